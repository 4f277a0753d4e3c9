//! Which sources a robot is made of, and their hash.
//!
//! The hash covers the robot's crate, the SDK with its generated bindings, the WIT and the
//! release profile. It leaves out the compiler, whose version the manifest names, and the
//! dependencies of the workspace, because the SDK and the robots have none.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// The robots that are bundled with the host, sorted by name: the folders in
/// `example-robots` whose Cargo.toml has a table `[package.metadata.wasmouse]`.
///
/// # Errors
///
/// When the folder or a manifest in it cannot be read.
pub fn robot_names(root: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(root.join("example-robots"))? {
        let entry = entry?;
        let manifest = entry.path().join("Cargo.toml");
        if manifest.is_file() && is_bundled(&parse(&manifest)?) {
            names.push(entry.file_name().to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}

fn is_bundled(manifest: &toml::Table) -> bool {
    ["package", "metadata", "wasmouse"]
        .iter()
        .try_fold(manifest, |table, key| table.get(*key)?.as_table())
        .is_some()
}

/// The hash of everything that the robot `name` is made of: lowercase
/// hexadecimal SHA-256.
///
/// # Errors
///
/// When a source cannot be read, or a manifest cannot be understood.
pub fn sources_sha256(root: &Path, name: &str) -> io::Result<String> {
    let robot = Path::new("example-robots").join(name);
    let mut files = vec![
        robot.join("Cargo.toml"),
        PathBuf::from("guest-sdk/Cargo.toml"),
        PathBuf::from("wit/robot.wit"),
    ];
    collect(root, &robot.join("src"), &mut files)?;
    collect(root, Path::new("guest-sdk/src"), &mut files)?;
    files.sort();
    let mut hash = Sha256::new();
    for file in files {
        let label = file.to_string_lossy().replace('\\', "/");
        absorb(&mut hash, &label, &fs::read(root.join(&file))?);
    }
    absorb(&mut hash, "profile", release_profile(root)?.as_bytes());
    Ok(hexadecimal(&hash.finalize()))
}

/// The hash of files, and of all files in folders: lowercase hexadecimal SHA-256. Those that
/// do not exist are left out.
///
/// # Errors
///
/// When a file cannot be read.
pub fn files_sha256(root: &Path, paths: &[&Path]) -> io::Result<String> {
    let mut files = Vec::new();
    for &path in paths {
        if root.join(path).is_dir() {
            collect(root, path, &mut files)?;
        } else if root.join(path).exists() {
            files.push(path.to_owned());
        }
    }
    files.sort();
    let mut hash = Sha256::new();
    for file in files {
        let label = file.to_string_lossy().replace('\\', "/");
        absorb(&mut hash, &label, &fs::read(root.join(&file))?);
    }
    Ok(hexadecimal(&hash.finalize()))
}

/// Lowercase hexadecimal SHA-256 of `bytes`.
pub fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// Lengths go in as well, so that no two lists of files give the same input.
fn absorb(hash: &mut Sha256, label: &str, bytes: &[u8]) {
    for part in [label.as_bytes(), bytes] {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
}

fn hexadecimal(digest: &[u8]) -> String {
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// All files below `folder`, relative to `root`.
fn collect(root: &Path, folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(root.join(folder))? {
        let entry = entry?;
        let path = folder.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            collect(root, &path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}

fn release_profile(root: &Path) -> io::Result<String> {
    let manifest = parse(&root.join("Cargo.toml"))?;
    let profile = manifest.get("profile").and_then(|it| it.get("release"));
    Ok(profile.map(ToString::to_string).unwrap_or_default())
}

/// Reads a TOML file.
pub(crate) fn parse(path: &Path) -> io::Result<toml::Table> {
    let text = fs::read_to_string(path)?;
    toml::from_str(&text).map_err(|error| {
        io::Error::new(
            io::ErrorKind::InvalidData,
            format!("{}: {error}", path.display()),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A repository that is just large enough.
    fn repository() -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        for (file, text) in [
            ("Cargo.toml", "[profile.release]\nlto = \"thin\"\n"),
            ("Cargo.lock", "version = 4\n"),
            ("wit/robot.wit", "package a:b;\n"),
            ("guest-sdk/Cargo.toml", "[package]\n"),
            ("guest-sdk/src/lib.rs", "//! sdk\n"),
            (
                "example-robots/flood/Cargo.toml",
                "[package]\n[package.metadata.wasmouse]\n",
            ),
            ("example-robots/draft/Cargo.toml", "[package]\n"),
            ("example-robots/flood/src/lib.rs", "//! flood\n"),
            ("example-robots/flood/src/map/cell.rs", "//! cell\n"),
            ("example-robots/prebuilt/manifest.toml", "schema = 1\n"),
        ] {
            let path = root.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        root
    }

    #[track_caller]
    fn check_changes(file: &str, from: &str, to: &str, changes: bool) {
        let root = repository();
        let before = sources_sha256(root.path(), "flood").unwrap();
        let path = root.path().join(file);
        let text = fs::read_to_string(&path).unwrap();
        assert!(text.contains(from));
        fs::write(path, text.replace(from, to)).unwrap();
        let after = sources_sha256(root.path(), "flood").unwrap();
        assert_eq!(before != after, changes, "{file}: {from} -> {to}");
    }

    #[test]
    fn the_hash_covers_what_is_in_a_robot() {
        for file in [
            "wit/robot.wit",
            "guest-sdk/Cargo.toml",
            "example-robots/flood/Cargo.toml",
        ] {
            check_changes(file, "package", "package ", true);
        }
        check_changes("guest-sdk/src/lib.rs", "sdk", "SDK", true);
        check_changes("example-robots/flood/src/lib.rs", "flood", "f", true);
        check_changes("example-robots/flood/src/map/cell.rs", "cell", "c", true);
        check_changes("Cargo.toml", "thin", "fat", true);
        check_changes("Cargo.lock", "4", "5", false);
        check_changes("example-robots/prebuilt/manifest.toml", "1", "2", false);
    }

    #[test]
    fn moving_text_between_files_changes_the_hash() {
        let root = repository();
        let before = sources_sha256(root.path(), "flood").unwrap();
        let source = root.path().join("example-robots/flood/src");
        fs::write(source.join("lib.rs"), "//! flood\n//! cell\n").unwrap();
        fs::write(source.join("map/cell.rs"), "").unwrap();
        assert_ne!(before, sources_sha256(root.path(), "flood").unwrap());
    }

    #[test]
    fn only_marked_crates_are_bundled() {
        assert_eq!(robot_names(repository().path()).unwrap(), ["flood"]);
    }

    #[test]
    fn sha256_is_the_known_one() {
        assert_eq!(
            sha256(b"abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }
}
