//! [`File`]: a rubric as it is written.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, Unexpected, Visitor};

use super::super::config::{FilePath, Integer, Name, table, tables};
use super::super::file::{RulesEntry, SeedsEntry};

/// The version of rubrics; raised when a reader of the old one would go wrong.
pub const RUBRIC_VERSION: u64 = 1;

/// A rubric as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    #[expect(dead_code, reason = "it has been checked before")]
    pub(super) version: Integer<1, RUBRIC_VERSION>,
    pub(super) name: Option<Name>,
    #[serde(default, deserialize_with = "table")]
    pub(super) rules: RulesEntry,
    #[serde(default, deserialize_with = "table")]
    pub(super) seeds: SeedsEntry,
    #[serde(default, deserialize_with = "tables")]
    pub(super) mazes: Vec<MazesEntry>,
    pub(super) pass_percent: Option<Decimal>,
    pub(super) pass_points: Option<Integer<0, 10_000_000>>,
    #[serde(default, deserialize_with = "tables")]
    pub(super) criteria: Vec<Entry>,
}

/// A set of mazes as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct MazesEntry {
    pub(super) set: Name,
    pub(super) paths: OneOrMany,
    #[serde(default)]
    pub(super) lenient: bool,
}

/// A criterion as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct Entry {
    pub(super) name: Name,
    pub(super) points: Option<Integer<0, 10_000>>,
    pub(super) mazes: Option<OneOrMany>,
    pub(super) none: Option<Decimal>,
    pub(super) finished_percent: Option<Decimal>,
    pub(super) mean_score: Option<Decimal>,
    pub(super) mean_regret: Option<Decimal>,
    pub(super) faults: Option<Decimal>,
    pub(super) step_fuel_mean: Option<Decimal>,
    pub(super) step_fuel_max: Option<Decimal>,
    pub(super) memory_bytes_max: Option<Decimal>,
    pub(super) beats: Option<String>,
    pub(super) beats_percent: Option<Decimal>,
    pub(super) baseline: Option<FilePath>,
    pub(super) baseline_robot: Option<String>,
    pub(super) baseline_steps: Option<Decimal>,
    pub(super) no_worse_than: Option<String>,
}

/// One text, or a list of them.
pub(super) struct OneOrMany(pub(super) Vec<String>);

impl<'de> Deserialize<'de> for OneOrMany {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Texts;
        impl<'de> Visitor<'de> for Texts {
            type Value = OneOrMany;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a string or an array of strings")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<OneOrMany, E> {
                Ok(OneOrMany(vec![text.to_owned()]))
            }

            fn visit_seq<A: serde::de::SeqAccess<'de>>(
                self,
                mut texts: A,
            ) -> Result<OneOrMany, A::Error> {
                let mut all = Vec::new();
                while let Some(text) = texts.next_element()? {
                    all.push(text);
                }
                Ok(OneOrMany(all))
            }
        }
        deserializer.deserialize_any(Texts)
    }
}

/// A number with at most three decimals, in thousandths. Range: -10^12 to 10^12.
#[derive(Clone, Copy)]
pub(super) struct Decimal(pub(super) i64);

impl Decimal {
    const MAX: f64 = 1e12;
}

impl<'de> Deserialize<'de> for Decimal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Number;
        impl Visitor<'_> for Number {
            type Value = Decimal;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number with at most three decimals")
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<Decimal, E> {
                let is_small = number.unsigned_abs() <= Decimal::MAX as u64;
                let thousandths = is_small.then(|| number * 1000);
                thousandths
                    .map(Decimal)
                    .ok_or_else(|| E::invalid_value(Unexpected::Signed(number), &self))
            }

            fn visit_u64<E: Error>(self, number: u64) -> Result<Decimal, E> {
                match i64::try_from(number) {
                    Ok(number) => self.visit_i64(number),
                    Err(_) => Err(E::invalid_value(Unexpected::Unsigned(number), &self)),
                }
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<Decimal, E> {
                let thousandths = (number * 1000.0).round();
                // NaN is not small.
                let is_small = number.abs() <= Decimal::MAX;
                // The number that is written is the nearest to the decimal fraction.
                if is_small && thousandths / 1000.0 == number {
                    Ok(Decimal(thousandths as i64))
                } else {
                    Err(E::invalid_value(Unexpected::Float(number), &self))
                }
            }
        }
        deserializer.deserialize_any(Number)
    }
}
