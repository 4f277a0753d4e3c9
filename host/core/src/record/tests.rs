//! Properties of random matches: their transcripts replay, and their serialised forms round trip.

use proptest::collection::vec;
use proptest::prelude::*;

use super::*;
use crate::Digest;
use crate::game::{Action, BudgetScope, Counts, Event, FaultKind, GameRules, Phase};
use crate::game::{Simulation, Trace};
use crate::journal::JournalCounts;
use crate::maze::Turn;
use crate::maze::testing::random_maze;

fn any_action() -> impl Strategy<Value = Action> {
    let turn = prop::sample::select(vec![Turn::Left, Turn::Straight, Turn::Right]);
    let advance = prop_oneof![4 => -3_i8..=3, 1 => any::<i8>()];
    let drive = (turn, advance).prop_map(|(turn, advance)| Action::Move { turn, advance });
    prop_oneof![8 => drive, 1 => Just(Action::Reset)]
}

fn any_rules() -> impl Strategy<Value = GameRules> {
    let scope = prop::sample::select(vec![BudgetScope::BothRuns, BudgetScope::EachRun]);
    (1_u32..60, scope, 1_u8..=4, 1_u32..40).prop_map(
        |(budget, budget_scope, longest_move, exploration_divisor)| GameRules {
            budget,
            budget_scope,
            longest_move,
            exploration_divisor,
        },
    )
}

fn any_record_parts() -> impl Strategy<Value = (MatchKey, Usage)> {
    let digests = any::<[[u8; 32]; 4]>();
    let numbers = any::<[u64; 7]>();
    (digests, any::<u32>(), numbers).prop_map(|(digests, variant, numbers)| {
        let [engine, rules, robot, maze] = digests.map(Digest::from_bytes);
        let [seed, start, steps, step_max, memory_bytes, entries, dropped] = numbers;
        let key = MatchKey {
            engine,
            rules,
            robot,
            variant,
            maze,
            seed,
        };
        let fuel = FuelUse {
            start,
            steps,
            step_max,
        };
        let usage = Usage {
            fuel,
            memory_bytes,
            journal: JournalCounts { entries, dropped },
        };
        (key, usage)
    })
}

/// The counts of a match, from its events.
fn counts(trace: &Trace) -> Counts {
    let mut counts = Counts::default();
    for step in trace.steps() {
        match step.event {
            Event::Moved {
                bumped, clamped, ..
            } => {
                counts.bumps += u32::from(bumped);
                counts.clamps += u32::from(clamped);
            }
            Event::Reset => {}
            Event::ResetBeforeGoal => counts.resets_before_goal += 1,
            Event::ResetInSpeedRun => counts.resets_in_speed_run += 1,
        }
    }
    counts
}

proptest! {
    /// Mazes this small let random actions finish some matches. `fault_after` is often greater
    /// than the number of steps, so that most matches end by the rules.
    #[test]
    fn a_match_is_its_transcript(
        maze in random_maze(3..=5),
        rules in any_rules(),
        actions in vec(any_action(), 120),
        fault_after in 0_usize..200,
        (key, usage) in any_record_parts(),
    ) {
        let mut simulation = Simulation::new(&maze, &rules);
        let mut played = Trace::default();
        let mut transcript = Transcript::default();
        for action in actions.into_iter().take(fault_after) {
            if simulation.has_ended() {
                break;
            }
            played.apply(&mut simulation, action);
            transcript.push(action);
        }
        if !simulation.has_ended() {
            let detail = "panicked at \u{1b}".to_owned();
            transcript.end_with_fault(FaultKind::Panic, Phase::NextMove, detail);
        }
        let result = GameResult::new(&simulation, transcript.ending()).expect("it has ended");

        prop_assert_eq!(result.steps.total() as usize, played.steps().len());
        prop_assert_eq!(result.counts, counts(&played));
        prop_assert_eq!(replay(&maze, &rules, &transcript), Ok(result.clone()));
        let replayed = trace(&maze, &rules, &transcript);
        prop_assert_eq!(replayed, Ok((result.clone(), played)));

        let decoded = Transcript::from_bytes(&transcript.to_bytes());
        prop_assert_eq!(decoded.as_ref(), Ok(&transcript));
        let record = MatchRecord::new(key, result, usage, &transcript);
        let json = serde_json::to_string(&record).expect("it serialises");
        let read: MatchRecord = serde_json::from_str(&json).expect("it deserialises");
        prop_assert_eq!(serde_json::to_string(&read).expect("it serialises"), json);
        prop_assert_eq!(read, record);
    }
}
