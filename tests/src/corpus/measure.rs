//! [`measure`]: a command's time, the memory of all its processes, and whether one of
//! them stays behind.
//!
//! Only Linux provides these figures (`/proc`); elsewhere memory is zero.

use std::fs::{self, File};
use std::io;
use std::path::Path;
use std::process::ExitStatus;
use std::thread;
use std::time::{Duration, Instant};

use crate::program::Program;

/// The result of a command and the resources that it used.
#[derive(Debug)]
pub struct Measured {
    /// How it ended; `None` when it was killed because it used too much.
    pub status: Option<ExitStatus>,
    /// What it wrote to stdout.
    pub stdout: String,
    /// What it wrote to stderr.
    pub stderr: String,
    /// How long it took.
    pub time: Duration,
    /// The largest resident memory of the process that was started, in bytes.
    pub first_bytes: u64,
    /// The largest sum over all processes that lived at the same time, each counted
    /// with its largest so far, and the pages of the program once, in bytes.
    pub all_bytes: u64,
    /// Processes that were still there when the first had ended.
    pub left_behind: usize,
}

/// How often memory is sampled. The kernel reports the peak of a process, so a short peak is not
/// missed as long as the process lives on for that long.
const SAMPLE: Duration = Duration::from_millis(2);

/// A command that uses more memory is killed, whatever the caller's ceiling, before the machine
/// runs out of it.
const BYTES_MAX: u64 = 6 << 30;

/// Runs the program with its output in files of its folder.
///
/// # Errors
///
/// When it cannot be run, or its output cannot be kept.
pub fn measure(
    program: &Program,
    arguments: &[String],
    time_max: Duration,
) -> io::Result<Measured> {
    let folder = program.folder();
    let (stdout, stderr) = (folder.join("stdout"), folder.join("stderr"));
    let begin = Instant::now();
    let mut child = program
        .command()
        .args(arguments)
        .stdout(File::create(&stdout)?)
        .stderr(File::create(&stderr)?)
        .spawn()?;
    let mut memory = Memory::default();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break Some(status);
        }
        memory.sample(program, child.id());
        if begin.elapsed() > time_max || memory.all > BYTES_MAX {
            child.kill()?;
            child.wait()?;
            break None;
        }
        thread::sleep(SAMPLE);
    };
    let time = begin.elapsed();
    let left_behind = program.left_behind();
    let text =
        |path: &Path| fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    Ok(Measured {
        status,
        stdout: text(&stdout)?,
        stderr: text(&stderr)?,
        time,
        first_bytes: memory.first,
        all_bytes: memory.all,
        left_behind,
    })
}

#[derive(Default)]
struct Memory {
    first: u64,
    all: u64,
}

impl Memory {
    fn sample(&mut self, program: &Program, first: u32) {
        let mut sum = 0;
        for process in program.processes() {
            let (peak, of_files) = resident_bytes(process);
            if process == first {
                self.first = self.first.max(peak);
                sum += peak;
            } else {
                // All processes share the pages of one program.
                sum += peak.saturating_sub(of_files);
            }
        }
        self.all = self.all.max(sum);
    }
}

/// The largest resident memory that a process has had, and how much of what it has now are pages
/// of files, in bytes; 0 when it is gone.
fn resident_bytes(process: u32) -> (u64, u64) {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let bytes = |name| {
        let line = status.lines().find_map(|line| line.strip_prefix(name));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
        kilobytes.unwrap_or(0) << 10
    };
    (bytes("VmHWM:"), bytes("RssFile:"))
}
