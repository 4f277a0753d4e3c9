//! [`Field`]: the robots that are graded, and those that they are compared with.

use std::collections::BTreeMap;

use wasmouse_core::GuestText;
use wasmouse_engine::LocalExecutor;
use wasmouse_engine::bundled::find;

use super::super::entrants;
use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::robots::{self, RobotSpec};
use super::rubric::RubricFile;
use crate::contest::Entrant;
use crate::contest::grade::Submission;
use crate::report::text::text;

/// Everybody who takes part.
pub struct Field {
    /// The robots that are graded, in the order in which they were given.
    pub submissions: Vec<Submission>,
    /// The robots that can be read, then the reference robots.
    pub entrants: Vec<Entrant>,
    /// The reference robots by what the rubric calls them, as indices of the entrants.
    pub references: BTreeMap<String, usize>,
    /// Whether any robot that is graded plays.
    pub has_player: bool,
}

impl Field {
    /// Reads the robots. One that is not there, or cannot be read or built, is graded as missing.
    ///
    /// # Errors
    ///
    /// When an argument is wrong.
    pub fn load(
        arguments: &[String],
        references: Vec<(String, RobotSpec)>,
        executor: &LocalExecutor,
    ) -> Result<Self, Failure> {
        let bytes_max = executor.limits().admission.component_bytes_max;
        let (mut submissions, mut specs) = (Vec::new(), Vec::new());
        for argument in arguments {
            let found = match robots::resolve(argument) {
                Ok(found) => found,
                Err(failure) => {
                    submissions.push(missing(argument.clone().into(), failure)?);
                    continue;
                }
            };
            for spec in found {
                match spec.read(bytes_max) {
                    Ok(_) => {
                        submissions.push(Submission::Robot(specs.len()));
                        specs.push(spec);
                    }
                    Err(failure) => submissions.push(missing(spec.short_name(), failure)?),
                }
            }
        }
        let graded = specs.len();
        let mut names = BTreeMap::new();
        for (name, spec) in references {
            names.insert(name, specs.len());
            specs.push(spec);
        }
        let entrants = entrants::load(&specs, executor)?;
        Ok(Self {
            has_player: entrants[..graded].iter().any(|it| it.admission.is_ok()),
            submissions,
            entrants,
            references: names,
        })
    }
}

/// A robot that cannot be graded; the failure itself when that is no matter of the robot.
fn missing(name: GuestText, failure: Failure) -> Result<Submission, Failure> {
    match failure.exit() {
        Exit::Input | Exit::Robot => Ok(Submission::Missing {
            name,
            reason: failure.message().as_str().into(),
        }),
        _ => Err(failure),
    }
}

/// The reference robots that a rubric names, each once and with that name.
///
/// # Errors
///
/// When one of them cannot be used.
pub fn references(
    rubric: &RubricFile,
    bytes_max: u64,
) -> Result<Vec<(String, RobotSpec)>, Failure> {
    let mut references: Vec<(String, RobotSpec)> = Vec::new();
    for (criterion, name) in rubric.references() {
        if references.iter().any(|it| it.0 == name) {
            continue;
        }
        let spec = reference(rubric, name).and_then(|spec| {
            spec.read(bytes_max)?;
            Ok(spec)
        });
        let spec = spec.map_err(|failure| {
            let message = format!("`{name}` cannot be used: {}", failure.message().as_str());
            let hint = failure.hint_text().map(|it| it.as_str().to_owned());
            rubric.failure(criterion, &message, hint)
        })?;
        references.push((name.to_owned(), spec));
    }
    Ok(references)
}

/// The reference robot that a rubric names. It gets a name that no submission has.
fn reference(rubric: &RubricFile, name: &str) -> Result<RobotSpec, Failure> {
    let bundled = name.split(':').next().unwrap_or_default();
    let mut found = if find(bundled).is_some() {
        robots::resolve(&format!("reference {bundled}={name}"))?
    } else {
        let files = robots::files_at(&rubric.folder().join(name))?.into_iter();
        let spec = |file| RobotSpec::of_file(file, 0, Some(format!("reference {name}").into()));
        files.map(spec).collect()
    };
    match (found.pop(), found.is_empty()) {
        (Some(spec), true) => Ok(spec),
        _ => Err(Failure::input(text!(
            "`{}` names more than one robot",
            name
        ))),
    }
}
