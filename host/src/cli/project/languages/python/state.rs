//! Finds state that Python robots lose: componentize-py makes a new `Controller` for every call,
//! so nothing that is kept in `self` is there in the next step.

/// What was found in a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Found {
    /// Nothing to object to.
    Nothing,
    /// No class `Controller`, nor an import of one.
    NoController,
    /// An assignment to an attribute of `self`.
    State {
        /// The line, from 1.
        line: usize,
        /// The attribute.
        name: String,
    },
}

/// Reads lines, not syntax: whether the module is valid Python is found out by the interpreter.
pub fn check(module: &str) -> Found {
    let mut is_there = false;
    // The indentation of the class that is being read.
    let mut class: Option<usize> = None;
    for (index, line) in module.lines().enumerate() {
        let code = line.trim_start();
        if code.is_empty() || code.starts_with('#') {
            continue;
        }
        let indentation = line.len() - code.len();
        if class.is_some_and(|outer| indentation <= outer) {
            class = None;
        }
        if let Some(rest) = code.strip_prefix("class Controller")
            && rest.starts_with([':', '(', ' '])
        {
            (is_there, class) = (true, Some(indentation));
        } else if class.is_some() {
            if let Some(name) = assigned(code) {
                let name = name.to_owned();
                return Found::State {
                    line: index + 1,
                    name,
                };
            }
        } else {
            let is_import = code.starts_with("from ") || code.starts_with("Controller =");
            is_there |= is_import && code.contains("Controller");
        }
    }
    if is_there {
        Found::Nothing
    } else {
        Found::NoController
    }
}

/// The attribute of `self` that a line assigns to, such as `x` in `self.x: int = 1`.
fn assigned(code: &str) -> Option<&str> {
    let rest = code.strip_prefix("self.")?;
    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
    let (name, rest) = rest.split_at(end);
    let rest = rest.trim_start();
    // `:=` cannot stand here; `==` and `(` are no assignments.
    let is_assignment = rest.starts_with(':')
        || (rest.starts_with('=') && !rest.starts_with("=="))
        || ["+=", "-=", "*=", "/=", "|=", "&="]
            .iter()
            .any(|it| rest.starts_with(it));
    is_assignment.then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_state(module: &str, expected: Option<(usize, &str)>) {
        let expected = expected.map_or(Found::Nothing, |(line, name)| Found::State {
            line,
            name: name.to_owned(),
        });
        assert_eq!(check(module), expected, "{module}");
    }

    #[test]
    fn state_in_the_controller_is_found() {
        let class = "class Controller(exports.Controller):\n    def start(self, briefing):\n";
        check_state(&format!("{class}        self.x = 1\n"), Some((3, "x")));
        check_state(
            &format!("{class}        self.steps += 1\n"),
            Some((3, "steps")),
        );
        check_state(
            &format!("{class}\n        self.x: int = 1\n"),
            Some((4, "x")),
        );
        check_state(&format!("{class}        self.helper(1)\n"), None);
        check_state(&format!("{class}        # self.x = 1\n"), None);
        check_state(&format!("{class}        return self.x == 1\n"), None);
        check_state(
            &format!("{class}        pass\n\nclass Robot:\n    def f(self):\n        self.x = 1\n"),
            None,
        );
        check_state("from other import Controller\n", None);
        assert_eq!(check("class Controllers:\n    pass\n"), Found::NoController);
        assert_eq!(check("class Robot:\n    pass\n"), Found::NoController);
    }
}
