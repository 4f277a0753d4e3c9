//! What a robot costs: its size, and the fuel and time of a match.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::Value;
use wasmouse_tests::binary::{Ran, ran, wasmouse};
use wasmouse_tests::rust_wasi;
use xtask::languages::{Environment, Kit, STARLINGMONKEY};

/// The maze that is played: the flood robot takes 52 steps.
const MAZE: &str = "test_maze_01";

/// The name of the projects.
const NAME: &str = "robot";

/// How often a match is played to take its time, which is the least of three tries.
const MATCHES: u32 = 20;
const TRIES: u32 = 3;

/// What a robot costs.
pub struct Cost {
    language: String,
    robot: &'static str,
    size_bytes: u64,
    /// `None` for a robot that comes with wasmouse.
    build: Option<Duration>,
    memory_bytes: u64,
    start_fuel: u64,
    fuel_per_step: u64,
    play: Duration,
}

impl Cost {
    /// The line of the table.
    pub fn row(&self) -> String {
        let build = self
            .build
            .map_or_else(|| "-".to_owned(), |it| format!("{:.1}", it.as_secs_f64()));
        #[expect(clippy::cast_precision_loss, reason = "shown with one decimal")]
        let memory = self.memory_bytes as f64 / f64::from(1 << 20);
        format!(
            "| {} | {} | {} | {build} | {memory:.1} | {} | {} | {:.1} |\n",
            self.language,
            self.robot,
            thousands(self.size_bytes.div_ceil(1000)),
            thousands(self.start_fuel),
            thousands(self.fuel_per_step),
            self.play.as_secs_f64() * 1e3,
        )
    }
}

/// A number with a comma after every three digits.
fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut shown = String::new();
    for (index, digit) in digits.char_indices() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            shown.push(',');
        }
        shown.push(digit);
    }
    shown
}

/// The flood robot that comes with wasmouse, in Rust.
pub fn bundled() -> Result<Cost, String> {
    let prebuilt = xtask::repository().join("example-robots/prebuilt/flood.wasm");
    measure(
        "rust",
        "flood",
        "flood",
        &prebuilt,
        Path::new("."),
        &Vec::new(),
    )
}

/// The example robot of a language, in a project in the target folder.
pub fn built(kit: Kit, root: &Path) -> Result<Cost, String> {
    let environment = kit
        .find(root, "costs")
        .ok_or_else(|| format!("no tools for {}", kit.language))?;
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let is_other_engine = kit.language == "starlingmonkey";
    let rust_target = rust_wasi::target_of(kit.language);
    let lang = if is_other_engine {
        "javascript"
    } else if rust_target.is_some() {
        "rust"
    } else {
        kit.language
    };
    let mut new = wasmouse();
    new.args(["new", NAME, "--lang", lang]);
    let printed = succeed(new.current_dir(folder.path()).envs(environment.clone()))?;
    let project = folder.path().join(NAME);
    if is_other_engine {
        for file in ["package.json", "package-lock.json"] {
            let from = root.join(STARLINGMONKEY).join(file);
            fs::copy(from, project.join(file)).map_err(|error| error.to_string())?;
        }
    }
    if let Some(target) = &rust_target {
        rust_wasi::choose(target, &project)
            .and_then(|()| fs::write(project.join("src/lib.rs"), rust_wasi::flood()))
            .map_err(|error| error.to_string())?;
    }
    // Python's tool is on the search path already.
    if kit.language != "python" {
        for line in printed.lines().map(str::trim) {
            let setup = line.strip_prefix('(').and_then(|it| it.strip_suffix(')'));
            if let Some((_, setup)) = setup.and_then(|it| it.split_once(" && ")) {
                let (shell, option) = if cfg!(windows) {
                    ("cmd", "/C")
                } else {
                    ("sh", "-c")
                };
                let mut command = Command::new(shell);
                command.args([option, setup]);
                succeed(command.current_dir(&project).envs(environment.clone()))?;
            }
        }
    }
    // The first build fills the caches of compilers.
    let mut build = Duration::MAX;
    for _ in 0..2 {
        let begin = Instant::now();
        let mut command = wasmouse();
        command.args(["build", "--output", "robot.wasm"]);
        succeed(command.current_dir(&project).envs(environment.clone()))?;
        build = begin.elapsed();
    }
    let robot = if kit.language == "wat" {
        "wall follower"
    } else {
        "flood"
    };
    let component = project.join("robot.wasm");
    let title = match kit.language {
        "starlingmonkey" => "javascript on StarlingMonkey",
        "javascript" => "javascript on QuickJS",
        "typescript" => "typescript on QuickJS",
        "rust-wasip1" => "rust for wasm32-wasip1",
        "rust-wasip2" => "rust for wasm32-wasip2",
        language => language,
    };
    let mut cost = measure(
        title,
        robot,
        "robot.wasm",
        &component,
        &project,
        &environment,
    )?;
    cost.build = Some(build);
    Ok(cost)
}

fn measure(
    language: &str,
    robot: &'static str,
    argument: &str,
    component: &Path,
    folder: &Path,
    environment: &Environment,
) -> Result<Cost, String> {
    let play = |matches: u32| -> Result<(Duration, Value), String> {
        let mut command = wasmouse();
        command.args(["run", argument, MAZE, "--json", "--jobs", "1"]);
        command.args(["--repeat", &matches.to_string()]);
        let begin = Instant::now();
        // A robot that does not finish has another exit code.
        let Ran { stdout, stderr, .. } = ran(command.current_dir(folder).envs(environment.clone()));
        let time = begin.elapsed();
        let results = serde_json::from_str(&stdout).map_err(|_| format!("{language}: {stderr}"))?;
        Ok((time, results))
    };
    let (_, results) = play(1)?;
    let record = &results["matches"][0];
    let number = |pointer: &str| {
        let found = record.pointer(pointer).and_then(Value::as_u64);
        found.ok_or_else(|| format!("{language}: no {pointer} in {record}"))
    };
    let steps = number("/steps/exploration")? + number("/steps/speed")?;
    let mut one = Duration::MAX;
    let mut many = Duration::MAX;
    for _ in 0..TRIES {
        one = one.min(play(1)?.0);
        many = many.min(play(1 + MATCHES)?.0);
    }
    Ok(Cost {
        language: language.to_owned(),
        robot,
        size_bytes: fs::metadata(component)
            .map_err(|error| error.to_string())?
            .len(),
        build: None,
        memory_bytes: number("/memory_bytes")?,
        start_fuel: number("/fuel/start")?,
        fuel_per_step: number("/fuel/steps")?
            .checked_div(steps)
            .ok_or_else(|| format!("{language}: the robot took no step: {record}"))?,
        play: many.saturating_sub(one) / MATCHES,
    })
}

fn succeed(command: &mut Command) -> Result<String, String> {
    let Ran {
        status,
        stdout,
        stderr,
    } = ran(command);
    if status.success() {
        Ok(stdout)
    } else {
        Err(format!("{command:?}: {status}\n{stdout}{stderr}"))
    }
}
