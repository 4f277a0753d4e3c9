//! The bundled robots. Written by `cargo xtask robots`, not by hand.

use super::{BundledRobot, Setting};

pub(super) const ROBOTS: &[BundledRobot] = &[
    BundledRobot {
        name: "champion",
        description: "Learns what kind of maze it is in, and explores only what is likely to pay.",
        settings: &[
            Setting {
                value: 0,
                name: "fast",
                description: "Weighs what a wall may hide against the steps to look at it.",
            },
            Setting {
                value: 1,
                name: "deep",
                description: "Also draws whole mazes that agree with what it saw, and in the goal plays what it could do next to the end in them; takes up to a second.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/champion.wasm"),
        sha256: "997d44a9824bb3340938a86261ac9675979fb6d38ca5df39ce7ba78ea2466ac2",
    },
    BundledRobot {
        name: "count-expansion",
        description: "Lobato's count expansion, from the same report as the random walk.",
        settings: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/count-expansion.wasm"),
        sha256: "7cb1c32e48341ecbd2a35db1010d439e303d9b0fd2d38d04d704856b9a897dda",
    },
    BundledRobot {
        name: "dfs",
        description: "Depth-first search with backtracking, from the sketch-city report.",
        settings: &[
            Setting {
                value: 0,
                name: "everything",
                description: "Explores every cell that it can reach.",
            },
            Setting {
                value: 1,
                name: "reset",
                description: "Resets as soon as it stands in the goal.",
            },
            Setting {
                value: 2,
                name: "pure",
                description: "Explores every cell without backtracking: drives straight to the next branch.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/dfs.wasm"),
        sha256: "ba5ca75ff11f61c05feffc93fc2cf3d9daa553591b192d84af35233c0509eac1",
    },
    BundledRobot {
        name: "flood",
        description: "Always on the shortest path that may still exist.",
        settings: &[
            Setting {
                value: 0,
                name: "reset",
                description: "Resets as soon as it stands in the goal.",
            },
            Setting {
                value: 1,
                name: "certain",
                description: "Explores until the best path is certain, or the budget is short.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/flood.wasm"),
        sha256: "aa4fb2c38acf71ab2ebb565f0034dd61813fec0b4388b151d9186bcef6bf6919",
    },
    BundledRobot {
        name: "lobato",
        description: "Lobato's A* robots: straight to the goal, there and back, the swing over key points.",
        settings: &[
            Setting {
                value: 0,
                name: "swing-3",
                description: "The key-point swing over three corners, the report's final solution.",
            },
            Setting {
                value: 1,
                name: "arrive",
                description: "A* to the goal, then resets.",
            },
            Setting {
                value: 2,
                name: "return",
                description: "A* to the goal and back to the start, then resets.",
            },
            Setting {
                value: 3,
                name: "swing-1",
                description: "The key-point swing with one corner, the upper left one.",
            },
            Setting {
                value: 4,
                name: "swing-2",
                description: "The key-point swing with two corners, upper left and lower right.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/lobato.wasm"),
        sha256: "fa7ed9bdf7dc922337b02098ea6c5506cc25e60a8178b79cab169a3bd76cc0ee",
    },
    BundledRobot {
        name: "minnett",
        description: "Minnett's peaks of uncertainty, in the five stages of his report.",
        settings: &[
            Setting {
                value: 0,
                name: "final",
                description: "His last stage: unscaled uncertainties, and loops are broken.",
            },
            Setting {
                value: 1,
                name: "first",
                description: "His first working version: scaled peaks, one step of each path.",
            },
            Setting {
                value: 2,
                name: "second-step",
                description: "The first version, taking two steps of each path.",
            },
            Setting {
                value: 3,
                name: "optimal-path",
                description: "The second stage with path costs that are right.",
            },
            Setting {
                value: 4,
                name: "simple",
                description: "The third stage with unscaled uncertainties.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/minnett.wasm"),
        sha256: "2e98b938d55c7d43cf929a1ddc8a6e2f8185fdfda839a69c01bfb270ce22cb68",
    },
    BundledRobot {
        name: "rai",
        description: "Rai's planner: where it has been least, dead ends marked, a share of the maze explored.",
        settings: &[
            Setting {
                value: 0,
                name: "cap-60",
                description: "Marks dead ends and explores 60 % of the cells: the report's final solution.",
            },
            Setting {
                value: 1,
                name: "cap-70",
                description: "Marks dead ends and explores 70 % of the cells.",
            },
            Setting {
                value: 2,
                name: "cap-80",
                description: "Marks dead ends and explores 80 % of the cells.",
            },
            Setting {
                value: 3,
                name: "cap-100",
                description: "Marks dead ends and explores every cell.",
            },
            Setting {
                value: 4,
                name: "full",
                description: "The report's first version: no dead ends marked, every cell explored.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/rai.wasm"),
        sha256: "4288fb75b1aaf002000581f2a0627d6dd87342f3cc5b0b15eb561e6cd162d302",
    },
    BundledRobot {
        name: "random",
        description: "Lobato's random walk, the robot to be beaten.",
        settings: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/random.wasm"),
        sha256: "7599ec0a1928f21235b3d00ef840e28548ada8339d90a50a498896891da17334",
    },
    BundledRobot {
        name: "wall-follower",
        description: "Goes straight, else to an open side, else turns around.",
        settings: &[
            Setting {
                value: 0,
                name: "left",
                description: "Prefers left where both sides are open.",
            },
            Setting {
                value: 1,
                name: "right",
                description: "Prefers right where both sides are open.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/wall-follower.wasm"),
        sha256: "692e994b01f09b78abc7607c0a7a48bdba8482226400cfea6e1c376be1036f09",
    },
];
