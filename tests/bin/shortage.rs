//! Plays a match in this process while it is short of something that the system gives.
//!
//! Called with what is short (`nothing`, `data`, `descriptors`), the moment at
//! which it becomes short (`before-admission`, `before-match`) and the file of a robot. Prints
//! `rejected: ...`, `failed: ...` for an infrastructure error, or `played: ...` with the record
//! of the match.

use std::error::Error;
use std::sync::Arc;
use std::{env, fs};

#[cfg(target_os = "linux")]
use rustix::process::{Resource, Rlimit, setrlimit};
use wasmouse_core::game::Ruleset;
use wasmouse_core::maze::{self, format};
use wasmouse_core::record::{MatchKey, MatchSpec};
use wasmouse_engine::{Executor as _, InProcess, Limits, engine_id};

/// What is left of memory: enough for everything but a large linear memory.
#[cfg(target_os = "linux")]
const SPARE_BYTES: u64 = 24 << 20;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().collect();
    let [_, what, moment, file] = &arguments[..] else {
        return Err("expected what is short, when, and a file".into());
    };
    let file = fs::read(file)?;
    let executor = InProcess::new(Limits::default(), 1, None)?;
    println!("{}", play(&executor, &file, what, moment));
    Ok(())
}

fn play(executor: &InProcess, file: &[u8], what: &str, moment: &str) -> String {
    let shorten = |now: &str| {
        if now == moment {
            shorten(what);
        }
    };
    shorten("before-admission");
    let robot = match executor.admit(file) {
        Err(error) => return format!("failed: {error}"),
        Ok(Err(rejection)) => return format!("rejected: {rejection}"),
        Ok(Ok(robot)) => robot,
    };
    let text = maze::bundled()[0].text;
    let maze = Arc::new(format::parse(text).expect("a bundled maze").maze);
    let rules = Arc::new(Ruleset::default());
    let spec = MatchSpec {
        key: MatchKey {
            engine: engine_id().digest(),
            rules: rules.digest(),
            robot: *robot.digest(),
            variant: 0,
            maze: maze.digest(),
            seed: 0,
        },
        maze,
        rules,
    };
    shorten("before-match");
    match executor.execute_with_details(&robot, &spec) {
        Err(error) => format!("failed: {error}"),
        Ok(played) => {
            let record = serde_json::to_string(&played.record).expect("records serialise");
            format!("played: {record}")
        }
    }
}

#[cfg(target_os = "linux")]
fn shorten(what: &str) {
    use std::os::fd::AsRawFd as _;

    match what {
        "nothing" => {}
        "data" => limit(Resource::Data, memory("VmData:") + SPARE_BYTES),
        "descriptors" => {
            // The lowest number that is free: none below it is.
            let free = fs::File::open("/dev/null").expect("a device").as_raw_fd();
            limit(Resource::Nofile, u64::try_from(free).expect("a number"));
        }
        other => panic!("nothing is known of `{other}`"),
    }
}

#[cfg(not(target_os = "linux"))]
fn shorten(_: &str) {
    panic!("only Linux tells how much memory a process has");
}

#[cfg(target_os = "linux")]
fn limit(resource: Resource, most: u64) {
    let most = Rlimit {
        current: Some(most),
        maximum: Some(most),
    };
    setrlimit(resource, most).expect("a limit may be lowered");
}

/// A field of this process's status, in bytes.
#[cfg(target_os = "linux")]
fn memory(field: &str) -> u64 {
    let status = fs::read_to_string("/proc/self/status").expect("Linux has it");
    let line = status.lines().find_map(|line| line.strip_prefix(field));
    let kilobytes = line.and_then(|line| line.split_whitespace().next());
    let kilobytes: Option<u64> = kilobytes.and_then(|it| it.parse().ok());
    kilobytes.expect("a number of kilobytes") << 10
}
