//! [`Language`]: what is known about a language, and [`Project`]: a folder with a robot in one.

use std::path::{Path, PathBuf};

use super::component::to_component;
use super::strip::without_debug_information;
use super::tool::Tool;
use crate::cli::failure::Failure;
use crate::report::text::{Text, text};

/// A check of a folder for a project.
pub type Check = fn(&Path) -> Result<(), Failure>;

/// A language that robots are written in.
pub struct Language {
    /// What `--lang` takes: lowercase ASCII letters.
    pub name: &'static str,
    /// Its name in sentences.
    pub title: &'static str,
    /// The files by which its projects are recognised, for messages.
    pub markers: &'static [&'static str],
    /// Whether a folder has a project in this language. Asked in the order of
    /// [`super::LANGUAGES`], so a later language need not exclude an earlier one.
    pub is_in: fn(&Path) -> bool,
    /// Reads the manifest of a project that is in this language.
    pub open: fn(&Path, &'static Language) -> Result<Project, Failure>,
    /// Compiles a project to a core module or a component, which may import WASI. What the tools
    /// print goes to stderr as it comes.
    pub compile: fn(&Project, &Options) -> Result<Vec<u8>, Failure>,
    /// Files and folders of a project that its component depends on. `*.py` stands for all files
    /// with that ending that are not in a folder of their own.
    pub sources: &'static [&'static str],
    /// What has to be installed to build its projects.
    pub tools: &'static [&'static Tool],
    /// Checks what else is needed, without installing anything, for a project in that folder.
    pub check: Option<Check>,
    /// Commands that a new project needs once, in its folder, such as those that install the
    /// tools that it pins.
    pub setup: &'static [&'static str],
}

/// How a project is built.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The cargo profile that Rust projects are built with; `None` is `release`.
    pub profile: Option<String>,
}

/// A folder with a robot.
pub struct Project {
    /// As the user gave it.
    pub folder: PathBuf,
    /// Its name, from the manifest, or from the folder where the language has none.
    pub name: String,
    /// What it is written in.
    pub language: &'static Language,
}

impl Project {
    /// A project in a language without a manifest, named after its folder.
    ///
    /// # Errors
    ///
    /// When the folder has no name, as the root of a file system.
    pub fn named_after_folder(folder: &Path, language: &'static Language) -> Result<Self, Failure> {
        let name = folder
            .canonicalize()
            .ok()
            .and_then(|path| Some(path.file_name()?.to_string_lossy().into_owned()));
        match name {
            Some(name) => Ok(Self {
                folder: folder.to_owned(),
                name,
                language,
            }),
            None => Err(Failure::input(text!(
                "`{}` has no name to call the robot by",
                Text::of_path(folder)
            ))),
        }
    }

    /// Where its component is written.
    pub fn component(&self) -> PathBuf {
        // Not `with_extension`: a name may have a dot in it.
        self.folder.join(format!("{}.wasm", self.name))
    }

    /// Compiles it and makes a component.
    ///
    /// # Errors
    ///
    /// When a tool is missing, it does not compile, or what was compiled is no robot.
    pub fn build(&self, options: &Options) -> Result<Vec<u8>, Failure> {
        let binary = (self.language.compile)(self, options)?;
        let binary = without_debug_information(&binary, &self.folder);
        to_component(&binary, &self.folder)
    }
}
