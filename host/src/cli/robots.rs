//! From what users write for a robot to entrants of a contest: [`load`].
//!
//! A robot is a bundled one by name or a file; `:N` behind it chooses a setting.
//! A file that is refused is no failure here: the contest goes on without it and
//! the report says why.

use std::fs;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::failure::Failure;
use crate::contest::Entrant;
use crate::report::visible;
use crate::robot::bundled::{BundledRobot, Variant, bundled, find};
use crate::robot::{CacheUse, Digest, HostError, Player, Referee, Refusal, Trust};

/// What a user may write for a robot, for the long help of commands.
pub const SPECIFICATION_HELP: &str = "\
A robot is one of:
  flood          the name of a bundled robot (see `wasmouse robots`)
  bot.wasm       a component, or a core module that can be turned into one
  flood:1        either with the number of a setting behind it; 0 without.
                 Settings of bundled robots also have names";

/// A robot that a specification names, not yet read.
#[derive(Clone, Debug)]
pub struct Specification {
    source: Source,
    setting: u32,
}

#[derive(Clone, Debug)]
enum Source {
    Bundled(&'static BundledRobot),
    File(PathBuf),
}

impl Specification {
    /// Whether a text that may mean a robot or a maze means a robot: a bundled
    /// name or a `.wasm` file, with or without a setting.
    pub fn is_meant_by(text: &str) -> bool {
        let names_robot = |name: &str| find(name).is_some() || has_wasm_extension(Path::new(name));
        names_robot(text) || split(text).is_some_and(|(name, _)| names_robot(name))
    }

    /// Whose code it is: bundled robots are the host's own.
    pub const fn trust(&self) -> Trust {
        match self.source {
            Source::Bundled(_) => Trust::Trusted,
            Source::File(_) => Trust::Stranger,
        }
    }

    /// The robot that this text means: a bundled name, or else a file whatever
    /// it is called.
    ///
    /// # Errors
    ///
    /// When a bundled robot does not have the setting.
    pub fn parse(text: &str) -> Result<Self, Failure> {
        if let Some(robot) = find(text) {
            let source = Source::Bundled(robot);
            return Ok(Self { source, setting: 0 });
        }
        let Some((name, setting)) = split(text) else {
            return Ok(Self::file(text, 0));
        };
        if let Some(robot) = find(name) {
            let setting = bundled_setting(robot, setting)?;
            let source = Source::Bundled(robot);
            return Ok(Self { source, setting });
        }
        // A colon may be part of a file's name.
        Ok(match setting.parse() {
            Ok(setting) => Self::file(name, setting),
            Err(_) => Self::file(text, 0),
        })
    }

    /// All bundled robots, each once for every setting.
    pub fn bundled_in_every_setting() -> Vec<Self> {
        let mut all = Vec::new();
        for robot in bundled() {
            let source = Source::Bundled(robot);
            let values = robot.variants.iter().map(|setting| setting.value);
            let only = robot.variants.is_empty().then_some(0);
            all.extend(values.chain(only).map(|setting| Self {
                source: source.clone(),
                setting,
            }));
        }
        all
    }

    fn file(path: &str, setting: u32) -> Self {
        let source = Source::File(path.into());
        Self { source, setting }
    }

    /// The bytes of the robot.
    ///
    /// # Errors
    ///
    /// When the file cannot be read.
    pub fn read(&self, bytes_max: u64) -> Result<Vec<u8>, Failure> {
        match &self.source {
            Source::Bundled(robot) => Ok(robot.component.to_vec()),
            Source::File(path) => read_file(path, bytes_max),
        }
    }

    /// Whether it comes with the host.
    pub const fn is_bundled(&self) -> bool {
        matches!(self.source, Source::Bundled(_))
    }

    /// The bundled name or the file name without its ending.
    pub fn robot_name(&self) -> String {
        match &self.source {
            Source::Bundled(robot) => robot.name.to_owned(),
            Source::File(path) => path
                .file_stem()
                .unwrap_or(path.as_os_str())
                .to_string_lossy()
                .into_owned(),
        }
    }

    /// The name of a bundled robot's setting, the number of a file's; `None` of
    /// robots without settings and of files with the setting 0.
    pub fn setting_name(&self) -> Option<String> {
        match &self.source {
            Source::Bundled(robot) => {
                let mut settings = robot.variants.iter();
                let setting = settings.find(|it| it.value == self.setting)?;
                Some(setting.name.to_owned())
            }
            Source::File(_) => (self.setting != 0).then(|| self.setting.to_string()),
        }
    }

    /// The bundled name or the file name without its ending, and the setting.
    fn short_name(&self) -> String {
        self.with_setting(self.robot_name())
    }

    /// The bundled name or the whole path, and the setting.
    fn label(&self) -> String {
        match &self.source {
            Source::Bundled(_) => self.short_name(),
            Source::File(path) => self.with_setting(path.display().to_string()),
        }
    }

    fn with_setting(&self, name: String) -> String {
        match self.setting {
            0 => name,
            setting => format!("{name}:{setting}"),
        }
    }
}

/// Takes what may be a setting off the end of a specification.
fn split(text: &str) -> Option<(&str, &str)> {
    text.rsplit_once(':').filter(|(name, _)| !name.is_empty())
}

/// The number of a bundled robot's setting, given as a number or by name.
fn bundled_setting(robot: &BundledRobot, text: &str) -> Result<u32, Failure> {
    let is_meant = |setting: &&Variant| {
        setting.name == text || text.parse().is_ok_and(|value: u32| value == setting.value)
    };
    if let Some(setting) = robot.variants.iter().find(is_meant) {
        return Ok(setting.value);
    }
    let text = visible(text);
    let failure = Failure::usage(format!("robot `{}` has no setting `{text}`", robot.name));
    Err(if robot.variants.is_empty() {
        failure.hint("it has no settings: leave the colon out")
    } else {
        let known = robot.variants.iter();
        let known: Vec<String> = known
            .map(|setting| format!("{} ({})", setting.value, setting.name))
            .collect();
        failure.hint(format!("its settings are {}", known.join(", ")))
    })
}

/// Whether a file has the ending of robots.
pub fn has_wasm_extension(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("wasm"))
}

/// Reads at most one byte more than a robot may have.
///
/// # Errors
///
/// When the file cannot be read.
pub fn read_file(path: &Path, bytes_max: u64) -> Result<Vec<u8>, Failure> {
    let shown = visible(&path.display().to_string());
    let failed = |error: std::io::Error| {
        let failure = Failure::input(format!("failed to read robot `{shown}`: {error}"));
        let names: Vec<&str> = bundled().iter().map(|robot| robot.name).collect();
        failure.hint(format!(
            "give a .wasm file or one of the bundled robots: {}",
            names.join(", ")
        ))
    };
    let file = fs::File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    file.take(bytes_max.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    Ok(bytes)
}

/// Reads the robots and asks the host to admit them.
///
/// # Errors
///
/// When a file cannot be read, or a robot is given twice; a robot that is refused
/// is an entrant all the same.
pub fn load(specifications: &[Specification], referee: &Referee) -> Result<Vec<Entrant>, Failure> {
    let mut labels: Vec<String> = specifications.iter().map(Specification::label).collect();
    labels.sort();
    if let Some(twice) = labels.windows(2).find(|pair| pair[0] == pair[1]) {
        let message = format!("robot `{}` is given twice", visible(&twice[0]));
        return Err(Failure::usage(message).hint("--repeat plays a robot more than once"));
    }
    let mut entrants = Vec::with_capacity(specifications.len());
    for specification in specifications {
        let bytes = specification.read(referee.rules().limits.component_bytes_max)?;
        let name = unique_name(specification, specifications);
        let admission = admit(referee, &bytes, specification.trust())?;
        entrants.push(Entrant {
            name,
            digest: Digest::of(&bytes),
            setting: specification.setting,
            admission,
        });
    }
    Ok(entrants)
}

/// Has the referee look at a robot, and tells what the user should know about that.
///
/// # Errors
///
/// When the host fails.
pub fn admit(
    referee: &Referee,
    bytes: &[u8],
    trust: Trust,
) -> Result<Result<Arc<Player>, Arc<Refusal>>, Failure> {
    let had_workers = referee.sandbox().is_some();
    let admission = referee
        .admit(bytes, trust)
        .map_err(|error| setup_failure(&error))?;
    if !had_workers {
        tell_sandbox(referee);
    }
    if let Ok(player) = &admission
        && let CacheUse::Failed(reason) = player.cache_use()
    {
        tell!("warning: {reason}; robots are compiled anew each time");
    }
    Ok(admission.map(Arc::new).map_err(Arc::new))
}

/// Says once where workers are confined by less than everything.
pub fn tell_sandbox(referee: &Referee) {
    static TOLD: AtomicBool = AtomicBool::new(false);
    if let Some(sandbox) = referee.sandbox()
        && !sandbox.is_complete()
        && !TOLD.swap(true, Ordering::Relaxed)
    {
        let lacks = match (sandbox.landlock, sandbox.seccomp) {
            (false, false) => "landlock and seccomp",
            (false, true) => "landlock",
            (true, _) => "seccomp",
        };
        tell!(
            "warning: this system has no {lacks}, so strangers' robots are kept apart by \
             processes with fewer restrictions; --require-sandbox refuses to go on"
        );
    }
}

/// A host that cannot begin.
pub fn setup_failure(error: &HostError) -> Failure {
    let hint = match error {
        HostError::Unconfined(_) => {
            "use Linux 5.13 or later with landlock and seccomp, or leave --require-sandbox out"
        }
        HostError::Engine(_) | HostError::Thread(_) => "try fewer threads with --jobs",
        _ => "--trust runs robots without worker processes",
    };
    Failure::host(error).hint(hint)
}

fn unique_name(specification: &Specification, all: &[Specification]) -> String {
    let name = specification.short_name();
    let is_taken = all
        .iter()
        .any(|other| other.label() != specification.label() && other.short_name() == name);
    if is_taken {
        specification.label()
    } else {
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(text: &str) -> (PathBuf, u32) {
        match Specification::parse(text).expect("a file").source {
            Source::File(path) => (path, Specification::parse(text).expect("a file").setting),
            Source::Bundled(robot) => panic!("{text} is the bundled robot {}", robot.name),
        }
    }

    #[test]
    fn settings_are_split_off_files() {
        for (text, path, setting) in [
            ("bot.wasm", "bot.wasm", 0),
            ("bot.wasm:2", "bot.wasm", 2),
            ("a:b.wasm", "a:b.wasm", 0),
            ("bot.wasm:-1", "bot.wasm:-1", 0),
            (":3", ":3", 0),
        ] {
            assert_eq!(file(text), (path.into(), setting), "{text}");
        }
    }

    #[test]
    fn only_wasm_files_and_bundled_names_are_robots() {
        for (text, is_robot) in [
            ("a/b.WASM:1", true),
            ("flood", true),
            ("flood:0", true),
            ("maze.txt", false),
            ("gen:tree:16:1", false),
            ("test_maze_01", false),
        ] {
            assert_eq!(Specification::is_meant_by(text), is_robot, "{text}");
        }
    }

    #[test]
    fn unknown_settings_of_bundled_robots_are_refused() {
        let failure = Specification::parse("flood:nosuch").expect_err("no such setting");
        let message = failure.to_string();
        assert!(
            message.starts_with("error: robot `flood` has no setting `nosuch`\n\nhint: "),
            "{message}"
        );
    }
}
