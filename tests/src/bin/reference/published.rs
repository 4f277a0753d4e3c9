//! The figures of the published reports, and where each report has them.

/// Scores in the official mazes 01, 02 and 03, as printed, in thousandths of a step: the bundled
/// robot, the report and the place in it, the scores. Minnett's are in section 1.3, in the table
/// of the progressive change in performance.
#[rustfmt::skip]
pub const FIGURES: [(&str, &str, [u64; 3]); 10] = [
    ("count-expansion", "Lobato 2016, section 2.4, second table", [44_100, 48_867, 50_500]),
    ("minnett:first", "Minnett 2016, \"First working version\"", [26_700, 31_400, 34_567]),
    ("minnett:second-step", "Minnett 2016, \"Take second step\"", [23_633, 34_033, 34_467]),
    ("minnett:optimal-path", "Minnett 2016, \"Use optimal path\"", [21_233, 29_433, 33_267]),
    ("minnett:simple", "Minnett 2016, \"Simplify uncertainties\"", [20_667, 28_567, 31_767]),
    ("minnett:final", "Minnett 2016, \"Break recursive loops\"", [20_667, 28_567, 31_767]),
    ("rai:full", "Rai 2017, section 0.10, first table", [22_667, 37_333, 40_333]),
    ("rai:cap-60", "Rai 2017, section 0.11, at 60", [21_633, 35_333, 37_667]),
    ("rai:cap-70", "Rai 2017, section 0.11, at 70", [21_800, 36_500, 38_900]),
    ("rai:cap-80", "Rai 2017, section 0.11, at 80", [23_000, 37_333, 41_067]),
];

/// The two lowest sums of scores that others have published. Their robots are not bundled.
pub const BEST_OTHERS: [[u64; 3]; 2] = [[19_033, 27_667, 32_600], [20_967, 27_700, 30_667]];

/// The official mazes: the name, which is that of the file, and the digest.
pub const OFFICIAL: [(&str, &str); 3] = [
    (
        "test_maze_01",
        "18e68e7e21b39c2abfc06473a1b189c01920d0e47c269df7a45668b5cb1bf193",
    ),
    (
        "test_maze_02",
        "3ccea3a8e2357459cd1e9cf16ca6a638e9d3c03d66cc38ea744783fda5b0a1f3",
    ),
    (
        "test_maze_03",
        "484db3627fac806d8c673bc816ee8b33aa486bf39d74b3d9f823fbcd99bf92c9",
    ),
];

/// The benchmarks of the reports, from the hardest to the easiest: a name, and how many steps
/// for each cell they allow beyond the optimal speed run, times [`BENCHMARK_SCALE`].
pub const BENCHMARKS: [(&str, i64); 5] = [
    ("Rai lower, 60\u{a0}%", 3),
    ("Minnett lower", 5),
    ("Minnett upper", 10),
    ("Rai upper, 60\u{a0}%", 15),
    ("Rai upper", 25),
];

/// Makes margins integers: scores are thirtieths of a step, some benchmarks fiftieths.
pub const BENCHMARK_SCALE: i64 = 150;

/// The positions of Minnett's lower and upper benchmark in [`BENCHMARKS`].
pub const MINNETT_BENCHMARKS: [usize; 2] = [1, 2];

/// Minnett's final robot in 500 generated mazes, sections 1.4.1 and 1.4.2: the rows of a table.
pub const MINNETT_ROWS: [(&str, &str); 8] = [
    ("finished", "483 of 500 (96.60 %)"),
    (
        "of these, beats the lower benchmark",
        "420 of 483 (86.96 %)",
    ),
    ("mean margin", "+2.770"),
    ("finished without safeguard", "483 of 500 (96.60 %)"),
    (
        "of these, beats the lower benchmark",
        "420 of 483 (86.96 %)",
    ),
    ("mean margin", "+2.770"),
    (
        "of all mazes, beats the lower benchmark",
        "420 of 500 (84.00 %)",
    ),
    ("mean margin to the upper benchmark", "+11.530"),
];
