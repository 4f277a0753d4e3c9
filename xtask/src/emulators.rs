//! Emulators of other processors, on which tests play robots.
//!
//! They are QEMU's user emulators of a pinned package of Debian: older ones (7.2) end a program that
//! handles a signal as wasmtime does, and with it every robot that traps. `cargo xtask emulators`
//! downloads the package from the archive that this system takes its packages from, compares its
//! SHA-256, and takes only the programs out of it, which are linked statically, into
//! `target/emulators`; `cargo xtask test` calls it. As with validators, the tests that need an
//! emulator which cannot be had are skipped with a line on stderr ([`Emulator::find`]); where
//! [`REQUIRED_VARIABLE`] is set, they fail instead.

use std::collections::BTreeSet;
use std::fmt;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use sha2::{Digest as _, Sha256};

use crate::packages::{self, quiet};
use crate::step::target_folder;

/// Set to anything but the empty string, it makes a missing emulator a failure.
pub const REQUIRED_VARIABLE: &str = "WASMOUSE_REQUIRE_EMULATORS";

/// The pinned version of Debian's package `qemu-user`.
const VERSION: &str = "10.0.13+ds-0+deb13u1";

/// The SHA-256 of that package for amd64.
const SHA256: &str = "ca6ede739327a20ae5a3498230c8a3a9a072c586e131bc6bcc1201eb1725e336";

/// The oldest major version that may stand in for the pinned one.
const MAJOR_MIN: u32 = 10;

/// The longest that a download may take, in seconds.
const DOWNLOAD_SECONDS_MAX: &str = "300";

/// A program that runs programs for another processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Emulator {
    /// 64-bit x86: `qemu-x86_64 -cpu MODEL PROGRAM`.
    X86_64,
    /// 64-bit Arm: `qemu-aarch64 -L ROOT PROGRAM`.
    Aarch64,
}

impl Emulator {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::X86_64, Self::Aarch64];

    /// The name of its program.
    pub const fn program(self) -> &'static str {
        match self {
            Self::X86_64 => "qemu-x86_64",
            Self::Aarch64 => "qemu-aarch64",
        }
    }

    /// Its program, if it was installed from the pinned package, or else one of the system that is
    /// not too old.
    pub fn path(self, root: &Path) -> Option<PathBuf> {
        let installed = folder(root).join(self.program());
        if is_stamped(root) && installed.is_file() {
            return Some(installed);
        }
        let output = Command::new(self.program()).arg("--version").output();
        let major = major(&String::from_utf8_lossy(&output.ok()?.stdout))?;
        (major >= MAJOR_MIN).then(|| self.program().into())
    }

    /// Its program for the test of that name, or `None` after saying on stderr that the test is
    /// skipped. The line is not captured with the output of the test.
    ///
    /// # Panics
    ///
    /// When there is none and [`REQUIRED_VARIABLE`] is set.
    pub fn find(self, root: &Path, test: &str) -> Option<PathBuf> {
        let path = self.path(root);
        if path.is_none() {
            let program = self.program();
            let reason = format!(
                "no `{program}` of version {MAJOR_MIN} or newer; `cargo xtask emulators` installs it"
            );
            packages::skip(test, &reason, REQUIRED_VARIABLE);
        }
        path
    }
}

impl fmt::Display for Emulator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.program())
    }
}

/// The major version in what an emulator says of itself.
fn major(version: &str) -> Option<u32> {
    let (_, number) = version.split_once(" version ")?;
    number.split_once('.')?.0.parse().ok()
}

fn folder(root: &Path) -> PathBuf {
    target_folder(root).join("emulators")
}

fn stamp(root: &Path) -> PathBuf {
    folder(root).join("installed.txt")
}

fn is_stamped(root: &Path) -> bool {
    fs::read_to_string(stamp(root)).is_ok_and(|text| text == SHA256)
}

/// Installs the emulators, if they are not there. Says on stderr why that failed, and returns those
/// that tests cannot have.
pub fn install(root: &Path) -> Vec<Emulator> {
    eprintln!("==> emulators");
    if !is_stamped(root)
        && let Err(error) = download(root)
    {
        eprintln!("    {error}");
    }
    let is_missing = |emulator: &Emulator| emulator.path(root).is_none();
    let missing: Vec<Emulator> = Emulator::ALL.into_iter().filter(is_missing).collect();
    for emulator in &missing {
        eprintln!("    not installed: {emulator}; its tests are skipped");
    }
    missing
}

/// `cargo xtask emulators`.
///
/// # Errors
///
/// When one of them could not be installed.
pub fn run(root: &Path) -> Result<(), String> {
    match install(root).as_slice() {
        [] => Ok(()),
        missing => Err(format!("{} emulators are not installed", missing.len())),
    }
}

/// Downloads the package and takes the programs out of it.
fn download(root: &Path) -> Result<(), String> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return Err("the package is for Linux on 64-bit x86".to_owned());
    }
    let folder = folder(root);
    fs::create_dir_all(&folder).map_err(|error| error.to_string())?;
    let package = folder.join("qemu-user.deb");
    let fetched = archives().and_then(|archives| {
        let mut problem = "`apt-get` knows no archive of packages".to_owned();
        for archive in archives {
            match fetch(&archive, &package) {
                Ok(()) => return Ok(()),
                Err(error) => problem = error,
            }
        }
        Err(problem)
    });
    let unpacked = fetched.and_then(|()| unpack(&package, &folder));
    // It may not be there.
    let _ = fs::remove_file(&package);
    unpacked?;
    fs::write(stamp(root), SHA256).map_err(|error| error.to_string())
}

/// Where this system takes its packages from: the archive has those of later releases of Debian, too.
fn archives() -> Result<BTreeSet<String>, String> {
    let output = Command::new("apt-get")
        .args(["indextargets", "--format", "$(REPO_URI)"])
        .output()
        .map_err(|error| format!("`apt-get` cannot run: {error}"))?;
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    let lines = lines.lines().map(|line| line.trim_end_matches('/'));
    Ok(lines.map(str::to_owned).collect())
}

fn fetch(archive: &str, package: &Path) -> Result<(), String> {
    let url = format!("{archive}/pool/main/q/qemu/qemu-user_{VERSION}_amd64.deb");
    quiet(
        Command::new("curl")
            .args(["--fail", "--location", "--silent", "--show-error"])
            .args(["--max-time", DOWNLOAD_SECONDS_MAX, "--output"])
            .arg(package)
            .arg(url),
    )?;
    let bytes = fs::read(package).map_err(|error| error.to_string())?;
    let sha256: String = Sha256::digest(bytes)
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    if sha256 != SHA256 {
        return Err(format!(
            "{archive}: the package has the SHA-256 {sha256}, expected {SHA256}"
        ));
    }
    Ok(())
}

/// Takes the programs out of the package, and none of its other files.
fn unpack(package: &Path, folder: &Path) -> Result<(), String> {
    let mut dpkg = Command::new("dpkg-deb")
        .arg("--fsys-tarfile")
        .arg(package)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| format!("`dpkg-deb` cannot run: {error}"))?;
    let Some(stdout) = dpkg.stdout.take() else {
        return Err("`dpkg-deb` has no output".to_owned());
    };
    let copied = copy_programs(stdout, folder).map_err(|error| error.to_string());
    let status = dpkg.wait().map_err(|error| error.to_string())?;
    let programs = copied?;
    if !status.success() {
        return Err(format!("`dpkg-deb` failed ({status})"));
    }
    if programs < Emulator::ALL.len() {
        return Err(format!("the package has {programs} of the emulators"));
    }
    Ok(())
}

/// Copies the programs out of an archive and returns their number. Reads it to its end, so that
/// what writes it does not fail.
fn copy_programs(archive: impl io::Read, folder: &Path) -> io::Result<usize> {
    let mut programs = 0;
    for entry in tar::Archive::new(archive).entries()? {
        let mut entry = entry?;
        let path = entry.path()?.into_owned();
        let is_wanted = |it: &Emulator| path == Path::new("./usr/bin").join(it.program());
        let Some(emulator) = Emulator::ALL.into_iter().find(is_wanted) else {
            continue;
        };
        let path = folder.join(emulator.program());
        let mut file = File::create(&path)?;
        io::copy(&mut entry, &mut file)?;
        make_executable(&path)?;
        programs += 1;
    }
    Ok(programs)
}

#[cfg(unix)]
fn make_executable(path: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt as _;
    fs::set_permissions(path, fs::Permissions::from_mode(0o755))
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_read() {
        let debian = "qemu-x86_64 version 7.2.22 (Debian 1:7.2+dfsg-7+deb12u18+b3)\nCopyright";
        assert_eq!(major(debian), Some(7));
        assert_eq!(major("qemu-aarch64 version 10.0.13"), Some(10));
        assert_eq!(major("something else"), None);
    }

    #[test]
    fn only_the_programs_are_taken_out_of_an_archive() {
        let mut archive = tar::Builder::new(Vec::new());
        for name in ["qemu-x86_64", "qemu-arm", "qemu-aarch64"] {
            let mut header = tar::Header::new_gnu();
            header.set_size(3);
            header.set_mode(0o755);
            // As in Debian's packages, which `Builder::append_data` would shorten.
            let path = format!("./usr/bin/{name}");
            header.as_mut_bytes()[..path.len()].copy_from_slice(path.as_bytes());
            header.set_cksum();
            archive.append(&header, b"ELF".as_slice()).unwrap();
        }
        let archive = archive.into_inner().unwrap();
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(copy_programs(archive.as_slice(), folder.path()).unwrap(), 2);
        assert!(folder.path().join("qemu-x86_64").is_file());
        assert!(!folder.path().join("qemu-arm").exists());
    }
}
