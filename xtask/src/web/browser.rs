//! Tests of web pages in a browser: `host/web/tests`, run by Node with Playwright and the system's
//! Chromium.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use super::project::{self, Project};
use crate::packages::{quiet, skip};
use crate::step::{target_folder, wasmouse_binary};

/// Set to anything but the empty string, it makes tests that cannot run a failure.
pub const REQUIRED_VARIABLE: &str = "WASMOUSE_REQUIRE_BROWSER";

/// A browser to use instead of one that is found.
const BROWSER_VARIABLE: &str = "WASMOUSE_BROWSER";

/// The names of browsers that Playwright can drive.
const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

/// Runs the tests, with programs that have been built. Where Node, a package or a browser is
/// missing, says so on stderr.
///
/// # Errors
///
/// When a test fails.
///
/// # Panics
///
/// When something is missing and [`REQUIRED_VARIABLE`] is set.
pub fn test(root: &Path) -> Result<(), String> {
    let tools = Project::install(root).and_then(|project| Ok((project, browser()?)));
    let (project, browser) = match tools {
        Ok(tools) => tools,
        Err(reason) => {
            skip(
                "the tests of web pages in a browser",
                &reason,
                REQUIRED_VARIABLE,
            );
            return Ok(());
        }
    };
    let samples = project::folder(root).join("samples");
    fs::create_dir_all(&samples).map_err(|error| error.to_string())?;
    let maker = target_folder(root).join("debug/web-samples");
    let maker = maker.with_extension(env::consts::EXE_EXTENSION);
    quiet(
        std::process::Command::new(maker)
            .arg(&samples)
            .env("WASMOUSE", wasmouse_binary(root)),
    )?;
    project
        .node("tests of web pages", &["--test", "--test-concurrency=1"])
        .args(["--test-reporter=spec", "tests/"])
        .env(BROWSER_VARIABLE, browser)
        .env("WASMOUSE_SAMPLES", samples)
        .run()
}

/// A browser on this machine.
fn browser() -> Result<PathBuf, String> {
    if let Some(browser) = env::var_os(BROWSER_VARIABLE) {
        return Ok(browser.into());
    }
    let path = env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = env::split_paths(&path).collect();
    let candidates = BROWSERS
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    let mut candidates = candidates.map(|it| it.with_extension(env::consts::EXE_EXTENSION));
    candidates
        .find(|it| it.is_file())
        .ok_or_else(|| format!("none of {} was found", BROWSERS.join(", ")))
}
