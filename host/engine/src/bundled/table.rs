//! The bundled robots. Written by `cargo xtask robots`, not by hand.

use super::robot::{BundledRobot, Variant};

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
        sha256: "7f0341b7268bbfbcc09551c6fdb556ae62e9519dda5114ae2436b04f4211e977",
    },
    BundledRobot {
        name: "count-expansion",
        description: "Lobato's count expansion, from the same report as the random walk.",
        variants: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/count-expansion.wasm"),
        sha256: "0195ace5b66e04bca9c0d6ae3732b3ccb9c83bf8ca4f5251a0b6e4d36ac8cea8",
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
        sha256: "195a6adfe261730cb868625b4eff03896b42d46882741335df24776333afaabe",
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
        sha256: "0490901ceb08c353f674bab517500a21d768b8173682cd98b9b68db48b60a77c",
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
        sha256: "4d75f5e98fcfcd297adb82277265911a035d8123dabfdb36790a905a9c523b63",
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
        sha256: "e3e8e23fed8545801719c738976353c38f00431ce9d20c48ad7976a0eada9da3",
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
        sha256: "d7fff5e3425947692487c9398526a1e9191a89474e547377b51f6f542bcdf686",
    },
    BundledRobot {
        name: "random",
        description: "Lobato's random walk, the robot to be beaten.",
        variants: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/random.wasm"),
        sha256: "aabd54c3aff36de0443d871b860407cb997d24092f9d693ff1b6c7418c741636",
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
        sha256: "5269a3cb98a00974603c896106d179a6437685cbb45e0e466e056693d0ddf7a4",
    },
];
