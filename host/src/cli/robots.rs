//! What users write for a robot: [`RobotSpec`].
//!
//! A robot is a bundled one by name, a file, a folder of files or a robot project; a name and a
//! variant can be given to it. `entrants` admits it.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use wasmouse_core::{GuestText, guest_text};
use wasmouse_engine::Trust;
use wasmouse_engine::bundled::{BundledRobot, Variant, bundled, find};

use super::failure::Failure;
use super::input;
use super::output::message;
use super::project;
use crate::contest::config::suggestion;
use crate::report::escape::for_terminal;
use crate::report::text::Text;

/// What a user may write for a robot, for the long help of commands.
pub const SPECIFICATION_HELP: &str = "\
A robot is one of:
  flood          the name of a bundled robot (see `wasmouse robots`)
  bot.wasm       a component, or a core module that can be turned into one
  bot.wat        either of them as WebAssembly text
  submissions    a folder: all its .wasm and .wat files by name, without subfolders
  my-robot       a robot project in any language: it is built first
  flood:certain  any of these followed by a variant: its number or, for bundled
                 robots, its name (default: 0)
  ann=bot.wasm   a file, with the name that results call it";

/// A robot that the command line names, not yet read.
#[derive(Clone, Debug)]
pub struct RobotSpec {
    source: Source,
    variant: u32,
    /// The name that the user gave it.
    name: Option<GuestText>,
}

#[derive(Clone, Debug)]
enum Source {
    Bundled(&'static BundledRobot),
    File(PathBuf),
}

/// Whether an argument that may mean a robot or a maze means a robot.
pub fn is_robot(argument: &str) -> bool {
    let argument = split_name(argument).map_or(argument, |(_, rest)| rest);
    let names_robot = |text: &str| {
        let path = Path::new(text);
        find(text).is_some()
            || has_robot_extension(path)
            || project::is_project(path)
            || (path.is_dir() && has_robots(path))
    };
    names_robot(argument) || split_variant(argument).is_some_and(|(text, _)| names_robot(text))
}

/// The robots that an argument names; a robot project is built.
///
/// # Errors
///
/// When a bundled robot does not have the variant, a folder has no robots, or a project cannot
/// be built.
pub fn resolve(argument: &str) -> Result<Vec<RobotSpec>, Failure> {
    let (name, text) = match split_name(argument) {
        Some((name, rest)) => (Some(GuestText::from(name)), rest),
        None => (None, argument),
    };
    let (text, variant) = match split_variant(text) {
        _ if find(text).is_some() || Path::new(text).exists() => (text, None),
        Some((rest, variant)) if find(rest).is_some() || variant.parse::<u32>().is_ok() => {
            (rest, Some(variant))
        }
        _ => (text, None),
    };
    if let Some(robot) = find(text) {
        let variant = variant.map_or(Ok(0), |it| bundled_variant(robot, it))?;
        let source = Source::Bundled(robot);
        return Ok(vec![RobotSpec {
            source,
            variant,
            name,
        }]);
    }
    let variant = variant.map_or(0, |it| it.parse().expect("checked to be a number above"));
    let files = files_at(Path::new(text))?;
    if name.is_some() && files.len() > 1 {
        let message = format!("`{}` names more than one robot", for_terminal(argument));
        return Err(Failure::usage(message).hint("give a name to a single file"));
    }
    let specs = files.into_iter().map(|file| RobotSpec {
        source: Source::File(file),
        variant,
        name: name.clone(),
    });
    Ok(specs.collect())
}

/// The files of the robots at a path: a file, all robots of a folder, or what a robot project
/// builds.
///
/// # Errors
///
/// When a folder has no robots, or a project cannot be built.
pub fn files_at(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    if project::is_project(path) {
        Ok(vec![project::build(path)?])
    } else if path.is_dir() {
        folder(path)
    } else {
        warn_if_stale(path);
        Ok(vec![path.to_owned()])
    }
}

/// Takes `NAME=` off the front of an argument. A file whose own name has a `=` in it is meant
/// as it is.
fn split_name(argument: &str) -> Option<(&str, &str)> {
    let (name, rest) = argument.split_once('=')?;
    let is_name = !name.is_empty() && !name.contains(['/', '\\', ':']);
    (is_name && !rest.is_empty() && !Path::new(argument).exists()).then_some((name, rest))
}

/// Takes what may be a variant off the end of an argument.
fn split_variant(text: &str) -> Option<(&str, &str)> {
    text.rsplit_once(':').filter(|(rest, _)| !rest.is_empty())
}

/// The number of a bundled robot's variant, given by number or name.
fn bundled_variant(robot: &BundledRobot, text: &str) -> Result<u32, Failure> {
    let is_meant = |variant: &&Variant| {
        variant.name == text || text.parse().is_ok_and(|value: u32| value == variant.value)
    };
    if let Some(variant) = robot.variants.iter().find(is_meant) {
        return Ok(variant.value);
    }
    let text = for_terminal(text);
    let failure = Failure::usage(format!("robot `{}` has no variant `{text}`", robot.name));
    if robot.variants.is_empty() {
        return Err(failure.hint("it has no variants; leave the colon out"));
    }
    let names: Vec<&str> = robot.variants.iter().map(|it| it.name).collect();
    Err(failure.hint(format!("its variants are {}", names.join(", "))))
}

/// The robots in a folder.
///
/// # Errors
///
/// When the folder cannot be read or has no robots.
pub fn folder(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    let shown = for_terminal(&path.display().to_string());
    let files = robot_files(path).map_err(|error| {
        Failure::input(format!("failed to read robots from `{shown}`: {error}"))
    })?;
    if files.is_empty() {
        return Err(Failure::input(format!("folder `{shown}` has no robots"))
            .hint("robots are files that end in .wasm or .wat"));
    }
    Ok(files)
}

/// Whether a folder has robots in files.
pub fn has_robots(folder: &Path) -> bool {
    input::has_any(folder, has_robot_extension)
}

/// The files in a folder that end in `.wasm` or `.wat`, by name.
fn robot_files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    input::list(folder, has_robot_extension)
}

/// Whether a file has an extension of robots. What it is depends on its content alone.
pub fn has_robot_extension(path: &Path) -> bool {
    path.extension().is_some_and(|extension| {
        ["wasm", "wat"]
            .iter()
            .any(|it| extension.eq_ignore_ascii_case(it))
    })
}

/// Warns about a component beside a robot project whose sources are newer.
fn warn_if_stale(component: &Path) {
    let Some(folder) = component.parent().map(|it| match it.to_str() {
        Some("") => Path::new("."),
        _ => it,
    }) else {
        return;
    };
    if let Some(source) = project::newer_source(folder, component) {
        message!(
            "warning: `{}` is older than `{}`\n  hint: rebuild it with `wasmouse build {}`",
            Text::of_path(component),
            Text::of_path(&source),
            Text::of_path(folder),
        );
    }
}

impl RobotSpec {
    /// A bundled robot in its default variant.
    pub const fn bundled(robot: &'static BundledRobot) -> Self {
        Self {
            source: Source::Bundled(robot),
            variant: 0,
            name: None,
        }
    }

    /// A bundled robot in a variant, with a name if it has one of its own.
    pub const fn of_bundled(
        robot: &'static BundledRobot,
        variant: u32,
        name: Option<GuestText>,
    ) -> Self {
        Self {
            source: Source::Bundled(robot),
            variant,
            name,
        }
    }

    /// A robot in a file, in a variant, with a name if it is not that of the file.
    pub const fn of_file(path: PathBuf, variant: u32, name: Option<GuestText>) -> Self {
        Self {
            source: Source::File(path),
            variant,
            name,
        }
    }

    /// The file; `None` for a bundled robot.
    pub fn file(&self) -> Option<&Path> {
        match &self.source {
            Source::File(path) => Some(path),
            Source::Bundled(_) => None,
        }
    }

    /// The number that chooses its mode.
    pub const fn variant(&self) -> u32 {
        self.variant
    }

    /// Whose code it is: bundled robots are trusted.
    pub const fn trust(&self) -> Trust {
        match self.source {
            Source::Bundled(_) => Trust::Trusted,
            Source::File(_) => Trust::Untrusted,
        }
    }

    /// The bytes of the robot, at most one more than it may have.
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

    /// What results call it if nothing else is called so: the given name, or the bundled name
    /// or file name without its extension, with the variant.
    pub fn short_name(&self) -> GuestText {
        match (&self.name, &self.source) {
            (Some(name), _) => self.with_variant(name.clone()),
            (None, Source::Bundled(robot)) => self.with_variant(robot.name.into()),
            (None, Source::File(path)) => {
                let stem = path.file_stem().unwrap_or(path.as_os_str());
                self.with_variant((&*stem.to_string_lossy()).into())
            }
        }
    }

    /// A name that no other robot has: with the whole path.
    fn label(&self) -> GuestText {
        match &self.source {
            Source::Bundled(_) => self.short_name(),
            Source::File(path) => self.with_variant(path.display().to_string().into()),
        }
    }

    /// The name with the variant, by name where it has one.
    fn with_variant(&self, name: GuestText) -> GuestText {
        if let Source::Bundled(robot) = &self.source {
            let mut variants = robot.variants.iter();
            if let Some(variant) = variants.find(|it| it.value == self.variant) {
                return guest_text!("{}:{}", name, variant.name);
            }
        }
        match self.variant {
            0 => name,
            variant => guest_text!("{}:{}", name, variant),
        }
    }
}

/// Reads at most one byte more than a robot may have.
///
/// # Errors
///
/// When the file cannot be read.
pub fn read_file(path: &Path, bytes_max: u64) -> Result<Vec<u8>, Failure> {
    let shown = for_terminal(&path.display().to_string());
    let failed = |error: std::io::Error| {
        Failure::input(format!("failed to read robot `{shown}`: {error}"))
            .hint(unknown_hint(&path.to_string_lossy()))
    };
    let file = input::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    file.take(bytes_max.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    Ok(bytes)
}

/// What to try instead of a robot that does not exist.
pub fn unknown_hint(text: &str) -> String {
    let names = bundled().iter().map(|robot| robot.name);
    suggestion(text, names.clone()).unwrap_or_else(|| {
        let names: Vec<&str> = names.collect();
        format!(
            "give a .wasm or .wat file, a folder of them, or one of the bundled robots: {}",
            names.join(", ")
        )
    })
}

/// The short names, or the labels of those robots that share a short name with another: what
/// results call them.
///
/// # Errors
///
/// When two robots have the same name.
pub fn unique_names(specs: &[RobotSpec]) -> Result<Vec<GuestText>, Failure> {
    let short: Vec<GuestText> = specs.iter().map(RobotSpec::short_name).collect();
    let is_shared = |name: &GuestText| short.iter().filter(|it| *it == name).count() > 1;
    let names: Vec<GuestText> = specs
        .iter()
        .zip(&short)
        .map(|(spec, name)| {
            if spec.name.is_none() && is_shared(name) {
                spec.label()
            } else {
                name.clone()
            }
        })
        .collect();
    let mut sorted: Vec<&GuestText> = names.iter().collect();
    sorted.sort();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        None => Ok(names),
        Some(pair) => {
            let message = format!("robot `{}` is given twice", for_terminal(pair[0]));
            let hint = "NAME=FILE gives a robot another name; --repeat plays it more than once";
            Err(Failure::usage(message).hint(hint))
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[track_caller]
    fn check(argument: &str, label: &str, variant: u32, name: Option<&str>) {
        let specs = resolve(argument).expect("a robot");
        let [spec] = &specs[..] else {
            panic!("{argument} is one robot");
        };
        let found = (spec.label(), spec.variant, spec.name.clone());
        let expected = (label.into(), variant, name.map(GuestText::from));
        assert_eq!(found, expected, "{argument}");
    }

    #[test]
    fn names_and_variants_are_split_off() {
        check("bot.wasm", "bot.wasm", 0, None);
        check("bot.wasm:2", "bot.wasm:2", 2, None);
        check("a:b.wasm", "a:b.wasm", 0, None);
        check("bot.wasm:-1", "bot.wasm:-1", 0, None);
        check("ann=bot.wasm:2", "bot.wasm:2", 2, Some("ann"));
        check("flood", "flood:reset", 0, None);
        check("flood:certain", "flood:certain", 1, None);
        check("flood:1", "flood:certain", 1, None);
        check("dry=flood", "dry:reset", 0, Some("dry"));
        check("a/b=c.wasm", "a/b=c.wasm", 0, None);
    }

    #[test]
    fn only_robots_are_taken_for_robots() {
        for (text, expected) in [
            ("a/b.WASM:1", true),
            ("ann=b.wasm", true),
            ("flood", true),
            ("flood:0", true),
            ("maze.txt", false),
            ("gen:tree:16:1", false),
            ("gen:tree,loops=3:16:1", false),
            ("test_maze_01", false),
            (".", false),
        ] {
            let folder = tempfile::tempdir().expect("a temporary folder");
            let text = if text == "." {
                folder.path().to_str().expect("UTF-8")
            } else {
                text
            };
            assert_eq!(is_robot(text), expected, "{text}");
        }
    }

    #[test]
    fn folders_of_robots_are_sorted_and_shallow() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::create_dir(folder.path().join("deeper.wasm")).expect("a folder");
        for name in ["b.wasm", "a.WASM", "c.wat", "README.md"] {
            fs::write(folder.path().join(name), "").expect("a file");
        }
        let argument = folder.path().to_str().expect("UTF-8");
        assert!(is_robot(argument));
        let names: Vec<GuestText> = resolve(argument)
            .expect("robots")
            .iter()
            .map(RobotSpec::short_name)
            .collect();
        assert_eq!(names, ["a", "b", "c"]);
        let failure = resolve(&format!("ann={argument}")).expect_err("two robots, one name");
        assert!(
            failure.to_string().contains("more than one robot"),
            "{failure}"
        );
    }

    #[test]
    fn unknown_variants_of_bundled_robots_are_errors() {
        let failure = resolve("flood:nosuch").expect_err("no such variant");
        assert_eq!(
            failure.to_string(),
            "error: robot `flood` has no variant `nosuch`\n\nhint: its variants are reset, certain"
        );
    }

    #[test]
    fn two_robots_never_have_one_name() {
        let specs = |arguments: &[&str]| -> Vec<RobotSpec> {
            let specs = arguments.iter().map(|it| resolve(it).expect("a robot"));
            specs.flatten().collect()
        };
        let names = unique_names(&specs(&["x/a.wasm", "y/a.wasm", "b=y/a.wasm"]));
        assert_eq!(names.expect("three names"), ["x/a.wasm", "y/a.wasm", "b"]);
        let failure = unique_names(&specs(&["flood", "flood"])).expect_err("one name");
        assert_eq!(failure.exit(), super::super::exit::Exit::Usage);
    }
}
