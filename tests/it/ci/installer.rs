//! `install.sh`, run by `sh`, with folders of archives that `cargo xtask dist` makes.

use std::fs;
use std::io::{BufRead as _, BufReader, Write as _};
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;
use xtask::dist::{Args, run, version};

use super::repository_file;
use crate::binary::{Ran, ran};

/// A platform that no machine has, so that the program is installed without being run.
const OTHER: &str = "riscv128-unknown-linux-gnu";

/// A folder of archives, as a release has it.
pub struct Release {
    folder: TempDir,
    target: String,
}

impl Release {
    /// With a program that prints a line.
    pub fn new(target: &str, line: &str) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let program = folder.path().join("program");
        fs::write(&program, format!("#!/bin/sh\necho '{line}'\n")).expect("a file");
        let args = Args {
            target: Some(target.to_owned()),
            binary: Some(program),
            to: Some(folder.path().to_owned()),
            ..Args::default()
        };
        run(&xtask::repository(), &args).expect("an archive");
        Self {
            folder,
            target: target.to_owned(),
        }
    }

    fn archive(&self) -> PathBuf {
        let name = format!("wasmouse-{}.tar.gz", self.target);
        self.folder.path().join(name)
    }

    fn checksum(&self) -> PathBuf {
        self.archive().with_extension("gz.sha256")
    }

    pub fn address(&self) -> String {
        format!("file://{}", self.folder.path().display())
    }
}

/// The platform of this machine, as the installer names it.
pub fn this_target() -> String {
    let system = if cfg!(target_os = "macos") {
        "apple-darwin"
    } else if cfg!(target_env = "musl") {
        "unknown-linux-musl"
    } else {
        "unknown-linux-gnu"
    };
    format!("{}-{system}", std::env::consts::ARCH)
}

fn installer() -> Command {
    let mut command = Command::new("sh");
    command.arg(repository_file("install.sh"));
    command.env_remove("WASMOUSE_REPOSITORY");
    command
}

/// Installs into an empty folder; says whether there is a program in it afterwards.
fn install(address: &str, arguments: &[&str]) -> (Ran, bool) {
    let to = tempfile::tempdir().expect("a temporary folder");
    let ran = ran(installer()
        .env("WASMOUSE_DOWNLOAD", address)
        .args(["--to".as_ref(), to.path().as_os_str()])
        .args(arguments));
    let program = to.path().join("wasmouse");
    let is_installed = program.exists();
    if is_installed {
        let mode = fs::metadata(&program).expect("a program").permissions();
        assert_eq!(mode.mode() & 0o777, 0o755);
    }
    let files = fs::read_dir(to.path()).expect("a folder").count();
    assert_eq!(files, usize::from(is_installed), "nothing else is there");
    (ran, is_installed)
}

#[track_caller]
fn rejects(release: &Release, arguments: &[&str], message: &str) {
    let (ran, is_installed) = install(&release.address(), arguments);
    assert!(ran.stderr.contains(message), "{}", ran.stderr);
    assert_eq!(ran.stderr.matches("error: ").count(), 1, "{}", ran.stderr);
    assert_eq!((ran.status.code(), is_installed), (Some(1), false));
}

#[test]
fn a_good_archive_is_installed() {
    let version = version(&xtask::repository()).expect("a version");
    let release = Release::new(&this_target(), &format!("wasmouse {version}"));
    let tag = format!("v{version}");
    for arguments in [&[][..], &["--version", &version], &["--version", &tag]] {
        let (ran, is_installed) = install(&release.address(), arguments);
        assert!(ran.status.success() && is_installed, "{}", ran.stderr);
        assert!(ran.stderr.contains("is not on the PATH"), "{}", ran.stderr);
    }
    let release = Release::new(OTHER, "");
    let (ran, is_installed) = install(&release.address(), &["--target", OTHER]);
    assert!(ran.status.success() && is_installed, "{}", ran.stderr);
}

#[test]
fn what_is_not_what_was_published_is_not_installed() {
    let of = ["--target", OTHER];
    let damaged = Release::new(OTHER, "");
    let mut bytes = fs::read(damaged.archive()).expect("an archive");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(damaged.archive(), &bytes).expect("an archive");
    rejects(&damaged, &of, "and should have");

    let cut = Release::new(OTHER, "");
    fs::write(cut.archive(), &bytes[..middle]).expect("an archive");
    rejects(&cut, &of, "and should have");

    let without = Release::new(OTHER, "");
    fs::remove_file(without.checksum()).expect("a checksum");
    rejects(&without, &of, "hint: without its checksum");

    for invalid in ["", "404 Not Found\n", "abc123  x.tar.gz\n", &"g".repeat(64)] {
        let strange = Release::new(OTHER, "");
        fs::write(strange.checksum(), invalid).expect("a checksum");
        rejects(&strange, &of, "has no SHA-256 in it");
    }

    let missing = Release::new(OTHER, "");
    fs::remove_file(missing.archive()).expect("an archive");
    rejects(&missing, &of, "hint: is there a release");

    let other = Release::new(&this_target(), "wasmouse 0.0.0");
    let expected = "has wasmouse 0.0.0 instead of wasmouse 9.9.9";
    rejects(&other, &["--version", "9.9.9"], expected);
}

#[test]
fn bad_command_lines_are_explained() {
    let check = |command: &mut Command, message: &str| {
        let ran = ran(command);
        assert_eq!(ran.status.code(), Some(1));
        assert!(ran.stderr.contains(message), "{}", ran.stderr);
    };
    check(installer().arg("--to"), "error: --to needs a value");
    check(installer().arg("--too"), "error: unknown argument: --too");
    let windows = ["--target", "x86_64-pc-windows-msvc"];
    check(
        installer().args(windows),
        "hint: on Windows, use install.ps1",
    );
    check(&mut installer(), "hint: set WASMOUSE_REPOSITORY");
    check(installer().env_remove("HOME"), "error: HOME is not set");
    let help = ran(installer().arg("--help"));
    assert!(help.status.success() && help.stdout.starts_with("usage: "));
}

/// A web server on a free port of this machine, until it is dropped.
struct Server {
    process: Child,
    address: String,
}

impl Server {
    /// `None` without Python.
    fn new(folder: &Path) -> Option<Self> {
        let mut process = Command::new("python3")
            .args(["-u", "-m", "http.server", "0", "--bind", "127.0.0.1"])
            .current_dir(folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        let mut line = String::new();
        let stdout = process.stdout.take()?;
        BufReader::new(stdout).read_line(&mut line).ok()?;
        // `Serving HTTP on 127.0.0.1 port 40193 (http://127.0.0.1:40193/) ...`
        let address = line.split_once('(')?.1.split_once("/)")?.0.to_owned();
        Some(Self { process, address })
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

#[test]
fn archives_are_downloaded_from_a_server() {
    let release = Release::new(OTHER, "");
    let has = |tool: &str| Command::new(tool).arg("--version").output().is_ok();
    let server = Server::new(release.folder.path()).filter(|_| has("curl") || has("wget"));
    let Some(server) = server else {
        // Not captured with the output of the test.
        let mut stderr = std::io::stderr();
        let _ = writeln!(
            stderr,
            "skipped the download test: no python3, curl or wget"
        );
        return;
    };
    let of = ["--target", OTHER];
    let (ran, is_installed) = install(&server.address, &of);
    assert!(ran.status.success() && is_installed, "{}", ran.stderr);
    fs::remove_file(release.checksum()).expect("a checksum");
    let (ran, is_installed) = install(&server.address, &of);
    assert!(!ran.status.success() && !is_installed, "{}", ran.stderr);
    assert!(ran.stderr.contains("hint: without its checksum"));

    // The address of a repository has the folders of its releases below it.
    let nested = release.folder.path().join("releases/download/v1.2.3");
    fs::create_dir_all(&nested).expect("a folder");
    let again = Release::new(OTHER, "");
    for file in [again.archive(), again.checksum()] {
        let name = file.file_name().expect("a file");
        fs::copy(&file, nested.join(name)).expect("a copy");
    }
    let to = tempfile::tempdir().expect("a temporary folder");
    let ran = self::ran(
        installer()
            .env("WASMOUSE_REPOSITORY", &server.address)
            .env_remove("WASMOUSE_DOWNLOAD")
            .args(["--to".as_ref(), to.path().as_os_str()])
            .args(["--version", "1.2.3"])
            .args(of),
    );
    assert!(ran.status.success(), "{}", ran.stderr);
    assert!(to.path().join("wasmouse").exists());
}
