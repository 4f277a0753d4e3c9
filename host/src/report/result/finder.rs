//! [`Finder`]: matches of a contest by the names in a document.
//!
//! Mazes may be in a contest twice under one name, so a name alone does not say which
//! match is meant: it is the first one behind the match before.

use std::collections::HashMap;
use std::hash::Hash;

use super::MatchName;
use crate::contest::{Contest, Pairing};

/// Finds matches in the order of the contest.
pub(super) struct Finder<'a> {
    entrants: HashMap<&'a str, Vec<usize>>,
    mazes: HashMap<&'a str, Vec<usize>>,
    seeds: HashMap<u64, Vec<usize>>,
    /// Robot, maze and seed, as indices, of the match before.
    last: Option<[usize; 3]>,
}

impl<'a> Finder<'a> {
    /// Begins before the first match.
    pub fn new(contest: &'a Contest) -> Self {
        let entrants = contest.entrants.iter().enumerate();
        let admitted = entrants.filter(|(_, entrant)| entrant.admission.is_ok());
        let mazes = contest.mazes.iter().enumerate();
        let seeds = contest.seeds.iter().enumerate();
        Self {
            entrants: places(admitted.map(|(index, it)| (&it.name[..], index))),
            mazes: places(mazes.map(|(index, it)| (&it.name[..], index))),
            seeds: places(seeds.map(|(index, &seed)| (seed, index))),
            last: None,
        }
    }

    /// The first match of that name behind the one before, if there is one.
    pub fn next(&mut self, name: &MatchName) -> Option<Pairing> {
        let entrants = self.entrants.get(&name.robot[..])?;
        let mazes = self.mazes.get(&name.maze[..])?;
        let seeds = self.seeds.get(&name.seed)?;
        let found = first_behind([entrants, mazes, seeds], self.last)?;
        self.last = Some(found);
        let [entrant, maze, _] = found;
        let seed = name.seed;
        Some(Pairing {
            entrant,
            maze,
            seed,
        })
    }
}

/// The indices, ascending, of everything that has the same key.
fn places<K: Eq + Hash>(all: impl Iterator<Item = (K, usize)>) -> HashMap<K, Vec<usize>> {
    let mut places: HashMap<K, Vec<usize>> = HashMap::new();
    for (key, index) in all {
        places.entry(key).or_default().push(index);
    }
    places
}

/// The smallest triple with a number of each list that is larger than `last`, as
/// words are compared. The lists ascend and are not empty.
fn first_behind(lists: [&[usize]; 3], last: Option<[usize; 3]>) -> Option<[usize; 3]> {
    let first = lists.map(|list| list[0]);
    let Some(last) = last else {
        return Some(first);
    };
    // The longest common beginning with `last` gives the smallest triple.
    for common in (0..3).rev() {
        let begins_alike = (0..common).all(|at| lists[at].binary_search(&last[at]).is_ok());
        let list = lists[common];
        let larger = list.get(list.partition_point(|&index| index <= last[common]));
        if let (true, Some(&larger)) = (begins_alike, larger) {
            let mut found = first;
            found[..common].copy_from_slice(&last[..common]);
            found[common] = larger;
            return Some(found);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against a search through all triples.
    #[test]
    fn the_first_triple_behind_is_the_first() {
        let lists: [&[usize]; 5] = [&[0], &[1], &[2], &[0, 2], &[0, 1, 2]];
        let numbers = || (0..27).map(|n| [n / 9, n / 3 % 3, n % 3]);
        for choice in 0..125 {
            let chosen = [choice / 25, choice / 5 % 5, choice % 5].map(|at| lists[at]);
            let fits = |triple: &[usize; 3]| (0..3).all(|at| chosen[at].contains(&triple[at]));
            assert_eq!(first_behind(chosen, None), numbers().find(fits));
            for last in numbers() {
                let expected = numbers().find(|triple| fits(triple) && *triple > last);
                assert_eq!(first_behind(chosen, Some(last)), expected);
            }
        }
    }
}
