//! The protocol between the supervisor and its workers, and how it is framed.
//!
//! A frame is its length (4 bytes, little endian) and a value in the `postcard` format; large
//! byte strings follow a frame that announces their length. Both ends are the same build of
//! wasmouse, and [`Hello`] says so before anything else counts. The format is private. What
//! a supervisor reads may still be anything, because a robot may have taken over the worker:
//! frames have a maximum size, and whoever uses a value checks it.

use std::io::{self, Read, Write};
use std::time::Duration;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_bytes::ByteBuf;
use wasmouse_core::Digest;
use wasmouse_core::GuestText;
use wasmouse_core::game::{FaultKind, Ruleset};
use wasmouse_core::journal::{Belief, Color, Level, Note};
use wasmouse_core::maze::{Cell, Heading};
use wasmouse_core::record::Usage;

use super::role::SandboxStatus;
use crate::admission::precheck::Shape;
use crate::admission::{BinaryKind, Rejection, ResourceRequirements};
use crate::limits::Limits;
use crate::profile::{Expected, Profile};
use crate::runtime::{Frame, engine_id};

/// The largest frame, in bytes: a match of 10,000 steps with a full journal has less. A value
/// that is read from a frame takes up to 16 times its bytes.
pub(super) const FRAME_BYTES_MAX: usize = 4 << 20;

/// What a worker has to be: the same version and engine as the supervisor.
pub(super) fn build() -> String {
    format!("{} {}", env!("CARGO_PKG_VERSION"), engine_id())
}

/// The first frame to a run worker.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Setup {
    /// The rules of all its matches.
    pub(super) rules: Ruleset,
    /// The limits that its robots were admitted under.
    pub(super) limits: Limits,
    /// Processor time of a match, at most.
    pub(super) match_time: Duration,
}

/// The first frame from a worker.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Hello {
    /// Its [`build`].
    pub(super) build: String,
    /// Which layers of the sandbox it has.
    pub(super) sandbox: SandboxStatus,
}

/// A request to a run worker.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Request {
    /// Keep a robot; its compiled code follows. Answered by [`Loaded`].
    Robot {
        /// Where to keep it; what was there is dropped.
        slot: u16,
        /// Bytes that follow.
        length: u64,
        /// Their digest.
        code: Digest,
        /// The digest of the robot's file.
        robot: Digest,
    },
    /// Keep a maze. Not answered.
    Maze {
        /// Where to keep it; what was there is dropped.
        slot: u16,
        /// Its digest. The worker does not compute it: a wrong one would only name what it
        /// plays, and the supervisor makes the record.
        digest: Digest,
        /// Its identity bytes.
        #[serde(with = "serde_bytes")]
        bytes: Vec<u8>,
    },
    /// Play matches. Answered by one [`MatchReport`] for each, in order.
    Run(RunBatch),
}

/// Matches of one robot.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct RunBatch {
    /// The slot of the robot.
    pub(super) robot: u16,
    /// Whether to report [`Details`].
    pub(super) details: bool,
    /// The matches.
    pub(super) matches: Vec<MatchOrder>,
}

/// One match of a batch.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct MatchOrder {
    /// The slot of the maze.
    pub(super) maze: u16,
    /// The robot's only source of randomness.
    pub(super) seed: u64,
    /// The variant of the robot.
    pub(super) variant: u32,
}

/// The answer to [`Request::Robot`].
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Loaded {
    /// The robot is loaded, and this is what it requires.
    Ready(Option<ResourceRequirements>),
    /// It cannot be a robot.
    Rejected(RejectionText),
    /// The engine does not take the code, and why.
    Unloadable(RejectionText),
    /// The code is not what its digest says.
    Damaged,
    /// The worker could not load it for a reason of the host.
    Failed(String),
}

/// What a robot did in a match. The score is not in it: the supervisor replays the transcript
/// by the rules.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct MatchReport {
    /// The encoded transcript, or why the worker could not play the match.
    pub(super) transcript: Result<ByteBuf, RunFailure>,
    /// What the robot used.
    pub(super) usage: Usage,
    /// Fuel by step and the journal, when asked for.
    pub(super) details: Option<Details>,
}

/// Why a worker could not play a match, although the robot did nothing wrong.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum RunFailure {
    /// The match did not end within that processor time.
    Slow {
        /// The limit.
        seconds: u64,
    },
    /// Anything else.
    Failed(String),
}

/// What journals and profiles are made of.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Details {
    /// Fuel of every call of `next-move`.
    pub(super) step_fuel: Vec<u64>,
    /// The journal's entries with their steps.
    pub(super) journal: Vec<(u32, OwnedNote)>,
}

/// An entry of the journal that owns its text.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum OwnedNote {
    Log(Level, GuestText),
    Paint(Cell, Color),
    Label(Cell, GuestText),
    Wall(Cell, Heading, Belief),
}

impl OwnedNote {
    /// The entry as the journal takes it.
    pub(super) fn borrowed(&self) -> Note<'_> {
        match self {
            Self::Log(level, text) => Note::Log {
                level: *level,
                text: text.as_guest(),
            },
            Self::Paint(cell, color) => Note::Paint {
                cell: *cell,
                color: *color,
            },
            Self::Label(cell, text) => Note::Label {
                cell: *cell,
                text: text.as_guest(),
            },
            Self::Wall(cell, side, belief) => Note::Wall {
                cell: *cell,
                side: *side,
                belief: *belief,
            },
        }
    }
}

impl From<Note<'_>> for OwnedNote {
    fn from(note: Note<'_>) -> Self {
        match note {
            Note::Log { level, text } => Self::Log(level, text.into()),
            Note::Paint { cell, color } => Self::Paint(cell, color),
            Note::Label { cell, text } => Self::Label(cell, text.into()),
            Note::Wall { cell, side, belief } => Self::Wall(cell, side, belief),
        }
    }
}

/// The only frame to a compile worker; the file follows.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct CompileOrder {
    /// What robots are admitted under.
    pub(super) limits: Limits,
    /// Bytes that follow.
    pub(super) length: u64,
    /// Whether compiled code is wanted, or only what the file is.
    pub(super) compile: bool,
    /// Whether its world is wanted as WIT.
    pub(super) describe: bool,
    /// Whether the code is for a backtrace worker.
    pub(super) backtraces: bool,
}

/// What a file is, from a compile worker, after its [`Hello`].
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Examined {
    /// What it is; `None` when it is not WebAssembly.
    pub(super) kind: Option<BinaryKind>,
    /// Imports and exports, when they can be read.
    pub(super) shape: Option<Shape>,
    /// The world as WIT, when wanted.
    pub(super) wit: Option<String>,
    /// Whether it is admitted.
    pub(super) result: Compiled,
}

/// What came of compiling.
#[derive(Debug, Serialize, Deserialize)]
pub(super) enum Compiled {
    /// It is admitted so far, and no code was wanted.
    NotWanted,
    /// The code follows.
    Code {
        /// Bytes that follow.
        length: u64,
        /// Their digest.
        digest: Digest,
    },
    /// It is rejected.
    Rejected(RejectionText),
}

/// The only frame to a backtrace worker; the file follows, or its code.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct BacktraceOrder {
    /// The rules of the match.
    pub(super) rules: Ruleset,
    /// The limits that the robot was admitted under.
    pub(super) limits: Limits,
    /// The identity bytes of the maze.
    pub(super) maze: Vec<u8>,
    /// The robot's seed.
    pub(super) seed: u64,
    /// The robot's variant.
    pub(super) variant: u32,
    /// What the match is known to do, when a [`Profiled`] is wanted instead of a [`Backtrace`].
    pub(super) profile: Option<Expected>,
    /// The digest of the robot's file.
    pub(super) robot: Digest,
    /// The digest of its code, made for backtraces, when that follows instead of the file.
    pub(super) code: Option<Digest>,
    /// Bytes that follow.
    pub(super) length: u64,
}

/// The fuel of a match by function, from a backtrace worker, after its [`Hello`].
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Profiled {
    /// The profile, or why there is none.
    pub(super) profile: Result<Profile, String>,
}

/// Where a robot fails, from a backtrace worker, after its [`Hello`].
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Backtrace {
    /// The kind of fault that the match ends in, with the calls in progress.
    pub(super) fault: Option<(FaultKind, Vec<Frame>)>,
}

/// A rejection as text.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct RejectionText {
    pub(super) name: GuestText,
    pub(super) reason: GuestText,
    pub(super) hint: GuestText,
}

impl From<Rejection> for RejectionText {
    fn from(rejection: Rejection) -> Self {
        Self {
            name: rejection.name().into(),
            reason: rejection.reason(),
            hint: rejection.hint().into(),
        }
    }
}

impl From<RejectionText> for Rejection {
    fn from(text: RejectionText) -> Self {
        let RejectionText { name, reason, hint } = text;
        Self::Reported { name, reason, hint }
    }
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

/// Whether these bytes begin with a whole frame.
pub(super) fn has_frame(bytes: &[u8]) -> bool {
    let frame = bytes.split_first_chunk();
    frame.is_some_and(|(length, rest)| rest.len() >= u32::from_le_bytes(*length) as usize)
}

/// Reads a frame that has to come.
pub(super) fn expect<T: DeserializeOwned>(from: &mut impl Read) -> io::Result<T> {
    read(from)?.ok_or_else(|| io::ErrorKind::UnexpectedEof.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_whole_with_its_last_byte() {
        let mut bytes = Vec::new();
        write(&mut bytes, &"a frame").expect("memory");
        let whole = bytes.len();
        write(&mut bytes, &"another one").expect("memory");
        for length in 0..=bytes.len() {
            let is_whole = has_frame(&bytes[..length]);
            assert_eq!(is_whole, length >= whole, "{length}");
        }
    }

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
