//! [`Groups`] on Windows: a job object for each worker. The neighbour `group` does the same with
//! Linux's control groups.
//!
//! A job limits the memory of its process, lets it start no other one, keeps it from the clipboard,
//! the desktop and the windows of others, and ends it when the supervisor's handle is closed, also
//! because the supervisor was killed. It does not keep the process from files and the network:
//! Windows has no counterpart of landlock and seccomp that a process without privileges could use.

use std::ffi::c_void;
use std::io;
use std::mem;
use std::os::windows::io::{AsRawHandle as _, FromRawHandle as _, OwnedHandle};
use std::process::Child;
use std::ptr;

use windows_sys::Win32::System::JobObjects::{
    AssignProcessToJobObject, CreateJobObjectW, JOB_OBJECT_LIMIT_ACTIVE_PROCESS,
    JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION, JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE,
    JOB_OBJECT_LIMIT_PROCESS_MEMORY, JOB_OBJECT_UILIMIT_DESKTOP,
    JOB_OBJECT_UILIMIT_DISPLAYSETTINGS, JOB_OBJECT_UILIMIT_EXITWINDOWS,
    JOB_OBJECT_UILIMIT_GLOBALATOMS, JOB_OBJECT_UILIMIT_HANDLES, JOB_OBJECT_UILIMIT_READCLIPBOARD,
    JOB_OBJECT_UILIMIT_SYSTEMPARAMETERS, JOB_OBJECT_UILIMIT_WRITECLIPBOARD,
    JOBOBJECT_BASIC_UI_RESTRICTIONS, JOBOBJECT_EXTENDED_LIMIT_INFORMATION, JOBOBJECTINFOCLASS,
    JobObjectBasicUIRestrictions, JobObjectExtendedLimitInformation, SetInformationJobObject,
};

use super::super::role::{COMPILE_MEMORY_BYTES, RUN_MEMORY_BYTES, Role};

/// What a process commits besides its heap, in bytes: stacks, tables, the program itself.
const EXTRA_BYTES: u64 = 256 << 20;

/// Everything that a job can keep a process from doing to the session of the user.
const NO_USER_INTERFACE: u32 = JOB_OBJECT_UILIMIT_DESKTOP
    | JOB_OBJECT_UILIMIT_DISPLAYSETTINGS
    | JOB_OBJECT_UILIMIT_EXITWINDOWS
    | JOB_OBJECT_UILIMIT_GLOBALATOMS
    | JOB_OBJECT_UILIMIT_HANDLES
    | JOB_OBJECT_UILIMIT_READCLIPBOARD
    | JOB_OBJECT_UILIMIT_SYSTEMPARAMETERS
    | JOB_OBJECT_UILIMIT_WRITECLIPBOARD;

/// Makes jobs. Every version of Windows that Rust supports has them.
#[derive(Debug)]
pub(super) struct Groups;

impl Groups {
    /// Whether a job can be made and limited.
    pub(super) fn find() -> Option<Self> {
        Self.create(Role::Run).map(|_| Self)
    }

    /// A job for a worker; `None` where it cannot be made.
    pub(super) fn create(&self, role: Role) -> Option<Group> {
        Group::new(role).ok()
    }
}

/// The job of one worker. Dropping it kills the worker.
#[derive(Debug)]
pub(super) struct Group {
    job: OwnedHandle,
}

impl Group {
    fn new(role: Role) -> io::Result<Self> {
        // SAFETY: a job without a name and without attributes; both may be null.
        let job = unsafe { CreateJobObjectW(ptr::null(), ptr::null()) };
        if job.is_null() {
            return Err(io::Error::last_os_error());
        }
        // SAFETY: the call has just returned this handle, and nothing else owns it.
        let job = unsafe { OwnedHandle::from_raw_handle(job) };
        let group = Self { job };
        let memory = match role {
            Role::Compile => COMPILE_MEMORY_BYTES,
            Role::Run | Role::Backtrace => RUN_MEMORY_BYTES,
        };
        // SAFETY: the structure consists of numbers, for which zeros are valid and mean no limit.
        let mut limits: JOBOBJECT_EXTENDED_LIMIT_INFORMATION = unsafe { mem::zeroed() };
        limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE
            | JOB_OBJECT_LIMIT_PROCESS_MEMORY
            | JOB_OBJECT_LIMIT_ACTIVE_PROCESS
            // Without it, a crash may wait in a dialog for somebody to close it.
            | JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
        limits.BasicLimitInformation.ActiveProcessLimit = 1;
        // What is reserved does not count, only what is committed: a pool of instances reserves
        // terabytes.
        limits.ProcessMemoryLimit = usize::try_from(memory + EXTRA_BYTES).unwrap_or(usize::MAX);
        group.set(JobObjectExtendedLimitInformation, &limits)?;
        let restrictions = JOBOBJECT_BASIC_UI_RESTRICTIONS {
            UIRestrictionsClass: NO_USER_INTERFACE,
        };
        group.set(JobObjectBasicUIRestrictions, &restrictions)?;
        Ok(group)
    }

    /// Puts a process into the job.
    ///
    /// # Errors
    ///
    /// When it has ended, or is in a job that allows no other one below it.
    pub(super) fn add(&self, process: &Child) -> io::Result<()> {
        // SAFETY: both handles are open for as long as they are borrowed.
        let added =
            unsafe { AssignProcessToJobObject(self.job.as_raw_handle(), process.as_raw_handle()) };
        if added == 0 {
            return Err(io::Error::last_os_error());
        }
        Ok(())
    }

    /// A process that exceeds the memory of a job is not killed: its allocations fail, and it says
    /// so itself.
    #[expect(
        clippy::unused_self,
        reason = "the signature of the groups of other systems"
    )]
    pub(super) const fn is_out_of_memory(&self) -> bool {
        false
    }

    fn set<T>(&self, class: JOBOBJECTINFOCLASS, information: &T) -> io::Result<()> {
        let length = u32::try_from(size_of::<T>()).map_err(io::Error::other)?;
        let information = ptr::from_ref(information).cast::<c_void>();
        // SAFETY: `information` points to that many bytes, of the type that the class has.
        let set = unsafe {
            SetInformationJobObject(self.job.as_raw_handle(), class, information, length)
        };
        if set == 0 {
            return Err(io::Error::last_os_error());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::process::{Command, Stdio};

    use super::*;

    /// Only started where a job keeps it from starting anything itself.
    fn sleeper() -> Child {
        Command::new("ping")
            .args(["-n", "60", "127.0.0.1"])
            .stdout(Stdio::null())
            .spawn()
            .expect("Windows has a ping")
    }

    #[test]
    fn a_process_ends_with_its_job() {
        let group = Groups::find().and_then(|groups| groups.create(Role::Run));
        let group = group.expect("a job can be made and limited");
        let mut child = sleeper();
        group.add(&child).expect("a process of ours");
        assert!(child.try_wait().expect("our child").is_none());
        drop(group);
        assert!(!child.wait().expect("our child").success());
    }
}
