//! [`Context`]: the size of the state that wasmtime keeps for one core instance.
//!
//! The engine refuses to load a component with a module whose state is larger than a slot of
//! its pool, whether the module is instantiated or not. The layout is that of `VMOffsets` in
//! `wasmtime-environ` 48 with pointers of 8 bytes; a test compares both at the limit. It is
//! restated here because the crate that has it is internal to wasmtime.

use wasmparser::TypeRef;

/// `Instance` of wasmtime and the fields of `VMContext` that every instance has: at least what
/// they take.
const FIXED_BYTES: u64 = 512;

const MEMORY_IMPORT_BYTES: u64 = 24;
const FUNCTION_IMPORT_BYTES: u64 = 32;
const TABLE_IMPORT_BYTES: u64 = 24;
const GLOBAL_IMPORT_BYTES: u64 = 24;
const TAG_IMPORT_BYTES: u64 = 24;
/// A pointer and the definition itself.
const MEMORY_BYTES: u64 = 8 + 16;
const TABLE_BYTES: u64 = 16;
const GLOBAL_BYTES: u64 = 16;
/// A function that something outside of its module can call ("escapes").
const FUNCTION_REFERENCE_BYTES: u64 = 32;
/// A pointer and a length.
const DATA_BYTES: u64 = 8 + 4;

/// What one core module imports and defines, as far as its instances grow with it.
#[derive(Clone, Debug, Default)]
pub(super) struct Context {
    pub(super) imported_functions: u64,
    pub(super) imported_tables: u64,
    pub(super) imported_memories: u64,
    pub(super) imported_globals: u64,
    pub(super) imported_tags: u64,
    pub(super) functions: u64,
    pub(super) tables: u64,
    pub(super) memories: u64,
    pub(super) globals: u64,
    /// Passive data segments, images of memories, and active data segments without an image.
    pub(super) data: u64,
    escaped: Escaped,
}

impl Context {
    /// An import.
    pub(super) const fn import(&mut self, ty: &TypeRef) {
        match ty {
            // A function that was imported has escaped already.
            TypeRef::Func(_) | TypeRef::FuncExact(_) => self.imported_functions += 1,
            TypeRef::Table(_) => self.imported_tables += 1,
            TypeRef::Memory(_) => self.imported_memories += 1,
            TypeRef::Global(_) => self.imported_globals += 1,
            TypeRef::Tag(_) => self.imported_tags += 1,
        }
    }

    /// The function with that index is exported, or a reference to it is made outside of code.
    pub(super) fn escape(&mut self, function: u32) {
        // An index out of range is rejected by validation, not here.
        let defined = u64::from(function).checked_sub(self.imported_functions);
        if defined.is_some_and(|defined| defined < self.functions) {
            self.escaped.insert(function);
        }
    }

    /// The functions that escape, of those that the module defines, in its order.
    pub(super) fn escaped(&self) -> impl Iterator<Item = usize> {
        let imported = usize::try_from(self.imported_functions).unwrap_or(usize::MAX);
        let words = self.escaped.words.iter().enumerate();
        words.flat_map(move |(at, &word)| {
            let set = (0..64).filter(move |bit| word & (1 << bit) != 0);
            set.map(move |bit| at * 64 + bit - imported)
        })
    }

    /// Bytes of an instance, at least.
    pub(super) const fn bytes(&self) -> u64 {
        FIXED_BYTES
            + self.imported_memories * MEMORY_IMPORT_BYTES
            + self.imported_functions * (FUNCTION_IMPORT_BYTES + FUNCTION_REFERENCE_BYTES)
            + self.imported_tables * TABLE_IMPORT_BYTES
            + self.imported_globals * GLOBAL_IMPORT_BYTES
            + self.imported_tags * TAG_IMPORT_BYTES
            + self.memories * MEMORY_BYTES
            + self.tables * TABLE_BYTES
            + self.globals * GLOBAL_BYTES
            + self.escaped.count * FUNCTION_REFERENCE_BYTES
            // The function that initialises the instance.
            + FUNCTION_REFERENCE_BYTES
            + self.data * DATA_BYTES
    }
}

/// A set of functions.
#[derive(Clone, Debug, Default)]
struct Escaped {
    words: Vec<u64>,
    count: u64,
}

impl Escaped {
    fn insert(&mut self, function: u32) {
        let word = usize::try_from(function / 64).expect("usize has at least 32 bits");
        if word >= self.words.len() {
            self.words.resize(word + 1, 0);
        }
        let bit = 1 << (function % 64);
        self.count += u64::from(self.words[word] & bit == 0);
        self.words[word] |= bit;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_escape_once() {
        let mut context = Context {
            functions: 100,
            ..Context::default()
        };
        let before = context.bytes();
        for function in [0, 70, 70, 0, 99, 100, u32::MAX] {
            context.escape(function);
        }
        assert!(context.escaped().eq([0, 70, 99]));
        assert_eq!(context.bytes(), before + 3 * FUNCTION_REFERENCE_BYTES);
    }
}
