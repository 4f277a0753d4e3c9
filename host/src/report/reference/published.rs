//! The figures of the reports, in one place: what they measured, in which maze,
//! and where they say so.
//!
//! A figure belongs to a robot of this repository by the names of the robot and
//! of its setting. Figures for robots that are not in a study are listed there
//! as such, so this table may be ahead of the robots.

use crate::sim::Score;

/// A report that comes with robots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Report {
    /// Lobato 2016.
    Lobato,
    /// Minnett 2016.
    Minnett,
    /// Rai 2017.
    Rai,
}

impl Report {
    /// Author and year.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lobato => "Lobato 2016",
            Self::Minnett => "Minnett 2016",
            Self::Rai => "Rai 2017",
        }
    }
}

/// The score of one robot in the three official mazes.
#[derive(Clone, Copy, Debug)]
pub struct Published {
    /// The bundled robot that stands for it.
    pub robot: &'static str,
    /// The name of its setting; `None` of a robot without settings.
    pub setting: Option<&'static str>,
    /// Which report says so.
    pub report: Report,
    /// Where in the report.
    pub place: &'static str,
    /// Scores in the mazes 01, 02 and 03, in thousandths of a step, as printed.
    pub scores: [u64; 3],
    /// What a difference of more than 10 % comes from, if that is known: text
    /// one or more sentences.
    pub remark: Option<&'static str>,
}

/// All scores in official mazes, in the order of the reports.
pub const PUBLISHED: &[Published] = &[
    Published {
        robot: "count-expansion",
        setting: None,
        report: Report::Lobato,
        place: "section 2.4, second table",
        scores: [44_100, 48_867, 50_500],
        remark: None,
    },
    // Section 1.3, the table of the progressive change in performance.
    minnett("first", "First working version", [26_700, 31_400, 34_567]),
    Published {
        remark: Some(
            "In this stage the report's program computes path costs by going on from whichever \
             reached cell comes last among the keys of a Python dictionary, an order that the \
             report does not give; ours takes the last one row by row. The order decides: the \
             last one column by column gives 32.367 in this maze, the first one row by row \
             35.233.",
        ),
        ..minnett("second-step", "Take second step", [23_633, 34_033, 34_467])
    },
    minnett("optimal-path", "Use optimal path", [21_233, 29_433, 33_267]),
    minnett("simple", "Simplify uncertainties", [20_667, 28_567, 31_767]),
    minnett("final", "Break recursive loops", [20_667, 28_567, 31_767]),
    Published {
        robot: "rai",
        setting: Some("full"),
        report: Report::Rai,
        place: "section 0.10, first table",
        scores: [22_667, 37_333, 40_333],
        remark: Some(
            "The report's figures leave at most 170 steps of run 1 for maze 01 and 280 for \
             maze 02, but visiting every cell of maze 01 takes 304 with dead ends marked; three \
             quarters of the cells are visited after about 170, 280 and 340 steps, so the \
             figures look like those of a capped run.",
        ),
    },
    rai("cap-60", "section 0.11, at 60", [21_633, 35_333, 37_667]),
    rai("cap-70", "section 0.11, at 70", [21_800, 36_500, 38_900]),
    rai("cap-80", "section 0.11, at 80", [23_000, 37_333, 41_067]),
];

const fn minnett(setting: &'static str, place: &'static str, scores: [u64; 3]) -> Published {
    Published {
        robot: "minnett",
        setting: Some(setting),
        report: Report::Minnett,
        place,
        scores,
        remark: None,
    }
}

const fn rai(setting: &'static str, place: &'static str, scores: [u64; 3]) -> Published {
    Published {
        robot: "rai",
        setting: Some(setting),
        report: Report::Rai,
        place,
        scores,
        remark: None,
    }
}

/// Something that a report says of a robot without a figure.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// The bundled robot that stands for it.
    pub robot: &'static str,
    /// The name of its setting.
    pub setting: &'static str,
    /// Which report says so.
    pub report: Report,
    /// Where in the report.
    pub place: &'static str,
    /// What it says: text that continues "the report says that".
    pub says: &'static str,
}

/// All claims without figures.
pub const CLAIMS: &[Claim] = &[
    Claim {
        robot: "lobato",
        setting: "swing-3",
        report: Report::Lobato,
        place: "section 4.2",
        says: "run 2 is the best possible in maze 01, and not in mazes 02 and 03",
    },
    Claim {
        robot: "lobato",
        setting: "arrive",
        report: Report::Lobato,
        place: "section 3.3",
        says: "run 1 is very short, and the score is worse than those of `return` and the key points",
    },
    Claim {
        robot: "lobato",
        setting: "return",
        report: Report::Lobato,
        place: "section 3.3",
        says: "coming back to the start before the reset improves on `arrive`, \
               but less than the key points do",
    },
    Claim {
        robot: "lobato",
        setting: "swing-2",
        report: Report::Lobato,
        place: "section 4.1",
        says: "two key points score slightly better than three",
    },
];

/// Tries of a robot that depends on chance, in maze 01.
#[derive(Clone, Copy, Debug)]
pub struct Tries {
    /// The bundled robot that stands for it; it has no settings.
    pub robot: &'static str,
    /// Which report says so.
    pub report: Report,
    /// Where in the report.
    pub place: &'static str,
    /// How often it was tried.
    pub tries: u32,
    /// How often run 1 reached the goal.
    pub goal_reached: u32,
    /// How often run 2 did.
    pub finished: u32,
    /// The average score of those, in thousandths of a step.
    pub score: u64,
}

/// Lobato's random robot: tries 2, 5 and 6 reached the goal, and 6 finished.
pub const RANDOM_TRIES: Tries = Tries {
    robot: "random",
    report: Report::Lobato,
    place: "section 2.4, first table",
    tries: 6,
    goal_reached: 3,
    finished: 1,
    score: 584_067,
};

/// A robot in generated mazes, which are not published themselves.
#[derive(Clone, Copy, Debug)]
pub struct PublishedStudy {
    /// The bundled robot that stands for it.
    pub robot: &'static str,
    /// The name of its setting.
    pub setting: &'static str,
    /// Which report says so.
    pub report: Report,
    /// Where in the report.
    pub place: &'static str,
    /// How many mazes.
    pub matches: u32,
    /// How many of them it finished.
    pub finished: u32,
    /// How many of these scores are lower than Minnett's lower benchmark.
    pub lower_beaten: u32,
    /// By how much they are on average, in thousandths of a step.
    pub lower_margin: i64,
    /// The same for the upper benchmark.
    pub upper_margin: i64,
    /// What a difference comes from: text of one or more sentences.
    pub remark: &'static str,
}

/// Minnett's final robot in 100 mazes of each size from 12 to 20.
pub const MINNETT_STUDY: PublishedStudy = PublishedStudy {
    robot: "minnett",
    setting: "final",
    report: Report::Minnett,
    place: "sections 1.4.1 and 1.4.2",
    matches: 500,
    finished: 483,
    lower_beaten: 420,
    lower_margin: 2_770,
    upper_margin: 11_530,
    remark: "In 17 mazes the report's robot looped for ever, and its averages leave them out. \
             Ours has a guard that ends such loops and says so in the robot's journal, so what it \
             does without the guard is counted apart. The mazes alone make the share of 500 \
             uncertain by 1.6 percentage points (one standard error). In 10,000 mazes of the kind \
             `stretches` (the seeds 1 to 1000 and 500001 to 501000 of each size) ours beats the \
             lower benchmark in 84.9 %, and without the guard in 85.4 %.",
};

/// Scores of other people's robots in the official mazes, which are not
/// described by the reports and not bundled: the two with the lowest sums that
/// are known. In thousandths of a step.
pub const BEST_ELSEWHERE: [[u64; 3]; 2] = [[19_033, 27_667, 32_600], [20_967, 27_700, 30_667]];

/// An official maze.
#[derive(Clone, Copy, Debug)]
pub struct Official {
    /// The name of its file without the ending.
    pub name: &'static str,
    /// The SHA-256 digest of its identity, lowercase hexadecimal; what the
    /// figures of the reports are compared in must be this maze.
    pub sha256: &'static str,
    /// Its floor under the ruleset `udacity`.
    pub floor: Score,
}

/// The mazes 01, 02 and 03.
pub const OFFICIAL: [Official; 3] = [
    Official {
        name: "test_maze_01",
        sha256: "18e68e7e21b39c2abfc06473a1b189c01920d0e47c269df7a45668b5cb1bf193",
        floor: Score::new(17, 18, 30),
    },
    Official {
        name: "test_maze_02",
        sha256: "3ccea3a8e2357459cd1e9cf16ca6a638e9d3c03d66cc38ea744783fda5b0a1f3",
        floor: Score::new(22, 23, 30),
    },
    Official {
        name: "test_maze_03",
        sha256: "484db3627fac806d8c673bc816ee8b33aa486bf39d74b3d9f823fbcd99bf92c9",
        floor: Score::new(25, 26, 30),
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::robot::bundled::{BundledRobot, find};

    /// A robot that is bundled has the settings that the figures are for: a
    /// renamed one would vanish from the comparison.
    #[test]
    fn figures_are_for_settings_that_exist() {
        let has = |robot: &BundledRobot, setting: Option<&str>| match setting {
            None => robot.variants.is_empty(),
            Some(name) => robot.variants.iter().any(|setting| setting.name == name),
        };
        let figures = PUBLISHED.iter().map(|it| (it.robot, it.setting));
        let claims = CLAIMS.iter().map(|it| (it.robot, Some(it.setting)));
        let others = [
            (RANDOM_TRIES.robot, None),
            (MINNETT_STUDY.robot, Some(MINNETT_STUDY.setting)),
        ];
        let mut seen = 0;
        for (name, setting) in figures.chain(claims).chain(others) {
            if let Some(robot) = find(name) {
                assert!(has(robot, setting), "{name} has no setting {setting:?}");
                seen += 1;
            }
        }
        assert!(seen > 0, "no figure is for a bundled robot");
    }

    /// The tables of the reports print sums of steps that their scores are made of.
    #[test]
    fn scores_are_whole_steps_of_run_2_and_thirtieths() {
        let scores = PUBLISHED.iter().flat_map(|it| it.scores);
        for score in scores.chain(BEST_ELSEWHERE.into_iter().flatten()) {
            let is_thirtieth =
                (0..30).any(|part| Score::new(0, part, 30).thousandths() == score % 1000);
            assert!(is_thirtieth, "{score}");
        }
    }
}
