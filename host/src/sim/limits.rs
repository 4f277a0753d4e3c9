//! Every limit on what a robot can use, each with the attack that it stops.
//!
//! Plain numbers: the simulation itself needs none of them, the `robot` stage
//! enforces them all. They are part of the ruleset, because a verdict depends
//! on them.

use serde::{Deserialize, Serialize};

/// The limits of one match, and of the admission to it.
///
/// The defaults are wide enough for interpreted languages (a Python or
/// JavaScript robot takes 20,000 to 100,000 units of fuel for a simple step, a
/// compiled one about 70) and still end an endless loop within seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Limits {
    /// Size of the component file, in bytes. Stops files that exhaust the
    /// host's memory before anything is known about them. Default 32 MiB.
    pub component_bytes_max: u64,
    /// Fuel for instantiation (start functions, data segments), and again for
    /// the call of `start`. Stops endless loops before the first step.
    /// Default 2,000,000,000.
    pub start_fuel_max: u64,
    /// Fuel for one call of `next-move`. Stops endless loops in a step.
    /// Default 2,000,000,000.
    pub step_fuel_max: u64,
    /// Fuel for `start` and all steps of a match together. Stops robots that
    /// stay just under the step limit a thousand times. Default 20,000,000,000.
    pub match_fuel_max: u64,
    /// Linear memory of all instances of a match together, in bytes. Stops
    /// `memory.grow`, and many memories that are each just under a per-memory
    /// cap. Default 256 MiB.
    pub memory_bytes_max: u64,
    /// Table elements of all instances of a match together. Stops
    /// `table.grow`. Default 100,000.
    pub table_elements_max: u64,
    /// Wasm call stack, in bytes. Stops unbounded recursion. Default 512 KiB.
    pub stack_bytes_max: u64,
    /// Core instances in one component. Stops small files that instantiate
    /// exponentially. Default 64.
    pub core_instances_max: u32,
    /// Linear memories in one component. Default 8.
    pub memories_max: u32,
    /// Tables in one component. Default 16.
    pub tables_max: u32,
    /// Journal of a match, in bytes: 16 for each entry plus the length of its
    /// text. Stops robots that fill the host's memory with log lines. Later
    /// entries are dropped and counted. Default 1 MiB.
    pub journal_bytes_max: u64,
    /// Bytes that one call into the host may copy out of the robot. Stops a
    /// log line of gigabytes. Default 64 KiB.
    pub host_call_bytes_max: u64,
    /// What a file may hold to be compiled at all.
    pub admission: AdmissionLimits,
}

/// The limits on a file that are checked before anything of it is compiled.
///
/// Compiling cannot be interrupted and takes time and memory that grow with the
/// square or the cube of some sizes, so files of a few KB can take minutes and
/// gigabytes. Each limit is well above what robots in Rust, JavaScript (QuickJS,
/// StarlingMonkey) and Python have been seen to need; the table is in the
/// documentation of `robot::precheck`. Times are of one 2026 x86-64 core.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct AdmissionLimits {
    /// Components inside each other. Stops deep nesting, for which each compiler
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
    /// Blocks, loops and ifs inside each other. Default 4,000.
    pub nesting_max: u32,
    /// Loops inside each other. Stops the compile time that grows with the cube of
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
    /// Estimated time to compile the file, in ms: the sum over its functions. Stops
    /// files with many functions that are each just under a limit. The estimate is
    /// an upper bound and about twice the truth for real robots. Default 65,000.
    pub work_ms_max: u32,
}

impl AdmissionLimits {
    /// The default limits.
    pub const DEFAULT: Self = Self {
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
        work_ms_max: 65_000,
    };
}

impl Default for AdmissionLimits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            component_bytes_max: 32 << 20,
            start_fuel_max: 2_000_000_000,
            step_fuel_max: 2_000_000_000,
            match_fuel_max: 20_000_000_000,
            memory_bytes_max: 256 << 20,
            table_elements_max: 100_000,
            stack_bytes_max: 512 << 10,
            core_instances_max: 64,
            memories_max: 8,
            tables_max: 16,
            journal_bytes_max: 1 << 20,
            host_call_bytes_max: 64 << 10,
            admission: AdmissionLimits::DEFAULT,
        }
    }
}
