//! [`Startup`]: the function that wasmtime generates for a core module to initialise its
//! instances: globals, tables, element segments and data segments.
//!
//! It is one function, however many globals and segments there are, so Cranelift takes time
//! that grows with the square of it. What is constant costs nothing here: numbers, and segments
//! that become [`Images`].

use super::super::constant::Constant;
use super::super::images::Images;
use super::cost::Sizes;

/// Bytes of an element in the image of a table.
const TABLE_IMAGE_ELEMENT_BYTES: u64 = 4;

/// Bytes of code in a function that would do what an operator of a constant expression does.
const OPERATOR_BYTES: u64 = 4;

/// What a module initialises, up to where it is read.
#[derive(Debug, Default)]
pub(super) struct Startup {
    images: Images,
    data_segments: u64,
    sizes: Sizes,
}

/// How the instances of a module are initialised.
#[derive(Clone, Copy, Debug)]
pub(super) struct Initialisation {
    /// Bytes of all images.
    pub(super) image_bytes: u64,
    /// Images of memories, or active data segments where there are no images.
    pub(super) data: u64,
    /// The function that does the rest.
    pub(super) code: Sizes,
}

impl Startup {
    /// An imported table.
    pub(super) fn import_table(&mut self) {
        self.images.import_table();
    }

    /// A table with that many elements, each of which is that expression.
    pub(super) fn table(&mut self, elements: u64, initial: Option<&Constant>) {
        let is_function = initial.map(|it| it.function.is_some());
        let is_image = self.images.table(elements, is_function);
        if let Some(initial) = initial
            && !is_image
        {
            self.operators(initial.operators, 1);
        }
    }

    /// An imported memory.
    pub(super) fn import_memory(&mut self) {
        self.images.import_memory();
    }

    /// A memory with that many bytes.
    pub(super) fn memory(&mut self, bytes: u64) {
        self.images.memory(bytes);
    }

    /// A global with that value.
    pub(super) fn global(&mut self, value: &Constant) {
        if !value.is_number {
            self.operators(value.operators, 1);
            self.sizes.regions += 1;
        }
    }

    /// A passive element segment, by the operators in its elements.
    pub(super) fn passive_elements(&mut self, elements: u64, operators: u64) {
        self.operators(operators, elements);
        self.calls(1);
    }

    /// An active element segment at that place of a table, by the operators in its elements.
    pub(super) fn elements(
        &mut self,
        table: u32,
        offset: &Constant,
        elements: u64,
        operators: Option<u64>,
    ) {
        let are_functions = operators.is_none();
        let images = &mut self.images;
        if images.elements(table, offset.number, elements, are_functions) {
            return;
        }
        self.operators(offset.operators, 1);
        self.operators(operators.unwrap_or(elements), elements);
        // As many checks of bounds.
        self.calls(elements.saturating_mul(3));
        self.sizes.blocks += 2;
    }

    /// An active data segment at that place of a memory.
    pub(super) fn data(&mut self, memory: u32, offset: &Constant, bytes: u64) {
        self.data_segments += 1;
        self.images.data(memory, offset.number, bytes);
    }

    /// What is left to do when the module has ended.
    pub(super) fn finish(&mut self) -> Initialisation {
        let tables = self.images.table_elements();
        let table_bytes = tables.saturating_mul(TABLE_IMAGE_ELEMENT_BYTES);
        let memories = self.images.memory_images();
        let data = match self.images.is_data_copied() {
            true => self.data_segments,
            false => u64::try_from(memories.len()).unwrap_or(u64::MAX),
        };
        let memory_bytes: u64 = memories.iter().sum();
        self.data_code(data);
        // One branch after the other.
        let sizes = &mut self.sizes;
        sizes.depths = sizes.blocks.saturating_mul(sizes.blocks) / 2;
        sizes.deep_bytes = sizes.blocks.saturating_mul(sizes.bytes) / 2;
        Initialisation {
            image_bytes: table_bytes.saturating_add(memory_bytes),
            data,
            code: self.sizes,
        }
    }

    /// Code that evaluates that many operators and stores that many values.
    const fn operators(&mut self, operators: u64, stores: u64) {
        self.sizes.bytes += (operators + stores) * OPERATOR_BYTES;
        self.sizes.heavy += operators;
        self.sizes.accesses += stores;
    }

    const fn calls(&mut self, calls: u64) {
        self.sizes.bytes += calls * OPERATOR_BYTES;
        self.sizes.heavy += calls;
    }

    /// Code that copies that many data segments.
    const fn data_code(&mut self, segments: u64) {
        self.calls(segments * 2);
        self.sizes.blocks += segments * 4;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What an image has before and after its data.
    const PAGES: u64 = 128 << 10;

    fn number(value: u64) -> Constant {
        Constant {
            operators: 1,
            number: Some(value),
            is_number: true,
            ..Constant::default()
        }
    }

    #[test]
    fn constant_segments_of_own_tables_and_memories_become_images() {
        let mut startup = Startup::default();
        startup.table(100, None);
        startup.memory(1 << 20);
        startup.elements(0, &number(10), 20, None);
        startup.data(0, &number(0), 1);
        startup.data(0, &number(100_000), 10);
        let found = startup.finish();
        assert_eq!(found.image_bytes, 30 * 4 + 100_010 + PAGES);
        assert_eq!((found.code.accesses, found.data), (0, 1));
    }

    #[test]
    fn whatever_is_at_an_imported_place_becomes_code() {
        let mut startup = Startup::default();
        startup.import_table();
        startup.import_memory();
        startup.elements(0, &number(10), 20, None);
        startup.data(0, &number(0), 1);
        let found = startup.finish();
        assert_eq!(found.image_bytes, 0);
        assert_eq!((found.code.accesses, found.code.blocks), (21, 6));
    }

    #[test]
    fn sparse_memories_become_code() {
        let mut startup = Startup::default();
        startup.memory(64 << 20);
        startup.data(0, &number(0), 1);
        startup.data(0, &number(32 << 20), 1);
        let found = startup.finish();
        assert_eq!(
            (found.image_bytes, found.data, found.code.blocks),
            (0, 2, 8)
        );
    }
}
