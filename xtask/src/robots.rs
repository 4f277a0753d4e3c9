//! `cargo xtask robots`: builds the bundled robots, or says which are stale.

use std::fs;
use std::io;
use std::path::Path;

use crate::manifest::{Entry, Manifest, folder, table_path};
use crate::sources::{robot_names, sha256, sources_sha256};
use crate::step::{Step, wasmouse_binary};

/// Builds every robot of `example-robots` into `output` as `NAME.wasm`, with a
/// `wasmouse` binary that already exists.
///
/// # Errors
///
/// A line that names the robot that cannot be built.
pub fn build_all(root: &Path, output: &Path) -> Result<(), String> {
    fs::create_dir_all(output)
        .map_err(|error| format!("cannot create `{}`: {error}", output.display()))?;
    for name in robot_names(root).map_err(text)? {
        let crate_folder = Path::new("example-robots").join(&name);
        let component = output.join(&name).with_extension("wasm");
        Step::new(format!("robot {name}"), root, wasmouse_binary(root))
            .args(["build".as_ref(), crate_folder.as_os_str()])
            .args(["--no-match"])
            .args(["--output".as_ref(), component.as_os_str()])
            .run()?;
    }
    Ok(())
}

/// Builds all robots into `example-robots/prebuilt` and writes the manifest and
/// the host's table.
///
/// # Errors
///
/// A line that names what cannot be built or written.
pub fn rebuild(root: &Path) -> Result<(), String> {
    Step::cargo("build wasmouse", root)
        // The same call as in `verify`, for the same reason.
        .args(["build", "--workspace", "--bins", "--tests"])
        .run()?;
    let folder = folder(root);
    build_all(root, &folder)?;
    let manifest = describe(root).map_err(text)?;
    remove_others(&folder, &manifest).map_err(text)?;
    fs::write(folder.join("manifest.toml"), manifest.to_toml()).map_err(text)?;
    fs::write(table_path(root), manifest.to_rust()).map_err(text)?;
    Step::new("format the table", root, "rustfmt")
        .args([
            "--edition".as_ref(),
            "2024".as_ref(),
            table_path(root).as_os_str(),
        ])
        .run()
}

fn describe(root: &Path) -> io::Result<Manifest> {
    let robots = robot_names(root)?
        .iter()
        .map(|name| {
            let component = fs::read(folder(root).join(name).with_extension("wasm"))?;
            Entry::describe(root, name, &component)
        })
        .collect::<io::Result<_>>()?;
    Ok(Manifest {
        schema: Manifest::SCHEMA,
        robots,
    })
}

/// Removes components of robots that are gone.
fn remove_others(folder: &Path, manifest: &Manifest) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let is_component = path.extension().is_some_and(|it| it == "wasm");
        let is_listed = manifest
            .robots
            .iter()
            .any(|robot| path.file_name().is_some_and(|it| it == &*robot.file));
        if is_component && !is_listed {
            fs::remove_file(path)?;
        }
    }
    Ok(())
}

/// Says on stdout whether the prebuilt robots are those of the sources.
///
/// # Errors
///
/// A line with the number of stale robots.
pub fn check(root: &Path) -> Result<(), String> {
    let problems = problems(root).map_err(text)?;
    if problems.is_empty() {
        println!("the prebuilt robots are those of the sources");
        return Ok(());
    }
    for problem in &problems {
        println!("{problem}");
    }
    Err("prebuilt robots are stale; run `cargo xtask robots`".to_owned())
}

/// What does not fit between the sources, the manifest, the components and the
/// host's table: one line each, none if all is well.
///
/// # Errors
///
/// When the manifest or a source cannot be read.
pub fn problems(root: &Path) -> io::Result<Vec<String>> {
    let manifest = Manifest::load(root)?;
    let names = robot_names(root)?;
    let mut problems = Vec::new();
    for name in &names {
        if !manifest.robots.iter().any(|robot| robot.name == *name) {
            problems.push(format!("{name}: not in the manifest"));
        }
    }
    for robot in &manifest.robots {
        let name = &robot.name;
        if !names.contains(name) {
            problems.push(format!("{name}: in the manifest, but has no sources"));
            continue;
        }
        if robot.sources_sha256 != sources_sha256(root, name)? {
            problems.push(format!("{name}: its sources have changed"));
        }
        match fs::read(folder(root).join(&robot.file)) {
            Ok(component) if sha256(&component) == robot.sha256 => {}
            Ok(_) => problems.push(format!("{name}: `{}` is another file", robot.file)),
            Err(error) => problems.push(format!("{name}: `{}`: {error}", robot.file)),
        }
    }
    Ok(problems)
}

fn text(error: io::Error) -> String {
    error.to_string()
}
