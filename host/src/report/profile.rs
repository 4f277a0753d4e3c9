//! Profiles: the fuel of a match by function, as a table, for [speedscope], and as folded stacks.
//!
//! [speedscope]: https://www.speedscope.app

use std::fmt::Write as _;

use serde::Serialize;
use wasmouse_core::guest_text::GuestStr;
use wasmouse_core::{GuestText, guest_text};
use wasmouse_engine::{Profile, ProfileNode};

use super::escape::for_terminal;
use super::json::line;
use super::number::grouped;

/// Columns of the table, at most.
const WIDTH: usize = 80;

/// Columns before the name of a function.
const BEFORE: usize = 49;

/// What a profile is about.
#[derive(Clone, Debug)]
pub struct ProfiledMatch<'a> {
    /// The robot's name.
    pub robot: GuestStr<'a>,
    /// The maze's name.
    pub maze: GuestStr<'a>,
    /// The seed.
    pub seed: u64,
    /// How the match ended, in words.
    pub verdict: &'a str,
    /// Steps of the match.
    pub steps: u64,
    /// The profile.
    pub profile: &'a Profile,
}

impl ProfiledMatch<'_> {
    fn title(&self) -> GuestText {
        guest_text!("{} in {}, seed {}", self.robot, self.maze, self.seed)
    }

    /// The functions that used most fuel themselves, at most so many, as a table of 80 columns. Ends
    /// with a newline.
    pub fn table(&self, functions: usize) -> String {
        let fuel = self.profile.fuel();
        let steps = match self.steps {
            1 => "1 step".to_owned(),
            steps => format!("{} steps", grouped(steps)),
        };
        let mut text = format!(
            "{}: {}, {} fuel in `start` and {}\n\n",
            for_terminal(&self.title()),
            self.verdict,
            grouped(fuel),
            steps
        );
        text.push_str("   Own fuel         Total fuel             Calls  Function\n");
        text.push_str(&"-".repeat(WIDTH));
        text.push('\n');
        let mut costs: Vec<_> = self.profile.costs().into_iter().enumerate().collect();
        costs.sort_by_key(|(at, cost)| (std::cmp::Reverse((cost.own, cost.total)), *at));
        for (at, cost) in costs.iter().take(functions) {
            let name = for_terminal(&self.profile.functions[*at].name);
            writeln!(
                text,
                "{:>11} {:>6} {:>11} {:>6} {:>9}  {}",
                short(cost.own, 1_000_000_000),
                percent(cost.own, fuel),
                short(cost.total, 1_000_000_000),
                percent(cost.total, fuel),
                short(cost.calls, 10_000_000),
                fitting(&name)
            )
            .expect("writing to a string cannot fail");
        }
        let rest = costs.get(functions..).unwrap_or_default();
        if !rest.is_empty() {
            let own: u64 = rest.iter().map(|(_, cost)| cost.own).sum();
            let count = grouped(rest.len() as u64);
            let own = (short(own, 1_000_000_000), percent(own, fuel));
            writeln!(text, "{:>11} {:>6}  {count} more functions", own.0, own.1)
                .expect("writing to a string cannot fail");
        }
        if self.profile.collapsed > 0 {
            let calls = grouped(self.profile.collapsed);
            text.push_str(&format!(
                "\n{calls} calls on rare paths count for their callers\n"
            ));
        }
        text
    }

    /// The profile in the file format of speedscope: the paths of calls, weighted by fuel. One line.
    pub fn speedscope(&self) -> String {
        let profile = self.profile;
        let spent = || profile.nodes.iter().filter(|it| it.fuel > 0);
        let names = profile.functions.iter();
        let name = self.title();
        let document = Speedscope {
            schema: "https://www.speedscope.app/file-format-schema.json",
            exporter: concat!("wasmouse ", env!("CARGO_PKG_VERSION")),
            name: &name,
            active_profile_index: 0,
            shared: Shared {
                frames: names.map(|it| SharedFrame { name: &it.name }).collect(),
            },
            profiles: [Sampled {
                kind: "sampled",
                name: "fuel",
                unit: "none",
                start_value: 0,
                end_value: profile.fuel(),
                samples: spent().map(|it| path(profile, it)).collect(),
                weights: spent().map(|it| it.fuel).collect(),
            }],
        };
        let mut text = line(&document);
        text.push('\n');
        text
    }

    /// Folded stacks, as `flamegraph.pl`, inferno and the Firefox profiler read them: a line for each path of calls,
    /// with the callers first, and its fuel.
    pub fn folded(&self) -> String {
        let mut text = String::new();
        for node in self.profile.nodes.iter().filter(|it| it.fuel > 0) {
            let names = path(self.profile, node).into_iter().map(|at| {
                let name = &self.profile.functions[at as usize].name;
                for_terminal(name).replace(';', ":")
            });
            let names: Vec<String> = names.collect();
            writeln!(text, "{} {}", names.join(";"), node.fuel)
                .expect("writing to a string cannot fail");
        }
        text
    }
}

/// The functions of a path, the first caller first.
fn path(profile: &Profile, node: &ProfileNode) -> Vec<u32> {
    let mut path: Vec<u32> = profile.path(node).map(|it| it.function).collect();
    path.reverse();
    path
}

/// A share with one decimal, rounded to the nearest.
fn percent(part: u64, whole: u64) -> String {
    let thousandths = (u128::from(part) * 2000 + u128::from(whole))
        .checked_div(2 * u128::from(whole))
        .unwrap_or(0);
    format!("{}.{}%", thousandths / 10, thousandths % 10)
}

/// A number below that limit as it is, and a larger one in millions.
fn short(number: u64, limit: u64) -> String {
    if number < limit {
        grouped(number)
    } else {
        format!("{} M", grouped(number / 1_000_000))
    }
}

/// The name in what is left of a line.
fn fitting(name: &str) -> String {
    let room = WIDTH - BEFORE - 1;
    match name.char_indices().nth(room) {
        None => name.to_owned(),
        // The end says more: the beginning is the path of a module.
        Some(_) => {
            let last = name.char_indices().rev().nth(room - 2).map_or(0, |it| it.0);
            format!("…{}", &name[last..])
        }
    }
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Speedscope<'a> {
    #[serde(rename = "$schema")]
    schema: &'static str,
    exporter: &'static str,
    name: &'a GuestText,
    active_profile_index: u32,
    shared: Shared<'a>,
    profiles: [Sampled; 1],
}

#[derive(Serialize)]
struct Shared<'a> {
    frames: Vec<SharedFrame<'a>>,
}

#[derive(Serialize)]
struct SharedFrame<'a> {
    name: &'a GuestText,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Sampled {
    #[serde(rename = "type")]
    kind: &'static str,
    name: &'static str,
    unit: &'static str,
    start_value: u64,
    end_value: u64,
    samples: Vec<Vec<u32>>,
    weights: Vec<u64>,
}

#[cfg(test)]
mod tests {
    use wasmouse_engine::ProfiledFunction;

    use super::super::sample::HOSTILE;
    use super::*;

    fn profile() -> Profile {
        let node = |parent, function, fuel, calls| ProfileNode {
            parent,
            function,
            fuel,
            calls,
        };
        let names = [
            "next-move",
            "a;b",
            HOSTILE,
            "robot::a::very::very::long::path::of::modules::flood",
        ];
        Profile {
            functions: names
                .map(|name| ProfiledFunction { name: name.into() })
                .into(),
            nodes: vec![
                node(None, 0, 100, 3),
                node(Some(0), 1, 600, 12_000_000),
                node(Some(1), 1, 50, 1),
                node(Some(0), 2, 0, 7),
                node(Some(3), 3, 250, 1),
            ],
            collapsed: 0,
        }
    }

    fn played(profile: &Profile) -> ProfiledMatch<'_> {
        ProfiledMatch {
            robot: "flood".into(),
            maze: HOSTILE.into(),
            seed: 7,
            verdict: "finished",
            steps: 3,
            profile,
        }
    }

    #[test]
    fn the_table_has_own_and_total_fuel_in_80_columns() {
        let profile = profile();
        let text = played(&profile).table(3);
        let rows: Vec<&str> = text.lines().skip(4).collect();
        let expected = [
            "        650  65.0%         650  65.0%      12 M  a;b",
            "        250  25.0%         250  25.0%         1  …ong::path::of::modules::flood",
            "        100  10.0%       1,000 100.0%         3  next-move",
            "          0   0.0%  1 more functions",
        ];
        assert_eq!(rows, expected, "\n{text}");
        assert!(rows.iter().all(|it| it.chars().count() <= WIDTH));
        assert!(!text.contains('\u{1b}'));
    }

    #[test]
    fn folded_stacks_have_one_line_for_each_path() {
        let profile = profile();
        let text = played(&profile).folded();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines[..3],
            ["next-move 100", "next-move;a:b 600", "next-move;a:b;a:b 50"]
        );
        assert_eq!(lines.len(), 4, "{text}");
        assert!(lines[3].ends_with("::flood 250") && !text.contains('\u{1b}'));
    }

    #[test]
    fn speedscope_gets_paths_and_weights() {
        let profile = profile();
        let text = played(&profile).speedscope();
        let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let sampled = &json["profiles"][0];
        assert_eq!(
            sampled["samples"],
            serde_json::json!([[0], [0, 1], [0, 1, 1], [0, 2, 3]])
        );
        assert_eq!(sampled["weights"], serde_json::json!([100, 600, 50, 250]));
        assert_eq!(
            (&sampled["endValue"], &sampled["unit"]),
            (&1000.into(), &"none".into())
        );
        assert_eq!(json["shared"]["frames"][2]["name"], HOSTILE);
    }
}
