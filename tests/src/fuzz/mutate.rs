//! [`Random`] and [`mutate`]: real inputs, changed a little.
//!
//! The changes are those that have proved themselves in other fuzzers ("havoc"): flipped
//! bits, interesting numbers, pieces removed, repeated, moved, or taken from other inputs.

/// A generator of numbers that are always the same: SplitMix64 (Steele, Lea and
/// Flood 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The numbers of that seed.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number.
    pub const fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `end`; 0 when that is 0.
    pub fn below(&mut self, end: usize) -> usize {
        let end = u64::try_from(end.max(1)).unwrap_or(u64::MAX);
        usize::try_from(self.next() % end).unwrap_or(0)
    }

    /// One of them, if there are any.
    pub fn one_of<'a, T>(&mut self, of: &'a [T]) -> Option<&'a T> {
        of.get(self.below(of.len()))
    }
}

/// Numbers at the edges of what formats can hold.
const EDGES: [u64; 14] = [
    0,
    1,
    0x7f,
    0x80,
    0xff,
    0x100,
    0x7fff,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    0x7fff_ffff_ffff_ffff,
    0x8000_0000_0000_0000,
    u64::MAX,
];

/// Changes the input in one to sixteen places; `other` is a second input to take from.
pub fn mutate(
    bytes: &mut Vec<u8>,
    other: &[u8],
    words: &[&[u8]],
    bytes_max: usize,
    random: &mut Random,
) {
    let changes = 1 << random.below(5);
    for _ in 0..1 + random.below(changes) {
        change(bytes, other, words, random);
    }
    bytes.truncate(bytes_max);
}

fn change(bytes: &mut Vec<u8>, other: &[u8], words: &[&[u8]], random: &mut Random) {
    let at = random.below(bytes.len() + 1);
    match random.below(13) {
        0 => flip(bytes, at, random),
        1 => overwrite(bytes, at, &[random.next().to_le_bytes()[0]]),
        2 => overwrite(bytes, at, &edge(random)),
        3 => insert(bytes, at, &edge(random)),
        4 => {
            let number = (random.next() >> random.below(64)).to_string();
            insert(bytes, at, number.as_bytes());
        }
        5 => {
            let piece = piece(bytes, 32, random).len();
            remove(bytes, at, piece);
        }
        6 => {
            let piece = piece(bytes, bytes.len(), random).len();
            remove(bytes, at, piece);
        }
        7 => {
            let piece = piece(bytes, 64, random).to_vec();
            for _ in 0..1 + random.below(4) {
                insert(bytes, at, &piece);
            }
        }
        8 => {
            let piece = piece(bytes, 64, random).to_vec();
            overwrite(bytes, at, &piece);
        }
        9 => insert(bytes, at, piece(other, 256, random)),
        10 => overwrite(bytes, at, piece(other, 256, random)),
        11 => {
            let from = random.below(other.len() + 1);
            bytes.truncate(at);
            bytes.extend_from_slice(&other[from..]);
        }
        _ => match random.one_of(words) {
            Some(word) => insert(bytes, at, word),
            None => flip(bytes, at, random),
        },
    }
}

/// A number at an edge, or close to one, as bytes, as a variable-length number or as
/// digits.
fn edge(random: &mut Random) -> Vec<u8> {
    let edge = random.one_of(&EDGES).copied().unwrap_or_default();
    let number = match random.below(4) {
        0 => edge.wrapping_sub(1),
        1 => edge.wrapping_add(1),
        _ => edge,
    };
    match random.below(6) {
        0 => number.to_string().into_bytes(),
        1 | 2 => variable_length(number),
        bytes => number.to_le_bytes()[..1 << (bytes - 3)].to_vec(),
    }
}

/// The number in LEB128, as WebAssembly and `postcard` write numbers.
pub(super) fn variable_length(mut number: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    loop {
        let low = (number & 0x7f) as u8;
        number >>= 7;
        if number == 0 {
            bytes.push(low);
            return bytes;
        }
        bytes.push(low | 0x80);
    }
}

fn flip(bytes: &mut [u8], at: usize, random: &mut Random) {
    if let Some(byte) = bytes.get_mut(at) {
        *byte ^= 1 << random.below(8);
    }
}

fn overwrite(bytes: &mut Vec<u8>, at: usize, with: &[u8]) {
    let end = bytes.len().min(at + with.len());
    bytes.splice(at..end, with.iter().copied());
}

fn insert(bytes: &mut Vec<u8>, at: usize, piece: &[u8]) {
    bytes.splice(at..at, piece.iter().copied());
}

fn remove(bytes: &mut Vec<u8>, at: usize, length: usize) {
    let end = bytes.len().min(at + length);
    bytes.drain(at..end);
}

fn piece<'a>(bytes: &'a [u8], length_max: usize, random: &mut Random) -> &'a [u8] {
    let from = random.below(bytes.len() + 1);
    let length = random.below(length_max.min(bytes.len() - from) + 1);
    &bytes[from..from + length]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mutation_is_the_same_each_time_and_keeps_the_limit() {
        let mutated = |seed| {
            let mut random = Random::new(seed);
            let mut bytes = b"some bytes to begin with".to_vec();
            for _ in 0..500 {
                mutate(&mut bytes, b"others", &[b"word"], 100, &mut random);
                assert!(bytes.len() <= 100);
            }
            bytes
        };
        assert_eq!(mutated(1), mutated(1));
        assert_ne!(mutated(1), mutated(2));
    }
}
