//! Whether questions pay off as often as expected: [`Faith`].
//!
//! In some mazes, especially those drawn by people, one promising path after another turns
//! out to be closed. The robot compares how many questions led to a shorter path with how many
//! it expected, and expects less of the next ones if there were fewer, and more if there were
//! more.

use crate::knowledge::Known;

/// Keeps count of questions.
#[derive(Default)]
pub struct Faith {
    /// The chances of the questions answered, added up.
    expected: f32,
    /// How many of them made the known path shorter.
    fulfilled: f32,
    asked: Option<Asked>,
}

/// A question that has not been answered yet.
struct Asked {
    /// How likely the shorter path was when the robot began to look for it.
    chance: f32,
    /// The steps of the known path then.
    known_steps: u32,
    /// The unknown walls of the shorter path.
    walls: Vec<usize>,
}

impl Faith {
    /// What the chance of a question is to be multiplied by, if the chances had come
    /// true this many times before the match.
    pub fn factor(&self, prior: f32) -> f32 {
        (self.fulfilled + prior) / (self.expected + prior)
    }

    /// Takes note of what is known now: the steps of the known path, and walls.
    pub fn hear(&mut self, known_steps: u32, known: &[Known]) {
        let Some(asked) = &self.asked else {
            return;
        };
        let shorter = known_steps < asked.known_steps;
        let closed = |it: &usize| known[*it] == Known::Closed;
        if shorter || asked.walls.iter().any(closed) {
            self.expected += asked.chance;
            self.fulfilled += if shorter { 1.0 } else { 0.0 };
            self.asked = None;
        }
    }

    /// A question is asked; nothing happens while another has no answer.
    pub fn ask(&mut self, chance: f32, known_steps: u32, walls: Vec<usize>) {
        self.asked.get_or_insert(Asked {
            chance,
            known_steps,
            walls,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRIOR: f32 = 2.0;

    #[test]
    fn a_closed_wall_disappoints() {
        let mut faith = Faith::default();
        assert_eq!(faith.factor(PRIOR), 1.0);
        faith.ask(0.5, 20, vec![1, 2]);
        // Another question while this one is open changes nothing.
        faith.ask(0.9, 20, vec![0]);
        faith.hear(20, &[Known::Closed, Known::Open, Known::Unknown]);
        assert_eq!(faith.factor(PRIOR), 1.0);
        faith.hear(20, &[Known::Closed, Known::Open, Known::Closed]);
        assert_eq!(faith.factor(PRIOR), 2.0 / 2.5);
        // Answered once and for all.
        faith.hear(10, &[Known::Closed; 3]);
        assert_eq!(faith.factor(PRIOR), 2.0 / 2.5);
    }

    #[test]
    fn a_shorter_way_encourages() {
        let mut faith = Faith::default();
        faith.ask(0.5, 20, vec![1]);
        faith.hear(18, &[Known::Unknown, Known::Open]);
        assert_eq!(faith.factor(PRIOR), 3.0 / 2.5);
    }
}
