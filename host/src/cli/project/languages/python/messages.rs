//! What componentize-py prints when a robot cannot be imported, in the robot's own terms.

use crate::cli::failure::Failure;
use crate::cli::project::language::Project;
use crate::report::text::{Text, text};

/// The failure that is meant, if it is the robot's: a syntax error, or an exception as a module is
/// imported, which happens while it is built.
pub fn failure(project: &Project, module: &str, printed: &str) -> Option<Failure> {
    // The tool is a program of Python, too, and its own traceback comes first.
    let start = printed.find("AssertionError: ")? + "AssertionError: ".len();
    let printed = &printed[start..];
    let end = ["\n\nCaused by:", "\n\nStack backtrace:"]
        .iter()
        .filter_map(|it| printed.find(it))
        .min();
    let traceback = printed[..end.unwrap_or(printed.len())].trim_end();
    let error = traceback.lines().last()?;
    let folder = project.folder.to_string_lossy();
    let shown = traceback.replace("File \"/0/", &format!("File \"{folder}/"));
    let failure = Failure::robot(text!(
        "`{}` failed as it was imported: {}\n\n{}",
        module,
        error,
        Text::of_lines(&shown)
    ));
    Some(failure.hint(hint(error)))
}

fn hint(error: &str) -> &'static str {
    let is = |kind: &str| error.starts_with(kind);
    if is("SyntaxError") || is("IndentationError") || is("TabError") {
        "the robot runs with Python 3.14"
    } else if is("ModuleNotFoundError") || is("ImportError") {
        "packages have to be pure Python and installed into the project's .venv"
    } else {
        "modules are imported while the robot is built, where there is neither a network nor the \
         host; do such work in `Robot.__init__`"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRINTED: &str = r#"Traceback (most recent call last):
  File "/x/bin/componentize-py", line 8, in <module>
    sys.exit(script())
AssertionError: Traceback (most recent call last):
  File "/0/controller.py", line 18, in <module>
    from robot import Robot
  File "/0/robot.py", line 55, in <module>
    x = {}["nothing"]
KeyError: 'nothing'


Caused by:
    KeyError: 'nothing'
"#;

    #[test]
    fn a_traceback_shows_the_project_and_nothing_else() {
        let project = Project {
            folder: "bots/my-robot".into(),
            name: "my-robot".to_owned(),
            language: &super::super::LANGUAGE,
        };
        let found = failure(&project, "controller", PRINTED)
            .unwrap()
            .to_string();
        let expected = "error: `controller` failed as it was imported: KeyError: 'nothing'\n\n\
            Traceback (most recent call last):\n  File \"bots/my-robot/controller.py\", line 18";
        assert!(found.starts_with(expected), "{found}");
        assert!(
            !found.contains("/x/bin") && !found.contains("Caused"),
            "{found}"
        );
        assert!(failure(&project, "controller", "panicked").is_none());
    }
}
