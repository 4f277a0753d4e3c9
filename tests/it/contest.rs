//! `wasmouse contest`: whatever happens to a contest, its results are the same.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;
use wasmouse::store::Store;
use wasmouse_core::Digest;
use wasmouse_engine::bundled::find;

use crate::binary::{Ran, ran, stdout_of, wasmouse};
use crate::hostile::Module;
use crate::shared::shared;

/// The reports that a contest writes here.
const REPORTS: [&str; 5] = ["out.html", "out.csv", "out.json", "out.jsonl", "out.md"];

const OUTPUTS: &str = "
[outputs]
html = \"out.html\"
csv = \"out.csv\"
json = \"out.json\"
jsonl = \"out.jsonl\"
markdown = \"out.md\"
";

/// Several robots in generated mazes of two sets, one of them hidden.
const SMALL: &str = "
version = 1
name = \"small\"
[[robots]]
bundled = \"flood\"
variants = [\"reset\", \"certain\"]
[[robots]]
bundled = \"dfs\"
[[robots]]
bundled = \"random\"
[[mazes]]
set = \"public\"
paths = [\"test_maze_01\", \"gen:tree:12..=20:1..=20\"]
[[mazes]]
set = \"final\"
hidden = true
weight = 2
paths = [\"gen:braid:16:1..=60\"]
[seeds]
count = 2
[run]
keep_transcripts = \"all\"
";

fn folder(contest: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("contest.toml");
    fs::write(file, format!("{contest}{OUTPUTS}")).expect("a file");
    folder
}

fn contest(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = wasmouse();
    command.current_dir(folder).arg("contest").args(arguments);
    command
}

#[track_caller]
fn succeeds(folder: &Path, arguments: &[&str]) -> Ran {
    let ran = ran(&mut contest(folder, arguments));
    assert_eq!(ran.status.code(), Some(0), "{arguments:?}: {}", ran.stderr);
    ran
}

fn reports(folder: &Path) -> Vec<Vec<u8>> {
    let read = |name| fs::read(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    REPORTS.map(read).to_vec()
}

fn content(store: PathBuf) -> Digest {
    let store = Store::open_read_only(store).expect("a store");
    store.integrity().expect("a sound store");
    store.content_digest().expect("its digest")
}

/// Both folders have the same content and the same reports.
#[track_caller]
fn check_same(one: &Path, other: &Path) {
    assert_eq!(
        content(one.join("contest.db")),
        content(other.join("contest.db"))
    );
    for ((one, other), name) in reports(one).iter().zip(reports(other)).zip(REPORTS) {
        assert!(*one == other, "{name} differs");
    }
}

/// Kills a contest that many times at moments that are spread over what it takes unbroken, lets
/// it come to its end, and compares.
fn check_kills(text: &str, kills: u32, jobs: &str) {
    let (unbroken, broken) = (folder(text), folder(text));
    let began = Instant::now();
    succeeds(unbroken.path(), &["run", jobs]);
    let whole = began.elapsed();
    // A linear congruential generator: any moment will do.
    let mut random = 12345_u32;
    let mut killed = 0;
    for _ in 0..kills {
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let share = f64::from(random >> 8) / f64::from(1 << 24);
        let mut run = contest(broken.path(), &["run", jobs]);
        let run = run.stdin(Stdio::null()).stdout(Stdio::null());
        let mut child = run.stderr(Stdio::null()).spawn().expect("a process");
        thread::sleep(whole.mul_f64(share / f64::from(kills)));
        killed += u32::from(child.try_wait().expect("a process").is_none());
        child.kill().expect("a process that can be killed");
        child.wait().expect("a process that was killed");
    }
    assert!(
        killed * 2 >= kills,
        "{killed} of {kills} were still running"
    );
    let last = succeeds(broken.path(), &["run", jobs]);
    check_same(unbroken.path(), broken.path());
    let again = succeeds(broken.path(), &["run"]);
    assert!(again.stderr.contains("nothing to play"), "{}", again.stderr);
    assert_eq!(last.stdout, again.stdout);
}

#[test]
fn a_contest_that_is_killed_goes_on_where_it_was() {
    check_kills(SMALL, 5, "--jobs=2");
}

/// All reference robots in the official mazes, 100 competition mazes and 400 generated ones.
#[test]
#[cfg_attr(
    not(shared_material),
    ignore = "needs shared material: set WASMOUSE_SHARED"
)]
fn a_large_contest_that_is_killed_ten_times_has_the_same_results() {
    let mazes = shared().join("mazes");
    let official = mazes.join("udacity");
    let competition = fs::read_dir(mazes.join("competition")).expect("a folder");
    let mut competition: Vec<PathBuf> = competition
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .collect();
    competition.sort();
    let paths: Vec<String> = competition
        .iter()
        .take(100)
        .map(|path| format!("{path:?}"))
        .collect();
    let robots: Vec<String> = wasmouse_engine::bundled::bundled()
        .iter()
        .map(|robot| format!("[[robots]]\nbundled = \"{}\"\n", robot.name))
        .collect();
    let text = format!(
        "version = 1\nname = \"large\"\n{}\
         [[mazes]]\nset = \"official\"\npaths = [{official:?}]\nlenient = true\n\
         [[mazes]]\nset = \"competition\"\npaths = [{}]\nlenient = true\n\
         [[mazes]]\nset = \"generated\"\npaths = [\"gen:tree:16:1..=200\", \"gen:braid:16:1..=200\"]\n",
        robots.concat(),
        paths.join(", ")
    );
    check_kills(&text, 10, "--jobs=2");
}

#[test]
fn shards_make_the_same_contest_as_one_run() {
    let (whole, parts) = (folder(SMALL), folder(SMALL));
    succeeds(whole.path(), &["run"]);
    let mut arguments = vec!["merge".to_owned(), "contest.db".to_owned()];
    for part in 1..=4 {
        let store = format!("part-{part}.db");
        let shard = format!("{part}/4");
        let ran = succeeds(parts.path(), &["run", "--shard", &shard, "--store", &store]);
        assert!(ran.stderr.contains("contest merge"), "{}", ran.stderr);
        arguments.push(store);
    }
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    succeeds(parts.path(), &arguments);
    let once = content(parts.path().join("contest.db"));
    let again = succeeds(parts.path(), &arguments);
    assert!(
        again.stdout.contains(": 0 matches added"),
        "{}",
        again.stdout
    );
    assert_eq!(content(parts.path().join("contest.db")), once);
    let ran = succeeds(parts.path(), &["run"]);
    assert!(ran.stderr.contains("nothing to play"), "{}", ran.stderr);
    check_same(whole.path(), parts.path());
}

#[test]
fn a_shard_that_was_changed_is_refused_by_name() {
    let folder = folder(SMALL);
    for part in ["1/2", "2/2"] {
        let store = format!("part-{}.db", &part[..1]);
        succeeds(folder.path(), &["run", "--shard", part, "--store", &store]);
    }
    let changed = change_records(
        &folder.path().join("part-2.db"),
        "UPDATE match SET fuel_steps = fuel_steps + 1 WHERE seed = 1",
    );
    assert!(changed > 0);
    let merge = ["merge", "contest.db", "part-1.db", "part-2.db"];
    let ran = ran(&mut contest(folder.path(), &merge));
    assert_eq!(ran.status.code(), Some(1), "{}", ran.stderr);
    assert!(ran.stdout.contains("part-1.db: "), "{}", ran.stdout);
    assert!(!ran.stdout.contains("part-2.db: "), "{}", ran.stdout);
    let expected =
        "error: not merged: store `part-2.db`: its content is not the one that was sealed";
    assert!(ran.stderr.contains(expected), "{}", ran.stderr);
    let part = content(folder.path().join("part-1.db"));
    assert_eq!(
        content(folder.path().join("contest.db")),
        part,
        "nothing of it was merged"
    );
}

/// Changes records of a store as nobody should, and returns how many.
fn change_records(store: &Path, update: &str) -> usize {
    let connection = rusqlite::Connection::open(store).expect("SQLite");
    // Records never change, unless somebody takes the trouble.
    let sql = "SELECT sql FROM sqlite_master WHERE name = 'match_is_final'";
    let trigger: String = connection
        .query_row(sql, [], |row| row.get(0))
        .expect("a trigger");
    let drop_trigger = connection.execute_batch("DROP TRIGGER match_is_final");
    drop_trigger.expect("it is dropped");
    let changed = connection.execute(update, []).expect("an update");
    connection
        .execute_batch(&trigger)
        .expect("it is there again");
    changed
}

/// Two machines must never get different records of a match, so the message names it.
#[test]
fn a_part_that_contradicts_the_contest_is_refused_with_its_matches() {
    let folder = folder(SMALL);
    succeeds(
        folder.path(),
        &["run", "--shard", "1/20", "--store", "one.db"],
    );
    let (one, other) = (folder.path().join("one.db"), folder.path().join("other.db"));
    fs::copy(&one, &other).expect("a copy");
    let changed = change_records(
        &other,
        "UPDATE match SET fuel_steps = fuel_steps + 1 WHERE (robot, variant, maze, seed) = \
         (SELECT robot, variant, maze, seed FROM match WHERE seed = 1 LIMIT 1)",
    );
    assert_eq!(changed, 1);
    let connection = rusqlite::Connection::open(&other).expect("SQLite");
    let unsealed = connection.execute("DELETE FROM seal", []);
    unsealed.expect("as before its end");
    drop(connection);
    succeeds(folder.path(), &["merge", "contest.db", "one.db"]);
    let before = content(folder.path().join("contest.db"));
    let merge = ["merge", "--unsealed", "contest.db", "other.db"];
    let ran = ran(&mut contest(folder.path(), &merge));
    assert_eq!(ran.status.code(), Some(1), "{}", ran.stderr);
    for expected in [
        "store `other.db`: it has records that contradict those of `contest.db`: 1, the first: ",
        "seed 1",
    ] {
        assert!(ran.stderr.contains(expected), "{}", ran.stderr);
    }
    assert_eq!(content(folder.path().join("contest.db")), before);
}

/// How many matches a store has.
fn matches(store: &Path) -> i64 {
    let connection = rusqlite::Connection::open(store).expect("SQLite");
    let count = connection.query_row("SELECT count(*) FROM match", [], |row| row.get(0));
    count.expect("a count")
}

/// Building a project runs what its author wrote, so a submission must not be able to ask for it.
#[test]
fn a_pattern_finds_no_projects() {
    let folder = folder(
        "version = 1
name = \"Test\"
[[robots]]
path = \"submissions/*\"
[[mazes]]
set = \"one\"
paths = [\"test_maze_01\"]
",
    );
    let project = folder.path().join("submissions/project");
    fs::create_dir_all(&project).expect("a folder");
    // Were it a project, this would be an error.
    fs::write(project.join("Cargo.toml"), "no manifest").expect("a file");
    let component = find("flood").expect("a bundled robot").component;
    fs::write(folder.path().join("submissions/ann.wasm"), component).expect("a file");
    let Ran { stdout, stderr, .. } = succeeds(folder.path(), &["run"]);
    assert!(stdout.contains("ann"), "{stdout}");
    assert!(
        !stdout.contains("project") && !stderr.contains("project"),
        "{stdout}{stderr}"
    );
}

#[test]
fn what_changes_is_played_again_and_nothing_else() {
    let text = "
version = 1
[[robots]]
path = \"submissions\"
[[mazes]]
set = \"mazes\"
paths = [\"gen:tree:12:1..=10\"]
";
    let folder = folder(text);
    let submissions = folder.path().join("submissions");
    fs::create_dir(&submissions).expect("a folder");
    let submit = |name: &str, robot: &str| {
        let component = find(robot).expect("a bundled robot").component;
        fs::write(submissions.join(name), component).expect("a file");
    };
    submit("ann.wasm", "flood");
    submit("bob.wasm", "dfs");
    succeeds(folder.path(), &["run"]);
    let store = folder.path().join("contest.db");
    assert_eq!(matches(&store), 20);
    submit("bob.wasm", "wall-follower");
    let ran = succeeds(folder.path(), &["run"]);
    assert!(ran.stdout.contains("bob "), "{}", ran.stdout);
    assert_eq!(
        matches(&store),
        30,
        "the new robot of bob; what he had stays"
    );
    let file = folder.path().join("contest.toml");
    let more = fs::read_to_string(&file)
        .expect("a file")
        .replace("1..=10", "1..=12");
    fs::write(&file, more).expect("a file");
    succeeds(folder.path(), &["run"]);
    assert_eq!(matches(&store), 34, "two robots in two more mazes");
    let status = stdout_of(&mut contest(folder.path(), &["status", "--check"]));
    let of_bob = status
        .lines()
        .filter(|line| line.starts_with("  bob: ") && line.contains("variant"));
    assert_eq!(of_bob.count(), 2, "{status}");
    assert!(
        status.contains("24 of 24 matches played, 0 left to play"),
        "{status}"
    );
}

#[test]
fn a_contest_that_is_interrupted_keeps_what_was_played() {
    let folder = folder(SMALL);
    let mut run = contest(folder.path(), &["run"]);
    let mut child = run
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("a process");
    thread::sleep(Duration::from_millis(700));
    interrupt(&child);
    let code = child.wait().expect("a process").code();
    if code == Some(130) {
        let status = stdout_of(&mut contest(folder.path(), &["status", "--check"]));
        assert!(!status.contains(", 0 left to play"), "{status}");
    } else {
        assert_eq!(code, Some(0), "it had ended already");
    }
    succeeds(folder.path(), &["run"]);
}

/// The threads of a process that play matches.
#[cfg(target_os = "linux")]
fn match_threads(child: &Child) -> usize {
    let Ok(tasks) = fs::read_dir(format!("/proc/{}/task", child.id())) else {
        return 0;
    };
    let names = tasks.filter_map(|task| fs::read_to_string(task.ok()?.path().join("comm")).ok());
    names.filter(|name| name.starts_with("matches-")).count()
}

#[cfg(target_os = "linux")]
#[test]
fn the_contest_file_says_how_many_matches_are_played_at_once() {
    let text = "
version = 1
[[robots]]
bundled = \"flood\"
[[mazes]]
set = \"all\"
paths = [\"gen:tree:16:1..=100000\"]
[run]
jobs = 3
";
    for (arguments, expected) in [(vec!["run"], 3), (vec!["run", "--jobs", "2"], 2)] {
        let folder = folder(text);
        let mut run = contest(folder.path(), &arguments);
        let run = run.stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = run.spawn().expect("a process");
        let began = Instant::now();
        while match_threads(&child) < expected && began.elapsed() < Duration::from_secs(60) {
            thread::sleep(Duration::from_millis(10));
        }
        // Long enough for one more to begin.
        thread::sleep(Duration::from_millis(100));
        let threads = match_threads(&child);
        interrupt(&child);
        assert_eq!(child.wait().expect("a process").code(), Some(130));
        assert_eq!(threads, expected, "{arguments:?}");
    }
}

fn interrupt(child: &Child) {
    let pid = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &pid]).status();
    assert!(sent.expect("a program `kill`").success());
}

#[test]
fn robots_are_played_as_they_are_submitted() {
    let text = "
version = 1
[[robots]]
bundled = \"flood\"
[[robots]]
path = \"submissions/*.wasm\"
[[mazes]]
set = \"mazes\"
paths = [\"gen:tree:12:1..=10\"]
";
    let folder = folder(text);
    let submissions = folder.path().join("submissions");
    fs::create_dir(&submissions).expect("a folder");
    let mut run = contest(folder.path(), &["run", "--watch"]);
    let mut child = run
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("a process");
    let store = folder.path().join("contest.db");
    let wait_for = |count: i64| {
        let deadline = Instant::now() + Duration::from_secs(120);
        while !store.is_file() || matches(&store) < count {
            assert!(
                Instant::now() < deadline,
                "{count} matches were never played"
            );
            thread::sleep(Duration::from_millis(200));
        }
    };
    wait_for(10);
    let dfs = find("dfs").expect("a bundled robot").component;
    fs::write(submissions.join("ann.wasm"), dfs).expect("a file");
    wait_for(20);
    interrupt(&child);
    assert_eq!(child.wait().expect("a process").code(), Some(130));
}

/// Robots that wait, loop, trap and are rejected, beside one that plays.
#[test]
#[cfg(target_os = "linux")]
fn bad_robots_do_not_hold_up_a_contest_and_are_explained() {
    let text = "
version = 1
[[robots]]
path = \"submissions\"
[[mazes]]
set = \"mazes\"
paths = [\"gen:tree:12:1..=10\"]
[run]
jobs = 2
match_time_seconds = 5
robot_time_seconds = 60
[rules]
base = \"udacity\"
name = \"little fuel\"
[rules.sandbox]
step_fuel_max = 2_000_000_000
match_fuel_max = 2_000_000_000
";
    let folder = folder(text);
    let submissions = folder.path().join("submissions");
    fs::create_dir(&submissions).expect("a folder");
    let submit = |name: &str, file: &[u8]| {
        fs::write(submissions.join(name), file).expect("a file");
    };
    submit(
        "good.wasm",
        find("flood").expect("a bundled robot").component,
    );
    submit("waits.wasm", &wasmouse_tests::slow::pointer_chaser());
    let robot = |next| {
        Module {
            next,
            ..Module::default()
        }
        .component()
    };
    submit("loops.wasm", &robot("(loop $l (br $l)) unreachable"));
    submit("traps.wasm", &robot("unreachable"));
    submit("rejected.wasm", b"not wasm");
    let began = Instant::now();
    let ran = ran(&mut contest(folder.path(), &["run"]));
    assert!(
        began.elapsed() < Duration::from_secs(300),
        "{:?}",
        began.elapsed()
    );
    let all = format!("{}{}", ran.stdout, ran.stderr);
    assert_eq!(ran.status.code(), Some(0), "{all}");
    let page = fs::read_to_string(folder.path().join("out.html")).expect("a page");
    let table = &ran.stdout;
    for report in [&page, table] {
        assert!(
            report.contains("waits") && report.contains("did not end"),
            "{report}"
        );
        assert!(
            report.contains("out-of-") || report.contains("fuel"),
            "{report}"
        );
        assert!(
            report.contains("traps") && report.contains("unreachable"),
            "{report}"
        );
        assert!(report.contains("rejected"), "{report}");
    }
    assert!(table.contains("   1  good "), "{table}");
    // What was withdrawn is the organiser's to decide, and not played again by itself.
    let again = succeeds(folder.path(), &["run"]);
    let reason = "`waits`: incomplete: 2 of its matches did not end in time";
    assert!(again.stdout.contains(reason), "{}", again.stdout);
    assert!(again.stderr.contains("nothing to play"), "{}", again.stderr);
    let retried = succeeds(folder.path(), &["run", "--retry"]);
    assert!(
        !retried.stderr.contains("nothing to play"),
        "{}",
        retried.stderr
    );
}

#[test]
fn hidden_mazes_are_committed_to_and_revealed() {
    let folder = folder(SMALL);
    succeeds(folder.path(), &["commit"]);
    let twice = ran(&mut contest(folder.path(), &["commit"]));
    assert_eq!(twice.status.code(), Some(3), "{}", twice.stderr);
    assert!(twice.stderr.contains("already exists"), "{}", twice.stderr);
    let files = ["contest.commitment.json", "contest.opening.json"];
    let reveal = ["reveal", files[0], files[1]];
    succeeds(folder.path(), &reveal);
    let with_store = [&reveal[..], &["--store", "contest.db"]].concat();
    let early = ran(&mut contest(folder.path(), &with_store));
    assert_eq!(early.status.code(), Some(3), "{}", early.stderr);
    succeeds(folder.path(), &["run"]);
    succeeds(folder.path(), &with_store);
    // Neither the commitment nor the reports say what the mazes are.
    let commitment = fs::read_to_string(folder.path().join(files[0])).expect("a file");
    assert!(!commitment.contains("braid"), "{commitment}");
    for (report, name) in reports(folder.path()).iter().zip(REPORTS) {
        let text = String::from_utf8_lossy(report);
        assert!(!text.contains("gen:braid"), "{name} shows a hidden maze");
    }
    let path = folder.path().join(files[1]);
    let opening = fs::read_to_string(&path).expect("a file");
    fs::write(
        &path,
        opening.replace("gen:braid:16:1\"", "gen:braid:16:99\""),
    )
    .expect("a file");
    let changed = ran(&mut contest(folder.path(), &reveal));
    assert_eq!(changed.status.code(), Some(1), "{}", changed.stderr);
    assert!(
        changed.stderr.contains("`final` is not the one"),
        "{}",
        changed.stderr
    );
    assert!(
        changed.stderr.contains("`gen:braid:16:99`"),
        "{}",
        changed.stderr
    );
}

/// What the contest file hides is hidden, and shown to the organiser.
#[test]
fn reports_show_what_the_contest_file_allows() {
    let options = "[report]\nshow_top = 2\nhide_names = true\nfreeze = true\n";
    let folder = folder(&SMALL.replace("[run]", &format!("{options}[run]")));
    let shown = succeeds(folder.path(), &["run"]).stdout;
    assert!(
        !shown.contains("flood") && !shown.contains("random"),
        "{shown}"
    );
    let ranks = |text: &str| {
        let lines = text.lines().filter(|line| line.starts_with("   "));
        lines.take_while(|line| !line.is_empty()).count()
    };
    let all = succeeds(
        folder.path(),
        &["report", "--organiser", "--matches-csv", "all.csv"],
    )
    .stdout;
    assert!(
        all.contains("flood:reset") && all.contains("random"),
        "{all}"
    );
    assert!(ranks(&shown) < ranks(&all), "{shown}\n{all}");
    let matches = fs::read_to_string(folder.path().join("all.csv")).expect("a file");
    assert!(
        matches.contains("gen:braid"),
        "the organiser sees hidden mazes"
    );
    assert_eq!(
        matches.lines().count(),
        4 * 161 * 2 + 1,
        "a line for each match, and names"
    );

    // Frozen reports stay as they are, whatever is played.
    let before = reports(folder.path());
    let file = folder.path().join("contest.toml");
    let more = fs::read_to_string(&file)
        .expect("a file")
        .replace("1..=60", "1..=61");
    fs::write(&file, more).expect("a file");
    let ran = succeeds(folder.path(), &["run"]);
    assert!(
        ran.stderr.contains("kept out.html: reports are frozen"),
        "{}",
        ran.stderr
    );
    assert!(
        before == reports(folder.path()),
        "a frozen report was written"
    );
}

/// A part that was interrupted is merged when that is asked for.
#[test]
fn parts_without_a_seal_are_merged_on_request_only() {
    let folder = folder(SMALL);
    succeeds(
        folder.path(),
        &["run", "--shard", "1/4", "--store", "part.db"],
    );
    let connection = rusqlite::Connection::open(folder.path().join("part.db")).expect("SQLite");
    connection
        .execute("DELETE FROM seal", [])
        .expect("as before its end");
    drop(connection);
    let merge = ["merge", "contest.db", "part.db"];
    let refused = ran(&mut contest(folder.path(), &merge));
    assert_eq!(refused.status.code(), Some(1), "{}", refused.stderr);
    assert!(
        refused.stderr.contains("it has no seal"),
        "{}",
        refused.stderr
    );
    succeeds(
        folder.path(),
        &["merge", "--unsealed", "contest.db", "part.db"],
    );
    assert!(matches(&folder.path().join("contest.db")) > 0);
}

#[test]
fn no_report_takes_the_place_of_the_contest() {
    let folder = folder(SMALL);
    succeeds(folder.path(), &["run", "--shard", "1/20"]);
    for (name, what) in [
        ("contest.toml", "the contest file"),
        ("contest.db", "the store"),
    ] {
        let before = fs::read(folder.path().join(name)).expect("a file");
        let arguments = ["report", "--html", name, "--force"];
        let ran = ran(&mut contest(folder.path(), &arguments));
        assert_eq!(ran.status.code(), Some(3), "{}", ran.stderr);
        assert!(
            ran.stderr.contains(&format!("it is {what}")),
            "{}",
            ran.stderr
        );
        assert_eq!(fs::read(folder.path().join(name)).expect("a file"), before);
    }
}

#[test]
fn what_is_no_store_is_named_and_kept() {
    let folder = folder(SMALL);
    let store = folder.path().join("contest.db");
    for content in ["", "a text"] {
        fs::write(&store, content).expect("a file");
        for command in ["run", "status", "report"] {
            let ran = ran(&mut contest(folder.path(), &[command]));
            assert_eq!(ran.status.code(), Some(3), "{command}: {}", ran.stderr);
            assert!(
                ran.stderr.contains("error: store `contest.db`"),
                "{}",
                ran.stderr
            );
            assert!(ran.stderr.contains("hint: "), "{}", ran.stderr);
        }
        assert_eq!(fs::read_to_string(&store).expect("a file"), content);
    }
}
