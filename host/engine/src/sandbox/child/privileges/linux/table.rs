//! Compares the lists in `calls` with the tables in SECURITY.md.

use std::collections::BTreeMap;

use super::super::super::super::role::Role;
use super::calls::{ALLOWED, Arguments, FATAL, FATAL_HERE};

const SECURITY: &str = include_str!("../../../../../../../SECURITY.md");

/// The rows of the table under a heading, in cells.
fn table(heading: &str) -> Vec<Vec<&'static str>> {
    let (_, section) = SECURITY.split_once(heading).expect("the heading");
    let rows = section.lines().skip_while(|line| !line.starts_with('|'));
    rows.skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|row| row.trim_matches('|').split('|').map(str::trim).collect())
        .collect()
}

fn names(cell: &'static str) -> impl Iterator<Item = &'static str> {
    cell.split('`').skip(1).step_by(2)
}

fn name(constant: &'static str) -> &'static str {
    constant.trim_start_matches("SYS_")
}

#[test]
fn the_calls_that_are_allowed_are_documented() {
    let mut documented = BTreeMap::new();
    for row in table("### System calls that are allowed") {
        let [calls, roles, arguments, reason] = row[..] else {
            panic!("{row:?}");
        };
        assert_ne!(reason, "", "{row:?}");
        for call in names(calls) {
            let before = documented.insert(call, (roles.to_owned(), arguments == "any"));
            assert_eq!(before, None, "{call}");
        }
    }
    let coded = ALLOWED.iter().map(|call| {
        let roles = if call.roles == Role::ALL {
            "all".to_owned()
        } else {
            call.roles
                .iter()
                .map(|role| role.name())
                .collect::<Vec<_>>()
                .join(", ")
        };
        (
            name(call.constant),
            (roles, call.arguments == Arguments::Any),
        )
    });
    assert_eq!(coded.collect::<BTreeMap<_, _>>(), documented);
}

#[test]
fn the_calls_that_are_fatal_are_documented() {
    let rows = table("### System calls that end the worker");
    let mut documented: Vec<&str> = rows.iter().flat_map(|row| names(row[0])).collect();
    let mut coded: Vec<&str> = FATAL
        .iter()
        .chain(FATAL_HERE)
        .map(|(constant, _)| name(constant))
        .collect();
    // The filter looks at its arguments, so it is in no list.
    coded.push("clone");
    coded.sort_unstable();
    documented.sort_unstable();
    if cfg!(target_arch = "x86_64") {
        assert_eq!(coded, documented);
    } else {
        let undocumented: Vec<_> = coded
            .iter()
            .filter(|call| !documented.contains(call))
            .collect();
        assert!(undocumented.is_empty(), "{undocumented:?}");
    }
}
