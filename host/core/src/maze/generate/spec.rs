//! [`GenSpec`]: `gen:KIND[,loops=PERCENT]:SIZE:SEED`, the name of one or more generated mazes.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use super::super::Maze;
use super::kind::{GENERATED_DIMENSIONS, Kind};

/// The most mazes of one specification.
pub const GENERATED_MAX: u64 = 100_000;

/// One or more generated mazes: a kind, sizes and seeds.
///
/// The text form is `gen:KIND:SIZE:SEED`. The kind is `division`, `tree`, `braid` or
/// `stretches`; `tree` takes `,loops=PERCENT`, 0 to 100, default 12. The size is an even number
/// of cells from 12 to 20, the seed a number below 2^64. Both may be inclusive ranges such as
/// `12..=20` or `1..=100`, which stand for all even sizes and all seeds in them: at most
/// [`GENERATED_MAX`] mazes.
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

/// Why a text is not a [`GenSpec`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GenSpecError {
    /// It does not have the three parts.
    #[error("expected `gen:KIND:SIZE:SEED`, found `{found}`")]
    Shape {
        /// The whole text.
        found: String,
    },
    /// A part has an invalid value.
    #[error("{part}: expected {expected}, found `{found}`")]
    Part {
        /// `kind`, `loops`, `size` or `seed`.
        part: &'static str,
        /// The valid values.
        expected: &'static str,
        /// The value found.
        found: String,
    },
    /// It stands for more than [`GENERATED_MAX`] mazes.
    #[error("seed: expected ranges for at most {GENERATED_MAX} mazes, found {count}")]
    TooMany {
        /// The number of mazes.
        count: u128,
    },
}

const KINDS: &str = "`division`, `tree`, `tree,loops=PERCENT`, `braid` or `stretches`";
const LOOPS: &str = "a percentage from 0 to 100";
const SIZES: &str = "an even number from 12 to 20, or a range such as `12..=20`";
const SEEDS: &str = "a number below 2^64, or a range such as `1..=100`";

impl GenSpec {
    /// The mazes of one kind with every even size and every seed of the ranges.
    ///
    /// # Errors
    ///
    /// If a range is empty or has invalid values, if the loops exceed 100 percent, or if there
    /// would be more than [`GENERATED_MAX`] mazes.
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
        let is_valid = |dimension| GENERATED_DIMENSIONS.contains(dimension);
        let spec = Self {
            kind,
            dimensions,
            seeds,
        };
        let bounds = [spec.dimensions.start(), spec.dimensions.end()];
        if !bounds.into_iter().all(is_valid) || spec.dimensions().next().is_none() {
            return Err(part("size", SIZES, range_text(&spec.dimensions)));
        }
        if spec.seeds.is_empty() {
            return Err(part("seed", SEEDS, range_text(&spec.seeds)));
        }
        let seeds = u128::from(spec.seeds.end() - spec.seeds.start()) + 1;
        let count = seeds * spec.dimensions().count() as u128;
        if count > u128::from(GENERATED_MAX) {
            return Err(GenSpecError::TooMany { count });
        }
        Ok(spec)
    }

    /// Whether a text is meant as a specification: it starts with `gen:`.
    pub fn is_meant_by(text: &str) -> bool {
        text.starts_with("gen:")
    }

    /// The kind of the mazes.
    pub const fn kind(&self) -> Kind {
        self.kind
    }

    /// The sizes of the mazes, in cells along a side: even ones, in ascending order.
    pub fn dimensions(&self) -> impl Iterator<Item = u8> + use<> {
        self.dimensions.clone().filter(|n| n.is_multiple_of(2))
    }

    /// The seeds of the mazes of each size.
    pub const fn seeds(&self) -> &RangeInclusive<u64> {
        &self.seeds
    }

    /// The number of mazes. Range: 1 to [`GENERATED_MAX`].
    pub fn count(&self) -> u64 {
        let dimensions = self.dimensions().count() as u64;
        dimensions * (self.seeds.end() - self.seeds.start() + 1)
    }

    /// The mazes, by size and then by seed, not generated yet.
    pub fn expand(&self) -> impl Iterator<Item = GeneratedMaze> + use<> {
        let Self { kind, seeds, .. } = self.clone();
        self.dimensions().flat_map(move |dimension| {
            seeds.clone().map(move |seed| GeneratedMaze {
                kind,
                dimension,
                seed,
            })
        })
    }
}

/// One generated maze, named but not generated yet.
///
/// Displays as the full specification of this maze alone; parsing it gives the same maze.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct GeneratedMaze {
    kind: Kind,
    dimension: u8,
    seed: u64,
}

impl GeneratedMaze {
    /// Generates the maze.
    pub fn generate(&self) -> Maze {
        self.kind.generate(self.dimension, self.seed)
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
        let dimensions = parse_range(dimensions).ok_or_else(|| part("size", SIZES, dimensions))?;
        let seeds = parse_range(seeds).ok_or_else(|| part("seed", SEEDS, seeds))?;
        Self::new(kind, dimensions, seeds)
    }
}

/// Parses the kind: a name, and for a tree optionally `,loops=PERCENT`.
fn parse_kind(text: &str) -> Result<Kind, GenSpecError> {
    if let Some(kind) = Kind::ALL.into_iter().find(|kind| kind.name() == text) {
        return Ok(kind);
    }
    let percent = text.strip_prefix("tree,loops=");
    let percent = percent.ok_or_else(|| part("kind", KINDS, text))?;
    let loops = parse_number(percent).ok_or_else(|| part("loops", LOOPS, percent))?;
    Ok(Kind::Tree { loops })
}

/// Parses `7` as 7..=7, or `7..=9`.
fn parse_range<N: FromStr + Copy>(text: &str) -> Option<RangeInclusive<N>> {
    match text.split_once("..=") {
        Some((first, last)) => Some(parse_number(first)?..=parse_number(last)?),
        None => parse_number(text).map(|number| number..=number),
    }
}

/// Parses digits only: `str::parse` would accept a sign.
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
    fn valid_specifications_display_in_full() {
        for (text, full, count) in [
            ("division:12:0", "division:12:0", 1),
            (
                "braid:20:18446744073709551615",
                "braid:20:18446744073709551615",
                1,
            ),
            ("stretches:18:3", "stretches:18:3", 1),
            ("tree:14:7", "tree,loops=12:14:7", 1),
            ("tree,loops=0:14:07", "tree,loops=0:14:7", 1),
            (
                "tree,loops=100:12..=13:5..=9",
                "tree,loops=100:12..=13:5..=9",
                5,
            ),
            (
                "division:12..=20:1..=20000",
                "division:12..=20:1..=20000",
                100_000,
            ),
        ] {
            let [text, full] = [text, full].map(|text| format!("gen:{text}"));
            let spec: GenSpec = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!((spec.to_string(), spec.count()), (full.clone(), count));
            assert_eq!(full.parse(), Ok(spec), "{full}");
        }
    }

    #[test]
    fn errors_name_the_invalid_part() {
        let check = |expected: &str, cases: &[(&str, &str)]| {
            for &(text, found) in cases {
                let error = text.parse::<GenSpec>().expect_err(text);
                assert_eq!(error.to_string(), format!("{expected}, found {found}"));
            }
        };
        check(
            "expected `gen:KIND:SIZE:SEED`",
            &[
                ("gen:", "`gen:`"),
                ("gen:tree:16", "`gen:tree:16`"),
                ("gen:tree:16:1:2", "`gen:tree:16:1:2`"),
                ("tree:16:1:2", "`tree:16:1:2`"),
            ],
        );
        check(
            "kind: expected `division`, `tree`, `tree,loops=PERCENT`, `braid` or `stretches`",
            &[
                ("gen:hedge:16:1", "`hedge`"),
                ("gen:braid,loops=3:16:1", "`braid,loops=3`"),
                ("gen:tree,twist=3:16:1", "`tree,twist=3`"),
            ],
        );
        check(
            "loops: expected a percentage from 0 to 100",
            &[
                ("gen:tree,loops=101:16:1", "`101`"),
                ("gen:tree,loops=:16:1", "``"),
            ],
        );
        check(
            "size: expected an even number from 12 to 20, or a range such as `12..=20`",
            &[
                ("gen:tree:13:1", "`13`"),
                ("gen:tree:10..=16:1", "`10..=16`"),
                ("gen:tree:16..=12:1", "`16..=12`"),
                ("gen:tree:300:1", "`300`"),
                ("gen:tree:12..20:1", "`12..20`"),
            ],
        );
        check(
            "seed: expected a number below 2^64, or a range such as `1..=100`",
            &[
                ("gen:tree:16:-1", "`-1`"),
                ("gen:tree:16:+1", "`+1`"),
                ("gen:tree:16:18446744073709551616", "`18446744073709551616`"),
                ("gen:tree:16:9..=8", "`9..=8`"),
            ],
        );
        check(
            "seed: expected ranges for at most 100000 mazes",
            &[
                ("gen:tree:12..=20:1..=20001", "100005"),
                (
                    "gen:tree:12..=20:0..=18446744073709551615",
                    "92233720368547758080",
                ),
            ],
        );
    }
}
