//! [`Grade`]: what a robot earned, criterion by criterion.

use wasmouse_core::{Digest, GuestText};

/// The grade of one robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grade {
    /// What reports call the robot.
    pub robot: GuestText,
    /// The digest of its file; `None` when there was no file to read.
    pub digest: Option<Digest>,
    /// The number that chose its mode.
    pub variant: u32,
    /// Whether it took part.
    pub participation: Participation,
    /// One for each criterion of the rubric, in its order.
    pub criteria: Vec<CriterionGrade>,
    /// Points earned, in thousandths.
    pub points_thousandths: u64,
    /// Points that could be earned.
    pub points_max: u32,
    /// Whether the points reach the mark of the rubric.
    pub is_passed: bool,
    /// Its matches in all mazes of the rubric.
    pub matches: MatchCounts,
    /// Its faults, by kind.
    pub faults: Vec<FaultLine>,
}

/// Whether a robot took part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Participation {
    /// It did.
    Admitted,
    /// There was nothing to grade: why.
    Missing(GuestText),
    /// Its file is rejected.
    Rejected {
        /// A short name: lowercase letters and hyphens.
        kind: GuestText,
        /// Why.
        reason: GuestText,
        /// What to do.
        hint: GuestText,
    },
    /// It took too long and was withdrawn: why. It may have played some matches.
    Withdrawn(GuestText),
    /// The host could not admit it, which says nothing about the robot: why.
    HostFailed(GuestText),
}

/// Matches of a robot, counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MatchCounts {
    /// As many as there are mazes and seeds.
    pub planned: u64,
    /// Those that were played.
    pub played: u64,
    /// Those that were finished.
    pub finished: u64,
    /// Those that ended in a fault.
    pub faults: u64,
}

/// The faults of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FaultLine {
    /// The kind.
    pub kind: &'static str,
    /// How many matches ended so.
    pub count: u64,
    /// The maze of the first of them.
    pub maze: GuestText,
    /// The seed of the first of them.
    pub seed: u64,
    /// What happened in it. May quote text of the robot.
    pub message: GuestText,
}

/// What a criterion came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CriterionGrade {
    /// Whether it is met.
    pub status: Status,
    /// Points earned, in thousandths.
    pub points_thousandths: u64,
    /// What was measured, in thousandths, rounded half to even; `None` when nothing could be.
    pub value_thousandths: Option<i64>,
    /// Matches that count for it.
    pub matches: u64,
    /// More about a value, or why there is none. May quote text of the robot.
    pub reason: Option<GuestText>,
}

/// Whether a criterion is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It is.
    Passed,
    /// It is not, and some of its points are earned.
    Partial,
    /// It is not, and nothing is earned.
    Failed,
    /// That is unknown, for a reason that is not the robot's; nothing is earned.
    Skipped,
}

impl Status {
    /// Its name in results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Partial => "partial",
            Self::Failed => "failed",
            Self::Skipped => "skipped",
        }
    }
}

impl Participation {
    /// Its name in results.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Admitted => "admitted",
            Self::Missing(_) => "missing",
            Self::Rejected { .. } => "rejected",
            Self::Withdrawn(_) => "withdrawn",
            Self::HostFailed(_) => "host-failed",
        }
    }

    /// Why it is what it is; `None` for a robot that took part.
    pub fn reason(&self) -> Option<&GuestText> {
        match self {
            Self::Admitted => None,
            Self::Missing(reason)
            | Self::Rejected { reason, .. }
            | Self::Withdrawn(reason)
            | Self::HostFailed(reason) => Some(reason),
        }
    }
}

impl Grade {
    /// Whether everything that decides it is known.
    pub fn is_complete(&self) -> bool {
        self.criteria.iter().all(|it| it.status != Status::Skipped)
    }
}
