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
