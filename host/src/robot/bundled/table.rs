//! The bundled robots. Written by `cargo xtask robots`, not by hand.

use super::{BundledRobot, Setting};

pub(super) const ROBOTS: &[BundledRobot] = &[
    BundledRobot {
        name: "count-expansion",
        description: "Lobato's count expansion, from the same report as the random walk.",
        settings: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/count-expansion.wasm"),
        sha256: "48baf127f9b9411e22348a44015398372bcec33370d730b0ae607a4fe498c44b",
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
        ],
        component: include_bytes!("../../../../example-robots/prebuilt/dfs.wasm"),
        sha256: "84c06887949108976a92862e01b807c72411111474d15fbe1117affd430b2ff2",
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
        sha256: "67df2501a3c61328c04c9241c3fbac32f5b37213c7a766c62ee3f5b45f3b045b",
    },
    BundledRobot {
        name: "random",
        description: "Lobato's random walk, the robot to be beaten.",
        settings: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/random.wasm"),
        sha256: "c4e7a7f3c3029045e1534bbccd08c72edebce08c83be046708ab8ed021be1a61",
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
