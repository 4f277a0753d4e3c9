//! The checker on small crates. They are written as `file: line of source`, and
//! what is found in them one problem a line.

use std::collections::BTreeSet;

use super::CrateRules;
use super::tree::Files;

const MANIFEST: &str = "\
dependencies.serde = '1'
dev-dependencies.clap = '4'
target.'cfg(unix)'.dependencies.libc.workspace = true";

fn strings(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_owned).collect()
}

/// The parts in `order` are in an order if there are any; `high` is impure, and
/// `caller` may hold code above other files.
#[track_caller]
fn check(order: &str, dependencies: &str, source: &str, expected: &str) {
    let rules = CrateRules {
        dependencies: Some(strings(dependencies)),
        order: (!order.is_empty()).then(|| strings(order)),
        impure: strings("high"),
        callers: strings("caller"),
        files_min: 2,
        imports_min: 1,
        ..CrateRules::default()
    };
    let mut files = Files::new();
    for (file, line) in source
        .lines()
        .filter_map(|line| line.trim().split_once(": "))
    {
        *files.entry(file.to_owned()).or_default() += &format!("{line}\n");
    }
    let outside = strings("std::fs std::io::stdout clap print!");
    let found = rules.problems(MANIFEST, &files, &outside);
    let expected: BTreeSet<&str> = expected.trim().lines().map(str::trim).collect();
    assert_eq!(
        found.iter().map(String::as_str).collect::<BTreeSet<_>>(),
        expected
    );
}

#[test]
fn cycles_are_seen_through_reexports() {
    check(
        "",
        "serde libc",
        "lib.rs: mod a; mod b; mod c; pub use a::A; pub use b::*;
         a.rs: use crate::B;
         a.rs: pub struct A;
         b.rs: pub use super::c::C as B;
         c.rs: fn f(_: &dyn Fn(Vec<crate::A>)) {}
         c.rs: pub struct C;",
        "a.rs:1 imports C of crate::c: cycle a -> c -> a
         c.rs:1 imports A of crate::a: cycle c -> a -> c",
    );
    // A folder counts as one; `y` alone is on no cycle.
    check(
        "",
        "serde libc",
        "lib.rs: mod a; mod z;
         a/mod.rs: mod x; mod y; pub use x::X;
         a/x.rs: pub struct X;
         a/y.rs: use super::X; use crate::z; fn f() { z::f() }
         z.rs: use crate::a;
         z.rs: pub fn f() { let _ = a::X; }",
        "a/y.rs:1 imports crate::z (and 1 more): cycle a -> z -> a
         z.rs:1 imports crate::a (and 1 more): cycle z -> a -> z",
    );
    // Modules that import all of each other, and names that lead to themselves.
    check(
        "",
        "serde libc",
        "lib.rs: mod a; mod b; use serde::serde;
         a.rs: pub use crate::b::*; pub use a::a;
         b.rs: pub use crate::a::*; fn f() { lost::g() }",
        "a.rs:1 imports * of crate::b: cycle a -> b -> a
         b.rs:1 imports * of crate::a: cycle b -> a -> b",
    );
}

#[test]
fn upward_imports_are_seen() {
    check(
        "",
        "serde libc",
        "lib.rs: mod a; mod caller; pub struct S; const C: u8 = 1;
         a.rs: macro_rules! m { () => { $crate::S } }
         a.rs: mod b; mod c;
         a/b.rs: use super::super::{S as T, C};
         a/b.rs: fn f() { m!() }
         a/c.rs: use super::*; use super::b; use super::super::a;
         caller/mod.rs: mod d; fn f() { d::g(self::d::Kind::A) }
         caller/d.rs: pub(in super) enum Kind { A } use self::Kind::*;",
        "lib.rs defines S
         a.rs defines m!
         a.rs:1 imports S of crate: upward
         a/b.rs:1 imports C of crate: upward
         a/b.rs:1 imports S of crate: upward
         a/b.rs:2 imports m! of crate::a: upward
         a/c.rs:1 imports * of crate::a: upward",
    );
    check(
        "low high",
        "serde libc",
        r#"lib.rs: mod low; mod high;
         low.rs: #[path = "other.rs"] mod unix;
         other.rs: mod inside { use super::super::super::high::{H, made}; }
         high.rs: use crate::low; pub struct H; make!(made);"#,
        "other.rs:1 imports H of crate::high: upward, low -> high
         other.rs:1 imports made of crate::high: upward, low -> high",
    );
}

#[test]
fn pure_code_does_not_reach_outside() {
    check(
        "low high",
        "serde libc",
        r#"lib.rs: mod low; mod high;
         low.rs: use std::io::{self, Write}; use std as s; use std::fsx::A;
         low.rs: #[derive(Clone, clap::Args)]
         low.rs: struct S(s::fs::File);
         low.rs: fn f() { io::stdout(); vec![g(print!(""))] }
         low.rs: use std::io::*;
         high.rs: use crate::low; use std::fs; fn f() { print!() }"#,
        "low.rs:2 uses clap::Args
         low.rs:3 uses std::fs::File
         low.rs:4 uses print!
         low.rs:4 uses std::io::stdout
         low.rs:5 uses std::io",
    );
}

#[test]
fn tests_comments_and_literals_are_left_out() {
    check(
        "low high",
        "serde libc clap",
        r#"lib.rs: mod low; mod high;
         low.rs: // use crate::high;
         low.rs: /// [`crate::high`]
         low.rs: const A: &str = concat!("crate::high");
         low.rs: #[cfg(test)] mod tests { use crate::high; }
         low.rs: #[cfg(test)] mod absent;
         low.rs: #[cfg(all(test, unix))] use std::fs;
         low.rs: #[cfg(test)] fn f() { print!() }
         low.rs: impl S { #[cfg(test)] fn f() { print!() } }
         low.rs: pub(in crate::high) struct S;
         high.rs: use crate::low; use low::S; use a::{self as b}; use b::high;"#,
        "",
    );
}

#[test]
fn a_check_that_sees_too_little_fails() {
    let nothing = "lib.rs: not found\nonly 1 files and 0 imports";
    check("", "serde libc", "", nothing);
    check(
        "low high",
        "serde",
        "lib.rs: mod low; mod a; mod b;
         low/mod.rs: use crate::low::S; fn f() {}
         a.rs: use crate::low::S; fn",
        r#"Cargo.toml: depends on libc
         lib.rs has {"a", "b", "low"}, the order is {"high", "low"}
         a.rs: unexpected end of input, expected identifier
         b/mod.rs: not found
         only 4 files and 0 imports"#,
    );
}
