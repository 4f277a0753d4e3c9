//! [`ProcessClock`]: the processor time of a worker, from the operating system.

use std::process::Child;
use std::time::Duration;

#[cfg(target_os = "linux")]
pub(super) use linux::ProcessClock;

#[cfg(target_os = "linux")]
mod linux {
    use std::sync::OnceLock;
    use std::{fs, iter};

    use super::{Child, Duration};

    /// Measures the processor time of a process, and of those that it has started to do its work.
    pub struct ProcessClock {
        process: u32,
        own: Option<libc::clockid_t>,
        inner: OnceLock<Vec<libc::clockid_t>>,
    }

    impl ProcessClock {
        /// How many processes deep a worker may be. In namespaces of its own it is in one that it
        /// has started; a wrapper around the program adds another.
        const DEPTH_MAX: usize = 4;

        pub fn of(child: &Child) -> Self {
            let process = child.id();
            Self {
                process,
                own: process_clock(process),
                inner: OnceLock::new(),
            }
        }

        /// Looks for the processes that a worker has started before it greeted.
        pub fn find_inner(&self) {
            self.inner.get_or_init(|| {
                let inner = iter::successors(first_child(self.process), |it| first_child(*it));
                inner
                    .take(Self::DEPTH_MAX)
                    .filter_map(process_clock)
                    .collect()
            });
        }

        /// The time of all its threads by now. The process is not reaped while it is watched, so
        /// its number means no other one; nor are the inner ones, as long as they work.
        pub fn time(&self) -> Duration {
            let inner = self.inner.get().into_iter().flatten().copied();
            let clocks = self.own.into_iter().chain(inner);
            clocks.filter_map(crate::time::clock_time).sum()
        }
    }

    /// The process that this one has started first.
    fn first_child(process: u32) -> Option<u32> {
        let children = fs::read_to_string(format!("/proc/{process}/task/{process}/children"));
        children.ok()?.split_whitespace().next()?.parse().ok()
    }

    /// The clock of a process; `None` when there is no such process.
    fn process_clock(process: u32) -> Option<libc::clockid_t> {
        let process = libc::pid_t::try_from(process).ok()?;
        let mut clock = 0;
        // SAFETY: the call writes to `clock` and to nothing else.
        let result = unsafe { libc::clock_getcpuclockid(process, &raw mut clock) };
        (result == 0).then_some(clock)
    }
}

/// Measures the processor time of a process, which can start no other one.
#[cfg(windows)]
pub(super) struct ProcessClock(Option<std::os::windows::io::OwnedHandle>);

#[cfg(windows)]
impl ProcessClock {
    pub(super) fn of(child: &Child) -> Self {
        use std::os::windows::io::AsHandle as _;
        Self(child.as_handle().try_clone_to_owned().ok())
    }

    #[expect(
        clippy::unused_self,
        reason = "the signature of the clocks of other systems"
    )]
    pub(super) const fn find_inner(&self) {}

    pub(super) fn time(&self) -> Duration {
        let process = self.0.as_ref();
        let time = process.and_then(crate::time::process_time);
        time.unwrap_or_default()
    }
}

/// Elsewhere, time on the wall clock, which is more.
#[cfg(not(any(target_os = "linux", windows)))]
pub(super) struct ProcessClock(std::time::Instant);

#[cfg(not(any(target_os = "linux", windows)))]
impl ProcessClock {
    pub(super) fn of(_: &Child) -> Self {
        Self(std::time::Instant::now())
    }

    #[expect(
        clippy::unused_self,
        reason = "the signature of the clocks of other systems"
    )]
    pub(super) const fn find_inner(&self) {}

    pub(super) fn time(&self) -> Duration {
        self.0.elapsed()
    }
}
