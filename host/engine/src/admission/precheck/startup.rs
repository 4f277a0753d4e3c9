//! [`Startup`]: the function that wasmtime generates for a core module to initialise its
//! instances: globals, tables, element segments and data segments.
//!
//! It is one function, however many globals and segments there are, so Cranelift takes time
//! that grows with the square of it. What is constant costs nothing here: numbers, and segments
//! at constant places of the module's own tables and memories, which become images that are a
//! part of the compiled code. The conditions are those of `try_static_init` and
//! `try_func_table_init` in `wasmtime-environ` 48.

use super::constant::Constant;
use super::cost::Sizes;

/// Wasmtime makes images of tables with at most that many elements.
const TABLE_IMAGE_ELEMENTS_MAX: u64 = 1 << 20;

/// Bytes of one of them.
const TABLE_IMAGE_ELEMENT_BYTES: u64 = 4;

/// An image of a memory that is smaller than this may be empty for the most part.
const MEMORY_IMAGE_BYTES_MAX: u64 = 16 << 20;

/// An image begins and ends with a page.
const IMAGE_PAGE_BYTES: u64 = 64 << 10;

/// Bytes of code in a function that would do what an operator of a constant expression does.
const OPERATOR_BYTES: u64 = 4;

/// What a module initialises, up to where it is read.
#[derive(Debug, Default)]
pub(super) struct Startup {
    tables: Vec<Table>,
    memories: Vec<Memory>,
    /// Whether an element segment needs code; then all after it do.
    has_dynamic_elements: bool,
    /// Whether a data segment needs code; then all do.
    has_dynamic_data: bool,
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

/// A table of the module; imported ones come first.
#[derive(Clone, Copy, Debug)]
struct Table {
    is_imported: bool,
    elements: u64,
    /// Whether its first elements are no image.
    is_dynamic: bool,
    /// Length of its image, in elements.
    image: u64,
}

/// A memory of the module; imported ones come first.
#[derive(Clone, Copy, Debug)]
struct Memory {
    is_imported: bool,
    bytes: u64,
    /// Of all segments together.
    data_bytes: u64,
    start: u64,
    end: u64,
}

impl Startup {
    /// An imported table.
    pub(super) fn import_table(&mut self) {
        self.tables.push(Table {
            is_imported: true,
            elements: 0,
            is_dynamic: false,
            image: 0,
        });
    }

    /// A table with that many elements, each of which is that expression.
    pub(super) fn table(&mut self, elements: u64, initial: Option<&Constant>) {
        let has_image = elements <= TABLE_IMAGE_ELEMENTS_MAX;
        let is_dynamic = initial.is_some_and(|it| it.function.is_none() || !has_image);
        if let Some(initial) = initial
            && is_dynamic
        {
            self.operators(initial.operators, 1);
        }
        self.tables.push(Table {
            is_imported: false,
            elements,
            is_dynamic,
            image: match initial {
                Some(_) if !is_dynamic => elements,
                _ => 0,
            },
        });
    }

    /// An imported memory.
    pub(super) fn import_memory(&mut self) {
        self.memories.push(Memory::new(true, 0));
    }

    /// A memory with that many bytes.
    pub(super) fn memory(&mut self, bytes: u64) {
        self.memories.push(Memory::new(false, bytes));
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
        if !self.has_dynamic_elements && operators.is_none() {
            let end = offset.number.map(|start| start.saturating_add(elements));
            let table = usize::try_from(table).ok();
            let table = table.and_then(|table| self.tables.get_mut(table));
            if let (Some(table), Some(end)) = (table, end)
                && !table.is_imported
                && !table.is_dynamic
                && end <= table.elements.min(TABLE_IMAGE_ELEMENTS_MAX)
            {
                table.image = table.image.max(end);
                return;
            }
        }
        self.has_dynamic_elements = true;
        self.operators(offset.operators, 1);
        self.operators(operators.unwrap_or(elements), elements);
        // As many checks of bounds.
        self.calls(elements.saturating_mul(3));
        self.sizes.blocks += 2;
    }

    /// An active data segment at that place of a memory.
    pub(super) fn data(&mut self, memory: u32, offset: &Constant, bytes: u64) {
        self.data_segments += 1;
        let end = offset.number.map(|start| start.saturating_add(bytes));
        let memory = usize::try_from(memory).ok();
        let memory = memory.and_then(|memory| self.memories.get_mut(memory));
        match (memory, offset.number, end) {
            (Some(memory), Some(start), Some(end))
                if !memory.is_imported && end <= memory.bytes =>
            {
                if bytes > 0 {
                    memory.data_bytes = memory.data_bytes.saturating_add(bytes);
                    memory.start = memory.start.min(start);
                    memory.end = memory.end.max(end);
                }
            }
            _ => self.has_dynamic_data = true,
        }
    }

    /// What is left to do when the module has ended.
    pub(super) fn finish(&mut self) -> Initialisation {
        let tables: u64 = self.tables.iter().map(|table| table.image).sum();
        let table_bytes = tables.saturating_mul(TABLE_IMAGE_ELEMENT_BYTES);
        let is_sparse = self.memories.iter().any(Memory::is_sparse);
        let (memory_bytes, data) = if self.has_dynamic_data || is_sparse {
            (0, self.data_segments)
        } else {
            let images = self.memories.iter().filter(|memory| memory.data_bytes > 0);
            let images: Vec<u64> = images.map(Memory::image_bytes).collect();
            let number = u64::try_from(images.len()).unwrap_or(u64::MAX);
            (images.iter().sum(), number)
        };
        self.data_code(data);
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

impl Memory {
    const fn new(is_imported: bool, bytes: u64) -> Self {
        Self {
            is_imported,
            bytes,
            data_bytes: 0,
            start: u64::MAX,
            end: 0,
        }
    }

    const fn extent(&self) -> u64 {
        self.end.saturating_sub(self.start)
    }

    /// Whether an image of it would be empty for the most part, and is not made.
    const fn is_sparse(&self) -> bool {
        let extent = self.extent();
        self.data_bytes > 0
            && extent >= self.data_bytes.saturating_mul(2)
            && extent >= MEMORY_IMAGE_BYTES_MAX
    }

    const fn image_bytes(&self) -> u64 {
        self.extent().saturating_add(2 * IMAGE_PAGE_BYTES)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(found.image_bytes, 30 * 4 + 100_010 + 2 * IMAGE_PAGE_BYTES);
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
