//! [`RubricFile`]: a rubric with the file that it was read from, for errors.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use wasmouse_core::maze::bundled;
use wasmouse_core::maze::generate::{GenSpec, GeneratedMaze};
use wasmouse_core::{Digest, GuestText};

use super::super::failure::Failure;
use super::super::input;
use super::super::maze_source;
use super::super::mazes::{self, BadFiles, Legality, Request};
use super::check;
use crate::contest::MazeSource;
use crate::contest::config::{BYTES_MAX, ConfigError, Document, decode, suggestion};
use crate::contest::grade::{Baseline, Expectation, Rubric};
use crate::report::config::config_error;
use crate::report::escape::for_terminal;
use crate::report::text::Text;

/// A rubric and its file.
pub struct RubricFile {
    /// The rubric.
    pub rubric: Rubric,
    path: PathBuf,
    text: String,
}

/// What tells mazes apart without generating any: the digest of one that was read, or what
/// generates it.
fn identity(maze: &MazeSource) -> (Option<Digest>, Option<GeneratedMaze>) {
    match maze {
        MazeSource::Loaded { maze, .. } => (Some(maze.digest()), None),
        MazeSource::Generated(generated) => (None, Some(*generated)),
    }
}

/// What is played for a rubric.
pub struct GradeContest {
    /// The mazes of all sets, each once.
    pub mazes: Vec<MazeSource>,
    /// By criterion, the mazes that count for it.
    pub scopes: Vec<Vec<usize>>,
    /// By criterion, what it is compared with.
    pub baselines: BTreeMap<usize, Baseline>,
}

impl RubricFile {
    /// Reads a rubric.
    ///
    /// # Errors
    ///
    /// When the file cannot be read or is no rubric.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let bytes = input::read_file(path, BYTES_MAX as u64)
            .map_err(|error| input::failure("rubric", path, &error))?;
        let text = decode(&bytes).map_err(|error| failure(path, &error))?;
        let rubric = Rubric::read(text).map_err(|error| failure(path, &error))?;
        Ok(Self {
            rubric,
            path: path.to_owned(),
            text: text.to_owned(),
        })
    }

    /// The folder that paths of the rubric are relative to.
    pub fn folder(&self) -> &Path {
        match self.path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        }
    }

    /// Something that is wrong with the value of a key.
    pub fn error(&self, key: &str, message: &str, hint: Option<String>) -> Failure {
        match Document::parse(&self.text) {
            Ok(document) => {
                let mut error = document.error(key, message);
                error.hint = hint;
                failure(&self.path, &error)
            }
            Err(error) => failure(&self.path, &error),
        }
    }

    /// The reference robots, with the criteria that name them.
    pub fn references(&self) -> impl Iterator<Item = (usize, &str)> {
        let criteria = self.rubric.criteria.iter().enumerate();
        criteria.filter_map(|(index, it)| Some((index, it.expectation.reference()?)))
    }

    /// That what a criterion expects cannot be measured.
    pub fn failure(&self, criterion: usize, because: &str, hint: Option<String>) -> Failure {
        let kind = self.rubric.criteria[criterion].expectation.name();
        self.error(&format!("criteria[{criterion}].{kind}"), because, hint)
    }

    /// Reads the mazes and the baselines, and finds out what each criterion is about.
    ///
    /// # Errors
    ///
    /// When something that the rubric names does not exist or cannot be used.
    pub fn contest(&self) -> Result<GradeContest, Failure> {
        let (mazes, members) = self.mazes()?;
        let names: Vec<GuestText> = mazes.iter().map(MazeSource::name).collect();
        let criteria = 0..self.rubric.criteria.len();
        let scopes = criteria.map(|it| self.scope(it, &names, &members));
        let scopes: Vec<Vec<usize>> = scopes.collect::<Result<_, _>>()?;
        let mut baselines = BTreeMap::new();
        for (index, criterion) in self.rubric.criteria.iter().enumerate() {
            if let Expectation::Baseline { file, robot, .. } = &criterion.expectation {
                let scope = scopes[index].iter().map(|&it| &mazes[it]);
                let path = self.folder().join(file);
                let baseline = check::baseline(&path, robot.as_deref(), &self.rubric, scope);
                let key = format!("criteria[{index}].baseline");
                let baseline = baseline.map_err(|message| {
                    let hint = "record it with `wasmouse run ROBOT MAZES -o FILE`, in the same mazes \
                                and with the same seeds and rules";
                    self.error(&key, &message, Some(hint.to_owned()))
                })?;
                baselines.insert(index, baseline);
            }
        }
        Ok(GradeContest {
            mazes,
            scopes,
            baselines,
        })
    }

    /// The mazes of all sets, each once, and by set which of them it has.
    fn mazes(&self) -> Result<(Vec<MazeSource>, Vec<Vec<usize>>), Failure> {
        let (mut requests, mut sets) = (Vec::new(), Vec::new());
        for (index, set) in self.rubric.sets.iter().enumerate() {
            for (path, spec) in set.mazes.iter().enumerate() {
                let key = format!("mazes[{index}].paths[{path}]");
                let Some(found) = self.maze_spec(spec) else {
                    let message = format!("there is no bundled maze, file or folder `{spec}`");
                    let hint = suggestion(spec, bundled().iter().map(|it| it.name));
                    return Err(self.error(&key, &message, hint));
                };
                let sources = maze_source::resolve(&found)
                    .map_err(|failure| self.error(&key, failure.message().as_str(), None))?;
                for source in sources {
                    requests.push(Request {
                        source,
                        rules: Legality::from_flag(set.is_lenient),
                        bad_files: BadFiles::Fail,
                    });
                    sets.push(index);
                }
            }
        }
        let hint = "`lenient = true` in the set accepts it";
        let loaded = mazes::load_requests(&requests, hint)?;
        let (mut mazes, mut places) = (Vec::new(), HashMap::new());
        let mut members = vec![Vec::new(); self.rubric.sets.len()];
        for (maze, set) in loaded.into_iter().zip(sets) {
            let Some(maze) = maze else { continue };
            let index = *places.entry(identity(&maze)).or_insert(mazes.len());
            if index == mazes.len() {
                mazes.push(maze);
            }
            members[set].push(index);
        }
        Ok((mazes, members))
    }

    /// A specification of mazes as commands take it: files and folders from where they are;
    /// `None` if there is no such thing.
    fn maze_spec(&self, spec: &str) -> Option<String> {
        let is_bundled = bundled().iter().any(|it| it.name == spec);
        if is_bundled || GenSpec::is_meant_by(spec) {
            return Some(spec.to_owned());
        }
        let path = self.folder().join(spec);
        path.exists().then(|| path.to_string_lossy().into_owned())
    }

    /// The mazes that count for a criterion, in their order.
    fn scope(
        &self,
        criterion: usize,
        names: &[GuestText],
        members: &[Vec<usize>],
    ) -> Result<Vec<usize>, Failure> {
        let entry = &self.rubric.criteria[criterion];
        let key = format!("criteria[{criterion}].mazes");
        let mut scope = Vec::new();
        for name in &entry.mazes {
            let mut sets = self.rubric.sets.iter().zip(members);
            if let Some((_, members)) = sets.find(|(set, _)| set.name == *name) {
                scope.extend_from_slice(members);
            } else if let Some(index) = names.iter().position(|it| *it == *name.as_str()) {
                scope.push(index);
            } else {
                let message = format!("there is no set and no maze `{name}` in this rubric");
                let sets = self.rubric.sets.iter().map(|it| it.name.as_str());
                let names: Vec<String> = names.iter().map(for_terminal).collect();
                let hint = suggestion(name, sets.chain(names.iter().map(String::as_str)));
                return Err(self.error(&key, &message, hint));
            }
        }
        if entry.mazes.is_empty() {
            scope.extend(0..names.len());
        }
        scope.sort_unstable();
        scope.dedup();
        check::is_enough(&entry.expectation, scope.len()).map_err(|message| {
            let key = format!("criteria[{criterion}].{}", entry.expectation.name());
            self.error(&key, &message, Some("give it more mazes".to_owned()))
        })?;
        Ok(scope)
    }
}

/// The failure of a rubric with an error.
fn failure(path: &Path, error: &ConfigError) -> Failure {
    let failure = Failure::input(config_error(&Text::of_path(path), error));
    match &error.hint {
        Some(hint) => failure.hint(hint),
        None => failure,
    }
}
