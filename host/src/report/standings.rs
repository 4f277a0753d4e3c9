//! Text about the standings of a results document.

use std::collections::BTreeSet;

use wasmouse_core::game::FuelClass;

use super::escape;
use crate::contest::{ContestInfo, Mean, RobotEntry, Standing, Standings};
use crate::report::number::counted;

/// What is shown where there is no value.
pub(super) const NONE: &str = "-";

/// Which mazes the ranking is about, whether it is a partial one, and the fuel class.
pub(super) fn scope(contest: &ContestInfo, standings: &Standings) -> String {
    let mazes = standings.mazes;
    let mut scope = if standings.partial {
        let planned = mazes_planned(contest);
        format!(
            "partial: ranked over {mazes} of {} that every robot has played",
            counted(planned, "maze")
        )
    } else {
        format!("ranked over {}", counted(mazes, "maze"))
    };
    // The usual one goes without saying.
    match contest.rules.fuel_class() {
        Some(FuelClass::Compiled) => {}
        Some(class) => scope.push_str(&format!(", fuel class {}", class.name())),
        None => scope.push_str(", fuel limits of its own"),
    }
    scope
}

/// How many mazes the contest has.
fn mazes_planned(contest: &ContestInfo) -> u64 {
    let admitted = contest.robots.iter().filter(|it| it.is_admitted());
    // The same robot under two names plays once.
    let players: BTreeSet<_> = admitted.map(|it| (it.digest, it.variant)).collect();
    let matches_per_maze = players.len() as u64 * u64::from(contest.seeds.count);
    contest
        .matches_planned
        .checked_div(matches_per_maze)
        .unwrap_or(0)
}

/// The rank of a robot.
pub(super) fn rank(line: &Standing) -> String {
    line.rank
        .map_or_else(|| NONE.to_owned(), |rank| rank.to_string())
}

/// The name of a robot, marked when it played no match; escaped for terminals.
pub(super) fn robot(contest: &ContestInfo, line: &Standing) -> String {
    let name = escape::for_terminal(&line.robot);
    let mut robots = contest.robots.iter();
    // A robot that has played was not the one of its name that was rejected.
    let is_meant = |it: &&RobotEntry| it.name == line.robot && !it.is_admitted();
    match robots.find(is_meant) {
        Some(robot) if line.matches == 0 && robot.rejection.is_some() => {
            format!("{name} (rejected)")
        }
        Some(_) if line.matches == 0 => format!("{name} (not admitted)"),
        _ => name,
    }
}

/// An average in thousandths of a step, in steps with three decimals.
pub(super) fn mean(thousandths: Option<i64>) -> String {
    thousandths.map_or_else(
        || NONE.to_owned(),
        |value| Mean::fraction(value.into(), 1000).to_string(),
    )
}
