//! Files by a pattern such as `submissions/*.wasm`.

use std::io;
use std::path::{Path, PathBuf};

use glob::{MatchOptions, Pattern, glob_with};

use super::output::message;
use crate::report::text::Text;

/// Hidden files have to be asked for, and `*` stays within a folder, as in a shell.
const OPTIONS: MatchOptions = MatchOptions {
    case_sensitive: true,
    require_literal_separator: true,
    require_literal_leading_dot: true,
};

/// The files and folders that match a pattern relative to a folder and are wanted, by name. `*`
/// and `?` stand for characters of a name, `[ab]` for one of them, `**` for any folders. As in
/// `input::list`, links that lead out of the folder that the pattern begins with are skipped with a
/// warning, and so is what is neither a file nor a folder.
///
/// # Errors
///
/// When it is no pattern, or a folder cannot be listed.
pub fn matches(
    folder: &Path,
    pattern: &str,
    is_wanted: impl Fn(&Path) -> bool,
) -> io::Result<Vec<PathBuf>> {
    let Some(base) = folder.to_str() else {
        return Err(io::Error::other(
            "patterns work only in folders whose path is Unicode",
        ));
    };
    let full = Path::new(&Pattern::escape(base)).join(pattern);
    let full = full.to_str().expect("both parts are Unicode");
    let found = glob_with(full, OPTIONS).map_err(|error| io::Error::other(error.msg))?;
    let inside = fixed_folder(folder, pattern).canonicalize();
    let mut paths = Vec::new();
    for path in found {
        let path = path?;
        if !is_wanted(&path) {
            continue;
        }
        let inside = inside.as_ref().map_err(|it| io::Error::from(it.kind()))?;
        // A link that leads nowhere cannot be followed.
        let target = path.canonicalize().unwrap_or_default();
        let problem = if !target.starts_with(inside) {
            "it is a link that leads out of the folder"
        } else if !target.is_file() && !target.is_dir() {
            "it is not a regular file"
        } else {
            paths.push(path);
            continue;
        };
        message!("warning: skipped `{}`: {}", Text::of_path(&path), problem);
    }
    paths.sort();
    Ok(paths)
}

/// The folder that everything that matches is in: the parts of the pattern before the first one
/// that stands for more than itself.
fn fixed_folder(folder: &Path, pattern: &str) -> PathBuf {
    let is_plain = |part: &&str| !part.contains(['*', '?', '[']);
    let parts: Vec<&str> = pattern.split('/').take_while(is_plain).collect();
    let is_absolute = pattern.starts_with('/');
    match (parts.join("/"), is_absolute) {
        (fixed, true) if fixed.is_empty() => PathBuf::from("/"),
        (fixed, false) if fixed.is_empty() && folder == Path::new("") => PathBuf::from("."),
        (fixed, _) => folder.join(fixed),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn names(folder: &Path, pattern: &str) -> Vec<String> {
        let paths = matches(folder, pattern, |_| true).expect("a pattern");
        let relative = paths
            .iter()
            .map(|it| it.strip_prefix(folder).expect("in it"));
        relative
            .map(|it| it.to_str().expect("Unicode").replace('\\', "/"))
            .collect()
    }

    #[test]
    fn patterns_match_as_in_a_shell() {
        let root = tempfile::tempdir().expect("a temporary folder");
        // The folder's own name has no meaning as a pattern.
        let folder = root.path().join("a[b]*");
        fs::create_dir_all(folder.join("sub/deep")).expect("folders");
        for name in [
            "b.wasm",
            "a.wasm",
            ".c.wasm",
            "sub/d.wasm",
            "sub/deep/e.wasm",
        ] {
            fs::write(folder.join(name), "").expect("a file");
        }
        let folder = folder.as_path();
        assert_eq!(names(folder, "*.wasm"), ["a.wasm", "b.wasm"]);
        assert_eq!(names(folder, "./[a]?wasm"), ["a.wasm"]);
        assert_eq!(names(folder, "*/*.wasm"), ["sub/d.wasm"]);
        let all = ["a.wasm", "b.wasm", "sub/d.wasm", "sub/deep/e.wasm"];
        assert_eq!(names(folder, "**/*.wasm"), all);
        assert_eq!(names(folder, "sub/*"), ["sub/d.wasm", "sub/deep"]);
        assert_eq!(names(folder, "none/*"), [""; 0]);
        let error = matches(folder, "a***", |_| true).expect_err("no pattern");
        assert!(error.to_string().contains("wildcards"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn links_out_of_the_folder_are_skipped() {
        use std::os::unix::fs::symlink;
        let root = tempfile::tempdir().expect("a temporary folder");
        let folder = root.path().join("submissions");
        fs::create_dir(&folder).expect("a folder");
        fs::write(root.path().join("secret.wasm"), "").expect("a file");
        fs::write(folder.join("a.wasm"), "").expect("a file");
        symlink(folder.join("a.wasm"), folder.join("b.wasm")).expect("a link");
        symlink(root.path().join("secret.wasm"), folder.join("c.wasm")).expect("a link");
        symlink("nowhere", folder.join("d.wasm")).expect("a link");
        let found = names(root.path(), "submissions/*.wasm");
        assert_eq!(found, ["submissions/a.wasm", "submissions/b.wasm"]);
    }
}
