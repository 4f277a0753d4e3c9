//! [`Monitor`]: the thread that starts workers and kills those that take too long.
//!
//! Workers die with the thread that started them, so that thread has to live as long
//! as the supervisor; threads that play matches come and go.

use std::io;
use std::process::{Child, Command};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender, SyncSender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// How often deadlines are checked: a worker is killed at most this late.
const CHECK_INTERVAL: Duration = Duration::from_millis(100);

/// No deadline.
const NEVER: u64 = u64::MAX;

/// Starts workers and watches their deadlines.
pub(super) struct Monitor {
    /// `None` only while it is dropped.
    orders: Option<Sender<Order>>,
    thread: Option<JoinHandle<()>>,
    began: Instant,
}

struct Order {
    command: Command,
    answer: SyncSender<io::Result<Child>>,
    /// Sent back once the caller has put the child where it can be watched.
    watched: mpsc::Receiver<Weak<Watched>>,
}

/// A running process with a deadline.
pub(super) struct Watched {
    child: Mutex<Child>,
    /// Milliseconds since the monitor began, or [`NEVER`].
    deadline: AtomicU64,
    expired: AtomicBool,
    began: Instant,
}

impl Monitor {
    /// Starts the thread.
    pub(super) fn start() -> io::Result<Self> {
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
                            watched.kill_if_expired();
                            true
                        }
                        None => false,
                    });
                }
            })?;
        Ok(Self {
            orders: Some(orders),
            thread: Some(thread),
            began: Instant::now(),
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
            child: Mutex::new(child),
            deadline: AtomicU64::new(NEVER),
            expired: AtomicBool::new(false),
            began: self.began,
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
    /// Kills the process after `time`, unless the deadline is moved or cleared before.
    pub(super) fn set_deadline(&self, time: Duration) {
        let deadline = self.began.elapsed().saturating_add(time).as_millis();
        let deadline = u64::try_from(deadline).unwrap_or(NEVER);
        self.deadline.store(deadline, Ordering::Relaxed);
    }

    /// Lets the process wait for as long as it takes.
    pub(super) fn clear_deadline(&self) {
        self.deadline.store(NEVER, Ordering::Relaxed);
    }

    /// Whether it was killed because it missed its deadline.
    pub(super) fn expired(&self) -> bool {
        self.expired.load(Ordering::Relaxed)
    }

    /// The process.
    pub(super) fn child(&self) -> MutexGuard<'_, Child> {
        // Nothing that holds the lock panics half-way.
        self.child.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn kill_if_expired(&self) {
        let now = u64::try_from(self.began.elapsed().as_millis()).unwrap_or(NEVER);
        if now >= self.deadline.load(Ordering::Relaxed) {
            self.clear_deadline();
            self.expired.store(true, Ordering::Relaxed);
            // It may have ended by itself meanwhile.
            let _ = self.child().kill();
        }
    }
}
