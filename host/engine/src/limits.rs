//! [`Limits`]: what a robot may use while it runs, and what its file may hold.

use serde::{Deserialize, Serialize};
use wasmouse_core::game::SandboxLimits;
use wasmouse_core::{Digest, DigestBuilder};

/// Stack of the threads that run robots, in bytes: wasm gets its own limit of it, and wasmtime
/// needs room for itself beyond that.
pub const STACK_BYTES: usize = 8 << 20;

/// Threads that compile one file, on every machine: each takes memory, and a file that is
/// rejected for taking too much must not be accepted where there are fewer cores. The limits of
/// admission were measured with two.
pub const COMPILE_THREADS: usize = 2;

/// Everything that an engine enforces, split by what it can decide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Limits {
    /// What a running robot may use: part of the ruleset, because a verdict can depend on it.
    pub sandbox: SandboxLimits,
    /// What a file may hold to be admitted.
    pub admission: AdmissionLimits,
}

impl Limits {
    /// The default admission limits with these sandbox limits.
    pub fn with_sandbox(sandbox: SandboxLimits) -> Self {
        Self {
            sandbox,
            admission: AdmissionLimits::DEFAULT,
        }
    }
}

/// The limits on a file, which are checked before it plays. They decide whether it is admitted
/// and cannot change a verdict.
///
/// Compiling cannot be interrupted and takes time and memory that grow with the
/// square or the cube of some sizes, so files of a few KB can take minutes and
/// gigabytes. What the engine would refuse to load is refused here too. Each limit is well above what robots in Rust, JavaScript (QuickJS,
/// StarlingMonkey) and Python have been seen to need; `admission/precheck/mod.rs` has the
/// table. Times are of one 2026 x86-64 core.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AdmissionLimits {
    /// Size of the component file, in bytes. Stops files that exhaust the host's memory
    /// before anything is known about them. Default 32 MiB.
    pub component_bytes_max: u64,
    /// WebAssembly text, in bytes. Stops text whose tree in memory is 70 times as large.
    /// Default 4 MiB.
    pub text_bytes_max: u64,
    /// Core instances in one component. Stops small files that instantiate
    /// exponentially. Default 64.
    pub core_instances_max: u32,
    /// Linear memories in one component. Default 8.
    pub memories_max: u32,
    /// Tables in one component. Default 16.
    pub tables_max: u32,
    /// Nested components. Stops deep nesting, for which each compiler
    /// stage keeps its state. Default 100.
    pub component_depth_max: u32,
    /// Items of components in the file: types and what they declare, imports,
    /// exports, instances, aliases, lifted and lowered functions. Stops component
    /// types that are compared with each other again and again. Default 10,000.
    pub component_items_max: u32,
    /// The same items, counted again for every instantiation. Stops components that
    /// instantiate each other exponentially: 2^30 instances in 1 KB.
    /// Default 20,000.
    pub expanded_items_max: u32,
    /// Values in the types of all lowered functions, counted for every
    /// instantiation. Stops the code that is generated to move values between
    /// components. Default 20,000.
    pub adapter_values_max: u32,
    /// Values in the type of one component function, with all that it names.
    /// Stops tuples of tuples of tuples: a million values in 100 bytes.
    /// Default 2,000.
    pub type_parts_max: u32,
    /// A name of an import or export, in bytes. Stops names of megabytes that are
    /// copied into every message. Default 2,000.
    pub name_bytes_max: u32,
    /// Custom sections in the file. Stops walking over millions of empty ones.
    /// Default 200,000.
    pub custom_sections_max: u32,
    /// Items of one kind in a core module: imports, exports, globals, tables,
    /// memories, element and data segments, elements. Stops tables of millions of
    /// entries in the compiled robot. Default 100,000.
    pub module_items_max: u32,
    /// Function types in a core module. Stops the entry that is compiled for each
    /// of them. Default 5,000.
    pub function_types_max: u32,
    /// Functions in the file. Stops a million empty ones: 9 MB, 93 s and 6 GB.
    /// Default 60,000.
    pub functions_max: u32,
    /// Core modules in the file. Stops many small ones, each of which is within the
    /// limits on one module. Default 200.
    pub modules_max: u32,
    /// State that the engine keeps for an instance of one core module, in bytes: for
    /// imports, globals, tables, memories, segments, and functions that escape. It is
    /// also the size of a slot of the engine, which would refuse to load what is
    /// larger. Default 1 MiB.
    pub core_instance_bytes_max: u32,
    /// The same for all instances together, in bytes. Default 2 MiB.
    pub component_instance_bytes_max: u32,
    /// Lowered functions, counted for every instantiation. Stops adapters between
    /// components: 100 KB of file become thousands of generated modules. Default 500.
    pub lowered_functions_max: u32,
    /// Items of all core modules in the file: imports, exports, globals, tables,
    /// memories, segments. Stops many modules that are each just under the limit on
    /// items of one kind. Default 200,000.
    pub file_items_max: u32,
    /// Function types of all core modules in the file, and those that components
    /// declare. Stops many modules that are each just under the limit on function
    /// types of one: 7.6 MB, 49 s and 1.4 GB. Default 10,000.
    pub file_function_types_max: u32,
    /// Elements of element segments, counted for every instantiation. Stops segments
    /// that every match sets up again: 62 instances of a module with 100,000 elements
    /// took 232 ms each. Default 200,000.
    pub elements_max: u32,
    /// Bytes of data segments, counted for every instantiation. Stops copying the same
    /// megabytes into many memories in every match. Default 64 MiB.
    pub data_bytes_max: u64,
    /// Images of memories and tables that become a part of the compiled robot, in
    /// bytes. Stops files of a few KB whose segments lie far apart: 99 KB became
    /// 669 MB. Default 128 MiB.
    pub image_bytes_max: u64,
    /// Parts of component types, counted again for every item whose type has them.
    /// Stops types that are compared or copied again and again: 69 KB took 40 s to
    /// validate. Default 1,000,000.
    pub type_work_max: u32,
    /// Parameters and results together, of a function or block type. Stops calls
    /// and branches that move a thousand values each. Default 200.
    pub values_max: u32,
    /// A constant expression, in bytes. Stops additions by the million where
    /// nothing has fuel. Default 200.
    pub const_bytes_max: u32,
    /// Locals of one function with its parameters. Stops frames that overflow the
    /// stack and the table "locals times blocks". Default 12,000.
    pub locals_max: u32,
    /// Code of one function, in bytes. Stops the parts of a compiler that look at
    /// a whole function. Default 1 MiB.
    pub function_bytes_max: u32,
    /// Nested blocks, loops and ifs. Default 4,000.
    pub nesting_max: u32,
    /// Nested loops. Stops the compile time that grows with the cube of
    /// it: 2,000 loops in 14 KB take 25 s. Default 64.
    pub loop_nesting_max: u32,
    /// Values on the operand stack of one function. Stops live values whose
    /// registers are allocated against each other: 30,000 in 236 KB take 24 s.
    /// Default 500.
    pub operands_max: u32,
    /// Targets of one `br_table`. Default 20,000.
    pub branch_targets_max: u32,
    /// Blocks of control flow that one function is compiled to. Stops compile time
    /// that grows with the square of it: 30,000 indirect calls in 210 KB take 24 s.
    /// Default 40,000.
    pub blocks_max: u32,
    /// Variables times blocks of one function, for each of which the compiler keeps
    /// a cell. Stops 70 KB that take 5 GB. Default 64,000,000.
    pub cells_max: u64,
    /// Values that the branches of one function carry to where paths meet. Stops
    /// walls of `br_table`, whose compile time grows with the square of it: 100
    /// tables of 1,000 targets in 200 KB take 22 s. Default 80,000.
    pub carried_max: u32,
    /// Estimated memory to compile one function, in MiB. Stops functions that are
    /// just under several of the limits above. Default 600.
    pub function_memory_mib_max: u32,
    /// Estimated time to compile one function, in ms. Default 20,000.
    pub function_work_ms_max: u32,
    /// Estimated memory to compile the file, in MiB: what is kept until its end, and what
    /// the two largest functions take, which compile at the same time. Stops files with a
    /// lot of everything that is each just under a limit. Default 1,000.
    pub memory_mib_max: u32,
    /// Estimated time to compile the file, in ms: the sum over its functions. Stops
    /// files with many functions that are each just under a limit. The estimate is
    /// about twice the truth for real robots, and near it for the worst files that are
    /// known, on one thread; workers compile on two. Default 49,000.
    pub work_ms_max: u32,
}

impl AdmissionLimits {
    /// The default limits.
    pub const DEFAULT: Self = Self {
        component_bytes_max: 32 << 20,
        text_bytes_max: 4 << 20,
        core_instances_max: 64,
        memories_max: 8,
        tables_max: 16,
        component_depth_max: 100,
        component_items_max: 10_000,
        expanded_items_max: 20_000,
        adapter_values_max: 20_000,
        type_parts_max: 2_000,
        name_bytes_max: 2_000,
        custom_sections_max: 200_000,
        module_items_max: 100_000,
        function_types_max: 5_000,
        functions_max: 60_000,
        modules_max: 200,
        core_instance_bytes_max: 1 << 20,
        component_instance_bytes_max: 2 << 20,
        lowered_functions_max: 500,
        file_items_max: 200_000,
        file_function_types_max: 10_000,
        elements_max: 200_000,
        data_bytes_max: 64 << 20,
        image_bytes_max: 128 << 20,
        type_work_max: 1_000_000,
        values_max: 200,
        const_bytes_max: 200,
        locals_max: 12_000,
        function_bytes_max: 1 << 20,
        nesting_max: 4_000,
        loop_nesting_max: 64,
        operands_max: 500,
        branch_targets_max: 20_000,
        blocks_max: 40_000,
        cells_max: 64_000_000,
        carried_max: 80_000,
        function_memory_mib_max: 600,
        function_work_ms_max: 20_000,
        memory_mib_max: 1000,
        work_ms_max: 49_000,
    };

    /// Core instances that an admitted component can have: those in the file, and one for every
    /// module that is generated to move values between components. There are at most as many
    /// of them as lowered functions.
    pub const fn instances_max(&self) -> u32 {
        self.core_instances_max
            .saturating_add(self.lowered_functions_max)
    }

    /// The identity of the limits. Canonical encoding `wasmouse.admission.4`
    /// ([`DigestBuilder`]): the fields as numbers, in their order.
    pub fn digest(&self) -> Digest {
        let Self {
            component_bytes_max,
            text_bytes_max,
            core_instances_max,
            memories_max,
            tables_max,
            component_depth_max,
            component_items_max,
            expanded_items_max,
            adapter_values_max,
            type_parts_max,
            name_bytes_max,
            custom_sections_max,
            module_items_max,
            function_types_max,
            functions_max,
            modules_max,
            core_instance_bytes_max,
            component_instance_bytes_max,
            lowered_functions_max,
            file_items_max,
            file_function_types_max,
            elements_max,
            data_bytes_max,
            image_bytes_max,
            type_work_max,
            values_max,
            const_bytes_max,
            locals_max,
            function_bytes_max,
            nesting_max,
            loop_nesting_max,
            operands_max,
            branch_targets_max,
            blocks_max,
            cells_max,
            carried_max,
            function_memory_mib_max,
            function_work_ms_max,
            memory_mib_max,
            work_ms_max,
        } = *self;
        DigestBuilder::new("wasmouse.admission.4")
            .numbers(&[
                component_bytes_max,
                text_bytes_max,
                core_instances_max.into(),
                memories_max.into(),
                tables_max.into(),
                component_depth_max.into(),
                component_items_max.into(),
                expanded_items_max.into(),
                adapter_values_max.into(),
                type_parts_max.into(),
                name_bytes_max.into(),
                custom_sections_max.into(),
                module_items_max.into(),
                function_types_max.into(),
                functions_max.into(),
                modules_max.into(),
                core_instance_bytes_max.into(),
                component_instance_bytes_max.into(),
                lowered_functions_max.into(),
                file_items_max.into(),
                file_function_types_max.into(),
                elements_max.into(),
                data_bytes_max,
                image_bytes_max,
                type_work_max.into(),
                values_max.into(),
                const_bytes_max.into(),
                locals_max.into(),
                function_bytes_max.into(),
                nesting_max.into(),
                loop_nesting_max.into(),
                operands_max.into(),
                branch_targets_max.into(),
                blocks_max.into(),
                cells_max,
                carried_max.into(),
                function_memory_mib_max.into(),
                function_work_ms_max.into(),
                memory_mib_max.into(),
                work_ms_max.into(),
            ])
            .finish()
    }
}

impl Default for AdmissionLimits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_admission_limit_is_part_of_the_identity() {
        let digest = AdmissionLimits::DEFAULT.digest();
        let changed = AdmissionLimits {
            work_ms_max: 1,
            ..AdmissionLimits::DEFAULT
        };
        assert_ne!(changed.digest(), digest);
    }
}
