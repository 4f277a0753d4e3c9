//! The generators of files with the parameters to begin with.

use crate::bombs;

/// Makes files of one kind.
#[derive(Clone, Copy, Debug)]
pub(super) struct Generator {
    pub(super) name: &'static str,
    pub(super) make: fn(&[u32]) -> Vec<u8>,
    /// Parameters of a small file.
    pub(super) start: &'static [u32],
}

/// A generator that is called with its parameters.
macro_rules! generator {
    ($name:ident($($at:literal = $start:literal),+)) => {
        Generator {
            name: stringify!($name),
            make: |parameters| bombs::$name($(parameters[$at]),+),
            start: &[$($start),+],
        }
    };
}

pub(super) const GENERATORS: [Generator; 41] = [
    generator!(nested_loops(0 = 20)),
    generator!(nested_blocks(0 = 500)),
    generator!(locals_and_branches(0 = 300, 1 = 1000)),
    generator!(branch_tables(0 = 10, 1 = 300)),
    generator!(exits(0 = 300, 1 = 10)),
    generator!(held_values(0 = 300, 1 = 10, 2 = 10, 3 = 0)),
    generator!(looped_values(0 = 10, 1 = 300, 2 = 300)),
    // Exits with calls, loops and joins, in four patterns to begin with.
    generator!(woven(0 = 0xb010, 1 = 0x6d8, 2 = 50, 3 = 10, 4 = 5, 5 = 2)),
    generator!(woven(0 = 0x5_0a14, 1 = 0xbf2, 2 = 50, 3 = 8, 4 = 9, 5 = 3)),
    generator!(woven(
        0 = 0x1_7013,
        1 = 0x50cb,
        2 = 40,
        3 = 6,
        4 = 13,
        5 = 1
    )),
    generator!(woven(0 = 0xd_8d9c, 1 = 0xe60, 2 = 30, 3 = 12, 4 = 1, 5 = 8)),
    generator!(typed_blocks(0 = 300, 1 = 3)),
    generator!(indirect_calls(0 = 2000)),
    generator!(stacked_values(0 = 100, 1 = 100)),
    generator!(reused_loads(0 = 50, 1 = 20)),
    generator!(shallow_joins(0 = 300, 1 = 300)),
    generator!(deep_additions(0 = 500, 1 = 500)),
    generator!(late_values(0 = 500, 1 = 8)),
    generator!(empty_functions(0 = 2000)),
    generator!(long_function(0 = 100_000)),
    generator!(wide_calls(0 = 20, 1 = 500)),
    generator!(simd(0 = 5000)),
    generator!(globals(0 = 10_000)),
    generator!(exports(0 = 10_000)),
    generator!(wide_record(0 = 500)),
    generator!(doubled_tuple(0 = 8)),
    generator!(reference_globals(0 = 3000)),
    generator!(written_globals(0 = 3000, 1 = 3000)),
    generator!(passive_elements(0 = 3, 1 = 3000)),
    generator!(placed_elements(0 = 10, 1 = 100)),
    generator!(placed_data(0 = 1000)),
    generator!(escaped_functions(0 = 500, 1 = 20)),
    generator!(function_types(0 = 1, 1 = 1000, 2 = 20)),
    generator!(sparse_memories(0 = 1, 1 = 2)),
    generator!(sparse_tables(0 = 3, 1 = 5, 2 = 10_000)),
    generator!(many_modules(0 = 50)),
    generator!(equal_targets(0 = 10, 1 = 1000, 2 = 10)),
    generator!(compared_instances(0 = 100, 1 = 10, 2 = 5)),
    generator!(exported_instances(0 = 100, 1 = 10, 2 = 5)),
    generator!(resources(0 = 500)),
    generator!(adapters(0 = 30, 1 = 4)),
];
