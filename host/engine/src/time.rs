//! Processor time: how much of it a match and a robot may take, and who may end everything.
//!
//! Fuel decides how a match ends. Time protects the other robots of a contest from one whose
//! fuel lasts for hours, and is never a verdict. What is measured is processor time, so that a
//! busy machine is not held against a robot. [`Control`] has what holds for all matches,
//! [`Account`] what one robot has used, and [`MatchClock`] watches a match in this process;
//! the monitor of the supervisor does the same for worker processes.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};
use std::time::Duration;

use wasmouse_core::game::SandboxLimits;

use crate::error::{InfrastructureError, Withdrawal};

/// Processor time of a match after which it is given up, by default and for the match fuel of the
/// default limits. All of that fuel lasts 2 s in a robot like flood and 25 s in work that takes ten
/// times as long for its fuel; the rest is for slower machines. What reaches this is a robot that
/// waits for memory all the time.
pub const MATCH_TIME_MAX: Duration = Duration::from_secs(60);

/// The match fuel that default times are about: that of the default limits.
const MATCH_FUEL: u64 = 20_000_000_000;

/// No default time of a match is longer.
const FACTOR_MAX: u64 = 24 * 60;

/// How many times the match fuel of the default limits a match may use, rounded up. Default times
/// are multiplied by it, so that a robot that uses all its fuel is never put off for its time.
/// Range: 1 to 1440.
pub const fn time_factor(limits: &SandboxLimits) -> u64 {
    match limits.match_fuel_max.div_ceil(MATCH_FUEL) {
        0 => 1,
        FACTOR_MAX.. => FACTOR_MAX,
        factor => factor,
    }
}

/// Processor time of a match under these limits after which it is given up, by default:
/// [`MATCH_TIME_MAX`] for the default limits and those with less fuel, up to a day for more.
pub const fn match_time_max(limits: &SandboxLimits) -> Duration {
    Duration::from_secs(MATCH_TIME_MAX.as_secs() * time_factor(limits))
}

/// How often a robot may exceed the time of a match. The second time may still be an accident of
/// the machine, but the contest does not wait for a third.
const STALLS_MAX: u32 = 2;

/// A robot whose matches take longer than this on average is slow. All the fuel of a match lasts
/// about as long in a robot like flood.
const SLOW_MATCH: Duration = Duration::from_secs(1);

/// Ends everything that is being admitted or played, when it is set; it is never unset. Clones
/// are the same flag.
#[derive(Clone, Debug, Default)]
pub struct CancelFlag(Arc<AtomicBool>);

impl CancelFlag {
    /// Sets it. Matches in progress end within half a second and have no result.
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it is set.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The flag as an atomic, for those who only ask.
    pub fn as_atomic(&self) -> &AtomicBool {
        &self.0
    }

    /// The flag as an atomic that is shared, for those who set it while a signal is handled.
    pub fn to_atomic(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }
}

/// What ends matches besides fuel and rules; the same for all matches of an executor.
#[derive(Clone, Debug)]
pub struct Control {
    /// Processor time of a match, at most. Default [`MATCH_TIME_MAX`].
    pub match_time: Duration,
    /// Ends all matches.
    pub cancel: CancelFlag,
}

impl Default for Control {
    fn default() -> Self {
        Self {
            match_time: MATCH_TIME_MAX,
            cancel: CancelFlag::default(),
        }
    }
}

/// The processor time that a robot has used in its matches, and may use.
#[derive(Debug)]
pub struct Account {
    /// In nanoseconds; `u64::MAX` when there is no budget.
    budget: AtomicU64,
    used: AtomicU64,
    /// Matches that ended.
    matches: AtomicU64,
    /// Matches that were given up.
    stalls: AtomicU32,
}

impl Default for Account {
    fn default() -> Self {
        Self {
            budget: AtomicU64::new(u64::MAX),
            used: AtomicU64::new(0),
            matches: AtomicU64::new(0),
            stalls: AtomicU32::new(0),
        }
    }
}

impl Account {
    /// Sets how much the robot may use in all, from its first match on. There is no limit before.
    pub fn set_budget(&self, budget: Duration) {
        self.budget.store(nanoseconds(budget), Ordering::Relaxed);
    }

    /// How much it has used, matches in progress included.
    pub fn used(&self) -> Duration {
        Duration::from_nanos(self.used.load(Ordering::Relaxed))
    }

    /// Whether its matches take so long that other robots should play first.
    pub fn is_slow(&self) -> bool {
        let matches = self.matches.load(Ordering::Relaxed).saturating_add(1);
        let usual = nanoseconds(SLOW_MATCH).saturating_mul(matches);
        self.stalls.load(Ordering::Relaxed) > 0 || self.used.load(Ordering::Relaxed) > usual
    }

    /// Why the robot plays no more matches; `None` while it does.
    pub fn withdrawal(&self) -> Option<Withdrawal> {
        let budget = self.budget.load(Ordering::Relaxed);
        if self.stalls.load(Ordering::Relaxed) >= STALLS_MAX {
            Some(Withdrawal::Stalled { times: STALLS_MAX })
        } else if self.used.load(Ordering::Relaxed) >= budget {
            Some(Withdrawal::Spent {
                seconds: Duration::from_nanos(budget).as_secs(),
            })
        } else {
            None
        }
    }

    /// [`Account::withdrawal`] as an error.
    pub(crate) fn check(&self) -> Result<(), InfrastructureError> {
        match self.withdrawal() {
            Some(withdrawal) => Err(InfrastructureError::Withdrawn(withdrawal)),
            None => Ok(()),
        }
    }

    /// Adds time that was used.
    pub(crate) fn charge(&self, time: Duration) {
        self.used.fetch_add(nanoseconds(time), Ordering::Relaxed);
    }

    /// Counts a match that ended.
    pub(crate) fn count_match(&self) {
        self.matches.fetch_add(1, Ordering::Relaxed);
    }

    /// Counts a match that took too long.
    pub(crate) fn count_stall(&self) {
        self.stalls.fetch_add(1, Ordering::Relaxed);
    }
}

fn nanoseconds(time: Duration) -> u64 {
    u64::try_from(time.as_nanos()).unwrap_or(u64::MAX)
}

/// Measures one match on the thread that plays it.
#[derive(Debug)]
pub(crate) struct MatchClock {
    control: Control,
    account: Option<Arc<Account>>,
    began: Duration,
    /// When the account was charged last, in nanoseconds of this thread.
    charged: AtomicU64,
}

impl MatchClock {
    /// The clock of a match that begins now, on this thread.
    pub(crate) fn start(control: Control, account: Option<Arc<Account>>) -> Arc<Self> {
        let began = thread_time();
        Arc::new(Self {
            control,
            account,
            began,
            charged: AtomicU64::new(nanoseconds(began)),
        })
    }

    /// Charges the account, and says whether the match may go on. To be called on the thread of
    /// the match, now and then.
    ///
    /// # Errors
    ///
    /// The reason why the match has to end.
    pub(crate) fn check(&self) -> Result<(), InfrastructureError> {
        if self.control.cancel.is_set() {
            return Err(InfrastructureError::Cancelled);
        }
        let now = self.charge();
        if now.saturating_sub(self.began) > self.control.match_time {
            return Err(InfrastructureError::Slow {
                seconds: self.control.match_time.as_secs(),
            });
        }
        self.account.as_ref().map_or(Ok(()), |it| it.check())
    }

    /// Charges the account with what was used since it was charged last. To be called at the
    /// end of the match, on its thread.
    pub(crate) fn charge(&self) -> Duration {
        let now = thread_time();
        let before = self.charged.swap(nanoseconds(now), Ordering::Relaxed);
        if let Some(account) = &self.account {
            account.charge(now.saturating_sub(Duration::from_nanos(before)));
        }
        now
    }
}

/// The processor time of the calling thread.
#[cfg(unix)]
fn thread_time() -> Duration {
    clock_time(libc::CLOCK_THREAD_CPUTIME_ID).unwrap_or_default()
}

/// The processor time of the calling thread, in steps of about 16 ms.
#[cfg(windows)]
fn thread_time() -> Duration {
    use windows_sys::Win32::System::Threading::{GetCurrentThread, GetThreadTimes};

    let time = processor_time(|created, ended, kernel, user| {
        // SAFETY: the handle always means the calling thread, and the call writes to the four
        // times and to nothing else.
        unsafe { GetThreadTimes(GetCurrentThread(), created, ended, kernel, user) }
    });
    time.unwrap_or_default()
}

/// The processor time of a process; `None` when the system does not tell.
#[cfg(windows)]
pub(crate) fn process_time(process: &impl std::os::windows::io::AsRawHandle) -> Option<Duration> {
    use windows_sys::Win32::System::Threading::GetProcessTimes;

    let handle = process.as_raw_handle();
    processor_time(|created, ended, kernel, user| {
        // SAFETY: the handle is borrowed, so it is open, and the call writes to the four times and
        // to nothing else.
        unsafe { GetProcessTimes(handle, created, ended, kernel, user) }
    })
}

#[cfg(windows)]
type FileTime = windows_sys::Win32::Foundation::FILETIME;

/// The time in the kernel and outside of it, by a function that writes when something was created,
/// when it ended, and these two, and returns zero when it fails.
#[cfg(windows)]
fn processor_time(
    times: impl FnOnce(*mut FileTime, *mut FileTime, *mut FileTime, *mut FileTime) -> i32,
) -> Option<Duration> {
    const ZERO: FileTime = FileTime {
        dwLowDateTime: 0,
        dwHighDateTime: 0,
    };
    /// Nanoseconds.
    const UNIT: u64 = 100;

    let (mut created, mut ended, mut kernel, mut user) = (ZERO, ZERO, ZERO, ZERO);
    let result = times(
        &raw mut created,
        &raw mut ended,
        &raw mut kernel,
        &raw mut user,
    );
    let units =
        |time: FileTime| u64::from(time.dwHighDateTime) << 32 | u64::from(time.dwLowDateTime);
    let total = units(kernel).saturating_add(units(user));
    (result != 0).then(|| Duration::from_nanos(total.saturating_mul(UNIT)))
}

/// The time of a clock of the system; `None` when there is no such clock.
#[cfg(unix)]
pub(crate) fn clock_time(clock: libc::clockid_t) -> Option<Duration> {
    let mut time = libc::timespec {
        tv_sec: 0,
        tv_nsec: 0,
    };
    // SAFETY: the call writes to `time` and to nothing else.
    let result = unsafe { libc::clock_gettime(clock, &raw mut time) };
    let seconds = u64::try_from(time.tv_sec).ok()?;
    let nanoseconds = u32::try_from(time.tv_nsec).ok()?;
    (result == 0).then(|| Duration::new(seconds, nanoseconds))
}

#[cfg(test)]
mod tests {
    use std::thread;

    use wasmouse_core::game::FuelClass;

    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn a_budget_that_is_spent_withdraws() {
        let account = Account::default();
        account.charge(1000 * SECOND);
        assert_eq!(account.withdrawal(), None, "there is no budget yet");
        account.set_budget(1001 * SECOND);
        account.check().expect("one second is left");
        account.charge(SECOND);
        assert_eq!(
            account.withdrawal(),
            Some(Withdrawal::Spent { seconds: 1001 })
        );
    }

    #[test]
    fn default_times_grow_with_the_fuel() {
        let time = |fuel| {
            match_time_max(&SandboxLimits {
                match_fuel_max: fuel,
                ..SandboxLimits::default()
            })
        };
        assert_eq!(MATCH_FUEL, SandboxLimits::default().match_fuel_max);
        for fuel in [0, 1, MATCH_FUEL] {
            assert_eq!(time(fuel), MATCH_TIME_MAX);
        }
        assert_eq!(time(MATCH_FUEL + 1), 2 * MATCH_TIME_MAX);
        let interpreted = FuelClass::Interpreted.limits();
        assert_eq!(match_time_max(&interpreted), 10 * MATCH_TIME_MAX);
        assert_eq!(time(u64::MAX), Duration::from_secs(86_400));
    }

    #[test]
    fn the_second_stall_withdraws() {
        let account = Account::default();
        account.count_stall();
        assert!(account.is_slow());
        account.check().expect("once may be an accident");
        account.count_stall();
        assert_eq!(account.withdrawal(), Some(Withdrawal::Stalled { times: 2 }));
    }

    #[test]
    fn slow_is_what_takes_long_on_average() {
        let account = Account::default();
        for _ in 0..10 {
            account.charge(SECOND / 10);
            account.count_match();
        }
        assert!(!account.is_slow());
        account.charge(11 * SECOND);
        assert!(account.is_slow(), "one match of 11 s among ten of 0.1 s");
    }

    #[test]
    fn sleeping_takes_no_processor_time() {
        let account = Arc::new(Account::default());
        let control = Control {
            match_time: SECOND / 10,
            ..Control::default()
        };
        let clock = MatchClock::start(control.clone(), Some(Arc::clone(&account)));
        thread::sleep(SECOND / 5);
        if cfg!(unix) {
            clock.check().expect("it has only slept");
        }
        while clock.charge() < clock.began + control.match_time {}
        let error = clock.check().expect_err("it was busy");
        assert!(matches!(error, InfrastructureError::Slow { .. }), "{error}");
        assert!(account.used() >= control.match_time);
        control.cancel.set();
        let error = clock.check().expect_err("it was cancelled");
        assert!(matches!(error, InfrastructureError::Cancelled), "{error}");
    }
}
