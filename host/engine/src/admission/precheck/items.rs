//! [`each`]: the items of a section of a component, one at a time.
//!
//! wasmparser validates a section at once. What an item costs to validate depends on the items
//! before it, in the same section too, so each is validated as a section of its own, after what
//! it costs has been compared with the limits.

use wasmparser::{BinaryReader, FromReader, SectionLimited};

use super::super::proposal::FEATURES;
use super::super::rejection::Rejection;

/// Calls `check` for each item of a section with its offset in the file, the item, and a
/// section that has nothing but the item.
///
/// # Errors
///
/// [`Rejection::Invalid`] when an item cannot be read, and what `check` returns.
pub(super) fn each<'a, T: FromReader<'a>>(
    section: &SectionLimited<'a, T>,
    file: &[u8],
    mut check: impl FnMut(u64, T, BinaryReader<'_>) -> Result<(), Rejection>,
) -> Result<(), Rejection> {
    let mut items = section.clone().into_iter();
    let mut alone = Vec::new();
    loop {
        let start = items.original_position();
        let Some(item) = items.next() else {
            return Ok(());
        };
        let item = item?;
        alone.clear();
        // The number of items.
        alone.push(1);
        alone.extend_from_slice(bytes(file, start, items.original_position()));
        // Errors then have the offset of the item in the file.
        let reader = BinaryReader::new_features(&alone, start.saturating_sub(1), FEATURES);
        check(start, item, reader)?;
    }
}

fn bytes(file: &[u8], start: u64, end: u64) -> &[u8] {
    let index = |byte: u64| usize::try_from(byte).unwrap_or(usize::MAX);
    file.get(index(start)..index(end)).unwrap_or_default()
}
