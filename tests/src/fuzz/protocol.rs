//! The pipe between supervisor and workers, with either side gone mad.

use wasmouse::robot::bundled::find;
use wasmouse::robot::worker::fuzz::{self, Worker};

use super::Target;

pub(super) const TARGETS: [Target; 2] = [
    Target {
        name: "answers",
        about: "frames from a worker that a robot has taken over",
        seeds: || fuzz::examples(flood()),
        words: &[],
        bytes_max: 64 << 10,
        make: || Box::new(fuzz::judge),
        short: 10_000,
        takes_modules: false,
    },
    Target {
        name: "requests",
        about: "frames to a worker that plays",
        seeds: Worker::examples,
        words: &[],
        bytes_max: 8 << 10,
        make: || {
            let mut worker = Worker::new(flood());
            Box::new(move |bytes| worker.serve(bytes))
        },
        short: 4000,
        takes_modules: false,
    },
];

fn flood() -> &'static [u8] {
    find("flood").expect("a bundled robot").component
}
