//! The bundled robots. Written by `cargo xtask robots`, not by hand.

use super::robot::{BundledRobot, Variant};

pub(super) const ROBOTS: &[BundledRobot] = &[
    BundledRobot {
        name: "champion",
        description: "Learns what kind of maze it is in, and explores only what is likely to pay off.",
        variants: &[
            Variant {
                value: 0,
                name: "fast",
                description: "Looks for shorter paths in 12 sampled mazes that agree with what it has seen; takes milliseconds.",
            },
            Variant {
                value: 1,
                name: "deep",
                description: "The same with 64 sampled mazes and more sampling rounds; takes a tenth of a second.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/champion.wasm"),
        sha256: "6de2a44a9c7f9fe190f1c33fabcf20fcf5b8f4f6525fbc37c2f66b2884c2802d",
    },
    BundledRobot {
        name: "count-expansion",
        description: "Lobato's count expansion, the second benchmark of his report.",
        variants: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/count-expansion.wasm"),
        sha256: "2f19f89e9cef1afb5ecfa614b8bced3834ad200d61b7701266638a6adee61cb7",
    },
    BundledRobot {
        name: "dfs",
        description: "Depth-first search with backtracking, from the sketch-city report.",
        variants: &[
            Variant {
                value: 0,
                name: "everything",
                description: "Explores every reachable cell.",
            },
            Variant {
                value: 1,
                name: "reset",
                description: "Resets as soon as it is in the goal.",
            },
            Variant {
                value: 2,
                name: "pure",
                description: "Explores every reachable cell without backtracking: drives to the next branch on the shortest path.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/dfs.wasm"),
        sha256: "742e6d7318e06824306a44b8d5b8bf00a7bad277c82144a991f9984b61cc36e5",
    },
    BundledRobot {
        name: "flood",
        description: "Flood fill, treating unknown walls as open.",
        variants: &[
            Variant {
                value: 0,
                name: "reset",
                description: "Resets as soon as it is in the goal.",
            },
            Variant {
                value: 1,
                name: "certain",
                description: "Explores until the best path is certain, or the remaining budget is just enough for the speed run.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/flood.wasm"),
        sha256: "e8a179b0968b4ac5ed72d8bc026c92577992ad221ddaf2e823d84ad73f96c162",
    },
    BundledRobot {
        name: "lobato",
        description: "Lobato's A* robots: straight to the goal, there and back, and the swing over key points.",
        variants: &[
            Variant {
                value: 0,
                name: "swing-3",
                description: "The key-point swing over three corners, the report's final solution.",
            },
            Variant {
                value: 1,
                name: "arrive",
                description: "A* to the goal, then resets.",
            },
            Variant {
                value: 2,
                name: "return",
                description: "A* to the goal and back to the start, then resets.",
            },
            Variant {
                value: 3,
                name: "swing-1",
                description: "The key-point swing with one corner, the upper left one.",
            },
            Variant {
                value: 4,
                name: "swing-2",
                description: "The key-point swing with two corners, upper left and lower right.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/lobato.wasm"),
        sha256: "f5292a2f840c0c372b9ccf3866e61e39e23ba16af24232e5dd72cf8fde9cffe4",
    },
    BundledRobot {
        name: "minnett",
        description: "Minnett's planner: drives to the most uncertain cells, in the five stages of his report.",
        variants: &[
            Variant {
                value: 0,
                name: "final",
                description: "The last stage: unscaled uncertainties, and loops are broken.",
            },
            Variant {
                value: 1,
                name: "first",
                description: "The first working version: scaled uncertainties, one step of each path.",
            },
            Variant {
                value: 2,
                name: "second-step",
                description: "The first version, taking two steps of each path.",
            },
            Variant {
                value: 3,
                name: "optimal-path",
                description: "The second stage with correct path costs.",
            },
            Variant {
                value: 4,
                name: "simple",
                description: "The third stage with unscaled uncertainties.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/minnett.wasm"),
        sha256: "941a89b597eb4718da4cedabfc406ff1854953d6bbef262ae5f86344c68cc668",
    },
    BundledRobot {
        name: "rai",
        description: "Rai's planner: least-visited cells first, marking dead ends, until a share of the maze is explored.",
        variants: &[
            Variant {
                value: 0,
                name: "cap-60",
                description: "Marks dead ends and explores 60 % of the cells: the report's final solution.",
            },
            Variant {
                value: 1,
                name: "cap-70",
                description: "Marks dead ends and explores 70 % of the cells.",
            },
            Variant {
                value: 2,
                name: "cap-80",
                description: "Marks dead ends and explores 80 % of the cells.",
            },
            Variant {
                value: 3,
                name: "cap-100",
                description: "Marks dead ends and explores every cell.",
            },
            Variant {
                value: 4,
                name: "full",
                description: "The report's first version: no dead ends marked, every cell explored.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/rai.wasm"),
        sha256: "cc02728a45f6803205e5ee46d1560a261bfd3dcaa7ede8ecb4d18f86fd6207e2",
    },
    BundledRobot {
        name: "random",
        description: "Lobato's random walk, the first benchmark of his report.",
        variants: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/random.wasm"),
        sha256: "72b055b75ec022e37795f70b891cd807c487a99a2cd9dc176f935e0982031cb5",
    },
    BundledRobot {
        name: "wall-follower",
        description: "Goes straight, otherwise to an open side, otherwise turns around.",
        variants: &[
            Variant {
                value: 0,
                name: "left",
                description: "Prefers left where both sides are open.",
            },
            Variant {
                value: 1,
                name: "right",
                description: "Prefers right where both sides are open.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/wall-follower.wasm"),
        sha256: "16e640030e44dd370a5ec31a894b7213f7d55fcbc9aa97a398988fe6a8946804",
    },
];
