//! [`Recorder`]: a thread that writes matches into the store while others are played.
//!
//! A transaction waits for the disk. Were it written by the thread whose match has just ended,
//! every other thread that ends one meanwhile would wait with it.

use std::io;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, sync_channel};
use std::thread::{self, Scope, ScopedJoinHandle};
use std::time::{Duration, Instant};

use crate::contest::{ContestMaze, Ended, Sink as _};
use crate::store::StoreSink;

/// Matches are on the disk after this much time at the latest.
const FLUSH: Duration = Duration::from_secs(1);

/// Matches that wait to be written, at most. Whoever plays more than the disk takes waits.
const QUEUE: usize = 8192;

/// How long the thread sleeps between two looks at the queue. Were it woken for each match, it
/// would take a processor from a match in progress each time.
const PAUSE: Duration = Duration::from_millis(50);

/// Takes matches from any thread.
pub struct Recorder<'scope> {
    queue: SyncSender<(Arc<ContestMaze>, Arc<Ended>)>,
    thread: ScopedJoinHandle<'scope, io::Result<()>>,
}

impl<'scope> Recorder<'scope> {
    /// Starts the thread.
    ///
    /// # Errors
    ///
    /// When the system has no more threads.
    pub fn start<'env>(
        scope: &'scope Scope<'scope, 'env>,
        sink: StoreSink<'env>,
    ) -> io::Result<Self> {
        let (queue, received) = sync_channel(QUEUE);
        let thread = thread::Builder::new()
            .name("store".to_owned())
            .spawn_scoped(scope, move || record(sink, &received))?;
        Ok(Self { queue, thread })
    }

    /// Writes a match soon. Waits while too many others are waiting.
    ///
    /// # Errors
    ///
    /// When the thread has ended because the store failed; [`Recorder::finish`] says why.
    pub fn put(&self, maze: &Arc<ContestMaze>, ended: &Arc<Ended>) -> io::Result<()> {
        self.queue
            .send((Arc::clone(maze), Arc::clone(ended)))
            .map_err(|_| io::ErrorKind::BrokenPipe.into())
    }

    /// Waits until everything has been written.
    ///
    /// # Errors
    ///
    /// When something could not be written; the error of the store is inside.
    pub fn finish(self) -> io::Result<()> {
        drop(self.queue);
        self.thread.thread().unpark();
        self.thread
            .join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }
}

/// Writes what is received until nobody is left to send anything.
fn record(
    mut sink: StoreSink<'_>,
    received: &Receiver<(Arc<ContestMaze>, Arc<Ended>)>,
) -> io::Result<()> {
    let mut flushed = Instant::now();
    loop {
        match received.try_recv() {
            Ok((maze, ended)) => {
                sink.maze(&maze)?;
                match &*ended {
                    Ended::Played(played) => sink.played(played)?,
                    Ended::Failed(failure) => sink.failed(failure)?,
                    Ended::Withdrawn(failure) => sink.withdrawn(failure)?,
                }
                continue;
            }
            Err(TryRecvError::Empty) => {}
            Err(TryRecvError::Disconnected) => {
                sink.finish()?;
                return Ok(());
            }
        }
        if flushed.elapsed() >= FLUSH {
            sink.flush()?;
            flushed = Instant::now();
        }
        thread::park_timeout(PAUSE);
    }
}
