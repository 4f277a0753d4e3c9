//! [`Project`]: a copy of `host/web` below `target`, with the packages that its lock file names.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::packages::{NPM_OPTIONS, npm, quiet};
use crate::sources::files_sha256;
use crate::step::{Step, target_folder};

/// What is copied.
const PARTS: [&str; 6] = [
    "build.mjs",
    "package-lock.json",
    "package.json",
    "src",
    "tests",
    "tsconfig.json",
];

/// The oldest Node that the packages work with.
const NODE_MIN: u32 = 20;

/// A copy of `host/web` whose packages are installed.
pub struct Project {
    folder: PathBuf,
}

/// Everything about the player below `target`.
pub fn folder(root: &Path) -> PathBuf {
    target_folder(root).join("web")
}

impl Project {
    /// Copies the project and installs its packages, unless they are there.
    ///
    /// # Errors
    ///
    /// A line about what is missing: Node, or a package.
    pub fn install(root: &Path) -> Result<Self, String> {
        check_node()?;
        let folder = folder(root).join("project");
        fs::create_dir_all(&folder).map_err(text)?;
        for part in PARTS {
            mirror(&root.join("host/web").join(part), &folder.join(part)).map_err(text)?;
        }
        let lock = Path::new("host/web/package-lock.json");
        let expected = files_sha256(root, &[lock]).map_err(text)?;
        let stamp = folder.join("installed.txt");
        if !fs::read_to_string(&stamp).is_ok_and(|it| it == expected) {
            quiet(
                npm()
                    .arg("ci")
                    .args(NPM_OPTIONS)
                    .arg("--prefix")
                    .arg(&folder),
            )?;
            fs::write(stamp, expected).map_err(text)?;
        }
        Ok(Self { folder })
    }

    /// Builds script and style sheet into a folder.
    ///
    /// # Errors
    ///
    /// A line that names the step.
    pub fn build(&self, output: &Path) -> Result<(), String> {
        self.node("script of web pages", &["build.mjs"])
            .args([output])
            .run()
    }

    /// Checks the types of the script.
    ///
    /// # Errors
    ///
    /// A line that names the step.
    pub fn check_types(&self) -> Result<(), String> {
        let compiler = ["node_modules/typescript/bin/tsc", "--noEmit"];
        self.node("types of the script", &compiler).run()
    }

    /// A step that runs a program of Node in the project.
    pub fn node(&self, name: &str, arguments: &[&str]) -> Step {
        Step::new(name, &self.folder, "node").args(arguments)
    }
}

fn check_node() -> Result<(), String> {
    let output = Command::new("node")
        .arg("--version")
        .output()
        .map_err(|error| format!("`node` cannot run: {error}"))?;
    let version = String::from_utf8_lossy(&output.stdout);
    let version = version.trim();
    let major = version.trim_start_matches('v').split('.').next();
    match major.and_then(|it| it.parse::<u32>().ok()) {
        Some(major) if major >= NODE_MIN => Ok(()),
        _ => Err(format!(
            "Node {NODE_MIN} or newer is needed, found `{version}`"
        )),
    }
}

/// Makes `to` the same as `from`: a file, or a folder with everything in it.
fn mirror(from: &Path, to: &Path) -> io::Result<()> {
    if !from.is_dir() {
        fs::copy(from, to)?;
        return Ok(());
    }
    if to.exists() {
        fs::remove_dir_all(to)?;
    }
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let name = entry?.file_name();
        mirror(&from.join(&name), &to.join(&name))?;
    }
    Ok(())
}

fn text(error: io::Error) -> String {
    error.to_string()
}
