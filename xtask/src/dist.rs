//! `cargo xtask dist`: the archive of a release for one platform, its checksum, and the installers.
//!
//! The release workflow calls this on every platform and uploads what is in the folder; nothing
//! about an archive is decided in the workflow, so that it can be tested here.
//!
//! Names have no version in them, so that the address of the latest release is known without
//! asking an interface for it. The version is in the tag, in the file `VERSION`, and in the program.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::GzEncoder;

use crate::sources::sha256;
use crate::step::{Step, target_folder};

/// What an archive holds besides the program: files of the repository.
const DOCUMENTS: [&str; 7] = [
    "README.md",
    "CHANGELOG.md",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "SECURITY.md",
    "docs/CI.md",
    // The font is part of the program.
    "host/src/report/raster/font/LICENSE_DEJAVU",
];

/// Scripts that download an archive, and the beginning of the line in each that says where from.
const INSTALLERS: [(&str, &str); 2] = [
    ("install.sh", "published_at="),
    ("install.ps1", "$PublishedAt = "),
];

/// What to pack.
#[derive(clap::Args, Debug, Default)]
pub struct Args {
    /// The platform, as a target triple of Rust; by default, that of this machine.
    #[arg(long, value_name = "TRIPLE")]
    pub target: Option<String>,
    /// Pack this program instead of building one.
    #[arg(long, value_name = "FILE")]
    pub binary: Option<PathBuf>,
    /// The folder to write to; by default, `target/dist`.
    #[arg(long, value_name = "FOLDER")]
    pub to: Option<PathBuf>,
    /// The tag of the release, `vVERSION`: an error if it is not the version of the workspace.
    #[arg(long, value_name = "TAG")]
    pub tag: Option<String>,
    /// The address of the repository that publishes the release: where the installers download
    /// from. Without it, they have to be told.
    #[arg(long, value_name = "URL", env = "WASMOUSE_REPOSITORY")]
    pub repository: Option<String>,
}

/// Writes the archive with its checksum, and the installers.
///
/// # Errors
///
/// A line that says what cannot be built, read or written.
pub fn run(root: &Path, args: &Args) -> Result<(), String> {
    let version = version(root)?;
    if let Some(tag) = &args.tag
        && *tag != format!("v{version}")
    {
        return Err(format!(
            "the tag is `{tag}`, and the version of the workspace is {version}; \
             change one of them"
        ));
    }
    let host = host_target()?;
    let target = args.target.as_deref().unwrap_or(&host);
    let binary = match &args.binary {
        Some(binary) => binary.clone(),
        None => build(root, target)?,
    };
    let folder = match &args.to {
        Some(folder) => folder.clone(),
        None => target_folder(root).join("dist"),
    };
    fs::create_dir_all(&folder).map_err(|error| at(&folder, &error))?;
    let archive = folder.join(format!("wasmouse-{target}.tar.gz"));
    pack(root, &binary, target, &version, &archive).map_err(|error| at(&archive, &error))?;
    let bytes = fs::read(&archive).map_err(|error| at(&archive, &error))?;
    let name = file_name(&archive);
    let checksum = folder.join(format!("{name}.sha256"));
    // As `sha256sum` writes it, so that `sha256sum --check` reads it.
    let line = format!("{}  {name}\n", sha256(&bytes));
    fs::write(&checksum, line).map_err(|error| at(&checksum, &error))?;
    println!("{}", archive.display());
    println!("{}", checksum.display());
    for (name, beginning) in INSTALLERS {
        let path = folder.join(name);
        installer(root, name, beginning, args.repository.as_deref(), &path)?;
        println!("{}", path.display());
    }
    Ok(())
}

/// Builds the program for release with the locked dependencies.
fn build(root: &Path, target: &str) -> Result<PathBuf, String> {
    Step::cargo(format!("build for {target}"), root)
        .args(["build", "--release", "--locked", "--target", target])
        .args(["--package", "wasmouse", "--bin", "wasmouse"])
        .run()?;
    let folder = target_folder(root).join(target).join("release");
    Ok(folder.join(program(target)))
}

/// The name of the program on that platform.
fn program(target: &str) -> &'static str {
    if target.contains("-windows-") {
        "wasmouse.exe"
    } else {
        "wasmouse"
    }
}

/// Writes the archive. The same files give the same bytes: owners, modes and times are constants.
fn pack(root: &Path, binary: &Path, target: &str, version: &str, archive: &Path) -> io::Result<()> {
    let compressed = GzEncoder::new(File::create(archive)?, Compression::best());
    let mut tar = tar::Builder::new(compressed);
    tar.mode(tar::HeaderMode::Deterministic);
    let folder = PathBuf::from(format!("wasmouse-{target}"));
    let mut add = |name: &str, mode: u32, content: &[u8]| {
        let mut header = tar::Header::new_gnu();
        header.set_size(content.len() as u64);
        header.set_mode(mode);
        // A time must not be 0, which `tar` calls implausible; this one has no meaning.
        header.set_mtime(1_700_000_000);
        tar.append_data(&mut header, folder.join(name), content)
    };
    add(program(target), 0o755, &fs::read(binary)?)?;
    add("VERSION", 0o644, format!("{version}\n").as_bytes())?;
    for document in DOCUMENTS {
        let name = file_name(Path::new(document));
        add(&name, 0o644, &fs::read(root.join(document))?)?;
    }
    tar.into_inner()?.finish()?.sync_all()
}

/// Copies an installer, with the address of the repository in the line that is for it.
fn installer(
    root: &Path,
    name: &str,
    beginning: &str,
    repository: Option<&str>,
    path: &Path,
) -> Result<(), String> {
    let source = root.join(name);
    let script = fs::read_to_string(&source).map_err(|error| at(&source, &error))?;
    let published_at = repository.unwrap_or_default();
    // It ends up inside quotes of a script.
    let is_harmless = |c: char| c.is_ascii_alphanumeric() || "-._~:/@".contains(c);
    if !published_at.chars().all(is_harmless) {
        return Err(format!(
            "`{published_at}` is not the address of a repository"
        ));
    }
    let line = |line: &str| {
        if line.starts_with(beginning) {
            format!("{beginning}'{published_at}'\n")
        } else {
            format!("{line}\n")
        }
    };
    let script: String = script.lines().map(line).collect();
    fs::write(path, script).map_err(|error| at(path, &error))?;
    fs::set_permissions(
        path,
        fs::metadata(&source)
            .map_err(|error| at(&source, &error))?
            .permissions(),
    )
    .map_err(|error| at(path, &error))
}

/// The version of the workspace.
///
/// # Errors
///
/// When its Cargo.toml cannot be read or has none.
pub fn version(root: &Path) -> Result<String, String> {
    let path = root.join("Cargo.toml");
    let text = fs::read_to_string(&path).map_err(|error| at(&path, &error))?;
    let manifest: toml::Table = toml::from_str(&text).map_err(|error| error.to_string())?;
    let version = manifest
        .get("workspace")
        .and_then(|it| it.get("package")?.get("version")?.as_str());
    version
        .map(str::to_owned)
        .ok_or_else(|| format!("`{}` has no version", path.display()))
}

/// The platform of the compiler.
fn host_target() -> Result<String, String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = std::process::Command::new(rustc)
        .arg("-vV")
        .output()
        .map_err(|error| format!("`rustc` cannot run: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let mut lines = text.lines();
    let host = lines.find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned)
        .ok_or_else(|| "`rustc -vV` names no host".to_owned())
}

fn file_name(path: &Path) -> String {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

fn at(path: &Path, error: &io::Error) -> String {
    format!("`{}`: {error}", path.display())
}
