//! The wall follower from the sketch-city report.
//!
//! From the report (its state machine, at every intersection): go straight unless there is a
//! wall ahead; then, with walls on both sides, turn around; otherwise turn to the open side.
//! The report drives it along the perimeter of a small maze and has no contest results.
//!
//! What the report leaves open:
//!
//! - *A wall ahead and none at the sides*: the report's code keeps its previous state. Here
//!   the variant decides.
//! - *Turning around*: a step cannot turn by 180 degrees. This robot turns left on the spot,
//!   and the rule then turns it left again and drives on, so a dead end costs one extra step.
//! - *Distance*: one cell per step, because the report checks every cell.
//! - *The goal*: the report has none. This robot resets in the goal and follows the same
//!   rules again in the speed run, so it repeats its path.
//!
//! The robot remembers no walls, so it can circle until its budget is used up.
//!
//! Variants: 0 prefers left where both sides are open; 1 prefers right.

use wasmouse_sdk::{Action, Area, Briefing, Pose, Robot, Sensors, Turn, export_robot};

/// The robot; all it remembers is where it is.
pub struct WallFollower {
    pose: Pose,
    start: Pose,
    goal: Area,
    preferred: Turn,
    exploring: bool,
}

export_robot!(WallFollower);

impl Robot for WallFollower {
    fn start(briefing: &Briefing) -> Self {
        let preferred = match briefing.variant {
            0 => Turn::Left,
            1 => Turn::Right,
            _ => panic!("the wall follower has the variants 0 and 1"),
        };
        let start = Pose::at_start(briefing.start);
        Self {
            pose: start,
            start,
            goal: briefing.goal,
            preferred,
            exploring: true,
        }
    }

    fn next_move(&mut self, sensors: Sensors) -> Action {
        if self.exploring && self.goal.contains(self.pose.cell) && self.pose.cell != self.start.cell
        {
            self.exploring = false;
            self.pose = self.start;
            return Action::Reset;
        }
        let (turn, advance) = self.decide(sensors);
        self.pose = self
            .pose
            .after(turn, advance, sensors)
            .expect("forward moves only");
        Action::drive(turn, advance)
    }
}

impl WallFollower {
    /// The report's rule.
    fn decide(&self, sensors: Sensors) -> (Turn, i8) {
        if sensors.front > 0 {
            return (Turn::Straight, 1);
        }
        match (sensors.left > 0, sensors.right > 0) {
            (false, false) => (Turn::Left, 0),
            (false, true) => (Turn::Right, 1),
            (true, false) => (Turn::Left, 1),
            (true, true) => (self.preferred, 1),
        }
    }
}

#[cfg(test)]
#[path = "../../contest_mazes.rs"]
mod contest_mazes;

#[cfg(test)]
mod tests {
    use super::*;
    use wasmouse_sdk::Cell;
    use wasmouse_sdk::testing::{self, MAZE_01, PlayOptions};

    fn play(maze: &str, variant: u32, goal: Option<Area>) -> String {
        let options = PlayOptions {
            variant,
            goal,
            ..PlayOptions::default()
        };
        let played = testing::play::<WallFollower>(maze, &options);
        assert_eq!(played.bumps, 0);
        played.summary()
    }

    #[test]
    fn circles_in_the_contest_mazes() {
        for (number, maze) in contest_mazes::contest_mazes() {
            for variant in [0, 1] {
                let summary = play(&maze, variant, None);
                assert_eq!(summary, "goal not seen 1000 + 0", "maze {number}");
            }
        }
    }

    #[test]
    fn repeats_its_way_when_it_finds_the_goal() {
        // Up two cells, to the right two, with a dead end behind the goal.
        let maze = "4\n1,5,6,0\n0,0,10,0\n0,0,10,0\n0,0,8,0";
        let goal = Area::new(Cell::new(2, 2), 1, 1);
        assert_eq!(play(maze, 0, Some(goal)), "finished 5 + 4: 4.167");
    }

    #[test]
    fn turns_around_in_a_dead_end() {
        let maze = "4\n1,5,6,0\n0,0,10,0\n0,0,10,0\n0,0,8,0";
        let far = Area::new(Cell::new(0, 3), 1, 1);
        let options = PlayOptions {
            goal: Some(far),
            ..PlayOptions::default()
        };
        let played = testing::play::<WallFollower>(maze, &options);
        let cells: Vec<(u32, u32)> = played.stops[..9]
            .iter()
            .map(|it| (it.cell.x, it.cell.y))
            .collect();
        let expected = [
            (0, 0),
            (0, 1),
            (0, 2),
            (1, 2),
            (2, 2),
            (3, 2),
            (3, 2),
            (2, 2),
            (1, 2),
        ];
        assert_eq!(cells, expected);
    }

    #[test]
    #[should_panic(expected = "variants 0 and 1")]
    fn an_unknown_variant() {
        play(MAZE_01, 2, None);
    }
}
