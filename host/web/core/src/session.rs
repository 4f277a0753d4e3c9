//! [`Session`]: the buffers and the open matches of an instance.

use wasmouse_core::replay::BYTES_MAX;

use crate::input;
use crate::open::OpenMatch;

/// The largest input, in bytes.
const INPUT_MAX: u64 = BYTES_MAX;

/// Open matches at most; a page shows four.
const OPEN_MAX: usize = 64;

/// Everything that the exported functions share.
#[derive(Default)]
pub struct Session {
    input: Vec<u8>,
    output: Vec<u8>,
    matches: Vec<Option<OpenMatch>>,
}

impl Session {
    /// Room for input, or null.
    pub fn reserve(&mut self, length: u32) -> *mut u8 {
        self.input.clear();
        let length_usize = length as usize;
        if u64::from(length) > INPUT_MAX || self.input.try_reserve_exact(length_usize).is_err() {
            return std::ptr::null_mut();
        }
        self.input.resize(length_usize, 0);
        self.input.as_mut_ptr()
    }

    /// The last output.
    pub fn output(&self) -> &[u8] {
        &self.output
    }

    /// Opens what [`input::read_match`] reads.
    pub fn open_match(&mut self) -> u32 {
        let input = std::mem::take(&mut self.input);
        self.add(input::read_match(&input))
    }

    /// Opens a replay file.
    pub fn open_replay(&mut self) -> u32 {
        let input = std::mem::take(&mut self.input);
        self.add(input::read_replay(&input))
    }

    fn add(&mut self, opened: Result<OpenMatch, String>) -> u32 {
        let opened = match opened {
            Ok(opened) => opened,
            Err(message) => return self.fail(message),
        };
        let free = self.matches.iter().position(Option::is_none);
        let index = free.unwrap_or(self.matches.len());
        if index >= OPEN_MAX {
            return self.fail(format!("more than {OPEN_MAX} matches are open"));
        }
        if index == self.matches.len() {
            self.matches.push(None);
        }
        self.matches[index] = Some(opened);
        self.output.clear();
        index as u32 + 1
    }

    /// What there is to say about a match.
    pub fn about(&mut self, handle: u32) -> u32 {
        self.answer(handle, |it| {
            serde_json::to_vec(&it.about()).map_err(|error| error.to_string())
        })
    }

    /// Where the robot is at each position.
    pub fn poses(&mut self, handle: u32) -> u32 {
        self.answer(handle, |it| Ok(it.poses()))
    }

    /// What could be known at each position.
    pub fn audit(&mut self, handle: u32) -> u32 {
        self.answer(handle, |it| Ok(bytes(&it.audit())))
    }

    /// What there is to see at a position.
    pub fn frame(&mut self, handle: u32, step: u32) -> u32 {
        self.answer(handle, |it| it.frame(step).map(|numbers| bytes(&numbers)))
    }

    /// Closes a match.
    pub fn close(&mut self, handle: u32) -> u32 {
        let Some(slot) = self.slot(handle).filter(|slot| slot.is_some()) else {
            return self.fail(not_open(handle));
        };
        *slot = None;
        self.output.clear();
        1
    }

    fn answer(
        &mut self,
        handle: u32,
        answer: impl FnOnce(&OpenMatch) -> Result<Vec<u8>, String>,
    ) -> u32 {
        let opened = self.slot(handle).and_then(|slot| slot.as_ref());
        match opened.map_or_else(|| Err(not_open(handle)), answer) {
            Ok(output) => {
                self.output = output;
                1
            }
            Err(message) => self.fail(message),
        }
    }

    fn slot(&mut self, handle: u32) -> Option<&mut Option<OpenMatch>> {
        let index = (handle as usize).checked_sub(1)?;
        self.matches.get_mut(index)
    }

    fn fail(&mut self, message: String) -> u32 {
        self.output = message.into_bytes();
        0
    }
}

fn not_open(handle: u32) -> String {
    format!("no match has the handle {handle}")
}

fn bytes(numbers: &[i32]) -> Vec<u8> {
    numbers.iter().flat_map(|it| it.to_le_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::HEAD;
    use wasmouse_core::game::Action;
    use wasmouse_core::maze::{Maze, Turn, Walls};
    use wasmouse_core::record::Transcript;

    /// A match of two steps as the page gives it.
    fn input() -> Vec<u8> {
        let maze = Maze::contest(Walls::open(12)).expect("start and goal fit");
        let mut transcript = Transcript::default();
        transcript.push(Action::Move {
            turn: Turn::Straight,
            advance: 3,
        });
        transcript.push(Action::Reset);
        let maze = maze.identity_bytes();
        let mut bytes = 2_u32.to_le_bytes().to_vec();
        bytes.extend([0, 3]);
        bytes.extend(30_u32.to_le_bytes());
        bytes.extend((maze.len() as u32).to_le_bytes());
        bytes.extend(maze);
        bytes.extend(transcript.to_bytes());
        bytes
    }

    fn open(session: &mut Session, input: &[u8]) -> u32 {
        session.input = input.to_vec();
        session.open_match()
    }

    fn numbers(session: &Session) -> Vec<i32> {
        let (chunks, rest) = session.output().as_chunks();
        assert!(rest.is_empty());
        chunks.iter().copied().map(i32::from_le_bytes).collect()
    }

    #[test]
    fn a_match_is_shown_at_every_position() {
        let mut session = Session::default();
        let handle = open(&mut session, &input());
        assert_eq!(handle, 1);
        assert_eq!(session.poses(handle), 1);
        assert_eq!(session.output(), [1, 0, 0, 0, 1, 0, 3, 0, 1, 0, 3, 0]);
        assert_eq!(session.audit(handle), 1);
        let audit = numbers(&session);
        assert_eq!(audit.len(), 3 * 3);
        assert_eq!(session.frame(handle, 1), 1);
        let frame = numbers(&session);
        assert_eq!(frame[..11], [1, 1, 0, 3, 0, 1, 0, 0, 0, 8, 11]);
        assert_eq!(frame[11..13], audit[4..6]);
        assert_eq!(frame[15..25], [0, 1, 3, 0, 3, 1, -1, -1, 5, 0]);
        let (stops, path) = (frame[25] as usize, frame[26] as usize);
        assert_eq!(frame.len(), HEAD + 2 * (stops + path) + 3 * 144);
        assert_eq!(frame[HEAD..HEAD + 4], [0, 0, 0, 3]);
        let visits = &frame[HEAD + 2 * (stops + path)..][..144];
        assert_eq!(visits.iter().sum::<i32>(), 4);
        assert_eq!(session.frame(handle, 3), 0);
        assert_eq!(session.output(), b"the match has 2 steps, not 3");
    }

    #[test]
    fn what_is_said_about_a_match_is_json() {
        let mut session = Session::default();
        let handle = open(&mut session, &input());
        assert_eq!(session.about(handle), 1);
        let about: serde_json::Value = serde_json::from_slice(session.output()).expect("JSON");
        assert_eq!(about["dimension"], 12);
        assert_eq!(about["goal"], serde_json::json!([5, 5, 2, 2]));
        assert_eq!(about["verdict"], "budget used up");
        assert_eq!(about["oracleSpeedSteps"], 4);
        assert_eq!(about["notes"], serde_json::json!([]));
    }

    #[test]
    fn handles_are_used_again() {
        let mut session = Session::default();
        assert_eq!(open(&mut session, &input()), 1);
        assert_eq!(open(&mut session, &input()), 2);
        assert_eq!(session.close(1), 1);
        assert_eq!(session.close(1), 0);
        assert_eq!(session.about(1), 0);
        assert_eq!(session.output(), b"no match has the handle 1");
        assert_eq!(open(&mut session, &input()), 1);
        assert_eq!(session.close(0), 0);
        assert_eq!(session.close(u32::MAX), 0);
        for _ in 2..OPEN_MAX {
            assert_ne!(open(&mut session, &input()), 0);
        }
        assert_eq!(open(&mut session, &input()), 0);
    }

    #[test]
    fn input_that_is_cut_is_refused() {
        let mut session = Session::default();
        let input = input();
        for length in 0..input.len() {
            assert_eq!(open(&mut session, &input[..length]), 0, "{length} bytes");
            assert!(!session.output().is_empty());
        }
        session.input = b"{}".to_vec();
        assert_eq!(session.open_replay(), 0);
        let message = String::from_utf8_lossy(session.output());
        assert!(message.contains("missing field"), "{message}");
        assert!(session.reserve(u32::MAX).is_null());
    }
}
