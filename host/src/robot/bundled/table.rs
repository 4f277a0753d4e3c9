//! The bundled robots. Written by `cargo xtask robots`, not by hand.

use super::{BundledRobot, Variant};

pub(super) const ROBOTS: &[BundledRobot] = &[
    BundledRobot {
        name: "champion",
        description: "Learns what kind of maze it is in, and explores only what is likely to pay.",
        variants: &[
            Variant {
                value: 0,
                name: "fast",
                description: "Looks for shorter ways in 12 mazes that agree with what it saw, drawn anew after every step; takes milliseconds.",
            },
            Variant {
                value: 1,
                name: "deep",
                description: "The same with 64 mazes, drawn with more care; takes a tenth of a second.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/champion.wasm"),
        sha256: "56bab6c5ecfed1dc0ac25897aee46105d68d3af0c21501e5ddb01087c098753f",
    },
    BundledRobot {
        name: "count-expansion",
        description: "Lobato's count expansion, from the same report as the random walk.",
        variants: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/count-expansion.wasm"),
        sha256: "d763b3e8c9d8480e6ecf3df7ecafd23d1e09f5f9867830e5b3ddf4851685d643",
    },
    BundledRobot {
        name: "dfs",
        description: "Depth-first search with backtracking, from the sketch-city report.",
        variants: &[
            Variant {
                value: 0,
                name: "everything",
                description: "Explores every cell that it can reach.",
            },
            Variant {
                value: 1,
                name: "reset",
                description: "Resets as soon as it stands in the goal.",
            },
            Variant {
                value: 2,
                name: "pure",
                description: "Explores every cell without backtracking: drives straight to the next branch.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/dfs.wasm"),
        sha256: "6552f714b2b2243ab5d7376b87c96655504cdacf4847895bffbb70f7d7949917",
    },
    BundledRobot {
        name: "flood",
        description: "Always on the shortest path that may still exist.",
        variants: &[
            Variant {
                value: 0,
                name: "reset",
                description: "Resets as soon as it stands in the goal.",
            },
            Variant {
                value: 1,
                name: "certain",
                description: "Explores until the best path is certain, or the budget is short.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/flood.wasm"),
        sha256: "394cfea93da089603d5ec63c23c1d6b1c38f42ce6976ec02093d0decfc9e327a",
    },
    BundledRobot {
        name: "lobato",
        description: "Lobato's A* robots: straight to the goal, there and back, the swing over key points.",
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
        sha256: "4dcf73e56a59cfd5fefbcfa0315b346c3b0cba7f17c29f91eab99fbc1b667cfd",
    },
    BundledRobot {
        name: "minnett",
        description: "Minnett's peaks of uncertainty, in the five stages of his report.",
        variants: &[
            Variant {
                value: 0,
                name: "final",
                description: "His last stage: unscaled uncertainties, and loops are broken.",
            },
            Variant {
                value: 1,
                name: "first",
                description: "His first working version: scaled peaks, one step of each path.",
            },
            Variant {
                value: 2,
                name: "second-step",
                description: "The first version, taking two steps of each path.",
            },
            Variant {
                value: 3,
                name: "optimal-path",
                description: "The second stage with path costs that are right.",
            },
            Variant {
                value: 4,
                name: "simple",
                description: "The third stage with unscaled uncertainties.",
            },
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/minnett.wasm"),
        sha256: "e3183f80f71ad88a873257df05018e93e34f1e0552d4766ac3f53682bb4dc590",
    },
    BundledRobot {
        name: "rai",
        description: "Rai's planner: where it has been least, dead ends marked, a share of the maze explored.",
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
        sha256: "94b1762b7e7a1c5bff785c54f4d7fadbf8fbd8bf2fd51411230cb115eb0b20b9",
    },
    BundledRobot {
        name: "random",
        description: "Lobato's random walk, the robot to be beaten.",
        variants: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/random.wasm"),
        sha256: "290072b738aee7e80c743241ad00583e38883d9f7f2f48f001f64d53fbb1cb0a",
    },
    BundledRobot {
        name: "wall-follower",
        description: "Goes straight, else to an open side, else turns around.",
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
        sha256: "390792456e61d2306cd7aab7d5c1ef18bc78d7b6286e8889c38e097b61258be5",
    },
];
