//! What the champion promises: it finishes, its proofs hold, and it was trained on
//! generated mazes that are not those it is measured on.

use std::collections::HashSet;
use std::path::Path;

use robot_champion::{Champion, PROVEN};
use serde::Deserialize;
use wasmouse_core::maze::format::{self, Format};
use wasmouse_core::maze::generate::GenSpec;
use wasmouse_core::maze::{Metric, distances_from};
use wasmouse_sdk::testing::{self, Note, PlayOptions};

use crate::matches::generated_mazes;

#[derive(Deserialize)]
struct Training {
    patterns: Set,
    tuning: Set,
    test: Set,
}

#[derive(Deserialize)]
struct Set {
    kinds: Vec<String>,
    sizes: String,
    first_seed: u64,
    last_seed: u64,
}

impl Set {
    fn names(&self) -> HashSet<String> {
        let Self {
            sizes,
            first_seed,
            last_seed,
            ..
        } = self;
        let names = self.kinds.iter().flat_map(|kind| {
            let spec = format!("gen:{kind}:{sizes}:{first_seed}..={last_seed}");
            let spec: GenSpec = spec.parse().expect("a specification");
            spec.expand().map(|it| it.to_string())
        });
        names.collect()
    }
}

fn training() -> Training {
    let path = "../example-robots/champion/training.toml";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let text = std::fs::read_to_string(path).expect("training.toml");
    toml::from_str(&text).expect("training.toml has the tables")
}

/// Neither by seed nor by maze. That every maze is a generated one follows from the
/// form of the file: it can name no others.
#[test]
fn no_test_maze_was_trained_on() {
    let Training {
        patterns,
        tuning,
        test,
    } = training();
    assert_eq!(test.names().len(), 500);
    for trained in [&patterns, &tuning] {
        let seeds = trained.first_seed..=trained.last_seed;
        assert!(!seeds.contains(&test.first_seed) && !seeds.contains(&test.last_seed));
        assert!(trained.first_seed > test.last_seed);
        assert!(trained.names().is_disjoint(&test.names()));
    }
    assert!(patterns.names().is_disjoint(&tuning.names()));
}

/// Wherever the journal claims a proof, the solver finds no shorter path; and the
/// claim is made often enough to mean something.
#[test]
fn finishes_and_proves_what_it_claims() {
    let (mut proofs, mut matches) = (0, 0);
    for kind in ["division", "tree,loops=0", "tree,loops=60", "braid"] {
        for (name, maze) in generated_mazes(&format!("gen:{kind}:12..=20:1..=6")) {
            let text = format::print(&maze, Format::Udacity).expect("a contest maze");
            let played = testing::play::<Champion>(&text, &PlayOptions::default());
            assert!(played.finished, "{name}: {}", played.summary());
            matches += 1;
            let claims = |entry: &testing::Entry| matches!(&entry.note, Note::Log(_, text) if text == PROVEN);
            if played.journal.iter().any(claims) {
                let distances =
                    distances_from(&maze, maze.start(), Metric::Steps { longest_move: 3 });
                let goal = maze.goal().cells().filter_map(|it| distances.get(it));
                assert_eq!(Some(played.speed_steps), goal.min(), "{name}");
                proofs += 1;
            }
        }
    }
    assert_eq!(matches, 120);
    assert!(proofs >= 10, "{proofs} proofs");
}
