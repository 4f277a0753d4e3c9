//! [`RobotsEntry`]: one `[[robots]]` of a contest file.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, Visitor};
use wasmouse_engine::bundled::{BundledRobot, find};

use super::super::config::{FilePath, Name};

/// Robots that take part: files or a bundled robot, in one or more variants.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct RobotsEntry {
    /// A file, a folder of files, a robot project, or a pattern such as `submissions/*.wasm`.
    path: Option<FilePath>,
    /// The name of a bundled robot.
    bundled: Option<Name>,
    /// The variants to play. Default: variant 0.
    pub variants: Option<Vec<VariantRef>>,
    /// What the standings call it. Default: as `names_from` says, or the name of the bundled
    /// robot. Not for patterns.
    pub name: Option<Name>,
    /// Who submitted it. Default: as `names_from` says; a bundled robot has no author.
    pub author: Option<Name>,
    /// Where the names and authors of files come from.
    pub names_from: Option<NamesFrom>,
    /// The class that it competes in: the name of one of the classes. Default: the first class
    /// whose limits it keeps.
    pub class: Option<Name>,
}

/// Where robots are.
#[derive(Clone, Copy, Debug)]
pub enum RobotSource<'a> {
    /// In files.
    Path(&'a FilePath),
    /// In this program.
    Bundled(&'static BundledRobot),
}

/// A variant of a robot, by number or, for bundled robots, by name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum VariantRef {
    /// The number.
    Number(u32),
    /// The name.
    Name(String),
}

/// Where the name and the author of a robot in a file come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NamesFrom {
    /// From the name of the file, without its ending.
    #[default]
    File,
    /// From the name of the folder that the file is in.
    Folder,
}

impl RobotsEntry {
    /// Where the robots are. Exactly one of the two in a contest file that was parsed.
    pub fn source(&self) -> Option<RobotSource<'_>> {
        match (&self.path, &self.bundled) {
            (Some(path), None) => Some(RobotSource::Path(path)),
            (None, Some(name)) => find(name.as_str()).map(RobotSource::Bundled),
            _ => None,
        }
    }

    /// The key `path`.
    pub(super) const fn path(&self) -> Option<&FilePath> {
        self.path.as_ref()
    }

    /// The key `bundled`.
    pub(super) const fn bundled(&self) -> Option<&Name> {
        self.bundled.as_ref()
    }

    /// The numbers of its variants, each once; none for names that the robot does not have.
    pub fn variant_numbers(&self) -> Vec<u32> {
        let Some(variants) = &self.variants else {
            return vec![0];
        };
        let source = self.source();
        let number = |variant: &VariantRef| variant.number(source);
        variants.iter().filter_map(number).collect()
    }
}

impl VariantRef {
    /// The number of the variant; `None` if the robot has none of the name.
    pub fn number(&self, source: Option<RobotSource<'_>>) -> Option<u32> {
        match (self, source) {
            (Self::Number(number), Some(RobotSource::Path(_))) => Some(*number),
            (Self::Number(number), Some(RobotSource::Bundled(robot))) => {
                let known = robot.variants.iter().any(|it| it.value == *number);
                (known || *number == 0).then_some(*number)
            }
            (Self::Name(name), Some(RobotSource::Bundled(robot))) => {
                let variant = robot.variants.iter().find(|it| it.name == name);
                variant.map(|it| it.value)
            }
            _ => None,
        }
    }
}

impl fmt::Display for VariantRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Name(name) => write!(f, "{name}"),
        }
    }
}

impl<'de> Deserialize<'de> for VariantRef {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(VariantVisitor)
    }
}

struct VariantVisitor;

impl Visitor<'_> for VariantVisitor {
    type Value = VariantRef;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the number or the name of a variant")
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<VariantRef, E> {
        let number = u32::try_from(number).map_err(|_| {
            let message = format!("expected a variant from 0 to {}, found {number}", u32::MAX);
            E::custom(message)
        })?;
        Ok(VariantRef::Number(number))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<VariantRef, E> {
        let name = Name::new(name).map_err(E::custom)?;
        Ok(VariantRef::Name(name.into_string()))
    }
}
