//! [`Images`]: which segments of a core module become images of its memories and tables.
//!
//! An image is a part of the compiled code and costs nothing at instantiation, however large it
//! is; what is no image is copied by code that wasmtime generates. The check before compiling
//! estimates that code and the size of the images, the runtime has a price for what is copied, and
//! both ask here. The conditions are those of `try_static_init` and `try_func_table_init` in
//! `wasmtime-environ` 48.

/// Wasmtime makes images of tables with at most that many elements.
const TABLE_ELEMENTS_MAX: u64 = 1 << 20;

/// An image of a memory that is smaller than this may be empty for the most part; the default of
/// wasmtime's `memory_guaranteed_dense_image_size`.
const SPARSE_BYTES_MAX: u64 = 16 << 20;

/// An image begins and ends with a page, in bytes.
const PAGE_BYTES: u64 = 64 << 10;

/// What a module initialises, up to where it is read: its tables and memories in the order of their
/// indices, then its segments.
#[derive(Debug, Default)]
pub(crate) struct Images {
    tables: Vec<Table>,
    memories: Vec<Memory>,
    /// Whether an element segment is no image; then none after it is.
    has_copied_elements: bool,
    /// Whether a data segment can be in no image; then none is.
    has_copied_data: bool,
}

#[derive(Clone, Copy, Debug)]
struct Table {
    is_imported: bool,
    elements: u64,
    /// Whether its first elements are no image.
    is_copied: bool,
    /// Length of its image, in elements.
    image: u64,
}

#[derive(Clone, Copy, Debug)]
struct Memory {
    is_imported: bool,
    bytes: u64,
    /// Of all segments together.
    data_bytes: u64,
    begin: u64,
    end: u64,
}

impl Images {
    /// An imported table.
    pub(crate) fn import_table(&mut self) {
        self.tables.push(Table {
            is_imported: true,
            elements: 0,
            is_copied: false,
            image: 0,
        });
    }

    /// A table with that many elements, which are given a first value, and perhaps that is one
    /// function. Says whether that value is in the image.
    pub(crate) fn table(&mut self, elements: u64, is_function: Option<bool>) -> bool {
        let has_image = elements <= TABLE_ELEMENTS_MAX;
        let is_copied = is_function.is_some_and(|is_function| !is_function || !has_image);
        self.tables.push(Table {
            is_imported: false,
            elements,
            is_copied,
            image: match is_function {
                Some(_) if !is_copied => elements,
                _ => 0,
            },
        });
        !is_copied
    }

    /// An imported memory.
    pub(crate) fn import_memory(&mut self) {
        self.memories.push(Memory::new(true, 0));
    }

    /// A memory with that many bytes.
    pub(crate) fn memory(&mut self, bytes: u64) {
        self.memories.push(Memory::new(false, bytes));
    }

    /// An active segment of that many elements at that place of a table, where it is known. Says
    /// whether they are in the image.
    pub(crate) fn elements(
        &mut self,
        table: u32,
        offset: Option<u64>,
        elements: u64,
        are_functions: bool,
    ) -> bool {
        if !self.has_copied_elements && are_functions {
            let end = offset.map(|begin| begin.saturating_add(elements));
            let table = usize::try_from(table).ok();
            let table = table.and_then(|table| self.tables.get_mut(table));
            if let (Some(table), Some(end)) = (table, end)
                && !table.is_imported
                && !table.is_copied
                && end <= table.elements.min(TABLE_ELEMENTS_MAX)
            {
                table.image = table.image.max(end);
                return true;
            }
        }
        self.has_copied_elements = true;
        false
    }

    /// An active segment of that many bytes at that place of a memory, where it is known.
    pub(crate) fn data(&mut self, memory: u32, offset: Option<u64>, bytes: u64) {
        let end = offset.map(|begin| begin.saturating_add(bytes));
        let memory = usize::try_from(memory).ok();
        let memory = memory.and_then(|memory| self.memories.get_mut(memory));
        match (memory, offset, end) {
            (Some(memory), Some(begin), Some(end))
                if !memory.is_imported && end <= memory.bytes =>
            {
                if bytes > 0 {
                    memory.data_bytes = memory.data_bytes.saturating_add(bytes);
                    memory.begin = memory.begin.min(begin);
                    memory.end = memory.end.max(end);
                }
            }
            _ => self.has_copied_data = true,
        }
    }

    /// The elements in the images of all tables.
    pub(crate) fn table_elements(&self) -> u64 {
        self.tables.iter().map(|table| table.image).sum()
    }

    /// Whether data is copied, all of it. Only known when all segments are read.
    pub(crate) fn is_data_copied(&self) -> bool {
        self.has_copied_data || self.memories.iter().any(Memory::is_sparse)
    }

    /// The bytes of the image of each memory that has one.
    pub(crate) fn memory_images(&self) -> Vec<u64> {
        if self.is_data_copied() {
            return Vec::new();
        }
        let images = self.memories.iter().filter(|memory| memory.data_bytes > 0);
        images.map(Memory::image_bytes).collect()
    }
}

impl Memory {
    const fn new(is_imported: bool, bytes: u64) -> Self {
        Self {
            is_imported,
            bytes,
            data_bytes: 0,
            begin: u64::MAX,
            end: 0,
        }
    }

    const fn extent(&self) -> u64 {
        self.end.saturating_sub(self.begin)
    }

    /// Whether an image of it would be empty for the most part, and is not made.
    const fn is_sparse(&self) -> bool {
        let extent = self.extent();
        self.data_bytes > 0
            && extent >= self.data_bytes.saturating_mul(2)
            && extent >= SPARSE_BYTES_MAX
    }

    const fn image_bytes(&self) -> u64 {
        self.extent().saturating_add(2 * PAGE_BYTES)
    }
}
