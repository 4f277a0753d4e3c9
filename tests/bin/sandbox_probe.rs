//! A worker that tries what the sandbox forbids: the real sandbox setup of each role, and then a
//! line for each attempt, `NAME: ERROR` or `NAME: DONE`.
//!
//! Called as the real one is (`worker ROLE`), with the process to signal as one more
//! argument, and perhaps a descriptor that it should not have inherited.

use std::fs::File;
use std::io::{self, Write as _};
use std::net::{TcpListener, TcpStream, UdpSocket};
use std::os::fd::BorrowedFd;
use std::os::unix::net::UnixListener;
use std::process::Command;
use std::{env, fs, ptr, thread};

use rustix::mm::{MapFlags, MprotectFlags, ProtFlags, mmap_anonymous, mprotect};
use rustix::process::{Pid, Signal, kill_process};
use wasmouse_engine::Limits;
use wasmouse_engine::sandbox::{SandboxStatus, child};

fn main() -> io::Result<()> {
    let arguments: Vec<String> = env::args().collect();
    let role = arguments.get(2).map_or("", String::as_str);
    let parent = number(&arguments, 3).and_then(Pid::from_raw);
    let inherited = number(&arguments, 4);
    child::close_inherited();
    child::die_with_parent();
    let limits = Limits::default();
    let with = move |sandbox| attempts(sandbox, parent, inherited);
    match role {
        "run" => child::enter_run(&limits, move |_, sandbox| with(sandbox)),
        "compile" => child::enter_compile(&limits, move |_, sandbox| with(sandbox)),
        "backtrace" => child::enter_backtrace(&limits, move |_, sandbox| with(sandbox)),
        other => Err(io::Error::other(format!("no role `{other}`"))),
    }
}

fn number(arguments: &[String], index: usize) -> Option<i32> {
    arguments.get(index)?.parse().ok()
}

fn attempts(sandbox: SandboxStatus, parent: Option<Pid>, inherited: Option<i32>) -> io::Result<()> {
    let (landlock, seccomp) = (sandbox.landlock, sandbox.seccomp);
    let mut lines = format!("landlock: {landlock}\nseccomp: {seccomp}\n");
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
        "connect by TCP",
        TcpStream::connect("127.0.0.1:9").map(drop),
    );
    attempt("listen by TCP", TcpListener::bind("127.0.0.1:0").map(drop));
    attempt(
        "open a UDP socket",
        UdpSocket::bind("127.0.0.1:0").map(drop),
    );
    attempt(
        "open a Unix socket",
        UnixListener::bind("probe.sock").map(drop),
    );
    attempt(
        "start a program",
        Command::new("/bin/true").status().map(drop),
    );
    attempt(
        "start a thread",
        thread::Builder::new().spawn(|| ()).map(drop),
    );
    attempt(
        "map writable executable memory",
        map(ProtFlags::WRITE | ProtFlags::EXEC),
    );
    attempt("map executable memory", map(ProtFlags::EXEC));
    attempt("make memory executable", make_executable());
    if let Some(parent) = parent {
        let signalled = kill_process(parent, Signal::TERM);
        attempt("signal its parent", signalled.map_err(io::Error::from));
    }
    if let Some(inherited) = inherited {
        attempt("read an inherited descriptor", read(inherited));
    }
    io::stdout().write_all(lines.as_bytes())
}

fn map(protection: ProtFlags) -> io::Result<()> {
    // SAFETY: a new mapping at a place that the kernel chooses harms nothing.
    unsafe { mmap_anonymous(ptr::null_mut(), 4096, protection, MapFlags::PRIVATE) }?;
    Ok(())
}

fn make_executable() -> io::Result<()> {
    let writable = ProtFlags::READ | ProtFlags::WRITE;
    // SAFETY: as above, and the protection of that mapping alone is changed.
    unsafe {
        let page = mmap_anonymous(ptr::null_mut(), 4096, writable, MapFlags::PRIVATE)?;
        mprotect(page, 4096, MprotectFlags::READ | MprotectFlags::EXEC)?;
    }
    Ok(())
}

fn read(descriptor: i32) -> io::Result<()> {
    // SAFETY: nothing is closed, and a number that is no descriptor is an error.
    let descriptor = unsafe { BorrowedFd::borrow_raw(descriptor) };
    rustix::io::read(descriptor, &mut [0; 1])?;
    Ok(())
}
