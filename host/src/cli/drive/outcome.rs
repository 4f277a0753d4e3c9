//! What came of a drive, in words.

use wasmouse_core::game::Verdict;

use super::super::tui::Role;
use super::driver::Driver;

/// What came of a match, line by line.
pub fn result(driver: &Driver<'_>) -> Vec<(String, Role)> {
    let steps = driver.simulation.steps();
    let oracle = driver.oracle;
    let known = oracle.map_or_else(|| "none".to_owned(), |it| it.to_string());
    let oracle_line = (format!("oracle score: {known}"), Role::Plain);
    match driver.verdict() {
        Some(Verdict::Finished { score }) => {
            let divisor = score.divisor();
            let parts = format!("{} + {}/{divisor}", steps.speed, steps.exploration);
            let regret = oracle.map_or_else(String::new, |oracle| {
                let thousandths = score.thousandths().saturating_sub(oracle.thousandths());
                format!("regret: {}.{:03}", thousandths / 1000, thousandths % 1000)
            });
            vec![
                (format!("finished: score {score} = {parts}"), Role::Good),
                oracle_line,
                (regret, Role::Plain),
            ]
        }
        Some(verdict) => vec![(verdict.title().into_owned(), Role::Bad), oracle_line],
        None => {
            let total = steps.total();
            let steps = if total == 1 { "step" } else { "steps" };
            vec![(
                format!("given up after {total} {steps}: no score"),
                Role::Bad,
            )]
        }
    }
}
