//! Lobato's random walk, the first benchmark of his report.
//!
//! From the report: the agent makes random moves. Of six tries in maze 01, three reached the
//! goal (after 317, 361 and 897 steps) and one finished both runs within 1000 steps, with a
//! score of 584.067.
//!
//! The report leaves open what a random move is. Here, the robot picks one of the open
//! directions among left, ahead and right, and a distance from 1 cell to the longest move or
//! the nearest wall, all with equal probability. In a dead end it turns left on the spot. It
//! resets in the goal and then walks at random again.
//!
//! In maze 01, 720 of the seeds 0 to 999 reach the goal (half of them within 374 steps) and
//! 337 finish, about as often as in the report's six tries. With moves in any direction, open
//! or not, fewer than 200 seeds would reach it.
//!
//! The seed of the briefing is the only source of randomness, expanded by SplitMix64
//! ([`Random`]).
//!
//! Variants: only 0.

use wasmouse_sdk::{Action, Area, Briefing, Pose, Random, Robot, Sensors, Turn, export_robot};

/// The robot.
pub struct RandomWalk {
    pose: Pose,
    start: Pose,
    goal: Area,
    longest_move: u32,
    random: Random,
    exploring: bool,
}

export_robot!(RandomWalk);

impl Robot for RandomWalk {
    fn start(briefing: &Briefing) -> Self {
        assert!(
            briefing.variant == 0,
            "the random walk has the variant 0 only"
        );
        let start = Pose::at_start(briefing.start);
        Self {
            pose: start,
            start,
            goal: briefing.goal,
            longest_move: briefing.longest_move.min(i8::MAX as u32),
            random: Random::new(briefing.seed),
            exploring: true,
        }
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        if self.exploring && self.pose != self.start && self.goal.contains(self.pose.cell) {
            self.exploring = false;
            self.pose = self.start;
            return Action::Reset;
        }
        let (turn, advance) = self.roll(sensors);
        self.pose = self
            .pose
            .after(turn, advance, sensors)
            .expect("forward moves only");
        Action::drive(turn, advance)
    }
}

impl RandomWalk {
    fn roll(&mut self, sensors: Sensors) -> (Turn, i8) {
        let directions = [
            (Turn::Left, sensors.left),
            (Turn::Straight, sensors.front),
            (Turn::Right, sensors.right),
        ];
        let open = || directions.into_iter().filter(|&(_, cells)| cells > 0);
        let ways = open().count() as u32;
        if ways == 0 {
            return (Turn::Left, 0);
        }
        let chosen = self.random.below(ways) as usize;
        let (turn, cells) = open().nth(chosen).expect("fewer than the ways");
        let farthest = cells.min(self.longest_move).max(1);
        (turn, 1 + self.random.below(farthest) as i8)
    }
}

#[cfg(test)]
#[path = "../../contest_mazes.rs"]
mod contest_mazes;

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions, Played};

    fn play(maze: &str, seed: u64) -> Played {
        let options = PlayOptions {
            seed,
            ..PlayOptions::default()
        };
        let played = testing::play::<RandomWalk>(maze, &options);
        assert_eq!((played.bumps, played.resets_before_goal), (0, 0));
        played
    }

    #[test]
    fn contest_mazes() {
        let expected = [
            (1, 0, "goal not seen 1000 + 0"),
            (1, 1, "finished 67 + 221: 223.233"),
            (1, 2, "finished 590 + 254: 273.667"),
            (2, 0, "goal seen 740 + 260"),
            (3, 0, "goal seen 726 + 274"),
        ];
        let mazes = contest_mazes::contest_mazes();
        for (number, seed, expected) in expected {
            if let Some((_, maze)) = mazes.iter().find(|it| it.0 == number) {
                assert_eq!(play(maze, seed).summary(), expected, "maze {number}");
            }
        }
    }

    /// The figures of the crate's documentation.
    #[test]
    fn as_often_as_in_the_report() {
        let matches: Vec<Played> = (0..1000).map(|seed| play(MAZE_01, seed)).collect();
        let mut explorations: Vec<u32> = matches
            .iter()
            .filter(|it| it.goal_seen)
            .map(|it| it.exploration_steps)
            .collect();
        explorations.sort_unstable();
        let finished = matches.iter().filter(|it| it.finished).count();
        assert_eq!((explorations.len(), finished), (720, 337));
        assert_eq!(explorations[360], 374);
    }

    #[test]
    fn the_same_seed_walks_the_same_way() {
        assert_eq!(play(MAZE_01, 7), play(MAZE_01, 7));
        assert_ne!(play(MAZE_01, 7).stops, play(MAZE_01, 8).stops);
    }

    #[test]
    #[should_panic(expected = "variant 0 only")]
    fn an_unknown_variant() {
        RandomWalk::start(&Briefing {
            variant: 1,
            ..Briefing::contest(12)
        });
    }
}
