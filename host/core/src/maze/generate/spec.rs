//! [`GenSpec`]: `gen:KIND[,loops=PERCENT]:DIMENSION:SEED`, the name of one
//! generated maze or of many.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use super::super::Maze;
use super::{GENERATED_DIMENSIONS, Kind, generate};

/// The most mazes that one specification may stand for.
pub const GENERATED_MAX: u64 = 100_000;

/// One or more generated mazes: a kind, dimensions and seeds.
///
/// Written as `gen:KIND:DIMENSION:SEED`. The kind is `division`, `tree`, `braid`
/// or `stretches`; a tree takes `,loops=PERCENT`, 0 to 100, default 12. The
/// dimension is an even number of cells from 12 to 20, the seed any number below
/// 2^64. Both may be inclusive ranges, `12..=20` or `1..=100`, of which all even
/// dimensions and all seeds are meant: at most [`GENERATED_MAX`] mazes.
///
/// ```
/// use wasmouse_core::maze::generate::GenSpec;
/// let spec: GenSpec = "gen:tree:16:42".parse().expect("a specification");
/// assert_eq!(spec.to_string(), "gen:tree,loops=12:16:42");
///
/// let many: GenSpec = "gen:division:12..=20:1..=3".parse().expect("a specification");
/// assert_eq!(many.count(), 15);
/// let names: Vec<String> = many.expand().map(|maze| maze.to_string()).take(4).collect();
/// assert_eq!(names[2..], ["gen:division:12:3", "gen:division:14:1"]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct GenSpec {
    kind: Kind,
    dimensions: RangeInclusive<u8>,
    seeds: RangeInclusive<u64>,
}

/// Why a text is no [`GenSpec`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GenSpecError {
    /// It has not the three parts.
    #[error("expected `gen:KIND:DIMENSION:SEED`, found `{found}`")]
    Shape {
        /// The whole text.
        found: String,
    },
    /// A part of it has a value that cannot be.
    #[error("{part}: expected {expected}, found `{found}`")]
    Part {
        /// `kind`, `loops`, `dimension` or `seed`.
        part: &'static str,
        /// What would have been right.
        expected: &'static str,
        /// What was there.
        found: String,
    },
    /// It stands for more mazes than anyone wants to wait for.
    #[error("seed: expected ranges that make at most {GENERATED_MAX} mazes, found {count}")]
    TooMany {
        /// How many mazes it would be.
        count: u128,
    },
}

const KINDS: &str = "`division`, `tree`, `tree,loops=PERCENT`, `braid` or `stretches`";
const LOOPS: &str = "a percentage from 0 to 100";
const DIMENSIONS: &str = "an even number from 12 to 20, or a range such as `12..=20`";
const SEEDS: &str = "a number below 2^64, or a range such as `1..=100`";

impl GenSpec {
    /// Mazes of one kind, of every even dimension and with every seed of the ranges.
    ///
    /// # Errors
    ///
    /// When a range is empty or leaves what is valid, the loops exceed 100
    /// percent, or there would be more than [`GENERATED_MAX`] mazes.
    pub fn new(
        kind: Kind,
        dimensions: RangeInclusive<u8>,
        seeds: RangeInclusive<u64>,
    ) -> Result<Self, GenSpecError> {
        if let Kind::Tree { loops } = kind
            && loops > 100
        {
            return Err(part("loops", LOOPS, loops));
        }
        let valid = |dimension| GENERATED_DIMENSIONS.contains(dimension);
        let spec = Self {
            kind,
            dimensions,
            seeds,
        };
        let bounds = [spec.dimensions.start(), spec.dimensions.end()];
        if !bounds.into_iter().all(valid) || spec.even_dimensions().next().is_none() {
            return Err(part("dimension", DIMENSIONS, range_text(&spec.dimensions)));
        }
        if spec.seeds.is_empty() {
            return Err(part("seed", SEEDS, range_text(&spec.seeds)));
        }
        let seeds = u128::from(spec.seeds.end() - spec.seeds.start()) + 1;
        let count = seeds * spec.even_dimensions().count() as u128;
        if count > u128::from(GENERATED_MAX) {
            return Err(GenSpecError::TooMany { count });
        }
        Ok(spec)
    }

    /// Whether a text claims to be such a specification: it begins with `gen:`.
    pub fn is_meant_by(text: &str) -> bool {
        text.starts_with("gen:")
    }

    /// The kind of all its mazes.
    pub const fn kind(&self) -> Kind {
        self.kind
    }

    /// How many mazes it stands for. Range: 1 to [`GENERATED_MAX`].
    pub fn count(&self) -> u64 {
        let dimensions = self.even_dimensions().count() as u64;
        dimensions * (self.seeds.end() - self.seeds.start() + 1)
    }

    /// The mazes, by dimension and then by seed, none of them generated yet.
    pub fn expand(&self) -> impl Iterator<Item = GeneratedMaze> + use<> {
        let Self { kind, seeds, .. } = self.clone();
        self.even_dimensions().flat_map(move |dimension| {
            seeds.clone().map(move |seed| GeneratedMaze {
                kind,
                dimension,
                seed,
            })
        })
    }

    fn even_dimensions(&self) -> impl Iterator<Item = u8> + use<> {
        self.dimensions.clone().filter(|n| n.is_multiple_of(2))
    }
}

/// One generated maze, named but not generated yet.
///
/// Displays as the specification of this maze alone, in full: parsing it gives the same maze
/// again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GeneratedMaze {
    kind: Kind,
    dimension: u8,
    seed: u64,
}

impl GeneratedMaze {
    /// Generates the maze.
    pub fn generate(&self) -> Maze {
        generate(self.kind, self.dimension, self.seed)
    }
}

impl fmt::Display for GeneratedMaze {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "gen:{}:{}:{}", self.kind, self.dimension, self.seed)
    }
}

impl fmt::Display for GenSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let dimensions = range_text(&self.dimensions);
        let seeds = range_text(&self.seeds);
        write!(f, "gen:{}:{dimensions}:{seeds}", self.kind)
    }
}

impl FromStr for GenSpec {
    type Err = GenSpecError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts: Vec<&str> = text.split(':').collect();
        let &["gen", kind, dimensions, seeds] = parts.as_slice() else {
            return Err(GenSpecError::Shape {
                found: text.to_owned(),
            });
        };
        let kind = parse_kind(kind)?;
        let dimensions =
            parse_range(dimensions).ok_or_else(|| part("dimension", DIMENSIONS, dimensions))?;
        let seeds = parse_range(seeds).ok_or_else(|| part("seed", SEEDS, seeds))?;
        Self::new(kind, dimensions, seeds)
    }
}

/// Parses the kind part: a name and perhaps `,loops=PERCENT`.
fn parse_kind(text: &str) -> Result<Kind, GenSpecError> {
    let (name, setting) = match text.split_once(',') {
        Some((name, setting)) => (name, Some(setting)),
        None => (text, None),
    };
    match (name, setting) {
        ("division", None) => Ok(Kind::Division),
        ("braid", None) => Ok(Kind::Braid),
        ("stretches", None) => Ok(Kind::Stretches),
        ("tree", None) => Ok(Kind::Tree {
            loops: Kind::DEFAULT_LOOPS,
        }),
        ("tree", Some(setting)) => {
            let percent = setting
                .strip_prefix("loops=")
                .ok_or_else(|| part("kind", KINDS, text))?;
            let loops = parse_number(percent).ok_or_else(|| part("loops", LOOPS, percent))?;
            Ok(Kind::Tree { loops })
        }
        _ => Err(part("kind", KINDS, text)),
    }
}

/// Parses `7` as 7..=7, and `7..=9`.
fn parse_range<N: FromStr + Copy>(text: &str) -> Option<RangeInclusive<N>> {
    match text.split_once("..=") {
        Some((first, last)) => Some(parse_number(first)?..=parse_number(last)?),
        None => parse_number(text).map(|number| number..=number),
    }
}

/// Parses digits only: no sign, which `parse` would take.
fn parse_number<N: FromStr>(text: &str) -> Option<N> {
    let digits = text.bytes().all(|byte| byte.is_ascii_digit());
    digits.then(|| text.parse().ok()).flatten()
}

fn range_text<N: fmt::Display + PartialEq>(range: &RangeInclusive<N>) -> String {
    if range.start() == range.end() {
        range.start().to_string()
    } else {
        format!("{}..={}", range.start(), range.end())
    }
}

fn part(part: &'static str, expected: &'static str, found: impl fmt::Display) -> GenSpecError {
    GenSpecError::Part {
        part,
        expected,
        found: found.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn good_specifications_print_in_full() {
        for (text, printed, count) in [
            ("gen:division:12:0", "gen:division:12:0", 1),
            (
                "gen:braid:20:18446744073709551615",
                "gen:braid:20:18446744073709551615",
                1,
            ),
            ("gen:stretches:18:3", "gen:stretches:18:3", 1),
            ("gen:tree:14:7", "gen:tree,loops=12:14:7", 1),
            ("gen:tree,loops=0:14:07", "gen:tree,loops=0:14:7", 1),
            (
                "gen:tree,loops=100:12..=13:5..=9",
                "gen:tree,loops=100:12..=13:5..=9",
                5,
            ),
            (
                "gen:division:12..=20:1..=20000",
                "gen:division:12..=20:1..=20000",
                100_000,
            ),
        ] {
            let spec: GenSpec = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!((spec.to_string().as_str(), spec.count()), (printed, count));
            assert_eq!(printed.parse(), Ok(spec), "{printed}");
        }
    }

    #[test]
    fn bad_specifications_name_the_part() {
        for (text, message) in [
            ("gen:", "expected `gen:KIND:DIMENSION:SEED`, found `gen:`"),
            (
                "gen:tree:16",
                "expected `gen:KIND:DIMENSION:SEED`, found `gen:tree:16`",
            ),
            (
                "gen:tree:16:1:2",
                "expected `gen:KIND:DIMENSION:SEED`, found `gen:tree:16:1:2`",
            ),
            (
                "tree:16:1:2",
                "expected `gen:KIND:DIMENSION:SEED`, found `tree:16:1:2`",
            ),
            (
                "gen:hedge:16:1",
                "kind: expected `division`, `tree`, `tree,loops=PERCENT`, `braid` or `stretches`, found `hedge`",
            ),
            (
                "gen:braid,loops=3:16:1",
                "kind: expected `division`, `tree`, `tree,loops=PERCENT`, `braid` or `stretches`, found `braid,loops=3`",
            ),
            (
                "gen:tree,twist=3:16:1",
                "kind: expected `division`, `tree`, `tree,loops=PERCENT`, `braid` or `stretches`, found `tree,twist=3`",
            ),
            (
                "gen:tree,loops=101:16:1",
                "loops: expected a percentage from 0 to 100, found `101`",
            ),
            (
                "gen:tree,loops=:16:1",
                "loops: expected a percentage from 0 to 100, found ``",
            ),
            (
                "gen:tree:13:1",
                "dimension: expected an even number from 12 to 20, or a range such as `12..=20`, found `13`",
            ),
            (
                "gen:tree:10..=16:1",
                "dimension: expected an even number from 12 to 20, or a range such as `12..=20`, found `10..=16`",
            ),
            (
                "gen:tree:16..=12:1",
                "dimension: expected an even number from 12 to 20, or a range such as `12..=20`, found `16..=12`",
            ),
            (
                "gen:tree:300:1",
                "dimension: expected an even number from 12 to 20, or a range such as `12..=20`, found `300`",
            ),
            (
                "gen:tree:12..20:1",
                "dimension: expected an even number from 12 to 20, or a range such as `12..=20`, found `12..20`",
            ),
            (
                "gen:tree:16:-1",
                "seed: expected a number below 2^64, or a range such as `1..=100`, found `-1`",
            ),
            (
                "gen:tree:16:+1",
                "seed: expected a number below 2^64, or a range such as `1..=100`, found `+1`",
            ),
            (
                "gen:tree:16:18446744073709551616",
                "seed: expected a number below 2^64, or a range such as `1..=100`, found `18446744073709551616`",
            ),
            (
                "gen:tree:16:9..=8",
                "seed: expected a number below 2^64, or a range such as `1..=100`, found `9..=8`",
            ),
            (
                "gen:tree:12..=20:1..=20001",
                "seed: expected ranges that make at most 100000 mazes, found 100005",
            ),
            (
                "gen:tree:12..=20:0..=18446744073709551615",
                "seed: expected ranges that make at most 100000 mazes, found 92233720368547758080",
            ),
        ] {
            let error = text.parse::<GenSpec>().expect_err(text);
            assert_eq!(error.to_string(), message, "{text}");
        }
    }
}
