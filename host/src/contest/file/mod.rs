//! The contest file, `contest.toml`: its types, its parser, and a template.
//!
//! [`ContestFile::parse`] checks everything that can be known without the files that it names;
//! `cli::contest::resolve` finds those. `docs/CONTEST.md` is the reference of the format and
//! `host/schema/contest.schema.json` its JSON Schema; tests keep both in agreement with the parser.

pub(in crate::contest) mod check;
mod contest_file;
mod mazes;
mod options;
mod parse;
mod robots;
mod rules;
mod template;

pub use contest_file::{CONTEST_FILE_VERSION, ContestFile};
pub use mazes::MazesEntry;
pub use options::{ClassEntry, KeepTranscripts, Outputs, ReportOptions, RunOptions, SeedsEntry};
pub use robots::{NamesFrom, RobotSource, RobotsEntry, VariantRef};
pub use rules::{GameEntry, RulesEntry, SandboxEntry};
pub use template::template;
