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
        sha256: "fbb608bf933f9276872c2929f03350c6497247707ad8d342cda5b9020d838e31",
    },
    BundledRobot {
        name: "count-expansion",
        description: "Lobato's count expansion, the second benchmark of his report.",
        variants: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/count-expansion.wasm"),
        sha256: "913cf6bae3329fe1ec4268fd96fc4af4b950626f19c5c21ddb4b7ea2cf687d56",
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
        sha256: "a9d9024d32453eec9c18519ce525d521f27e0bc02865ad25bf68ee00c9e449fa",
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
        sha256: "eb792326a906b75f3d6948bfddf25541b25b5ca994a972129475fd745fb8ce2e",
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
        sha256: "249a2aa53d63b13418a21c8df255b9eb2b9d05d54f888bdb7f48f184163a3295",
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
        sha256: "63707be398fcc4a93d6082ae7936477dc65289d1c4f81fb6f22aad29ac18bed3",
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
        sha256: "24f5daa7e3757d97f5e2915cf66cef3d866b0f21aef5d1df280fd17730607813",
    },
    BundledRobot {
        name: "random",
        description: "Lobato's random walk, the first benchmark of his report.",
        variants: &[],
        component: include_bytes!("../../../../example-robots/prebuilt/random.wasm"),
        sha256: "6af2438f7a76a2c0f0f9c08c0dfad86ae9a903065893ba05d04f9a67e3423a9a",
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
        sha256: "de37677dcfc16547fc0493c0f52b59e4c719ef83d6204a48dd551b4cc54088f7",
    },
];
