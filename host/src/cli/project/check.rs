//! [`check`]: whether the tools of a language are there.

use std::path::Path;

use super::language::Language;
use super::tool::{Program, Tool, Version};
use crate::report::text::{Text, text};

/// How it is about a tool.
#[derive(Debug)]
pub enum Status {
    /// It is there, in this version if it prints one.
    Found(Option<Version>),
    /// It is installed into each project, by this command.
    PerProject(&'static str),
    /// It is not there, or too old.
    Missing {
        /// What is wrong.
        problem: Text,
        /// How to install it, in one or more lines.
        install: Text,
    },
}

impl Status {
    /// Whether nothing is missing on this machine.
    pub const fn is_ready(&self) -> bool {
        !matches!(self, Self::Missing { .. })
    }
}

/// Looks for each tool of a language by its name. Tools of projects are looked for in `folder` if
/// it is a project in that language.
pub fn check(language: &Language, folder: &Path) -> Vec<(&'static str, Status)> {
    let project = (language.is_in)(folder).then_some(folder);
    let check_tool = |tool: &&'static Tool| match tool.find(project) {
        Ok(found) => (found.name(), Status::Found(found.version)),
        Err(_) if project.is_none() && is_of_projects(tool) => {
            (tool.name, Status::PerProject(tool.install))
        }
        Err(failure) => {
            let problem = failure.message().clone();
            let install = Text::of_lines(tool.install);
            (tool.name, Status::Missing { problem, install })
        }
    };
    let mut checks: Vec<_> = language.tools.iter().map(check_tool).collect();
    if let Some(check) = language.check
        && let Err(failure) = check(folder)
    {
        let problem = failure.message().clone();
        let install = failure.hint_text().cloned().unwrap_or_else(|| text!(""));
        checks.push((language.name, Status::Missing { problem, install }));
    }
    checks
}

fn is_of_projects(tool: &Tool) -> bool {
    let is_local = |it: &Program| matches!(it, Program::Npm(_) | Program::Venv(_));
    tool.programs.iter().any(is_local)
}
