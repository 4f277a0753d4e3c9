//! [`Watch`]: notices robots that are submitted or changed while a contest waits for them.

use std::path::Path;
use std::thread;
use std::time::Duration;

use wasmouse_core::{Digest, GuestText};

use super::super::interrupt;
use super::super::output::message;
use super::planned::PlannedContest;

/// How often the files are looked at.
const INTERVAL: Duration = Duration::from_secs(2);

/// How often Ctrl-C is looked for.
const TICK: Duration = Duration::from_millis(100);

/// What a contest consisted of when it was played last.
#[derive(Default)]
pub struct Watch {
    played: Option<Vec<(GuestText, Digest, u32)>>,
    complaint: Option<String>,
}

impl Watch {
    /// Remembers what is about to be played.
    pub fn seen(&mut self, contest: &PlannedContest) {
        self.played = Some(entries(contest));
        self.complaint = None;
    }

    /// Waits until there is something else to play; `false` after Ctrl-C. A contest that cannot be
    /// read meanwhile is reported once, and may become right again: a file may be half-way there.
    pub fn wait(&mut self, file: &Path) -> bool {
        let mut before = None;
        loop {
            for _ in 0..INTERVAL.as_millis() / TICK.as_millis() {
                if interrupt::flag().is_set() {
                    return false;
                }
                thread::sleep(TICK);
            }
            match PlannedContest::read(file) {
                Ok(contest) => {
                    let now = Some(entries(&contest));
                    // Twice the same: nobody is writing a file right now.
                    if now != self.played && now == before {
                        return true;
                    }
                    before = now;
                }
                Err(failure) => {
                    let complaint = failure.report().as_str().to_owned();
                    if self.complaint.as_ref() != Some(&complaint) {
                        message!("{}", failure.report());
                        self.complaint = Some(complaint);
                    }
                    before = None;
                }
            }
        }
    }
}

fn entries(contest: &PlannedContest) -> Vec<(GuestText, Digest, u32)> {
    let robots = contest.robots.iter();
    robots
        .map(|it| {
            let (digest, variant) = it.player();
            (it.robot.name.clone(), digest, variant)
        })
        .collect()
}
