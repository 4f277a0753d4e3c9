//! [`Groups`]: a control group for each worker, where the system has given this process a part of
//! the hierarchy (version 2) to arrange as it likes.
//!
//! A group limits what the limits of a process do not count, such as files in memory, and it ends
//! as a whole. systemd gives one to `systemd-run --user --scope -p Delegate=yes wasmouse ...`.
//! Elsewhere there usually is none, and workers have the limits of a process alone. On Windows,
//! `job` takes the place of this file.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{self, Child};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

use super::super::role::{COMPILE_MEMORY_BYTES, RUN_MEMORY_BYTES, Role};

/// What has to be there to limit a worker.
const CONTROLLERS: [&str; 2] = ["memory", "pids"];

/// The group of the supervisor itself: a group whose children are limited has no processes of
/// its own.
const OWN: &str = "wasmouse-supervisor";

/// What the name of a worker's group begins with; the supervisor's process number and a number
/// follow.
const PREFIX: &str = "wasmouse-worker-";

/// Processes and threads of a worker: two processes, and one of them has a thread for each of a
/// few duties.
const TASKS_MAX: u32 = 32;

/// A group counts more than the limits of a process do: page tables, pipes, files in memory. With
/// so much more, in bytes, what a file may need to be compiled is decided by the limits that are
/// the same everywhere.
const EXTRA_BYTES: u64 = 256 << 20;

/// Where this process may make groups.
#[derive(Debug)]
pub(super) struct Groups {
    base: PathBuf,
}

/// The number of the next group: of all supervisors of this process, so that names differ.
static NEXT: AtomicU64 = AtomicU64::new(0);

impl Groups {
    /// The part of the hierarchy that is this process's, if any. May move this process into a group
    /// below its own, where it is alone in that.
    pub(super) fn find() -> Option<Self> {
        let own = fs::read_to_string("/proc/self/cgroup").ok()?;
        let mounts = fs::read_to_string("/proc/self/mountinfo").ok()?;
        let base = base(&folder(&own, &mounts)?)?;
        remove_abandoned(&base);
        let groups = Self { base };
        // Whether groups can be made and limited shows when one is.
        groups.create(Role::Run).map(|_| groups)
    }

    /// A group for a worker; `None` where it cannot be made any more.
    pub(super) fn create(&self, role: Role) -> Option<Group> {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("{PREFIX}{}-{number}", process::id());
        let folder = self.base.join(name);
        fs::create_dir(&folder).ok()?;
        // Removes it again if the rest fails.
        let group = Group {
            folder: folder.into(),
        };
        let memory = match role {
            Role::Compile => COMPILE_MEMORY_BYTES,
            Role::Run | Role::Backtrace => RUN_MEMORY_BYTES,
        };
        group.set("memory.max", memory + EXTRA_BYTES).ok()?;
        group.set("pids.max", TASKS_MAX).ok()?;
        // Where swap is not counted, there is no such file.
        let _ = group.set("memory.swap.max", 0);
        group.set("memory.oom.group", 1).ok()?;
        Some(group)
    }
}

/// The folder of this process's group.
fn folder(own: &str, mounts: &str) -> Option<PathBuf> {
    let own = own.lines().find_map(|line| line.strip_prefix("0::"))?;
    mounts.lines().find_map(|line| {
        let (mount, kind) = line.split_once(" - ")?;
        if kind.split(' ').next() != Some("cgroup2") {
            return None;
        }
        let mut fields = mount.split(' ').skip(3);
        let (root, point) = (fields.next()?, fields.next()?);
        let below = Path::new(own).strip_prefix(root).ok()?;
        Some(Path::new(point).join(below))
    })
}

/// Where groups of workers go, for a process in that group.
fn base(own: &Path) -> Option<PathBuf> {
    let parent = own.parent()?;
    if own.file_name().is_some_and(|name| name == OWN) && lists(parent, "cgroup.subtree_control") {
        return Some(parent.to_owned());
    }
    if lists(own, "cgroup.subtree_control") {
        return Some(own.to_owned());
    }
    let alone = fs::read_to_string(own.join("cgroup.procs")).ok()?;
    if alone.trim() != process::id().to_string() || !lists(own, "cgroup.controllers") {
        return None;
    }
    let below = own.join(OWN);
    fs::create_dir(&below).ok()?;
    let moved = fs::write(below.join("cgroup.procs"), "0")
        .and_then(|()| fs::write(own.join("cgroup.subtree_control"), "+memory +pids"));
    if moved.is_err() {
        // As it was before.
        let _ = fs::write(own.join("cgroup.procs"), "0");
        let _ = fs::remove_dir(&below);
        return None;
    }
    Some(own.to_owned())
}

/// Whether that file of a group lists what is needed.
fn lists(group: &Path, file: &str) -> bool {
    let text = fs::read_to_string(group.join(file)).unwrap_or_default();
    let there: Vec<&str> = text.split_whitespace().collect();
    CONTROLLERS.iter().all(|needed| there.contains(needed))
}

/// Removes groups that supervisors left behind which were killed. Their workers have ended with
/// them; a group with a process cannot be removed.
fn remove_abandoned(base: &Path) {
    for entry in fs::read_dir(base).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let supervisor = name
            .to_str()
            .and_then(|name| name.strip_prefix(PREFIX)?.split('-').next());
        if supervisor.is_some_and(|it| !Path::new("/proc").join(it).exists()) {
            let _ = fs::remove_dir(entry.path());
        }
    }
}

/// The group of one worker. Dropping it kills what is in it.
#[derive(Debug)]
pub(super) struct Group {
    folder: Box<Path>,
}

impl Group {
    /// Puts a process into the group, and what that starts from then on.
    ///
    /// # Errors
    ///
    /// When it has ended, or the group is gone.
    pub(super) fn add(&self, process: &Child) -> io::Result<()> {
        self.set("cgroup.procs", process.id())
    }

    /// Whether the kernel killed a process of it because the group had no memory left.
    pub(super) fn is_out_of_memory(&self) -> bool {
        let events = fs::read_to_string(self.folder.join("memory.events")).unwrap_or_default();
        let mut lines = events.lines();
        let kills = lines.find_map(|line| line.strip_prefix("oom_kill "));
        kills.is_some_and(|kills| kills.trim() != "0")
    }

    fn set(&self, file: &str, value: impl ToString) -> io::Result<()> {
        // Files of a group exist with it; none may be created.
        let mut file = fs::OpenOptions::new()
            .write(true)
            .open(self.folder.join(file))?;
        io::Write::write_all(&mut file, value.to_string().as_bytes())
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        const LOOKS: u32 = 100;
        // Since Linux 5.14; before, the end of the first process ends the others.
        let _ = self.set("cgroup.kill", 1);
        for _ in 0..LOOKS {
            match fs::remove_dir(&self.folder) {
                // A process needs a moment to end.
                Err(error) if error.kind() == io::ErrorKind::ResourceBusy => {
                    thread::sleep(Duration::from_millis(1));
                }
                _ => return,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_own_group_is_found_in_all_hierarchies() {
        const HYBRID: &str = "31 23 0:27 / /sys/fs/cgroup rw - tmpfs tmpfs rw\n\
            32 31 0:28 / /sys/fs/cgroup/cpu rw,relatime - cgroup cgroup rw,cpu\n\
            41 31 0:38 / /sys/fs/cgroup/unified rw,relatime shared:9 - cgroup2 cgroup2 rw\n";
        const UNIFIED: &str = "30 23 0:26 /user /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n";
        let found = folder("4:memory:/a\n0::/b/c\n", HYBRID);
        assert_eq!(found, Some("/sys/fs/cgroup/unified/b/c".into()));
        let found = folder("0::/user/x\n", UNIFIED);
        assert_eq!(found, Some("/sys/fs/cgroup/x".into()));
        // It is not in that part of the hierarchy.
        assert_eq!(folder("0::/other\n", UNIFIED), None);
        assert_eq!(folder("4:memory:/a\n", HYBRID), None);
    }
}
