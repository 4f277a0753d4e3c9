//! A worker that tries what the sandbox forbids, after the real sandbox setup of its role.
//!
//! Called as the real one is (`worker ROLE`), with what to try as one more argument:
//!
//! - `attempts PARENT DESCRIPTOR`: a list of things, one of them to signal that process, one to
//!   read a descriptor that it should not have inherited. Prints a line for each layer of the
//!   sandbox and each attempt: `NAME: yes`, `NAME: no`, `NAME: DONE` or `NAME: ERROR`.
//! - `others`: all system calls that are in none of the lists here. Prints the numbers of those
//!   that do not fail as forbidden calls do.
//! - `fatal NAME`: one of the system calls that end the process.
//! - `wait`: nothing. Prints a line and waits for the end of its input, so that it can be looked
//!   at from outside.
//! - `spin`: nothing, for ever.
//!
//! `list` in place of `worker` prints the names of all calls that end the process.

#[cfg(target_os = "linux")]
mod linux {
    use std::fs::File;
    use std::io::{self, Error, Read as _, Write as _};
    use std::os::fd::{AsFd as _, BorrowedFd, FromRawFd as _};
    use std::{env, fs, ptr, thread};

    use rustix::mm::{MapFlags, MprotectFlags, ProtFlags, mmap, mmap_anonymous, mprotect};
    use rustix::process::{Pid, Signal, kill_process};
    use wasmouse_engine::Limits;
    use wasmouse_engine::sandbox::{SandboxStatus, child};

    /// Numbers of system calls end below this; the newest kernels have about 470.
    const CALLS_END: libc::c_long = 600;

    macro_rules! calls {
        ($($constant:ident)*) => { &[$((stringify!($constant), libc::$constant)),*] };
    }

    type Calls = &'static [(&'static str, libc::c_long)];

    /// Calls that some role may make, with some arguments.
    const ALLOWED: Calls = calls! {
        SYS_read SYS_write SYS_writev SYS_close SYS_mmap SYS_munmap SYS_mprotect SYS_mremap
        SYS_madvise SYS_brk SYS_memfd_create SYS_fcntl SYS_ioctl SYS_membarrier SYS_futex
        SYS_sched_yield SYS_sched_getaffinity SYS_clock_gettime SYS_clock_nanosleep
        SYS_restart_syscall SYS_getrandom SYS_rseq SYS_set_robust_list SYS_sigaltstack
        SYS_rt_sigaction SYS_rt_sigprocmask SYS_rt_sigreturn SYS_gettid SYS_getpid SYS_tgkill
        SYS_exit SYS_exit_group
    };

    /// Calls that end the process in every role. `clone` without flags starts a process.
    const FATAL: Calls = calls! {
        SYS_execve SYS_execveat SYS_clone
        SYS_ptrace SYS_process_vm_readv SYS_process_vm_writev SYS_kcmp SYS_pidfd_getfd
        SYS_pidfd_send_signal
        SYS_socket SYS_socketpair SYS_bind SYS_connect SYS_listen SYS_accept SYS_accept4
        SYS_sendto SYS_sendmsg SYS_sendmmsg SYS_recvfrom SYS_recvmsg SYS_recvmmsg
        SYS_unshare SYS_setns SYS_mount SYS_umount2 SYS_pivot_root SYS_chroot SYS_open_tree
        SYS_move_mount SYS_fsopen SYS_fsconfig SYS_fsmount SYS_fspick SYS_mount_setattr
        SYS_name_to_handle_at SYS_open_by_handle_at
        SYS_add_key SYS_request_key SYS_keyctl
        SYS_bpf SYS_perf_event_open SYS_userfaultfd
        SYS_io_uring_setup SYS_io_uring_enter SYS_io_uring_register
        SYS_init_module SYS_finit_module SYS_delete_module SYS_kexec_load SYS_kexec_file_load
        SYS_reboot SYS_swapon SYS_swapoff SYS_acct SYS_quotactl
        SYS_personality SYS_remap_file_pages SYS_shmat SYS_memfd_secret
        SYS_setuid SYS_setgid SYS_setreuid SYS_setregid SYS_setresuid SYS_setresgid
        SYS_setgroups SYS_setfsuid SYS_setfsgid SYS_capset
    };

    /// The same, of calls that only this architecture has.
    #[cfg(target_arch = "x86_64")]
    const FATAL_HERE: Calls = calls! {
        SYS_fork SYS_vfork SYS_modify_ldt SYS_ioperm SYS_iopl
    };

    /// The same, of calls that only this architecture has.
    #[cfg(not(target_arch = "x86_64"))]
    const FATAL_HERE: Calls = &[];

    pub fn main() -> io::Result<()> {
        let arguments: Vec<String> = env::args().collect();
        let argument = |index: usize| arguments.get(index).map_or("", String::as_str).to_owned();
        if argument(1) == "list" {
            for (constant, _) in FATAL.iter().chain(FATAL_HERE) {
                println!("{}", constant.trim_start_matches("SYS_"));
            }
            return Ok(());
        }
        child::close_inherited();
        child::die_with_parent();
        let limits = Limits::default();
        let (what, first, second) = (argument(3), argument(4), argument(5));
        let with = move |sandbox: SandboxStatus| match what.as_str() {
            "attempts" => attempts(sandbox, &first, &second),
            "others" => others(),
            "fatal" => fatal(&first),
            "wait" => wait(sandbox),
            "spin" => loop {
                std::hint::spin_loop();
            },
            other => Err(Error::other(format!("nothing to try: `{other}`"))),
        };
        match argument(2).as_str() {
            "run" => child::enter_run(&limits, move |_, sandbox| with(sandbox)),
            "compile" => child::enter_compile(&limits, move |_, sandbox| with(sandbox)),
            "backtrace" => child::enter_backtrace(&limits, move |_, sandbox| with(sandbox)),
            other => Err(Error::other(format!("no role `{other}`"))),
        }
    }

    fn layers(sandbox: SandboxStatus) -> String {
        let lines = sandbox
            .layers()
            .map(|(name, there)| format!("{name}: {}\n", if there { "yes" } else { "no" }));
        lines.concat()
    }

    /// A system call with nothing but zeros.
    fn call(number: libc::c_long) -> io::Result<()> {
        // SAFETY: either the sandbox forbids the call, or the test has failed.
        match unsafe { libc::syscall(number, 0_usize, 0_usize, 0_usize, 0_usize, 0_usize, 0_usize) }
        {
            -1 => Err(Error::last_os_error()),
            _ => Ok(()),
        }
    }

    fn others() -> io::Result<()> {
        // Kernels let no filter see these two, which a kernel that traces a program makes itself;
        // from anywhere else they only fail.
        let exempt = |number| cfg!(target_arch = "x86_64") && matches!(number, 335 | 336);
        let listed = |number| {
            let mut lists = ALLOWED.iter().chain(FATAL).chain(FATAL_HERE);
            exempt(number) || lists.any(|(_, other)| *other == number)
        };
        let allowed = (0..CALLS_END)
            .filter(|number| !listed(*number))
            .filter(|number| {
                let error = call(*number).err();
                error.and_then(|it| it.raw_os_error()) != Some(libc::EPERM)
            });
        let numbers: Vec<String> = allowed.map(|number| format!("{number}\n")).collect();
        io::stdout().write_all(numbers.concat().as_bytes())
    }

    fn fatal(name: &str) -> io::Result<()> {
        let mut calls = FATAL.iter().chain(FATAL_HERE);
        let found = calls.find(|(constant, _)| constant.trim_start_matches("SYS_") == name);
        let (_, number) = found.ok_or_else(|| Error::other("no such call"))?;
        let outcome = call(*number);
        println!("survived: {outcome:?}");
        Ok(())
    }

    fn wait(sandbox: SandboxStatus) -> io::Result<()> {
        let mut stdout = io::stdout();
        stdout.write_all(layers(sandbox).as_bytes())?;
        stdout.write_all(b"waiting: yes\n")?;
        stdout.flush()?;
        io::stdin().read_to_end(&mut Vec::new()).map(drop)
    }

    fn attempts(sandbox: SandboxStatus, parent: &str, inherited: &str) -> io::Result<()> {
        let mut lines = layers(sandbox);
        let mut attempt = |name: &str, result: io::Result<()>| {
            let outcome = match result {
                Ok(()) => "DONE".to_owned(),
                Err(error) => error.to_string(),
            };
            lines.push_str(&format!("{name}: {outcome}\n"));
        };
        attempt("read a file", File::open("/etc/passwd").map(drop));
        attempt("list a folder", fs::read_dir("/").map(drop));
        attempt("write a file", fs::write("wasmouse-probe", "x"));
        attempt("remove a file", fs::remove_file("Cargo.toml"));
        attempt(
            "read its own memory",
            File::open("/proc/self/mem").map(drop),
        );
        attempt(
            "start a thread",
            thread::Builder::new().spawn(|| ()).map(drop),
        );
        attempt("ask who its parent is", call(libc::SYS_getppid));
        attempt("become dumpable", become_dumpable());
        attempt("raise a limit", call(libc::SYS_prlimit64));
        attempt(
            "copy a descriptor",
            io::stdin().as_fd().try_clone_to_owned().map(drop),
        );
        memory(&mut attempt);
        let parent = parent.parse().ok().and_then(Pid::from_raw);
        let signalled = parent.map(|parent| kill_process(parent, Signal::TERM));
        let signalled = signalled.ok_or_else(|| Error::other("no parent"))?;
        attempt("signal its parent", signalled.map_err(Error::from));
        attempt("signal everybody", every_process(libc::SYS_kill));
        attempt("signal a thread", every_process(libc::SYS_tgkill));
        let inherited = inherited.parse().map_err(Error::other)?;
        attempt("read an inherited descriptor", read(inherited));
        io::stdout().write_all(lines.as_bytes())
    }

    /// Everything about memory that is executable, or shared.
    fn memory(attempt: &mut dyn FnMut(&str, io::Result<()>)) {
        let (write, execute) = (ProtFlags::WRITE, ProtFlags::EXEC);
        let (private, shared) = (MapFlags::PRIVATE, MapFlags::SHARED);
        attempt(
            "map writable executable memory",
            map(write | execute, private),
        );
        attempt("map executable memory", map(execute, private));
        attempt("map shared memory", map(write, shared));
        let protect = |protection| protect(MprotectFlags::READ | protection);
        attempt(
            "make memory writable and executable",
            protect(MprotectFlags::WRITE | MprotectFlags::EXEC),
        );
        attempt("make memory executable", protect(MprotectFlags::EXEC));
        let file = memory_file(libc::MFD_CLOEXEC | libc::MFD_ALLOW_SEALING);
        let unsealable = memory_file(libc::MFD_CLOEXEC).map(drop);
        attempt("make a memory file that cannot be sealed", unsealable);
        // Where there is none to be had, its mappings are tried with a descriptor that is there.
        let stdin = io::stdin();
        let descriptor = file.as_ref().map_or(stdin.as_fd(), |file| file.as_fd());
        attempt(
            "map a memory file that writes go to",
            map_file(descriptor, write, shared),
        );
        attempt(
            "map a memory file with others",
            map_file(descriptor, ProtFlags::READ, shared),
        );
        attempt(
            "map a memory file executable",
            map_file(descriptor, execute, private),
        );
        attempt(
            "map a memory file for itself",
            map_file(descriptor, write, private),
        );
        attempt("make a memory file", file.map(drop));
    }

    fn map(protection: ProtFlags, flags: MapFlags) -> io::Result<()> {
        // SAFETY: a new mapping at a place that the kernel chooses harms nothing.
        unsafe { mmap_anonymous(ptr::null_mut(), 4096, protection, flags) }?;
        Ok(())
    }

    fn protect(protection: MprotectFlags) -> io::Result<()> {
        let writable = ProtFlags::READ | ProtFlags::WRITE;
        // SAFETY: as above, and the protection of that mapping alone is changed.
        unsafe {
            let page = mmap_anonymous(ptr::null_mut(), 4096, writable, MapFlags::PRIVATE)?;
            mprotect(page, 4096, protection)?;
        }
        Ok(())
    }

    fn memory_file(flags: libc::c_uint) -> io::Result<File> {
        // SAFETY: the name ends in zero.
        let descriptor = unsafe { libc::memfd_create(c"probe".as_ptr(), flags) };
        if descriptor == -1 {
            return Err(Error::last_os_error());
        }
        // SAFETY: the descriptor is new, and owned by nothing else.
        let mut file = unsafe { File::from_raw_fd(descriptor) };
        file.write_all(&[0xc3; 4096])?;
        Ok(file)
    }

    fn map_file(file: BorrowedFd<'_>, protection: ProtFlags, flags: MapFlags) -> io::Result<()> {
        // SAFETY: a new mapping at a place that the kernel chooses harms nothing.
        unsafe { mmap(ptr::null_mut(), 4096, protection, flags, file, 0) }?;
        Ok(())
    }

    fn become_dumpable() -> io::Result<()> {
        // SAFETY: the option takes a number.
        match unsafe { libc::prctl(libc::PR_SET_DUMPABLE, 1) } {
            0 => Ok(()),
            _ => Err(Error::last_os_error()),
        }
    }

    /// Whether a call with the number of any other process works, with signal 0, which does
    /// nothing.
    fn every_process(number: libc::c_long) -> io::Result<()> {
        let own = std::process::id().cast_signed();
        let mut last = Ok(());
        for process in (-1..1000).filter(|process| *process != own) {
            // SAFETY: numbers.
            last = match unsafe { libc::syscall(number, process, process, 0) } {
                -1 => Err(Error::last_os_error()),
                _ => return Ok(()),
            };
        }
        last
    }

    fn read(descriptor: i32) -> io::Result<()> {
        // SAFETY: nothing is closed, and a number that is no descriptor is an error.
        let descriptor = unsafe { BorrowedFd::borrow_raw(descriptor) };
        rustix::io::read(descriptor, &mut [0; 1])?;
        Ok(())
    }
}

#[cfg(target_os = "linux")]
fn main() -> std::io::Result<()> {
    linux::main()
}

#[cfg(not(target_os = "linux"))]
fn main() {}
