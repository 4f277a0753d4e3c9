//! [`Tool`]: a program that a language needs; finding it, its version, and running it.
//!
//! wasmouse installs nothing on its own. A missing tool is an error that says which one and the
//! command that installs it, the same that `wasmouse doctor` shows.

use std::ffi::OsString;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::cli::failure::Failure;
use crate::cli::output::{self, message};
use crate::report::text::{Text, text};

/// A program that is needed to build projects.
#[derive(Debug)]
pub struct Tool {
    /// What people call it.
    pub name: &'static str,
    /// The ways to start it, in the order in which they are tried.
    pub programs: &'static [Program],
    /// Arguments that make it print its version.
    pub version_arguments: &'static [&'static str],
    /// The oldest version that works.
    pub oldest: Version,
    /// The version that wasmouse is tested with.
    pub tested: Version,
    /// The command, or commands, that install it.
    pub install: &'static str,
}

/// A way to start a tool.
#[derive(Clone, Copy, Debug)]
pub enum Program {
    /// A program on the search path.
    OnPath(&'static str),
    /// A program that `npm` installed into the project.
    Npm(&'static str),
    /// A program in the project's virtual environment `.venv`.
    Venv(&'static str),
    /// A module of Python, started with `python3 -m`.
    PythonModule(&'static str),
    /// Another tool that does as well.
    Other(&'static Tool),
}

/// A version by its first three numbers; those that are missing are 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Version(pub u32, pub u32, pub u32);

/// A tool on this machine.
#[derive(Clone, Debug)]
pub struct FoundTool {
    tool: &'static Tool,
    /// The program and the arguments that come before those of a caller.
    program: OsString,
    arguments: Vec<OsString>,
    /// `None` where it prints none that can be read.
    pub version: Option<Version>,
}

impl Tool {
    /// Looks for the tool, for a project in `folder` or for any.
    ///
    /// # Errors
    ///
    /// When it is not there, or too old; the hint says how to install it.
    pub fn find(&'static self, folder: Option<&Path>) -> Result<FoundTool, Failure> {
        let mut too_old = None;
        for program in self.programs {
            let Some(found) = self.probe(*program, folder) else {
                continue;
            };
            match found.version {
                Some(version) if found.is(self) && version < self.oldest => {
                    too_old = too_old.or(Some(version));
                }
                _ => return Ok(found),
            }
        }
        let failure = match too_old {
            Some(version) => Failure::input(text!(
                "{} {} is too old; {} or later is needed",
                self.name,
                version,
                self.oldest
            )),
            None => Failure::input(text!("{} is not installed", self.name)),
        };
        Err(failure.hint(text!(
            "install it with: {}\n`wasmouse doctor` checks all tools",
            Text::of_lines(self.install)
        )))
    }

    fn probe(&'static self, program: Program, folder: Option<&Path>) -> Option<FoundTool> {
        if let Program::Other(tool) = program {
            return tool.find(folder).ok();
        }
        let (program, arguments) = program.command(folder)?;
        let mut found = FoundTool {
            tool: self,
            program,
            arguments,
            version: None,
        };
        let mut command = found.command();
        if let Some(folder) = folder {
            command.current_dir(folder);
        }
        let output = command
            .args(self.version_arguments)
            .stderr(Stdio::piped())
            .stdout(Stdio::piped())
            .output()
            .ok()
            .filter(|output| output.status.success())?;
        let printed = [output.stdout, output.stderr].concat();
        found.version = Version::find(&String::from_utf8_lossy(&printed));
        Some(found)
    }
}

impl Program {
    fn command(self, folder: Option<&Path>) -> Option<(OsString, Vec<OsString>)> {
        // A path with a folder in it has to be absolute: the child may run elsewhere.
        let local = |parts: &str, name: &str| -> Option<OsString> {
            let path = folder?.canonicalize().ok()?.join(parts).join(name);
            let candidates = ["", ".exe", ".cmd"].map(|suffix| {
                let mut name = path.clone().into_os_string();
                name.push(suffix);
                PathBuf::from(name)
            });
            let found = candidates.into_iter().find(|it| it.is_file())?;
            Some(found.into_os_string())
        };
        let scripts = if cfg!(windows) { "Scripts" } else { "bin" };
        let python = if cfg!(windows) { "python" } else { "python3" };
        match self {
            Self::OnPath(name) => Some((name.into(), Vec::new())),
            Self::Npm(name) => Some((local("node_modules/.bin", name)?, Vec::new())),
            Self::Venv(name) => {
                let folder = format!(".venv/{scripts}");
                Some((local(&folder, name)?, Vec::new()))
            }
            Self::PythonModule(module) => Some((python.into(), vec!["-m".into(), module.into()])),
            // It has programs of its own.
            Self::Other(_) => None,
        }
    }
}

impl FoundTool {
    /// Whether it is that tool, and not another that does as well.
    pub fn is(&self, tool: &'static Tool) -> bool {
        std::ptr::eq(self.tool, tool)
    }

    /// What people call it.
    pub const fn name(&self) -> &'static str {
        self.tool.name
    }

    /// A command that runs it, without arguments of a caller. It reads nothing from stdin.
    pub fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.args(&self.arguments).stdin(Stdio::null());
        command
    }

    /// Runs a command made by [`FoundTool::command`], to do what `purpose` says (such as
    /// "compile `my-robot`"). What it prints goes to stderr: stdout is for results.
    ///
    /// # Errors
    ///
    /// When it cannot be started or reports an error.
    pub fn run(&self, mut command: Command, purpose: &Text) -> Result<(), Failure> {
        let status = command
            .stdout(output::child_stdout())
            .status()
            .map_err(|error| self.not_started(&error))?;
        if status.success() {
            return Ok(());
        }
        Err(self.failed(purpose))
    }

    /// Runs a command made by [`FoundTool::command`] whose messages need work before people see
    /// them: keeps them, and returns what it printed if it reports an error.
    ///
    /// # Errors
    ///
    /// When it cannot be started.
    pub fn run_quietly(&self, mut command: Command) -> Result<Result<(), String>, Failure> {
        let output = command.output().map_err(|error| self.not_started(&error))?;
        if output.status.success() {
            return Ok(Ok(()));
        }
        let printed = [output.stdout, output.stderr].concat();
        Ok(Err(String::from_utf8_lossy(&printed).into_owned()))
    }

    /// Like [`FoundTool::failed`], after showing what the tool has printed.
    pub fn failed_with(&self, purpose: &Text, printed: &str) -> Failure {
        message!("{}", Text::of_lines(printed.trim_end()));
        self.failed(purpose)
    }

    /// What is said when it has reported an error, after its own messages.
    fn failed(&self, purpose: &Text) -> Failure {
        let name = self.tool.name;
        let mut hint = format!("the messages of {name} are above");
        if let Some(version) = self.version.filter(|it| *it != self.tool.tested) {
            use std::fmt::Write as _;
            write!(
                hint,
                "; this is version {version}, wasmouse is tested with {}",
                self.tool.tested
            )
            .expect("writing to a string cannot fail");
        }
        Failure::input(text!("{} failed to {}", name, purpose)).hint(hint)
    }

    fn not_started(&self, error: &std::io::Error) -> Failure {
        Failure::input(text!("failed to run {}: {}", self.tool.name, error))
    }
}

impl Version {
    /// The first version number in what a tool prints: numbers with dots between them.
    pub fn find(text: &str) -> Option<Self> {
        text.split(|c: char| !c.is_ascii_digit() && c != '.')
            .find_map(Self::parse)
    }

    fn parse(word: &str) -> Option<Self> {
        let mut numbers = word.split('.').map(|it| it.parse::<u32>());
        let first = numbers.next()?.ok()?;
        let second = numbers.next()?.ok()?;
        let third = numbers.next().and_then(Result::ok).unwrap_or(0);
        Some(Self(first, second, third))
    }
}

impl fmt::Display for Version {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}.{}", self.0, self.1, self.2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    static MISSING: Tool = Tool {
        name: "imaginary",
        programs: &[
            Program::OnPath("wasmouse-imaginary-tool"),
            Program::Npm("imaginary"),
            Program::Venv("imaginary"),
        ],
        version_arguments: &["--version"],
        oldest: Version(1, 0, 0),
        tested: Version(1, 2, 3),
        install: "imaginary-installer imaginary",
    };

    /// Present wherever these tests are compiled.
    static RUSTC: Tool = Tool {
        name: "rustc",
        programs: &[
            Program::OnPath("wasmouse-imaginary-tool"),
            Program::OnPath("rustc"),
        ],
        version_arguments: &["--version"],
        oldest: Version(1, 0, 0),
        tested: Version(1, 95, 0),
        install: "rustup toolchain install stable",
    };

    static RUSTC_OF_TOMORROW: Tool = Tool {
        name: "rustc",
        programs: &[Program::OnPath("rustc")],
        version_arguments: &["--version"],
        oldest: Version(1000, 0, 0),
        tested: Version(1000, 0, 0),
        install: "rustup toolchain install stable",
    };

    #[test]
    fn versions_are_found_in_what_tools_print() {
        for (printed, expected) in [
            ("0.17.1\n", Some(Version(0, 17, 1))),
            ("go version go1.27.3 linux/amd64", Some(Version(1, 27, 3))),
            ("Debian clang version 22.1.0 (1)", Some(Version(22, 1, 0))),
            ("v24.4\n", Some(Version(24, 4, 0))),
            ("Version 0.28.20-dev", Some(Version(0, 28, 20))),
            ("unknown", None),
            ("7", None),
            ("", None),
            ("...", None),
        ] {
            assert_eq!(Version::find(printed), expected, "{printed}");
        }
    }

    #[test]
    fn missing_and_old_tools_say_how_to_install_them() {
        let missing = MISSING.find(None).unwrap_err().to_string();
        assert!(missing.contains("imaginary is not installed"), "{missing}");
        assert!(missing.contains("imaginary-installer"), "{missing}");
        let old = RUSTC_OF_TOMORROW.find(None).unwrap_err().to_string();
        assert!(old.contains("is too old; 1000.0.0 or later"), "{old}");
        assert!(RUSTC.find(None).unwrap().version >= Some(Version(1, 80, 0)));
    }

    #[test]
    fn failures_name_the_tool_and_its_version() {
        let rustc = RUSTC.find(None).unwrap();
        let mut command = rustc.command();
        command
            .args(["--print", "nothing-that-there-is"])
            .stderr(Stdio::null());
        let failure = rustc.run(command, &text!("compile `x`")).unwrap_err();
        let failure = failure.to_string();
        assert!(failure.contains("rustc failed to compile `x`"), "{failure}");
        assert!(
            failure.contains("the messages of rustc are above"),
            "{failure}"
        );
    }
}
