//! What is stored is read back, field by field.

use proptest::collection::vec;
use proptest::prelude::*;
use wasmouse_core::game::{Ruleset, Verdict};
use wasmouse_core::record::{EngineId, MatchRecord, Transcript};

use super::super::sample::{any_record, maze_with, new_store};
use super::super::{KeptTranscripts, StoreErrorKind, StoreSink};
use crate::contest::{ContestMatch, Sink as _};

fn engine() -> EngineId {
    EngineId::new("wasmtime-test")
}

fn played(record: MatchRecord) -> ContestMatch {
    ContestMatch {
        player: 0,
        record,
        transcript: Transcript::default(),
    }
}

/// The parts of a score, which are not all compared by `==`.
fn score_parts(record: &MatchRecord) -> Option<[u32; 3]> {
    let score = record.verdict.score()?;
    Some([
        score.speed_steps(),
        score.exploration_steps(),
        score.divisor(),
    ])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn a_record_is_read_back_as_it_was(
        records in vec(any_record(engine().digest(), Ruleset::default()), 1..40),
    ) {
        let (_folder, mut store) = new_store();
        let rules = Ruleset::default();
        let mut sink = StoreSink::new(&mut store, engine(), rules, KeptTranscripts::None)
            .expect("a sink");
        for record in &records {
            sink.maze(&maze_with(record.key.maze)).expect("the disk has room");
            sink.played(&played(record.clone())).expect("the disk has room");
        }
        sink.finish().expect("the disk has room");
        for record in &records {
            let read = store.record(&record.key).expect("it can be read");
            prop_assert_eq!(read.as_ref(), Some(record));
            prop_assert_eq!(read.as_ref().and_then(score_parts), score_parts(record));
        }
    }

    #[test]
    fn a_score_that_does_not_follow_from_the_steps_is_refused(
        record in any_record(engine().digest(), Ruleset::default()),
        speed_steps: u32,
    ) {
        let mut record = record;
        let rules = Ruleset::default();
        let score = rules.game.score(speed_steps, record.steps.exploration);
        record.verdict = Verdict::Finished { score };
        let is_consistent = speed_steps == record.steps.speed;
        let (_folder, mut store) = new_store();
        let mut sink = StoreSink::new(&mut store, engine(), rules, KeptTranscripts::None)
            .expect("a sink");
        sink.maze(&maze_with(record.key.maze)).expect("the disk has room");
        let outcome = sink.played(&played(record));
        prop_assert_eq!(outcome.is_ok(), is_consistent);
        if let Err(error) = outcome {
            let error = super::super::StoreError::of_sink(&error).expect("a store error");
            let is_named = matches!(error.kind, StoreErrorKind::Inconsistent { .. });
            prop_assert!(is_named, "{}", error);
        }
    }
}
