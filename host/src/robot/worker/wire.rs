//! What the supervisor and its workers say to each other, and how it is framed.
//!
//! A frame is its length (4 bytes, little endian) and a value in the `postcard`
//! format; large bytes follow a frame that tells their number. Both ends are the
//! same build of wasmouse, and [`Hello`] says so before anything else counts. This is no
//! public format: what a supervisor reads may still be anything, because a robot may
//! have taken the worker over, so frames have a largest size and values are checked by
//! whoever uses them.

use std::io::{self, Read, Write};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::maze::{Cell, Heading};
use crate::robot::componentize::BinaryKind;
use crate::robot::{
    Belief, Color, Digest, FaultKind, Frame, FuelUse, Level, Needs, Phase, Shape, engine_id,
};
use crate::sim::{Action, Limits, Ruleset};

/// The largest frame, in bytes: a match of 10,000 steps with a full journal has less.
/// What is read from a frame takes up to 16 times its bytes.
const FRAME_BYTES_MAX: usize = 4 << 20;

/// What a worker has to be: the same version and engine as the supervisor.
pub(super) fn build() -> String {
    format!("{} {}", env!("CARGO_PKG_VERSION"), engine_id())
}

/// The first frame to a worker that plays.
#[derive(Serialize, Deserialize)]
pub(super) struct Setup {
    /// The rules of all its matches.
    pub(super) rules: Ruleset,
}

/// The first frame from a worker.
#[derive(Serialize, Deserialize)]
pub(super) struct Hello {
    /// Its [`build`].
    pub(super) build: String,
    /// How well the operating system confines it.
    pub(super) sandbox: Sandbox,
}

/// What the operating system keeps a worker from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sandbox {
    /// Files, network and signals, by landlock.
    pub landlock: bool,
    /// All system calls but a few, by seccomp.
    pub seccomp: bool,
}

impl Sandbox {
    /// Whether every layer is there.
    pub const fn is_complete(self) -> bool {
        self.landlock && self.seccomp
    }
}

/// What a worker that plays is asked.
#[derive(Serialize, Deserialize)]
pub(super) enum Request {
    /// Keep a robot; its compiled code follows. Answered by [`Loaded`].
    Robot {
        /// Where to keep it; what was there is forgotten.
        slot: u16,
        /// Bytes that follow.
        length: u64,
        /// Their digest.
        code: Digest,
        /// The digest of the component.
        component: Digest,
    },
    /// Keep a maze. Not answered.
    Maze {
        /// Where to keep it; what was there is forgotten.
        slot: u16,
        /// Its identity bytes.
        bytes: Vec<u8>,
    },
    /// Play matches. Answered by one [`Answers`] for each, in order.
    Play(Batch),
}

/// Matches of one robot.
#[derive(Serialize, Deserialize)]
pub(super) struct Batch {
    /// The slot of the robot.
    pub(super) robot: u16,
    /// Whether to tell fuel by step and the journal.
    pub(super) full: bool,
    /// The matches.
    pub(super) games: Vec<GameOrder>,
}

/// One match of a batch.
#[derive(Serialize, Deserialize)]
pub(super) struct GameOrder {
    /// The slot of the maze.
    pub(super) maze: u16,
    /// The robot's only source of chance.
    pub(super) seed: u64,
    /// The variant of the robot.
    pub(super) setting: u32,
}

/// What came of [`Request::Robot`].
#[derive(Serialize, Deserialize)]
pub(super) enum Loaded {
    /// It is there, and this is what it needs.
    Ready(Option<Needs>),
    /// It is no robot.
    Refused(ToldRefusal),
    /// The code is not what its digest says.
    Damaged,
}

/// What a robot did in a match. The score is not in it: the supervisor plays the
/// robot's answers itself and finds out.
#[derive(Serialize, Deserialize)]
pub(super) struct Answers {
    /// The robot's answers, in order.
    pub(super) actions: Vec<Action>,
    /// How the match ended, unless by the rules.
    pub(super) stop: Option<Stop>,
    /// Fuel.
    pub(super) fuel: FuelUse,
    /// Entries in the journal, and those dropped from it.
    pub(super) journal: (u64, u64),
    /// Fuel by step and the journal, when asked for.
    pub(super) full: Option<Full>,
}

/// Why a match ended early.
#[derive(Serialize, Deserialize)]
pub(super) enum Stop {
    /// By a fault.
    Fault {
        kind: FaultKind,
        phase: Phase,
        detail: String,
    },
    /// The host stood still.
    Stalled,
    /// The host failed otherwise.
    Failed(String),
}

/// What pictures and journals are made of.
#[derive(Serialize, Deserialize)]
pub(super) struct Full {
    /// Fuel of every call of `next-move`.
    pub(super) step_fuel: Vec<u64>,
    /// The journal's entries with their steps.
    pub(super) journal: Vec<(u32, Note)>,
}

/// An entry of the journal that owns its text.
#[derive(Serialize, Deserialize)]
pub(super) enum Note {
    Log(Level, String),
    Paint(Cell, Color),
    Label(Cell, String),
    Wall(Cell, Heading, Belief),
}

/// The only frame to a worker that compiles; the file follows.
#[derive(Serialize, Deserialize)]
pub(super) struct CompileOrder {
    /// What robots are admitted under.
    pub(super) limits: Limits,
    /// Bytes that follow.
    pub(super) length: u64,
    /// Whether compiled code is wanted, or only what the file is.
    pub(super) compile: bool,
    /// Whether its world is wanted as WIT.
    pub(super) describe: bool,
}

/// What a file is, from a worker that compiles, after its [`Hello`].
#[derive(Serialize, Deserialize)]
pub(super) struct Examined {
    /// What it is; `None` when it is no WebAssembly binary.
    pub(super) kind: Option<BinaryKind>,
    /// Imports and exports, when they can be read.
    pub(super) shape: Option<Shape>,
    /// The world as WIT, when wanted.
    pub(super) wit: Option<String>,
    /// What came of the rest.
    pub(super) result: Compiled,
}

/// What came of compiling.
#[derive(Serialize, Deserialize)]
pub(super) enum Compiled {
    /// It would be admitted so far, and no code was wanted.
    NotWanted,
    /// The code follows.
    Code {
        /// Bytes that follow.
        length: u64,
        /// Their digest.
        digest: Digest,
    },
    /// It is no robot.
    Refused(ToldRefusal),
}

/// The only frame to a worker that explains; the file follows.
#[derive(Serialize, Deserialize)]
pub(super) struct ExplainOrder {
    /// The rules of the match.
    pub(super) rules: Ruleset,
    /// The identity bytes of the maze.
    pub(super) maze: Vec<u8>,
    pub(super) seed: u64,
    pub(super) setting: u32,
    /// Bytes that follow.
    pub(super) length: u64,
}

/// Where a robot fails, from a worker that explains, after its [`Hello`].
#[derive(Serialize, Deserialize)]
pub(super) struct Explained {
    /// The kind of fault that it ends in, with where.
    pub(super) fault: Option<(FaultKind, Vec<Frame>)>,
}

/// A refusal in words.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct ToldRefusal {
    pub(super) name: String,
    pub(super) reason: String,
    pub(super) hint: String,
}

/// Writes a frame and does not flush.
pub(super) fn write(to: &mut impl Write, value: &impl Serialize) -> io::Result<()> {
    let bytes = postcard::to_stdvec(value).map_err(io::Error::other)?;
    if bytes.len() > FRAME_BYTES_MAX {
        return Err(io::Error::other("a frame is too large"));
    }
    let length = u32::try_from(bytes.len()).map_err(io::Error::other)?;
    to.write_all(&length.to_le_bytes())?;
    to.write_all(&bytes)
}

/// Reads a frame; `None` when nothing comes any more.
pub(super) fn read<T: DeserializeOwned>(from: &mut impl Read) -> io::Result<Option<T>> {
    let mut length = [0; 4];
    match from.read(&mut length[..1]) {
        Ok(0) => return Ok(None),
        Ok(_) => from.read_exact(&mut length[1..])?,
        Err(error) if error.kind() == io::ErrorKind::Interrupted => return read(from),
        Err(error) => return Err(error),
    }
    let length = u32::from_le_bytes(length) as usize;
    if length > FRAME_BYTES_MAX {
        return Err(io::Error::other(format!("a frame claims {length} bytes")));
    }
    let mut bytes = vec![0; length];
    from.read_exact(&mut bytes)?;
    postcard::from_bytes(&bytes)
        .map(Some)
        .map_err(|error| io::Error::other(format!("a frame cannot be read: {error}")))
}

/// Reads a frame that has to come.
pub(super) fn expect<T: DeserializeOwned>(from: &mut impl Read) -> io::Result<T> {
    read(from)?.ok_or_else(|| io::ErrorKind::UnexpectedEof.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_come_back_and_end() {
        let mut bytes = Vec::new();
        write(&mut bytes, &"one").expect("memory");
        write(&mut bytes, &7_u32).expect("memory");
        let mut from = bytes.as_slice();
        assert_eq!(expect::<String>(&mut from).expect("a frame"), "one");
        assert_eq!(expect::<u32>(&mut from).expect("a frame"), 7);
        assert!(read::<u32>(&mut from).expect("the end").is_none());
        expect::<u32>(&mut from).expect_err("the end");
    }

    /// What a taken-over worker claims is no reason to take memory.
    #[test]
    fn frames_have_a_largest_size() {
        // The value's own length takes four bytes.
        let mut value = vec![1_u8; FRAME_BYTES_MAX - 4];
        let mut bytes = Vec::new();
        write(&mut bytes, &value).expect("the largest frame");
        let back: Vec<u8> = expect(&mut bytes.as_slice()).expect("the largest frame");
        assert!(back == value);

        value.push(1);
        write(&mut Vec::new(), &value).expect_err("one byte more");
        let length = u32::try_from(FRAME_BYTES_MAX + 1).expect("a small number");
        let mut claim = length.to_le_bytes().to_vec();
        claim.resize(claim.len() + FRAME_BYTES_MAX + 1, 0);
        let mut from = claim.as_slice();
        let error = read::<Vec<u8>>(&mut from).expect_err("one byte more");
        assert!(
            error.to_string().contains("claims 4194305 bytes"),
            "{error}"
        );
        assert_eq!(from.len(), FRAME_BYTES_MAX + 1, "nothing of it is read");
    }

    #[test]
    fn bad_frames_are_errors() {
        for bytes in [
            &[255, 255, 255, 255][..],
            &[4, 0, 0, 0, 1],
            &[1, 0],
            &[1, 0, 0, 0, 255],
        ] {
            read::<String>(&mut &bytes[..]).expect_err("a bad frame");
        }
    }
}
