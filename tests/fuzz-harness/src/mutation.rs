//! The strategy that makes inputs: a seed with a few edits, or random bytes.
//!
//! The edits are the usual ones of fuzzers: flipped bits, boundary values, pieces removed,
//! repeated, or taken from another seed.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

use super::Input;

/// Edits of one seed, at most. Few, because an input with many is rejected at the first.
const EDITS_MAX: usize = 6;

#[derive(Clone, Debug)]
enum Edit {
    Flip {
        at: Index,
        bit: u32,
    },
    Overwrite {
        at: Index,
        piece: Vec<u8>,
    },
    Replace {
        at: Index,
        length: usize,
        piece: Vec<u8>,
    },
    Remove {
        at: Index,
        length: usize,
    },
    Repeat {
        at: Index,
        length: usize,
    },
    Splice {
        at: Index,
        from: Index,
        length: usize,
    },
    Truncate {
        at: Index,
    },
}

/// Inputs of up to that many bytes.
pub(super) fn inputs(
    seeds: &[Vec<u8>],
    words: &'static [&'static [u8]],
    bytes_max: usize,
) -> BoxedStrategy<Input> {
    if seeds.is_empty() {
        return vec(any::<u8>(), 0..=bytes_max).prop_map(Input).boxed();
    }
    let seed = || select(seeds.to_vec());
    let edits = vec(edit(words), 0..=EDITS_MAX);
    let mutated = (seed(), seed(), edits).prop_map(move |(mut bytes, other, edits)| {
        for edit in edits {
            edit.apply(&mut bytes, &other);
        }
        bytes.truncate(bytes_max);
        Input(bytes)
    });
    let random = vec(any::<u8>(), 0..=bytes_max.min(64)).prop_map(Input);
    prop_oneof![15 => mutated, 1 => random].boxed()
}

fn edit(words: &'static [&'static [u8]]) -> impl Strategy<Value = Edit> {
    let at = any::<Index>;
    let length = || prop_oneof![4 => 1..8_usize, 1 => 1..256_usize];
    prop_oneof![
        2 => (at(), 0..8_u32).prop_map(|(at, bit)| Edit::Flip { at, bit }),
        2 => (at(), piece(words)).prop_map(|(at, piece)| Edit::Overwrite { at, piece }),
        4 => (at(), 0..4_usize, piece(words))
            .prop_map(|(at, length, piece)| Edit::Replace { at, length, piece }),
        2 => (at(), length()).prop_map(|(at, length)| Edit::Remove { at, length }),
        1 => (at(), length()).prop_map(|(at, length)| Edit::Repeat { at, length }),
        1 => (at(), at(), length())
            .prop_map(|(at, from, length)| Edit::Splice { at, from, length }),
        1 => at().prop_map(|at| Edit::Truncate { at }),
    ]
}

/// Bytes, a word, or a number at a boundary in one of the encodings that are read: little
/// endian, LEB128 (WebAssembly, postcard), decimal.
fn piece(words: &'static [&'static [u8]]) -> BoxedStrategy<Vec<u8>> {
    let boundary = (0..=64_u32, -1..=1_i64).prop_map(|(bits, offset)| {
        let power = 1_u64.checked_shl(bits).unwrap_or(0);
        power.wrapping_add_signed(offset)
    });
    let number = (boundary, 0..6_u32).prop_map(|(number, encoding)| match encoding {
        0 => number.to_string().into_bytes(),
        1 => leb128(number),
        bytes => number.to_le_bytes()[..1 << (bytes - 2)].to_vec(),
    });
    let bytes = vec(any::<u8>(), 1..4);
    if words.is_empty() {
        prop_oneof![bytes, number].boxed()
    } else {
        prop_oneof![bytes, number, select(words).prop_map(<[u8]>::to_vec)].boxed()
    }
}

fn leb128(mut number: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    while number > 0x7f {
        bytes.push(number.to_le_bytes()[0] | 0x80);
        number >>= 7;
    }
    bytes.push(number.to_le_bytes()[0]);
    bytes
}

impl Edit {
    fn apply(self, bytes: &mut Vec<u8>, other: &[u8]) {
        let place = |at: Index, bytes: &[u8]| at.index(bytes.len() + 1);
        let range = |at: usize, length: usize, bytes: &[u8]| at..bytes.len().min(at + length);
        match self {
            Self::Flip { at, bit } => {
                let at = place(at, bytes);
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << bit;
                }
            }
            Self::Overwrite { at, piece } => {
                let range = range(place(at, bytes), piece.len(), bytes);
                bytes.splice(range, piece);
            }
            Self::Replace { at, length, piece } => {
                bytes.splice(range(place(at, bytes), length, bytes), piece);
            }
            Self::Remove { at, length } => {
                bytes.drain(range(place(at, bytes), length, bytes));
            }
            Self::Repeat { at, length } => {
                let at = place(at, bytes);
                let piece = bytes[range(at, length, bytes)].to_vec();
                bytes.splice(at..at, piece);
            }
            Self::Splice { at, from, length } => {
                let at = place(at, bytes);
                let piece = other[range(place(from, other), length, other)].to_vec();
                bytes.splice(at..at, piece);
            }
            Self::Truncate { at } => bytes.truncate(place(at, bytes)),
        }
    }
}
