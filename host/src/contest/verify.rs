//! [`compare`]: recorded results against the same matches played again.

use std::collections::{HashMap, HashSet};

use serde_json::Value;
use wasmouse_core::record::{MatchKey, MatchRecord};

use super::difference::{FieldDifference, differences};
use super::results::Results;

/// A field that differs, with the match that it belongs to, if it does.
pub type Compared = (Option<MatchKey>, FieldDifference);

/// Everything in which recorded results differ from those that were found by playing the same
/// matches again. The version of wasmouse may differ, as long as the engine is the same.
pub fn compare(recorded: &Results, found: &Results) -> Vec<Compared> {
    let mut compared = Vec::new();
    let mut contest = found.contest.clone();
    contest.wasmouse.clone_from(&recorded.contest.wasmouse);
    add(
        &mut compared,
        "contest",
        differences(&recorded.contest, &contest),
    );
    compare_matches(&recorded.matches, &found.matches, &mut compared);
    let mut summary = found.summary.clone();
    // What could not be played then is not played now.
    summary.failures.clone_from(&recorded.summary.failures);
    summary.withdrawn.clone_from(&recorded.summary.withdrawn);
    add(
        &mut compared,
        "summary",
        differences(&recorded.summary, &summary),
    );
    compared
}

/// Everything in which recorded matches differ from those of the same keys that were played again,
/// when not all could be.
pub fn compare_played(recorded: &Results, found: &Results) -> Vec<Compared> {
    let keys: HashSet<&MatchKey> = found.matches.iter().map(|it| &it.key).collect();
    let played = recorded.matches.iter();
    let played: Vec<MatchRecord> = played
        .filter(|record| keys.contains(&record.key))
        .cloned()
        .collect();
    let mut compared = Vec::new();
    compare_matches(&played, &found.matches, &mut compared);
    compared
}

fn add(compared: &mut Vec<Compared>, part: &str, fields: Vec<FieldDifference>) {
    compared.extend(fields.into_iter().map(|mut field| {
        field.field = format!("{part}.{}", field.field);
        (None, field)
    }));
}

fn compare_matches(recorded: &[MatchRecord], found: &[MatchRecord], compared: &mut Vec<Compared>) {
    let mut by_key: HashMap<&MatchKey, &MatchRecord> =
        found.iter().map(|record| (&record.key, record)).collect();
    for record in recorded {
        match by_key.remove(&record.key) {
            Some(found) => {
                let fields = differences(record, found);
                compared.extend(fields.into_iter().map(|field| (Some(record.key), field)));
            }
            // Recorded twice, or of another contest.
            None => compared.push((Some(record.key), whole(record, None))),
        }
    }
    let keys = |records: &[MatchRecord]| records.iter().map(|it| it.key).collect::<Vec<_>>();
    if compared.is_empty() && keys(recorded) != keys(found) {
        compared.push((
            None,
            FieldDifference {
                field: "matches".to_owned(),
                recorded: Some(Value::from("in another order")),
                found: Some(Value::from("mazes, then seeds, then robots")),
            },
        ));
    }
}

fn whole(recorded: &MatchRecord, found: Option<Value>) -> FieldDifference {
    FieldDifference {
        field: "match".to_owned(),
        recorded: Some(Value::from(recorded.key.digest().to_string())),
        found,
    }
}
