//! The bundled robots. Written by `cargo xtask robots`, not by hand.

use super::{BundledRobot, Setting};

pub(super) const ROBOTS: &[BundledRobot] = &[
    BundledRobot {
        name: "count-expansion",
        description: "Lobato's count expansion, from the same report as the random walk.",
        settings: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/count-expansion.wasm"),
        sha256: "0e34e69e5a839ea992bd5755de0fcf46447b07cdc8041ef900bfaa40d5f505b0",
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
        sha256: "c5053bbdb78567f7dab8ab40f5c82aa12e4303fe76f77ee0f4e495e3bdb0cdd0",
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
        sha256: "706b937097ba1fb5a21371160d8585681f2ccd8d0a840b1c95dc23079098c53f",
    },
    BundledRobot {
        name: "random",
        description: "Lobato's random walk, the robot to be beaten.",
        settings: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/random.wasm"),
        sha256: "2a338ee9e2da38a43e56a3a56e4fa35df416d7d5190f4c15e56aa8bd0a6a5a35",
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
        sha256: "2b38f4dd7c18683c6e6197ec4f5e8cdad6110cf3c88f9bca2e9d7238ff6f56a4",
    },
];
