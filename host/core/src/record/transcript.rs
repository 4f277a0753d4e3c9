//! [`Transcript`]: the robot's actions in a match, at about one byte per step.

use crate::Digest;
use crate::game::{Action, FaultKind, Phase};
use crate::guest_text::GuestText;
use crate::maze::Turn;

/// How a match ended.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub enum Ending {
    /// By the rules: in the goal, or with the last step of the budget.
    #[default]
    Rules,
    /// By a fault of the robot.
    Fault {
        /// What happened.
        kind: FaultKind,
        /// The part of the match.
        phase: Phase,
        /// A message for the contestant. It may quote text of the robot.
        detail: GuestText,
    },
}

/// The robot's actions in a match, in order, and how the match ended.
///
/// With the maze and the rules, [`replay`](super::replay) computes the match from it.
///
/// ```
/// use wasmouse_core::game::Action;
/// use wasmouse_core::maze::Turn;
/// use wasmouse_core::record::Transcript;
///
/// let mut transcript = Transcript::default();
/// transcript.push(Action::Move { turn: Turn::Right, advance: 3 });
/// transcript.push(Action::Reset);
/// let bytes = transcript.to_bytes();
/// assert_eq!(bytes, [1, 0, 217, 0]);
/// assert_eq!(Transcript::from_bytes(&bytes), Ok(transcript));
/// ```
///
/// # Encoding
///
/// [`Transcript::to_bytes`] writes, in this order:
///
/// | bytes | meaning |
/// |---|---|
/// | 1 | the version of the encoding, 1 |
/// | 1 | the ending: 0 by the rules, else 1 + the index in [`FaultKind::ALL`] |
/// | 1, 4, n | only for a fault: the index in [`Phase::ALL`], the length n of the detail (little endian), the detail in UTF-8 |
/// | rest | the actions |
///
/// An action is one byte: 0 for a reset, 4 + 84 x turn + (advance + 42) for a move with an
/// advance from -42 to 41 and a turn of 0 left, 1 straight, 2 right. Any other move is two
/// bytes: 1 + turn, then the advance as a signed byte. Each transcript has exactly one encoding.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Transcript {
    /// The actions in their encoding, always valid.
    actions: Vec<u8>,
    ending: Ending,
}

/// Why bytes are not a transcript.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TranscriptError {
    /// The bytes end too early.
    #[error("the transcript is truncated")]
    Truncated,
    /// The version of the encoding is not supported.
    #[error("unsupported transcript version {0}, expected {VERSION}")]
    Version(u8),
    /// A byte has no meaning there.
    #[error("byte {offset} of the transcript is invalid")]
    Invalid {
        /// The position of the byte, counted from 0.
        offset: usize,
    },
}

const VERSION: u8 = 1;

const RESET: u8 = 0;
const LONG_MOVE: u8 = 1;
const FIRST_MOVE: u8 = 4;
const ADVANCE_MIN: i8 = -42;
const ADVANCES: u8 = 84;

const TURNS: [Turn; 3] = [Turn::Left, Turn::Straight, Turn::Right];

impl Transcript {
    /// Resets this to the default, but keeps the memory for the next match.
    pub fn clear(&mut self) {
        self.actions.clear();
        self.ending = Ending::Rules;
    }

    /// Adds an action.
    pub fn push(&mut self, action: Action) {
        match action {
            Action::Reset => self.actions.push(RESET),
            Action::Move { turn, advance } => {
                let turn = turn as u8;
                match short_code(advance) {
                    Some(code) => self.actions.push(FIRST_MOVE + ADVANCES * turn + code),
                    None => {
                        let advance = advance.cast_unsigned();
                        self.actions.extend([LONG_MOVE + turn, advance]);
                    }
                }
            }
        }
    }

    /// Ends the match with a fault.
    pub fn end_with_fault(&mut self, kind: FaultKind, phase: Phase, detail: impl Into<GuestText>) {
        self.ending = Ending::Fault {
            kind,
            phase,
            detail: detail.into(),
        };
    }

    /// The actions, in order.
    pub fn actions(&self) -> impl Iterator<Item = Action> {
        let mut bytes = self.actions.iter().copied();
        std::iter::from_fn(move || {
            let first = bytes.next()?;
            let second = if is_long(first) { bytes.next()? } else { 0 };
            Some(decode(first, second).expect("the actions are valid"))
        })
    }

    /// How the match ended.
    pub const fn ending(&self) -> &Ending {
        &self.ending
    }

    /// The identity of the transcript: the SHA-256 of its encoding.
    pub fn digest(&self) -> Digest {
        Digest::of(&self.to_bytes())
    }

    /// The encoding.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = self.header();
        bytes.extend_from_slice(&self.actions);
        bytes
    }

    /// Decodes the bytes of [`Transcript::to_bytes`].
    ///
    /// # Errors
    ///
    /// If the bytes are not the encoding of a transcript.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, TranscriptError> {
        let mut reader = Reader { bytes, offset: 0 };
        match reader.byte()? {
            VERSION => {}
            other => return Err(TranscriptError::Version(other)),
        }
        let ending = match reader.byte()? {
            0 => Ending::Rules,
            code => {
                let kind = reader.choose(&FaultKind::ALL, code - 1)?;
                let phase = reader.byte()?;
                let phase = reader.choose(&Phase::ALL, phase)?;
                let length = u32::from_le_bytes(*reader.array()?);
                let start = reader.offset;
                let detail = reader.take(usize::try_from(length).unwrap_or(usize::MAX))?;
                let detail = std::str::from_utf8(detail).map_err(|error| {
                    let offset = start + error.valid_up_to();
                    TranscriptError::Invalid { offset }
                })?;
                Ending::Fault {
                    kind,
                    phase,
                    detail: detail.into(),
                }
            }
        };
        let actions = &bytes[reader.offset..];
        while let Ok(first) = reader.byte() {
            let offset = reader.offset - 1;
            let second = if is_long(first) { reader.byte()? } else { 0 };
            decode(first, second).ok_or(TranscriptError::Invalid { offset })?;
        }
        Ok(Self {
            actions: actions.to_vec(),
            ending,
        })
    }

    fn header(&self) -> Vec<u8> {
        match &self.ending {
            Ending::Rules => vec![VERSION, 0],
            Ending::Fault {
                kind,
                phase,
                detail,
            } => {
                let length = u32::try_from(detail.len()).expect("a detail is shorter than 4 GiB");
                let mut bytes = vec![
                    VERSION,
                    1 + position(&FaultKind::ALL, kind),
                    position(&Phase::ALL, phase),
                ];
                bytes.extend(length.to_le_bytes());
                bytes.extend_from_slice(detail.raw().as_bytes());
                bytes
            }
        }
    }
}

fn position<T: PartialEq>(all: &[T], value: &T) -> u8 {
    let position = all.iter().position(|it| it == value);
    let position = position.expect("every value is in the list of all");
    u8::try_from(position).expect("a list of fewer than 255 values")
}

/// The code of an advance that fits in one byte together with its turn.
fn short_code(advance: i8) -> Option<u8> {
    let code = u8::try_from(i16::from(advance) - i16::from(ADVANCE_MIN)).ok()?;
    (code < ADVANCES).then_some(code)
}

const fn is_long(first: u8) -> bool {
    LONG_MOVE <= first && first < FIRST_MOVE
}

/// The action of these bytes; `second` counts only if `first` is that of a long action. `None` if
/// a long action has a short form.
fn decode(first: u8, second: u8) -> Option<Action> {
    match first {
        RESET => Some(Action::Reset),
        LONG_MOVE..FIRST_MOVE => {
            let advance = second.cast_signed();
            let turn = TURNS[usize::from(first - LONG_MOVE)];
            let action = Action::Move { turn, advance };
            short_code(advance).is_none().then_some(action)
        }
        FIRST_MOVE.. => {
            let code = first - FIRST_MOVE;
            Some(Action::Move {
                turn: TURNS[usize::from(code / ADVANCES)],
                advance: (code % ADVANCES).cast_signed() + ADVANCE_MIN,
            })
        }
    }
}

struct Reader<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl<'a> Reader<'a> {
    fn take(&mut self, length: usize) -> Result<&'a [u8], TranscriptError> {
        let rest = &self.bytes[self.offset..];
        let taken = rest.get(..length).ok_or(TranscriptError::Truncated)?;
        self.offset += length;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<&'a [u8; N], TranscriptError> {
        let taken = self.take(N)?;
        Ok(taken.first_chunk().expect("N bytes were taken"))
    }

    fn byte(&mut self) -> Result<u8, TranscriptError> {
        let [byte] = *self.array()?;
        Ok(byte)
    }

    /// The value for `code`, the byte that was read last.
    fn choose<T: Copy>(&self, all: &[T], code: u8) -> Result<T, TranscriptError> {
        let offset = self.offset - 1;
        let chosen = all.get(usize::from(code)).copied();
        chosen.ok_or(TranscriptError::Invalid { offset })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// All actions, in a fixed order.
    fn every_action() -> Vec<Action> {
        let advances = i8::MIN..=i8::MAX;
        let moves = TURNS.into_iter().flat_map(|turn| {
            advances
                .clone()
                .map(move |advance| Action::Move { turn, advance })
        });
        moves.chain([Action::Reset]).collect()
    }

    #[test]
    fn all_actions_round_trip() {
        let mut transcript = Transcript::default();
        for action in every_action() {
            transcript.push(action);
        }
        assert!(transcript.actions().eq(every_action()));
        let bytes = transcript.to_bytes();
        assert_eq!(bytes.len(), 2 + 1 + 3 * 84 + 2 * 3 * (256 - 84));
        assert_eq!(Transcript::from_bytes(&bytes), Ok(transcript.clone()));
        assert_eq!(transcript.digest(), Digest::of(&bytes));
    }

    #[test]
    fn all_faults_round_trip() {
        for kind in FaultKind::ALL {
            for phase in Phase::ALL {
                let mut transcript = Transcript::default();
                transcript.push(Action::Reset);
                transcript.end_with_fault(kind, phase, "d\u{e9}tail".to_owned());
                let bytes = transcript.to_bytes();
                assert_eq!(Transcript::from_bytes(&bytes), Ok(transcript));
                for length in 0..bytes.len() - 1 {
                    let cut = Transcript::from_bytes(&bytes[..length]);
                    assert_eq!(cut, Err(TranscriptError::Truncated), "{length} bytes");
                }
            }
        }
    }

    #[test]
    fn invalid_bytes_are_located() {
        use TranscriptError::{Invalid, Truncated, Version};
        for (bytes, expected) in [
            (&[][..], Truncated),
            (&[2, 0], Version(2)),
            (&[1, 15], Invalid { offset: 1 }),
            (&[1, 1, 4, 0, 0, 0, 0], Invalid { offset: 2 }),
            (&[1, 1, 0, 2, 0, 0, 0, b'a', 0xff], Invalid { offset: 8 }),
            (&[1, 1, 0, 255, 255, 255, 255], Truncated),
            (&[1, 0, 0, 1], Truncated),
            // 3 fits the short form, so the long form is not an encoding of it.
            (&[1, 0, 0, 1, 3], Invalid { offset: 3 }),
        ] {
            assert_eq!(Transcript::from_bytes(bytes), Err(expected), "{bytes:?}");
        }
    }

    proptest! {
        #[test]
        fn decoding_and_encoding_gives_the_same_bytes(bytes: Vec<u8>) {
            for bytes in [bytes.clone(), [&[1, 0][..], &bytes].concat()] {
                if let Ok(transcript) = Transcript::from_bytes(&bytes) {
                    prop_assert_eq!(transcript.to_bytes(), bytes);
                }
            }
        }
    }
}
