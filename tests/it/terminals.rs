//! Programs that fill the terminal, on a terminal: keys, signals, sizes, and that it is given back.

#![cfg(target_os = "linux")]

use std::ffi::CStr;
use std::fs::{self, File, OpenOptions};
use std::io::{Read as _, Write as _};
use std::os::fd::{AsRawFd as _, FromRawFd as _, OwnedFd};
use std::os::unix::fs::OpenOptionsExt as _;
use std::os::unix::process::CommandExt as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use wasmouse_core::maze::{format, is_contest_legal};

use crate::binary::path;
use crate::contest_text::ContestText;

/// A program on a terminal of its own.
struct Session {
    child: Child,
    /// The side of the person.
    keyboard: File,
    /// The side of the program, to see how it left the terminal.
    terminal: OwnedFd,
    shown: Arc<Mutex<Shown>>,
    reader: thread::JoinHandle<()>,
    /// Whether the person has gone.
    is_gone: Arc<AtomicBool>,
}

/// What a program has written, and what a terminal makes of it.
struct Shown {
    written: Vec<u8>,
    terminal: vt100::Parser,
}

/// What begins the alternate screen.
const ENTER: &str = "\u{1b}[?1049h";

impl Session {
    fn start(folder: &Path, arguments: &[&str]) -> Self {
        Self::start_with(folder, arguments, (libc::SIG_DFL, 80))
    }

    /// Starts a program with that action for the signal of a closed terminal, on a terminal with
    /// that many columns.
    fn start_with(
        folder: &Path,
        arguments: &[&str],
        (hangup, columns): (libc::sighandler_t, u16),
    ) -> Self {
        let (person, terminal) = pseudo_terminal(columns);
        let stdio = || Stdio::from(terminal.try_clone().expect("a descriptor"));
        let mut command = Command::new(path());
        command
            .args(arguments)
            .current_dir(folder)
            .env("TERM", "xterm-256color")
            .env("LC_ALL", "C.UTF-8")
            .env_remove("NO_COLOR")
            .stdin(stdio())
            .stdout(stdio())
            .stderr(stdio());
        let take_terminal = move || {
            // SAFETY: calls that take numbers, and may be made between fork and exec.
            unsafe {
                libc::setsid();
                libc::ioctl(0, libc::TIOCSCTTY, 0);
                libc::signal(libc::SIGHUP, hangup);
            }
            Ok(())
        };
        // SAFETY: the closure only makes those calls.
        unsafe { command.pre_exec(take_terminal) };
        let child = command.spawn().expect("the program starts");
        let shown = Arc::new(Mutex::new(Shown {
            written: Vec::new(),
            terminal: vt100::Parser::new(24, columns, 0),
        }));
        let mut reader = person.try_clone().expect("a descriptor");
        let sink = Arc::clone(&shown);
        let is_gone = Arc::new(AtomicBool::new(false));
        let gone = Arc::clone(&is_gone);
        let reader = thread::spawn(move || {
            let mut bytes = [0; 4096];
            while !gone.load(Ordering::SeqCst) {
                let mut polled = libc::pollfd {
                    fd: reader.as_raw_fd(),
                    events: libc::POLLIN,
                    revents: 0,
                };
                // SAFETY: the pointer is to one structure.
                if unsafe { libc::poll(&raw mut polled, 1, 50) } < 1 {
                    continue;
                }
                let Ok(count @ 1..) = reader.read(&mut bytes) else {
                    return;
                };
                let mut sink = sink.lock().expect("no panic");
                sink.written.extend_from_slice(&bytes[..count]);
                sink.terminal.process(&bytes[..count]);
            }
        });
        Self {
            child,
            keyboard: person,
            terminal,
            shown,
            reader,
            is_gone,
        }
    }

    /// Closes the terminal, and returns how the program ended.
    fn close(mut self) -> Option<i32> {
        self.is_gone.store(true, Ordering::SeqCst);
        self.reader.join().expect("no panic");
        drop(self.keyboard);
        let begin = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().expect("a child") {
                return status.code();
            }
            if begin.elapsed() > Duration::from_secs(60) {
                self.child.kill().expect("a child");
                panic!("it goes on without a terminal");
            }
            thread::sleep(Duration::from_millis(10));
        }
    }

    /// Everything that was written so far.
    fn written(&self) -> String {
        let shown = self.shown.lock().expect("no panic");
        String::from_utf8_lossy(&shown.written).into_owned()
    }

    /// What is on the screen.
    fn screen(&self) -> String {
        let shown = self.shown.lock().expect("no panic");
        shown.terminal.screen().contents()
    }

    /// Waits until something is on the screen.
    fn wait_for(&self, text: &str) {
        self.wait(|session| session.screen().contains(text));
    }

    /// Waits until something is so.
    fn wait(&self, is_so: impl Fn(&Self) -> bool) {
        let begin = Instant::now();
        while !is_so(self) {
            let waited = begin.elapsed();
            assert!(
                waited < Duration::from_secs(60),
                "never:\n{}",
                self.screen()
            );
            thread::sleep(Duration::from_millis(10));
        }
    }

    fn resize(&self, columns: u16, rows: u16) {
        let mut shown = self.shown.lock().expect("no panic");
        shown.terminal.screen_mut().set_size(rows, columns);
        let size = window(columns, rows);
        let keyboard = self.keyboard.as_raw_fd();
        // SAFETY: the pointer is to a size.
        let set = unsafe { libc::ioctl(keyboard, libc::TIOCSWINSZ, &raw const size) };
        assert_eq!(set, 0);
    }

    fn press(&mut self, keys: &str) {
        self.keyboard
            .write_all(keys.as_bytes())
            .expect("a terminal");
    }

    fn send(&self, signal: i32) {
        let pid = i32::try_from(self.child.id()).expect("a process");
        // SAFETY: the call takes numbers.
        assert_eq!(unsafe { libc::kill(pid, signal) }, 0);
    }

    /// Waits until the program has ended, and returns its exit code.
    fn exit_code(&mut self) -> Option<i32> {
        let begin = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().expect("a child") {
                return status.code();
            }
            let waited = begin.elapsed();
            assert!(waited < Duration::from_secs(60), "{}", self.screen());
            thread::sleep(Duration::from_millis(10));
        }
    }

    /// The exit code, and the screen afterwards, after checks that the terminal was given back.
    fn end(mut self) -> (Option<i32>, String) {
        let code = self.exit_code();
        assert!(self.written().contains(ENTER), "it took the terminal");
        // The last bytes may still be on their way.
        self.wait(|session| {
            let shown = session.shown.lock().expect("no panic");
            let screen = shown.terminal.screen();
            let is_free = screen.mouse_protocol_mode() == vt100::MouseProtocolMode::None;
            !screen.alternate_screen() && !screen.hide_cursor() && is_free
        });
        let mut settings = std::mem::MaybeUninit::<libc::termios>::zeroed();
        // SAFETY: the pointer is to a structure that the call fills.
        let read = unsafe { libc::tcgetattr(self.terminal.as_raw_fd(), settings.as_mut_ptr()) };
        assert_eq!(read, 0);
        // SAFETY: all of its fields may be zero, and the call has filled it.
        let flags = unsafe { settings.assume_init() }.c_lflag;
        let line_by_line = libc::ICANON | libc::ECHO | libc::ISIG;
        assert_eq!(flags & line_by_line, line_by_line, "lines are edited again");
        (code, self.screen())
    }
}

/// Both sides of a new terminal with that many columns and 24 rows. No other process gets them by accident: a terminal is
/// only closed when nobody has the side of the person.
fn pseudo_terminal(columns: u16) -> (File, OwnedFd) {
    // SAFETY: the call takes numbers.
    let person = unsafe { libc::posix_openpt(libc::O_RDWR | libc::O_NOCTTY | libc::O_CLOEXEC) };
    assert!(person >= 0, "there are pseudo terminals");
    let mut name = [0; 128];
    let size = window(columns, 24);
    // SAFETY: the descriptor is open, and the pointers are to a name with its length and to a size.
    let prepared = unsafe {
        libc::grantpt(person) == 0
            && libc::unlockpt(person) == 0
            && libc::ptsname_r(person, name.as_mut_ptr(), name.len()) == 0
            && libc::ioctl(person, libc::TIOCSWINSZ, &raw const size) == 0
    };
    assert!(prepared, "{}", std::io::Error::last_os_error());
    // SAFETY: the call has written a name that ends in a zero.
    let name = unsafe { CStr::from_ptr(name.as_ptr()) };
    let terminal = OpenOptions::new()
        .read(true)
        .write(true)
        .custom_flags(libc::O_NOCTTY)
        .open(name.to_str().expect("a path"))
        .expect("the other side");
    // SAFETY: the descriptor is ours.
    (unsafe { File::from_raw_fd(person) }, terminal.into())
}

fn window(columns: u16, rows: u16) -> libc::winsize {
    libc::winsize {
        ws_row: rows,
        ws_col: columns,
        ws_xpixel: 0,
        ws_ypixel: 0,
    }
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

#[test]
fn a_contest_shows_its_progress_and_standings() {
    let folder = folder();
    ContestText::of(&["flood"])
        .mazes("all", &["gen:tree:16:1..=100000"])
        .write(folder.path());
    let mut session = Session::start(folder.path(), &["contest", "run"]);
    session.wait_for("/100000 matches, ");
    session.wait_for("now 1. flood:reset ");
    let screen = session.screen();
    let rate = screen.split("matches, ").nth(1);
    let rate = rate.and_then(|it| it.split_once("/s, "));
    let (rate, rest) = rate.unwrap_or_else(|| panic!("{screen}"));
    assert!(rate.parse::<u32>().is_ok(), "{rate} is a whole number");
    assert!(rest.contains(" left"), "{screen}");
    assert!(screen.contains("; 0 faults"), "{screen}");
    session.press("\u{3}");
    assert_eq!(session.exit_code(), Some(130));
    session.wait(|session| {
        let written = session.written();
        written.contains("interrupted; `wasmouse contest run` goes on where this ended")
    });
}

/// The terminal shows `^C` where the cursor is, which must not move it to a line of its own.
#[test]
fn nothing_is_left_of_a_bar_after_an_interrupt() {
    let folder = folder();
    ContestText::of(&["flood"])
        .mazes("all", &["gen:tree:16:1..=100000"])
        .write(folder.path());
    let run = ["run", "flood", "gen:tree:16:1..=100000"];
    for (arguments, drawn) in [
        (&run[..], "/100000 matches, "),
        (&["contest", "run"], "now 1. "),
    ] {
        for columns in [80, 120] {
            let place = format!("{arguments:?} at {columns}");
            let terminal = (libc::SIG_DFL, columns);
            let mut session = Session::start_with(folder.path(), arguments, terminal);
            session.wait_for(drawn);
            session.press("\u{3}");
            assert_eq!(session.exit_code(), Some(130), "{place}");
            session.wait(|session| session.screen().contains("interrupted"));
            let screen = session.screen();
            for part in ["/s, ", "now 1. ", "^C"] {
                assert!(!screen.contains(part), "{place}: {part}\n{screen}");
            }
        }
    }
}

const WATCH: &[&str] = &["run", "flood", "test_maze_01", "--watch", "--no-cache"];

#[test]
fn the_player_is_left_with_a_key() {
    for key in ["q", "\u{3}", "\u{1b}"] {
        let folder = folder();
        let mut session = Session::start(folder.path(), WATCH);
        session.wait_for("exploration run");
        session.press(key);
        let (code, _) = session.end();
        assert_eq!(code, Some(0), "{key:?}");
    }
}

#[test]
fn signals_end_it_and_give_the_terminal_back() {
    for (signal, code) in [
        (libc::SIGTERM, 143),
        (libc::SIGINT, 130),
        (libc::SIGHUP, 129),
    ] {
        let folder = folder();
        let session = Session::start(folder.path(), WATCH);
        session.wait_for("exploration run");
        session.send(signal);
        assert_eq!(session.end().0, Some(code));
    }
}

/// Whether or not the signal that says so is ignored, as `nohup` does.
#[test]
fn a_closed_terminal_ends_it() {
    for hangup in [libc::SIG_DFL, libc::SIG_IGN] {
        for keys in ["", " "] {
            let folder = folder();
            let mut session = Session::start_with(folder.path(), WATCH, (hangup, 80));
            session.wait_for("exploration run");
            session.press(keys);
            assert_eq!(session.close(), Some(129), "{keys:?}");
        }
    }
}

/// The beginning of a key that never comes does not keep the program from ending.
#[test]
fn half_of_a_key_holds_nothing_up() {
    let folder = folder();
    let mut session = Session::start(folder.path(), WATCH);
    session.wait_for("exploration run");
    session.press("\u{1b}[");
    thread::sleep(Duration::from_millis(300));
    session.send(libc::SIGTERM);
    assert_eq!(session.end().0, Some(143));
}

#[test]
fn it_follows_the_size_of_the_terminal() {
    let folder = folder();
    let mut session = Session::start(folder.path(), WATCH);
    session.wait_for("what it could know");
    // The end stands still.
    session.press("\u{1b}[F");
    session.wait_for("the end");
    // A maze with posts needs more room than there was.
    assert!(!session.screen().contains('┌'), "{}", session.screen());
    session.resize(200, 50);
    session.wait_for("┌");
    session.press("q");
    assert_eq!(session.end().0, Some(0));
}

#[test]
fn two_robots_are_watched_side_by_side() {
    let folder = folder();
    let arguments = [
        "run",
        "flood",
        "dfs",
        "test_maze_01",
        "--watch",
        "--no-cache",
    ];
    let mut session = Session::start(folder.path(), &arguments);
    session.wait_for("dfs:everything: ");
    session.press("q");
    assert_eq!(session.end().0, Some(0));
}

#[test]
fn a_maze_is_drawn_and_saved() {
    let folder = folder();
    let arguments = ["maze", "edit", "new.txt", "--new", "12", "--format", "num"];
    let mut session = Session::start(folder.path(), &arguments);
    session.wait_for("keeps all contest rules");
    session.press("\u{1b}[Cd");
    session.press("\u{13}");
    session.wait_for("wrote ");
    session.press("q");
    assert_eq!(session.end().0, Some(0));
    let text = fs::read_to_string(folder.path().join("new.txt")).expect("a file");
    let parsed = format::parse(&text).expect("a maze");
    assert_eq!(parsed.format, format::Format::Num);
    assert!(is_contest_legal(&parsed.maze));
}

#[test]
fn a_drive_is_given_up() {
    let folder = folder();
    let arguments = ["drive", "test_maze_01", "--replay", "a.replay.json"];
    let mut session = Session::start(folder.path(), &arguments);
    session.wait_for("exploration run, 0 of 1000");
    session.press("2w");
    session.wait_for("drove 2");
    session.press("q");
    session.wait_for("give up");
    session.press("y");
    let (code, after) = session.end();
    assert_eq!(code, Some(0));
    assert!(after.contains("given up after 1 step: no score"), "{after}");
    assert!(after.contains("no replay was written"), "{after}");
    assert!(!folder.path().join("a.replay.json").exists());
}

/// A file name can hold anything but a zero and a slash.
#[test]
fn hostile_file_names_are_only_text() {
    let folder = folder();
    let name = "a\u{1b}]0;owned\u{7}\u{1b}[2J\u{202e}.txt";
    let maze = format::parse(wasmouse_core::maze::bundled()[0].text).expect("a maze");
    let text = format::print(&maze.maze, format::Format::Udacity).expect("a text");
    fs::write(folder.path().join(name), text).expect("a file");
    for arguments in [
        &["maze", "edit", name][..],
        &["drive", name],
        &["run", "flood", name, "--watch", "--no-cache"],
    ] {
        let mut session = Session::start(folder.path(), arguments);
        session.wait_for("owned");
        session.press("q");
        let written = session.written();
        session.end();
        for evil in ["\u{1b}]0;", "\u{1b}[2J\u{202e}", "\u{7}", "\u{202e}"] {
            assert!(!written.contains(evil), "{arguments:?}: {written:?}");
        }
    }
}
