//! The mazes of a study: official, generated, and of competitions.
//!
//! Official and competition mazes do not come with wasmouse. They are in folders
//! that options name, or in the folder of shared material.

use std::env;
use std::path::{Path, PathBuf};

use super::super::failure::Failure;
use super::super::mazes::{self, Legality};
use crate::contest::{
    CompetitionMazes, ContestMaze, Group, STUDY_QUICK, STUDY_QUICK_COMPETITION, STUDY_SEEDS,
    study_families,
};
use crate::maze::{Maze, bundled as bundled_mazes};
use crate::report::reference::published::OFFICIAL;
use crate::sim::Ruleset;

/// Where mazes are looked for when their option is not given: in these folders of
/// the shared material.
const SHARED_VARIABLE: &str = "WASMOUSE_SHARED";
const SHARED_OFFICIAL: &str = "mazes/udacity";
const SHARED_COMPETITION: &str = "mazes/competition";

#[derive(clap::Args, Debug)]
pub(super) struct MazeArgs {
    /// The folder with test_maze_02.txt and test_maze_03.txt; by default
    /// mazes/udacity in the folder $WASMOUSE_SHARED, if there are any
    #[arg(long, value_name = "FOLDER")]
    official: Option<PathBuf>,
    /// A folder with mazes of competitions; by default mazes/competition in the
    /// folder $WASMOUSE_SHARED, if there are any
    #[arg(long, value_name = "FOLDER")]
    competition: Option<PathBuf>,
    /// Play few mazes: 4 of each size and generator, 4 of each kind of
    /// competition mazes
    #[arg(long)]
    pub(super) quick: bool,
}

/// The mazes of a study and what they are.
pub(super) struct Mazes {
    pub(super) all: Vec<ContestMaze>,
    /// Where the official mazes 01, 02 and 03 are, those that are here.
    pub(super) official: [Option<usize>; 3],
    pub(super) groups: Vec<Group>,
    pub(super) competition: Option<CompetitionMazes>,
}

impl MazeArgs {
    /// Reads and generates the mazes.
    ///
    /// # Errors
    ///
    /// When a folder that is named is absent or a file in it is no maze, and when an
    /// official maze is another one.
    pub(super) fn load(&self, rules: &Ruleset) -> Result<Mazes, Failure> {
        let mut all = Vec::new();
        let official = self.official_mazes(rules, &mut all)?;
        let competition = self.competition_mazes()?;
        let seeds = if self.quick { STUDY_QUICK } else { STUDY_SEEDS };
        let groups = study_families(seeds)
            .into_iter()
            .map(|spec| Group::append(spec, &mut all, rules))
            .collect();
        let most = if self.quick {
            STUDY_QUICK_COMPETITION
        } else {
            usize::MAX
        };
        let competition =
            competition.map(|named| CompetitionMazes::append(named, most, &mut all, rules));
        Ok(Mazes {
            all,
            official,
            groups,
            competition,
        })
    }

    /// Puts the official mazes that are here behind the others and tells where
    /// they are among them.
    fn official_mazes(
        &self,
        rules: &Ruleset,
        mazes: &mut Vec<ContestMaze>,
    ) -> Result<[Option<usize>; 3], Failure> {
        let folder = self.official.clone().or_else(|| shared(SHARED_OFFICIAL));
        let mut places = [None; 3];
        for (place, official) in places.iter_mut().zip(OFFICIAL) {
            let is_bundled = bundled_mazes()
                .iter()
                .any(|maze| maze.name == official.name);
            let spec = match (&folder, is_bundled) {
                (_, true) => official.name.to_owned(),
                (Some(folder), false) => folder
                    .join(official.name)
                    .with_extension("txt")
                    .display()
                    .to_string(),
                (None, false) => continue,
            };
            for named in mazes::load(std::slice::from_ref(&spec), Legality::Contest)? {
                let name = official.name.to_owned();
                let maze = ContestMaze::new(name, named.maze, rules);
                if maze.digest.hex() != official.sha256 {
                    return Err(Failure::input(format!(
                        "`{spec}` is not the official maze of that name: its digest is {}, not sha256:{}",
                        maze.digest, official.sha256
                    )));
                }
                *place = Some(mazes.len());
                mazes.push(maze);
            }
        }
        Ok(places)
    }

    /// The competition mazes by the names of their files, if there are any.
    fn competition_mazes(&self) -> Result<Option<Vec<(String, Maze)>>, Failure> {
        let folder = self.competition.clone();
        let Some(folder) = folder.or_else(|| shared(SHARED_COMPETITION)) else {
            return Ok(None);
        };
        let folder = folder_specification(&folder)?;
        let named = mazes::load(&[folder], Legality::Lenient)?;
        let named = named.into_iter();
        Ok(Some(
            named.map(|it| (file_name(&it.name), it.maze)).collect(),
        ))
    }
}

/// The name of a maze without a folder, which two files of the same name have in it.
fn file_name(name: &str) -> String {
    let file = Path::new(name).file_name();
    file.map_or_else(|| name.to_owned(), |it| it.to_string_lossy().into_owned())
}

/// A folder as a specification of mazes that means nothing else.
fn folder_specification(folder: &Path) -> Result<String, Failure> {
    if !folder.is_dir() {
        return Err(Failure::input(format!(
            "failed to read mazes from `{}`: not a folder",
            folder.display()
        )));
    }
    Ok(Path::new(".").join(folder).display().to_string())
}

/// A folder of the shared material, if it is there.
fn shared(folder: &str) -> Option<PathBuf> {
    let folder = PathBuf::from(env::var_os(SHARED_VARIABLE)?).join(folder);
    folder.is_dir().then_some(folder)
}
