//! C++: a project is `src/robot.cpp`, compiled with `zig c++` or clang.

use super::c_family::{Dialect, SOURCES};
use super::zig_compiler::ZIG_CC;
use crate::cli::project::language::Language;

/// C++.
pub static LANGUAGE: Language = Language {
    name: "cpp",
    title: "C++",
    markers: &[DIALECT.entries[0]],
    is_in: |folder| folder.join(DIALECT.entries[0]).is_file(),
    open: |folder, language| DIALECT.open(folder, language),
    compile: |project, _| DIALECT.compile(project),
    sources: SOURCES,
    tools: &[&ZIG_CC],
    check: None,
    setup: &[],
};

pub(super) const DIALECT: Dialect = Dialect {
    driver: "c++",
    clang_options: &["--driver-mode=g++"],
    extensions: &["cpp", "cc", "cxx"],
    entries: ["src/robot.cpp", "src/robot.c"],
};
