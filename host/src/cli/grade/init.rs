//! `wasmouse grade --init`: a commented rubric to begin with.

use std::path::Path;

use super::super::exit::Exit;
use super::super::failure::Failure;
use super::super::output::{self, Existing, message};
use crate::report::text::Text;

const RUBRIC: &str = include_str!("../../../templates/grade/rubric.toml");

/// Writes the rubric.
pub fn run(path: &Path, existing: Existing) -> Result<Exit, Failure> {
    output::save(path, RUBRIC.as_bytes(), existing)?;
    let path = Text::of_path(path);
    message!(
        "wrote {}\n  hint: edit it, then run `wasmouse grade {} ROBOT`",
        path,
        path
    );
    Ok(Exit::Success)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contest::grade::Rubric;

    #[test]
    fn the_rubric_and_everything_that_it_offers_can_be_read() {
        let rubric = Rubric::read(RUBRIC).expect("a rubric");
        assert_eq!((rubric.points_max(), rubric.criteria.len()), (10, 5));
        for line in RUBRIC.lines().filter_map(|it| it.strip_prefix('#')) {
            let is_key = |it: &str| it.starts_with(|c: char| c.is_ascii_lowercase());
            if !is_key(line) || !line.contains(" = ") || line.starts_with("pass_points") {
                continue;
            }
            let text = RUBRIC.replace(&format!("#{line}"), line);
            Rubric::read(&text).unwrap_or_else(|error| panic!("{line}: {error}"));
        }
        for line in RUBRIC.lines().filter_map(|it| it.strip_prefix("#   ")) {
            let keys = ["mean_", "no_worse", "baseline =", "step_", "memory_"];
            if keys.iter().any(|it| line.starts_with(it)) {
                let key = line.split("  ").next().expect("split yields one part");
                let text = RUBRIC.replace("faults = 0", key);
                Rubric::read(&text).unwrap_or_else(|error| panic!("{key}: {error}"));
            }
        }
    }
}
