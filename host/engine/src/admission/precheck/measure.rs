//! [`Measure`]: what is measured in a file before it is compiled, and [`Measures`]: the
//! values found.

use serde::{Deserialize, Serialize};

use crate::limits::Limits;

/// Nanoseconds in a millisecond, the unit of estimates.
pub(super) const NS_IN_MS: u64 = 1_000_000;

/// Something that a file may have too much of. Each has its limit in
/// [`Limits`], which says what attack it stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Core instances, all components in it instantiated.
    CoreInstances,
    /// Linear memories of all core instances.
    Memories,
    /// Initial bytes of the largest linear memory; what all have together is limited
    /// in the match.
    MemoryBytes,
    /// Tables of all core instances.
    Tables,
    /// Initial elements of the largest table; what all have together is limited in
    /// the match.
    TableElements,
    /// Nested components.
    ComponentDepth,
    /// Items of components, as written in the file.
    ComponentItems,
    /// Items of components, with all components instantiated.
    ExpandedItems,
    /// Values in the types that pass from component to component.
    AdapterValues,
    /// Parts of the types that a component names, with all that they contain.
    TypeParts,
    /// The longest name of an import or export, in bytes.
    NameBytes,
    /// Custom sections in the whole file.
    CustomSections,
    /// The most items of one kind in one core module.
    ModuleItems,
    /// Function types in one core module.
    FunctionTypes,
    /// Functions in the whole file.
    Functions,
    /// Core modules in the whole file.
    Modules,
    /// State that the engine keeps for an instance of one core module, in bytes.
    CoreInstanceBytes,
    /// State that the engine keeps for all instances together, in bytes; at most that.
    ComponentInstanceBytes,
    /// Lowered functions, with all components instantiated.
    LoweredFunctions,
    /// Items of all core modules: imports, exports, globals, tables, memories, segments.
    FileItems,
    /// Function types of all core modules and core module types.
    FileFunctionTypes,
    /// Elements in element segments: in the file, or with all modules instantiated.
    Elements,
    /// Bytes in data segments, with all modules instantiated.
    DataBytes,
    /// Bytes of the images of memories and tables that become a part of the compiled code.
    ImageBytes,
    /// Parts of component types that are gone through, again for each item that has them.
    TypeWork,
    /// Parameters and results of one function or block.
    Values,
    /// The longest constant expression, in bytes.
    ConstBytes,
    /// Locals of one function, with its parameters.
    Locals,
    /// The longest function, in bytes.
    FunctionBytes,
    /// Nested constructs (`block`, `loop`, `if`) in one function.
    Nesting,
    /// Nested loops in one function.
    LoopNesting,
    /// Values on the operand stack at the same time.
    Operands,
    /// Targets of one `br_table`.
    BranchTargets,
    /// Blocks that one function is compiled to.
    Blocks,
    /// Cells of the table "value of a variable in a block" of one function.
    Cells,
    /// Arguments that branches carry in one function.
    Carried,
    /// Estimated memory to compile one function, in MiB.
    FunctionMemory,
    /// Estimated time to compile one function, in milliseconds.
    FunctionWork,
    /// Estimated memory to compile the file, in MiB.
    Memory,
    /// Estimated time to compile the file, in milliseconds.
    Work,
}

/// One row: the measure, how it is called in JSON and in a rejection, its limit.
struct Row {
    measure: Measure,
    name: &'static str,
    what: &'static str,
    max: fn(&Limits) -> u64,
}

/// In the order of [`Measure`]; a test holds that.
const ROWS: [Row; Measure::COUNT] = {
    use Measure as M;
    const fn row(
        measure: Measure,
        name: &'static str,
        what: &'static str,
        max: fn(&Limits) -> u64,
    ) -> Row {
        Row {
            measure,
            name,
            what,
            max,
        }
    }
    [
        row(M::CoreInstances, "core_instances", "core instances", |l| {
            l.admission.core_instances_max.into()
        }),
        row(M::Memories, "memories", "linear memories", |l| {
            l.admission.memories_max.into()
        }),
        row(
            M::MemoryBytes,
            "memory_bytes",
            "bytes of one linear memory at the start",
            |l| l.sandbox.memory_bytes_max,
        ),
        row(M::Tables, "tables", "tables", |l| {
            l.admission.tables_max.into()
        }),
        row(
            M::TableElements,
            "table_elements",
            "elements of one table at the start",
            |l| l.sandbox.table_elements_max,
        ),
        row(
            M::ComponentDepth,
            "component_depth",
            "nested components",
            |l| l.admission.component_depth_max.into(),
        ),
        row(
            M::ComponentItems,
            "component_items",
            "component items",
            |l| l.admission.component_items_max.into(),
        ),
        row(
            M::ExpandedItems,
            "expanded_items",
            "component items after instantiation",
            |l| l.admission.expanded_items_max.into(),
        ),
        row(
            M::AdapterValues,
            "adapter_values",
            "values in the types of lowered functions",
            |l| l.admission.adapter_values_max.into(),
        ),
        row(
            M::TypeParts,
            "type_parts",
            "parts in a component type",
            |l| l.admission.type_parts_max.into(),
        ),
        row(M::NameBytes, "name_bytes", "bytes in a name", |l| {
            l.admission.name_bytes_max.into()
        }),
        row(
            M::CustomSections,
            "custom_sections",
            "custom sections",
            |l| l.admission.custom_sections_max.into(),
        ),
        row(
            M::ModuleItems,
            "module_items",
            "items of one kind in a core module",
            |l| l.admission.module_items_max.into(),
        ),
        row(
            M::FunctionTypes,
            "function_types",
            "function types in a core module",
            |l| l.admission.function_types_max.into(),
        ),
        row(M::Functions, "functions", "functions", |l| {
            l.admission.functions_max.into()
        }),
        row(M::Modules, "modules", "core modules", |l| {
            l.admission.modules_max.into()
        }),
        row(
            M::CoreInstanceBytes,
            "core_instance_bytes",
            "bytes of state of one core instance",
            |l| l.admission.core_instance_bytes_max.into(),
        ),
        row(
            M::ComponentInstanceBytes,
            "component_instance_bytes",
            "bytes of state of all instances",
            |l| l.admission.component_instance_bytes_max.into(),
        ),
        row(
            M::LoweredFunctions,
            "lowered_functions",
            "lowered functions after instantiation",
            |l| l.admission.lowered_functions_max.into(),
        ),
        row(M::FileItems, "file_items", "items of core modules", |l| {
            l.admission.file_items_max.into()
        }),
        row(
            M::FileFunctionTypes,
            "file_function_types",
            "core function types",
            |l| l.admission.file_function_types_max.into(),
        ),
        row(
            M::Elements,
            "elements",
            "elements in element segments",
            |l| l.admission.elements_max.into(),
        ),
        row(
            M::DataBytes,
            "data_bytes",
            "bytes of data segments after instantiation",
            |l| l.admission.data_bytes_max,
        ),
        row(
            M::ImageBytes,
            "image_bytes",
            "bytes of images of memories and tables",
            |l| l.admission.image_bytes_max,
        ),
        row(
            M::TypeWork,
            "type_work",
            "parts of component types to compare",
            |l| l.admission.type_work_max.into(),
        ),
        row(
            M::Values,
            "values",
            "parameters and results of one function or block",
            |l| l.admission.values_max.into(),
        ),
        row(
            M::ConstBytes,
            "const_bytes",
            "bytes in a constant expression",
            |l| l.admission.const_bytes_max.into(),
        ),
        row(M::Locals, "locals", "locals in a function", |l| {
            l.admission.locals_max.into()
        }),
        row(
            M::FunctionBytes,
            "function_bytes",
            "bytes in a function",
            |l| l.admission.function_bytes_max.into(),
        ),
        row(M::Nesting, "nesting", "nested blocks", |l| {
            l.admission.nesting_max.into()
        }),
        row(M::LoopNesting, "loop_nesting", "nested loops", |l| {
            l.admission.loop_nesting_max.into()
        }),
        row(
            M::Operands,
            "operands",
            "values on the operand stack",
            |l| l.admission.operands_max.into(),
        ),
        row(
            M::BranchTargets,
            "branch_targets",
            "targets in a branch table",
            |l| l.admission.branch_targets_max.into(),
        ),
        row(
            M::Blocks,
            "blocks",
            "blocks of control flow in a function",
            |l| l.admission.blocks_max.into(),
        ),
        row(
            M::Cells,
            "cells",
            "variables times blocks in a function",
            |l| l.admission.cells_max,
        ),
        row(
            M::Carried,
            "carried",
            "values carried by the branches of a function",
            |l| l.admission.carried_max.into(),
        ),
        row(
            M::FunctionMemory,
            "function_memory_mib",
            "MiB of estimated memory to compile a function",
            |l| l.admission.function_memory_mib_max.into(),
        ),
        row(
            M::FunctionWork,
            "function_work_ms",
            "ms of estimated time to compile a function",
            |l| l.admission.function_work_ms_max.into(),
        ),
        row(
            M::Memory,
            "memory_mib",
            "MiB of estimated memory to compile the file",
            |l| l.admission.memory_mib_max.into(),
        ),
        row(
            M::Work,
            "work_ms",
            "ms of estimated time to compile the file",
            |l| l.admission.work_ms_max.into(),
        ),
    ]
};

impl Measure {
    const COUNT: usize = Self::Work as usize + 1;

    /// Every measure, in the order of this enum.
    pub fn all() -> impl Iterator<Item = Self> {
        ROWS.iter().map(|row| row.measure)
    }

    const fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// Its name in JSON.
    pub const fn name(self) -> &'static str {
        self.row().name
    }

    /// What it counts, as the words after a number.
    pub const fn what(self) -> &'static str {
        self.row().what
    }

    /// Its limit.
    pub fn max(self, limits: &Limits) -> u64 {
        (self.row().max)(limits)
    }
}

/// The greatest value found of each measure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Measures {
    // Two arrays, because serde knows none longer than 32.
    first: [u64; FIRST],
    rest: [u64; Measure::COUNT - FIRST],
}

const FIRST: usize = 32;

impl Measures {
    /// The greatest value found.
    pub const fn get(&self, measure: Measure) -> u64 {
        let position = measure as usize;
        if position < FIRST {
            self.first[position]
        } else {
            self.rest[position - FIRST]
        }
    }

    pub(super) const fn get_mut(&mut self, measure: Measure) -> &mut u64 {
        let position = measure as usize;
        if position < FIRST {
            &mut self.first[position]
        } else {
            &mut self.rest[position - FIRST]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::place::{FunctionPlace, Place};
    use super::*;

    #[test]
    fn rows_stand_in_the_order_of_the_measures() {
        for (position, row) in ROWS.iter().enumerate() {
            assert_eq!(row.measure as usize, position, "{}", row.name);
        }
        assert_eq!(Measure::all().count(), Measure::COUNT);
    }

    #[test]
    fn places_are_told_from_the_outside_inwards() {
        let mut place = Place::at(12);
        assert_eq!(place.to_string(), "byte 12");
        place.function = Some(FunctionPlace {
            index: 3,
            name: Some("f".into()),
        });
        assert_eq!(place.to_string(), "function 3 `f`, byte 12");
        place.module = Some(1);
        assert_eq!(place.to_string(), "core module 1, function 3 `f`, byte 12");
    }
}
