//! `wasmouse new`: a project with a robot that builds and scores at once.
//!
//! Everything in it is compiled into this program. Rust has the templates of
//! `host/templates/new`, with the SDK and the WIT. A project in any other language is a copy of
//! its example robot, which the build script collects.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;

use super::exit::Exit;
use super::failure::Failure;
use super::output;
use super::project::LANGUAGES;
use crate::report::text::{Text, text};

const EXAMPLES: &str = "\
Examples:
  wasmouse new my-robot
  wasmouse build my-robot
  wasmouse run my-robot/my-robot.wasm
  wasmouse new my-robot --lang python";

/// The SDK and the WIT: names below `vendor/`, and contents.
const VENDOR: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/vendor.rs"));

/// The example robots of the other languages: names of languages, and their files by name and
/// content. [`EXAMPLE_NAME`] stands for the name of the project.
const LANGUAGE_TEMPLATES: &[(&str, &[(&str, &str)])] =
    include!(concat!(env!("OUT_DIR"), "/languages.rs"));

/// The name of each example robot, which a new project replaces by its own. Also with `_` for
/// `-`, where a language wants an identifier.
const EXAMPLE_NAME: &str = "example-robot";

/// The other files of a Rust project; `{{name}}` stands for its name.
const TEMPLATES: &[(&str, &str)] = &[
    ("Cargo.toml", include_str!("../../templates/new/Cargo.toml")),
    ("README.md", include_str!("../../templates/new/README.md")),
    (".gitignore", include_str!("../../templates/new/gitignore")),
    ("src/lib.rs", include_str!("../../templates/new/lib.rs")),
    (
        ".github/workflows/ci.yml",
        include_str!("../../templates/new/ci.yml"),
    ),
];

/// The longest name of a project. Unit: bytes. File systems allow 255 for a
/// file, and the name is a part of several.
const NAME_BYTES_MAX: usize = 64;

/// Create a project for a robot
///
/// The project has a robot that finishes mazes, a test, the interface for the editor, and a README
/// that says how to go on. The last part of PATH is its name.
#[derive(clap::Args, Debug)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// The folder to create; it must not be there yet.
    #[arg(value_name = "PATH")]
    path: PathBuf,
    /// Programming language of the robot
    #[arg(long, value_name = "LANGUAGE", default_value = "rust", value_parser = language_names())]
    lang: String,
}

/// What `--lang` takes.
fn language_names() -> PossibleValuesParser {
    PossibleValuesParser::new(LANGUAGES.iter().map(|it| it.name))
}

/// Creates the project and says what to do next.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let path = &args.path;
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .ok_or_else(|| Failure::usage(text!("`{}` has no name in it", Text::of_path(path))))?;
    check_name(name)?;
    if path.symlink_metadata().is_ok() {
        return Err(
            Failure::input(text!("`{}` already exists", Text::of_path(path)))
                .hint("choose another name, or remove it"),
        );
    }
    create(path, name, &args.lang).map_err(|error| {
        Failure::internal(text!(
            "failed to create `{}`: {}",
            Text::of_path(path),
            error
        ))
    })?;
    let path = Text::of_path(path);
    let mut created = text!("created {}\n\n", path);
    let setup = LANGUAGES
        .iter()
        .filter(|it| it.name == args.lang)
        .flat_map(|it| it.setup);
    for command in setup {
        created = text!("{}  (cd {} && {})\n", created, path, command);
    }
    let created = text!(
        "{}  wasmouse build {}\n  wasmouse run {}/{}.wasm\n",
        created,
        path,
        path,
        name
    );
    output::print(created.as_str())?;
    Ok(Exit::Success)
}

/// The rules for the name of a cargo package, and no surprises in file names.
fn check_name(name: &str) -> Result<(), Failure> {
    let legal = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let problem = if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        "it has to begin with a letter from a to z"
    } else if !name.chars().all(legal) {
        "it may have letters, digits, `-` and `_`, without accents"
    } else if name.len() > NAME_BYTES_MAX {
        "it has more than 64 characters"
    } else if is_reserved(&name.to_ascii_lowercase()) {
        "Rust, cargo or the system uses this word"
    } else {
        return Ok(());
    };
    Err(Failure::usage(format_args!(
        "`{}` cannot be the name of a project: {problem}",
        name.escape_debug()
    ))
    .hint("for example: wasmouse new my-robot"))
}

/// Words that cargo rejects as names, names of crates that the project links,
/// and names that Windows keeps for devices.
fn is_reserved(name: &str) -> bool {
    const KEYWORDS: &str = "abstract as async await become box break const continue crate do dyn \
        else enum extern false final fn for gen if impl in let loop macro match mod move mut \
        override priv pub ref return self static struct super trait true try type typeof unsafe \
        unsized use virtual where while yield";
    const CRATES: &str = "alloc build core deps examples incremental proc_macro proc-macro std \
        test wasmouse-sdk wasmouse_sdk";
    const DEVICES: &str = "con prn aux nul com1 com2 com3 com4 com5 com6 com7 com8 com9 lpt1 lpt2 \
        lpt3 lpt4 lpt5 lpt6 lpt7 lpt8 lpt9";
    [KEYWORDS, CRATES, DEVICES]
        .iter()
        .flat_map(|words| words.split_ascii_whitespace())
        .any(|word| word == name)
}

/// Writes the project beside its place and moves it there when it is complete,
/// so that a failure leaves nothing behind.
fn create(path: &Path, name: &str, language: &str) -> io::Result<()> {
    let parent = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // As for any new folder; without it, temporary folders are private.
        builder.permissions(fs::Permissions::from_mode(0o777));
    }
    let draft = builder.prefix(".wasmouse-new-").tempdir_in(parent)?;
    if language == "rust" {
        for (file, text) in TEMPLATES {
            write(draft.path(), file, &text.replace("{{name}}", name))?;
        }
        for (file, text) in VENDOR {
            write(&draft.path().join("vendor"), file, text)?;
        }
    } else {
        let identifier = name.replace('-', "_");
        for (file, text) in template_of(language) {
            let text = text
                .replace(EXAMPLE_NAME, name)
                .replace(&EXAMPLE_NAME.replace('-', "_"), &identifier);
            write(draft.path(), file, &text)?;
        }
    }
    // Moving fails on a folder that has appeared meanwhile and is not empty.
    fs::rename(draft.path(), path)?;
    // The draft is in its place now: there is nothing to remove.
    let _moved = draft.keep();
    Ok(())
}

/// The files of a language's example robot.
fn template_of(language: &str) -> &'static [(&'static str, &'static str)] {
    LANGUAGE_TEMPLATES
        .iter()
        .find(|(name, _)| *name == language)
        .map_or(&[], |(_, files)| *files)
}

fn write(folder: &Path, file: &str, text: &str) -> io::Result<()> {
    let path = folder.join(file);
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn new(path: &Path) -> Result<Exit, Failure> {
        run(&Args {
            path: path.to_owned(),
            lang: "rust".to_owned(),
        })
    }

    fn entries(folder: &Path) -> usize {
        fs::read_dir(folder).unwrap().count()
    }

    #[test]
    fn a_project_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("my-robot");
        new(&path).unwrap();
        assert_eq!(entries(folder.path()), 1, "the draft is gone");
        for file in [
            ".gitignore",
            "src/lib.rs",
            ".github/workflows/ci.yml",
            "vendor/wasmouse-sdk/src/bindings/generated.rs",
            "vendor/wasmouse-sdk/src/lib.rs",
            "vendor/wit/robot.wit",
        ] {
            assert!(path.join(file).is_file(), "{file}");
        }
        let read = |file: &str| fs::read_to_string(path.join(file)).unwrap();
        assert!(read("Cargo.toml").contains("name = \"my-robot\""));
        assert!(!read("README.md").contains("{{"));
        let sdk: toml::Table = toml::from_str(&read("vendor/wasmouse-sdk/Cargo.toml")).unwrap();
        assert_eq!(sdk["package"]["name"].as_str(), Some("wasmouse-sdk"));
        assert_eq!(sdk["package"]["edition"].as_str(), Some("2024"));
        // A project builds offline: the SDK is its only dependency and has none.
        assert_eq!(sdk.get("dependencies"), None);
        assert!(read(".github/workflows/ci.yml").contains("wasmouse run my-robot.wasm"));
        assert!(!read("vendor/wasmouse-sdk/Cargo.toml").contains("workspace"));
    }

    #[test]
    fn every_language_has_a_template() {
        for language in LANGUAGES.iter().filter(|it| it.name != "rust") {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("my-robot");
            run(&Args {
                path: path.clone(),
                lang: language.name.to_owned(),
            })
            .unwrap();
            assert!((language.is_in)(&path), "{}", language.name);
            let readme = fs::read_to_string(path.join("README.md")).unwrap();
            assert!(readme.starts_with("# my-robot\n"), "{readme}");
            for file in [".gitignore", ".github/workflows/ci.yml"] {
                assert!(path.join(file).is_file(), "{} {file}", language.name);
            }
            let mut left = vec![path];
            while let Some(path) = left.pop() {
                if path.is_dir() {
                    left.extend(fs::read_dir(&path).unwrap().map(|it| it.unwrap().path()));
                } else {
                    let text = fs::read_to_string(&path).unwrap();
                    assert!(!text.contains("example-robot"), "{}", path.display());
                    assert!(!text.contains("example_robot"), "{}", path.display());
                }
            }
        }
        for (name, _) in LANGUAGE_TEMPLATES {
            assert!(LANGUAGES.iter().any(|it| it.name == *name), "{name}");
        }
    }

    #[test]
    fn what_is_there_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("my-robot");
        fs::create_dir(&path).unwrap();
        let failure = new(&path).unwrap_err();
        assert_eq!(failure.exit(), Exit::Input);
        assert_eq!(entries(&path), 0);
        assert_eq!(entries(folder.path()), 1);
        let lost = folder.path().join("lost/my-robot");
        assert_eq!(new(&lost).unwrap_err().exit(), Exit::Internal);
        assert_eq!(entries(folder.path()), 1);
    }

    #[test]
    fn names_are_checked() {
        for name in ["a", "my-robot", "Robot_2", "x9"] {
            assert!(check_name(name).is_ok(), "{name}");
        }
        let long = "a".repeat(65);
        for name in [
            "",
            "9lives",
            "-a",
            "_a",
            "a b",
            "a.b",
            "é",
            "aé",
            "a/b",
            "fn",
            "Self",
            "test",
            "std",
            "wasmouse-sdk",
            "CON",
            &long,
            "a\n",
        ] {
            let failure = check_name(name).expect_err(name);
            assert_eq!(failure.exit(), Exit::Usage);
            assert!(!failure.to_string().contains("a\n`"));
        }
        assert_eq!(new(Path::new("..")).unwrap_err().exit(), Exit::Usage);
    }
}
