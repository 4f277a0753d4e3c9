//! The bundled robots. Written by `cargo xtask robots`, not by hand.

use super::{BundledRobot, Setting};

pub(super) const ROBOTS: &[BundledRobot] = &[
    BundledRobot {
        name: "count-expansion",
        description: "Lobato's count expansion, from the same report as the random walk.",
        settings: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/count-expansion.wasm"),
        sha256: "473adcf699c3c20310f25f17ced6df54baabfdf0f15d3eacbab35455261a6e92",
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
        sha256: "68223625e6f220213327e6ec6ccd4096e7b8e3c31e371489a2b59c8d967c7452",
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
        sha256: "c1fc2caa51b40d2d7201acfc9fa37c42f23e7495216917791495d14d091a7766",
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
        sha256: "cc9a36254ee9bb5a02ea77551f9cceba3e574fffe80a9212cfc6c1053b4536d1",
    },
    BundledRobot {
        name: "random",
        description: "Lobato's random walk, the robot to be beaten.",
        settings: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/random.wasm"),
        sha256: "dd6e7dd675ae8e57fe5dd5a22fdac9a0e68fefc625b17747ca4153a135875f66",
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
        sha256: "215b15f13cbffac967d0659149e7f80701f580dc265b6f1592e15894d19a67ff",
    },
];
