//! [`Monitor`]: the thread that starts workers and kills those that take too long.
//!
//! Workers die with the thread that started them, so that thread has to live as long
//! as the supervisor; threads that play matches come and go.
//!
//! What a worker may take is measured here and not believed: processor time comes from the
//! operating system.

use std::io;
use std::process::{Child, Command};
use std::sync::mpsc::{self, RecvTimeoutError, Sender, SyncSender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::clock::ProcessClock;
use crate::time::{Account, CancelFlag};

/// How often workers are checked: one is killed at most this late.
const CHECK_INTERVAL: Duration = Duration::from_millis(100);

/// Starts workers and watches them.
pub(super) struct Monitor {
    /// `None` only while it is dropped.
    orders: Option<Sender<Order>>,
    thread: Option<JoinHandle<()>>,
}

struct Order {
    command: Command,
    answer: SyncSender<io::Result<Child>>,
    /// Sent back once the caller has put the child where it can be watched.
    watched: mpsc::Receiver<Weak<Watched>>,
}

/// What a worker may take in one exchange.
#[derive(Clone)]
pub(super) struct Limit {
    /// Time on the wall clock, for the exchange or for each of its matches.
    pub(super) wall: Duration,
    /// For matches: the processor time of each, and the account of the robot.
    pub(super) matches: Option<(Duration, Arc<Account>)>,
}

impl Limit {
    /// A limit on the wall clock alone.
    pub(super) const fn wall(wall: Duration) -> Self {
        Self {
            wall,
            matches: None,
        }
    }
}

/// Why the supervisor killed a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kill {
    /// It took too long on the wall clock.
    Deadline,
    /// A match took too much processor time.
    Slow,
    /// The robot's account is spent.
    Withdrawn,
    /// Everything was cancelled.
    Cancelled,
}

/// A running process.
pub(super) struct Watched {
    child: Mutex<Child>,
    clock: ProcessClock,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    exchange: Option<Exchange>,
    killed: Option<Kill>,
}

/// An exchange in progress.
struct Exchange {
    limit: Limit,
    deadline: Instant,
    /// The process's time when the exchange or its current match began.
    began: Duration,
    /// The process's time when the account was charged last.
    charged: Duration,
}

impl Monitor {
    /// Starts the thread.
    pub(super) fn start(cancel: CancelFlag) -> io::Result<Self> {
        let (orders, receive) = mpsc::channel::<Order>();
        let thread = thread::Builder::new()
            .name("worker-monitor".into())
            .spawn(move || {
                let mut all: Vec<Weak<Watched>> = Vec::new();
                loop {
                    match receive.recv_timeout(CHECK_INTERVAL) {
                        Ok(mut order) => {
                            let _ = order.answer.send(order.command.spawn());
                            all.extend(order.watched.recv());
                        }
                        Err(RecvTimeoutError::Timeout) => {}
                        Err(RecvTimeoutError::Disconnected) => return,
                    }
                    all.retain(|watched| match watched.upgrade() {
                        Some(watched) => {
                            watched.check(&cancel);
                            true
                        }
                        None => false,
                    });
                }
            })?;
        Ok(Self {
            orders: Some(orders),
            thread: Some(thread),
        })
    }

    /// Starts a process. The caller takes its pipes out of the child that
    /// `take` gets.
    pub(super) fn spawn<T>(
        &self,
        command: Command,
        take: impl FnOnce(&mut Child) -> T,
    ) -> io::Result<(Arc<Watched>, T)> {
        let gone = || io::Error::other("the thread that starts workers is gone");
        let (answer, answered) = mpsc::sync_channel(1);
        let (watch, watched) = mpsc::channel();
        let order = Order {
            command,
            answer,
            watched,
        };
        let orders = self.orders.as_ref().ok_or_else(gone)?;
        orders.send(order).map_err(|_| gone())?;
        let mut child = answered.recv().map_err(|_| gone())??;
        let taken = take(&mut child);
        let process = Arc::new(Watched {
            clock: ProcessClock::of(&child),
            child: Mutex::new(child),
            state: Mutex::new(State::default()),
        });
        // The monitor waits for it.
        let _ = watch.send(Arc::downgrade(&process));
        Ok((process, taken))
    }
}

impl Drop for Monitor {
    fn drop(&mut self) {
        self.orders = None;
        if let Some(thread) = self.thread.take() {
            // It does nothing that panics.
            let _ = thread.join();
        }
    }
}

impl Watched {
    /// From now on, the process may take what the limit says.
    pub(super) fn begin(&self, limit: Limit) {
        if limit.matches.is_some() {
            self.clock.find_inner();
        }
        let now = self.clock.time();
        let mut state = self.state();
        state.exchange = Some(Exchange {
            deadline: Instant::now() + limit.wall,
            limit,
            began: now,
            charged: now,
        });
        // It was killed when it had just finished something: that was not this robot's doing.
        state.killed = None;
    }

    /// The next match of the exchange begins.
    pub(super) fn next_match(&self) {
        let now = self.clock.time();
        if let Some(exchange) = &mut self.state().exchange {
            exchange.charge(now);
            exchange.deadline = Instant::now() + exchange.limit.wall;
            exchange.began = now;
        }
    }

    /// The exchange is over, and the process may wait for as long as it takes.
    pub(super) fn end(&self) {
        let now = self.clock.time();
        if let Some(mut exchange) = self.state().exchange.take() {
            exchange.charge(now);
        }
    }

    /// Why the supervisor killed it, if it did.
    pub(super) fn killed(&self) -> Option<Kill> {
        self.state().killed
    }

    /// The process. Not to be held during an exchange.
    pub(super) fn child(&self) -> MutexGuard<'_, Child> {
        lock(&self.child)
    }

    fn check(&self, cancel: &CancelFlag) {
        let mut state = self.state();
        let Some(exchange) = &mut state.exchange else {
            return;
        };
        let now = self.clock.time();
        exchange.charge(now);
        let kill = if cancel.is_set() {
            Some(Kill::Cancelled)
        } else {
            exchange.excess(now)
        };
        if let Some(kill) = kill {
            state.exchange = None;
            state.killed = Some(kill);
            // It may have ended by itself meanwhile.
            let _ = self.child().kill();
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        lock(&self.state)
    }
}

impl Exchange {
    fn charge(&mut self, now: Duration) {
        if let Some((_, account)) = &self.limit.matches {
            account.charge(now.saturating_sub(self.charged));
            self.charged = now;
        }
    }

    fn excess(&self, now: Duration) -> Option<Kill> {
        if Instant::now() >= self.deadline {
            return Some(Kill::Deadline);
        }
        let (match_time, account) = self.limit.matches.as_ref()?;
        if now.saturating_sub(self.began) >= *match_time {
            Some(Kill::Slow)
        } else {
            account.withdrawal().map(|_| Kill::Withdrawn)
        }
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Nothing that holds a lock panics half-way.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
