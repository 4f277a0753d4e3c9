//! [`Study`]: a contest in hundreds of generated mazes, looked at by family and size,
//! and in mazes of competitions.
//!
//! Minnett's report measures its robot in 100 mazes of each size from 12 to 20.
//! A study does the same with every generator. It is a contest like any other;
//! this file only says which mazes are in it and which of them belong together.

use std::ops::{Range, RangeInclusive};

use super::{Contest, ContestMaze, MatchResult, Tally};
use crate::maze::generate::{GENERATED_DIMENSIONS, GenSpec, Kind};
use crate::maze::{Maze, goal_entrances};
use crate::robot::Digest;
use crate::sim::Ruleset;

/// The seeds of a study's mazes: 100 for each family and size.
///
/// Far from the small numbers that people try robots with. No parameter of a
/// bundled robot may be fixed on a maze of these seeds; a test holds them against
/// the `training.toml` of every robot that has one.
pub const STUDY_SEEDS: RangeInclusive<u64> = 500_001..=500_100;

/// The most competition mazes of each kind in a quick study.
pub const STUDY_QUICK_COMPETITION: usize = 4;

/// The seeds of a quick study, the first of [`STUDY_SEEDS`].
pub const STUDY_QUICK: RangeInclusive<u64> = 500_001..=500_004;

/// Mazes of one family in a study.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// What they are generated from.
    pub spec: GenSpec,
    /// Where they are in [`Contest::mazes`], ordered by dimension.
    pub mazes: Range<usize>,
}

/// Mazes of competitions between people, by the number of entrances to their goal.
///
/// They need not keep the contest rules: many have cells that cannot be reached or a
/// start that is open to the right.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CompetitionMazes {
    /// Where those with one entrance are in [`Contest::mazes`].
    pub single: Range<usize>,
    /// Where those with several entrances are.
    pub several: Range<usize>,
    /// How many were left out because their goal cannot be reached.
    pub unsolvable: usize,
}

/// The families of a study, one for each generator, in all sizes.
///
/// # Panics
///
/// When `seeds` is empty or makes more mazes than a specification may stand for.
pub fn study_families(seeds: RangeInclusive<u64>) -> Vec<GenSpec> {
    let family = |kind| GenSpec::new(kind, GENERATED_DIMENSIONS, seeds.clone());
    let families = Kind::ALL.into_iter().map(family);
    let families = families.collect::<Result<_, _>>();
    families.expect("one to a few thousand seeds")
}

/// What has been played of a contest, with the mazes that belong together.
pub struct Study<'a> {
    /// The contest; mazes outside all groups are no part of the study.
    pub contest: &'a Contest,
    /// Its results.
    pub results: &'a [MatchResult],
    /// The families.
    pub groups: &'a [Group],
}

impl Group {
    /// Generates the mazes of a family and puts them behind those of a contest.
    pub fn append(spec: GenSpec, mazes: &mut Vec<ContestMaze>, rules: &Ruleset) -> Self {
        let begin = mazes.len();
        let generated = spec.expand();
        mazes.extend(generated.map(|(name, maze)| ContestMaze::new(name, maze, rules)));
        let mazes = begin..mazes.len();
        Self { spec, mazes }
    }
}

impl CompetitionMazes {
    /// Sorts mazes by their entrances and puts them behind those of a contest, each
    /// kind in the given order; at most `most` of each kind.
    pub fn append(
        named: impl IntoIterator<Item = (String, Maze)>,
        most: usize,
        mazes: &mut Vec<ContestMaze>,
        rules: &Ruleset,
    ) -> Self {
        let (mut single, mut several, mut unsolvable) = (Vec::new(), Vec::new(), 0);
        for (name, maze) in named {
            let maze = ContestMaze::new(name, maze, rules);
            if maze.floor.is_none() {
                unsolvable += 1;
            } else if goal_entrances(&maze.maze).len() == 1 {
                single.push(maze);
            } else {
                several.push(maze);
            }
        }
        let mut append = |kind: Vec<ContestMaze>| {
            let begin = mazes.len();
            mazes.extend(kind.into_iter().take(most));
            begin..mazes.len()
        };
        Self {
            single: append(single),
            several: append(several),
            unsolvable,
        }
    }
}

impl<'a> Study<'a> {
    /// One digest for some mazes: the digest of theirs, one behind the other.
    pub fn digest(&self, mazes: &Range<usize>) -> Digest {
        let mazes = self.contest.mazes[mazes.clone()].iter();
        let bytes: Vec<u8> = mazes.flat_map(|maze| *maze.digest.as_bytes()).collect();
        Digest::of(&bytes)
    }

    /// The tally of an entrant in some of the groups, and in mazes of one
    /// dimension only if one is given.
    pub fn tally(&self, entrant: usize, groups: &[Group], dimension: Option<u8>) -> Tally {
        let results = self.of_entrant(entrant).filter(|result| {
            let is_inside = groups
                .iter()
                .any(|group| group.mazes.contains(&result.maze));
            let size = self.contest.mazes[result.maze].maze.dimension();
            is_inside && dimension.is_none_or(|dimension| dimension == size)
        });
        Tally::of(self.contest, results)
    }

    /// The results of an entrant in some mazes, in their order.
    pub fn in_mazes(
        &self,
        entrant: usize,
        mazes: &Range<usize>,
    ) -> impl Iterator<Item = &'a MatchResult> + Clone + use<'a> {
        let mazes = mazes.clone();
        let results = self.all_of_entrant(entrant).iter();
        results.filter(move |result| mazes.contains(&result.maze))
    }

    /// The results of an entrant in the mazes of all groups, in their order.
    pub fn of_entrant(
        &self,
        entrant: usize,
    ) -> impl Iterator<Item = &'a MatchResult> + Clone + use<'a> {
        let groups = self.groups;
        self.all_of_entrant(entrant).iter().filter(move |result| {
            let mut groups = groups.iter();
            groups.any(|group| group.mazes.contains(&result.maze))
        })
    }

    fn all_of_entrant(&self, entrant: usize) -> &'a [MatchResult] {
        // Results are in the contest's order, so those of an entrant are together.
        let begin = self.results.partition_point(|it| it.entrant < entrant);
        let end = self.results.partition_point(|it| it.entrant <= entrant);
        &self.results[begin..end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maze::{Cell, Heading, Walls, bundled, format};

    #[test]
    fn competition_mazes_are_sorted_by_entrances() {
        let rules = Ruleset::default();
        let one = format::parse(bundled()[0].text).expect("a maze").maze;
        let maze = |walls| Maze::contest(walls).expect("start and goal fit");
        let mut closed = Walls::open(12);
        for heading in [Heading::Up, Heading::Right] {
            closed.set(Cell::new(0, 0), heading, false);
        }
        let named = [
            ("open", maze(Walls::open(12))),
            ("one", one.clone()),
            ("closed", maze(closed)),
            ("another", one.clone()),
        ];
        let named = named.map(|(name, maze)| (name.to_owned(), maze));
        for (most, expected) in [
            (9, &["official", "one", "another", "open"][..]),
            (1, &["official", "one", "open"]),
        ] {
            let mut mazes = vec![ContestMaze::new("official".into(), one.clone(), &rules)];
            let sets = CompetitionMazes::append(named.clone(), most, &mut mazes, &rules);
            let names: Vec<&str> = mazes.iter().map(|maze| &maze.name[..]).collect();
            assert_eq!(names, expected);
            let several = expected.len() - 1;
            assert_eq!(
                (sets.single, sets.several),
                (1..several, several..several + 1)
            );
            assert_eq!(sets.unsolvable, 1);
        }
    }

    #[test]
    fn a_study_has_a_hundred_mazes_of_each_family_and_size() {
        let families = study_families(STUDY_SEEDS);
        let names: Vec<String> = families.iter().map(GenSpec::to_string).collect();
        assert_eq!(
            names,
            [
                "gen:division:12..=20:500001..=500100",
                "gen:tree,loops=12:12..=20:500001..=500100",
                "gen:braid:12..=20:500001..=500100",
                "gen:stretches:12..=20:500001..=500100",
            ]
        );
        assert!(families.iter().all(|family| family.count() == 500));
        assert!(STUDY_SEEDS.contains(STUDY_QUICK.end()));
    }
}
