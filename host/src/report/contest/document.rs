//! [`ContestReport`]: what every report of a contest is made from.

use std::collections::{BTreeMap, BTreeSet};

use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::record::EngineId;
use wasmouse_core::{Digest, GuestText};

use super::picture::Pictures;
use super::playable::Playable;
use crate::contest::{Complaint, MazeFilter, PairedComparison, Ranking, ScoreMatrix, Scoring};

/// What a report does not show.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReportOptions {
    /// Show only the robots that are among the first so many, overall or in their class. `None`
    /// shows all.
    pub show_top: Option<u32>,
    /// Call robots by the beginning of their digests, and leave out authors, digests and all text
    /// that could come from a robot.
    pub hide_names: bool,
    /// Leave out the mazes of hidden sets. Their scores count, and are shown as averages.
    pub hide_hidden_mazes: bool,
    /// Since when the standings have been frozen, in the organiser's words; `None` if they are
    /// not. The report is about the matches that it is given in any case.
    pub frozen: Option<String>,
}

/// A ranking over a part of a contest.
#[derive(Clone, Debug)]
pub struct PartRanking {
    /// The name of the set or the class.
    pub name: GuestText,
    /// The ranking.
    pub ranking: Ranking,
}

/// Two robots with neighbouring ranks in the same mazes.
#[derive(Clone, Copy, Debug)]
pub struct Compared {
    /// The one with the better rank, as an index in the matrix.
    pub first: usize,
    /// The other.
    pub second: usize,
    /// How the first did compared with the second.
    pub comparison: PairedComparison,
}

/// The scores of a contest and the rankings that they make.
#[derive(Clone, Debug)]
pub struct ContestReport<'a> {
    /// What the contest is called.
    pub name: &'a str,
    /// The scores.
    pub matrix: &'a ScoreMatrix,
    /// How robots are ranked.
    pub scoring: &'a Scoring,
    /// The engine that played the matches.
    pub engine: &'a EngineId,
    /// How many matches the contest has.
    pub matches_planned: u64,
    /// What is not shown.
    pub options: ReportOptions,
    /// The ranking over all robots and mazes.
    pub overall: Ranking,
    /// By set, in the order of the matrix, if there is more than one.
    pub sets: Vec<PartRanking>,
    /// By class, in the order of their names, if there is any.
    pub classes: Vec<PartRanking>,
    /// The first robots, each with the next one.
    pub comparisons: Vec<Compared>,
    /// What identifies all matches together, such as the digest of the results document.
    pub results_digest: Option<Digest>,
    /// Matches of which the web page shows a picture. Those of hidden robots and mazes are left
    /// out.
    pub pictures: Pictures,
    /// Matches that can be watched in the web page. Those of hidden robots and mazes are left out.
    pub playable: Playable,
    /// What robots wrote when they first failed, by robot and name of the kind of fault.
    pub complaints: BTreeMap<(usize, &'static str), Complaint>,
}

/// Pairs of robots that are compared, at most.
const COMPARISONS_MAX: usize = 5;

impl<'a> ContestReport<'a> {
    /// The report of a contest, without pictures.
    pub fn new(
        name: &'a str,
        matrix: &'a ScoreMatrix,
        scoring: &'a Scoring,
        engine: &'a EngineId,
        matches_planned: u64,
        options: ReportOptions,
    ) -> Self {
        let rank = |filter, class| Ranking::new(matrix, scoring, filter, class);
        let overall = rank(MazeFilter::All, None);
        let sets = matrix
            .sets
            .iter()
            .enumerate()
            .map(|(index, set)| PartRanking {
                name: set.name.as_str().into(),
                ranking: rank(MazeFilter::Set(index), None),
            });
        let sets = if matrix.sets.len() > 1 {
            sets.collect()
        } else {
            Vec::new()
        };
        let classes: BTreeSet<GuestStr<'_>> = matrix
            .robots
            .iter()
            .filter_map(|it| it.class.as_ref().map(GuestStr::from))
            .collect();
        let classes = classes.into_iter().map(|class| PartRanking {
            name: class.into(),
            ranking: rank(MazeFilter::All, Some(class)),
        });
        let ranked = overall.lines.iter().filter(|line| line.rank.is_some());
        let ranked: Vec<usize> = ranked.map(|line| line.robot).collect();
        let pairs = ranked.windows(2).take(COMPARISONS_MAX).map(|pair| {
            let (first, second) = (pair[0], pair[1]);
            Compared {
                first,
                second,
                comparison: PairedComparison::new(
                    matrix,
                    scoring,
                    MazeFilter::All,
                    (first, second),
                ),
            }
        });
        Self {
            name,
            matrix,
            scoring,
            engine,
            matches_planned,
            options,
            sets,
            classes: classes.collect(),
            comparisons: pairs.collect(),
            overall,
            results_digest: None,
            pictures: Pictures::default(),
            playable: Playable::default(),
            complaints: BTreeMap::new(),
        }
    }

    /// Says what identifies all matches together.
    #[must_use]
    pub const fn with_results_digest(mut self, digest: Digest) -> Self {
        self.results_digest = Some(digest);
        self
    }

    /// Adds pictures to the web page.
    #[must_use]
    pub fn with_pictures(mut self, pictures: Pictures) -> Self {
        self.pictures = pictures;
        self
    }

    /// Adds matches that can be watched in the web page.
    #[must_use]
    pub fn with_playable(mut self, playable: Playable) -> Self {
        self.playable = playable;
        self
    }

    /// Adds what robots wrote when they first failed, by robot and name of the kind of fault.
    #[must_use]
    pub fn with_complaints(
        mut self,
        complaints: impl IntoIterator<Item = ((usize, &'static str), Complaint)>,
    ) -> Self {
        self.complaints = complaints.into_iter().collect();
        self
    }
}
