//! What C and C++ have in common: the flags in `compile_flags.txt`, which editors read too, and
//! the compiler, `zig cc` or clang.
//!
//! A robot is freestanding, without a standard library, unless its flags choose a target with
//! WASI: `--target=wasm32-wasi`.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::zig_compiler::{CLANG, ZIG_CC};
use crate::cli::failure::Failure;
use crate::cli::project::language::{Language, Project};
use crate::report::text::{Text, text};

/// The flags of the compiler, one a line: the file that clangd reads.
pub const FLAGS_FILE: &str = "compile_flags.txt";

/// What a component depends on.
pub const SOURCES: &[&str] = &["src", "wasmouse", FLAGS_FILE];

/// The folders that are compiled.
const FOLDERS: [&str; 2] = ["src", "wasmouse"];

/// One of the two languages.
pub struct Dialect {
    /// The subcommand of zig.
    pub driver: &'static str,
    /// The option by which clang links what the language needs.
    pub clang_options: &'static [&'static str],
    /// Of the files that are compiled.
    pub extensions: &'static [&'static str],
    /// The file that makes a folder a project in this language, and the one of the other.
    pub entries: [&'static str; 2],
}

impl Dialect {
    /// A project is named after its folder: there is no manifest.
    pub fn open(&self, folder: &Path, language: &'static Language) -> Result<Project, Failure> {
        let [own, other] = self.entries;
        if folder.join(other).is_file() {
            return Err(Failure::input(text!(
                "`{}` has two robots: {} and {}",
                Text::of_path(folder),
                own,
                other
            ))
            .hint("a project is one robot: move the other one into a folder of its own"));
        }
        Project::named_after_folder(folder, language)
    }

    /// Compiles and links all sources in one go; the diagnostics go to stderr as they come.
    pub fn compile(&self, project: &Project) -> Result<Vec<u8>, Failure> {
        let compiler = ZIG_CC.find(Some(&project.folder))?;
        let is_clang = compiler.is(&CLANG);
        let flags = read_flags(&project.folder)?;
        let target = Target::of(&flags);
        let sources = self.sources(&project.folder)?;
        let scratch = tempfile::tempdir()
            .map_err(|error| Failure::internal(text!("no temporary folder: {}", error)))?;
        let module = scratch.path().join("robot.wasm");
        let mut command = compiler.command();
        if is_clang {
            command.args(self.clang_options);
        } else {
            command.arg(self.driver);
        }
        command
            .arg(target.option(is_clang))
            .args(flags.iter().filter(|it| !it.starts_with(TARGET)))
            // For backtraces; of the lines, those of the project's files stay.
            .arg("-gline-tables-only")
            .args(target.linking())
            // Relative, so that the component does not depend on where the project is.
            .args(&sources)
            .arg("-o")
            .arg(&module)
            .current_dir(&project.folder);
        compiler
            .run(command, &text!("compile `{}`", project.name))
            .map_err(|failure| {
                let failure = if is_clang {
                    failure.hint(
                        "the messages of clang are above; if it could not run the linker, \
                         install wasm-ld (on Debian: apt-get install lld-22)",
                    )
                } else {
                    failure
                };
                self.explain(failure, target, project, &sources)
            })?;
        fs::read(&module).map_err(|error| {
            Failure::input(text!("the compiler wrote no module: {}", error))
                .hint(text!("look for flags such as `-c` in {}", FLAGS_FILE))
        })
    }

    /// A missing standard header has an answer that a compiler does not know.
    fn explain(
        &self,
        failure: Failure,
        target: Target,
        project: &Project,
        sources: &[PathBuf],
    ) -> Failure {
        let includes_library = |source: &PathBuf| {
            fs::read_to_string(project.folder.join(source))
                .is_ok_and(|text| text.lines().any(|line| is_library_header(line, self)))
        };
        if target == Target::Freestanding && sources.iter().any(includes_library) {
            return failure.hint(text!(
                "the messages are above; robots have no standard library by default, so only \
                 headers such as <stdint.h> and <stddef.h> are there: to have all of it, write \
                 `--target=wasm32-wasi` into {} (the first build then takes some minutes)",
                FLAGS_FILE
            ));
        }
        failure
    }

    /// The files to compile, in the same order everywhere.
    fn sources(&self, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
        let mut sources = Vec::new();
        for name in FOLDERS {
            let path = folder.join(name);
            if path.is_dir() {
                self.collect(&path, Path::new(name), &mut sources)
                    .map_err(|error| {
                        Failure::input(text!(
                            "failed to read `{}`: {}",
                            Text::of_path(&path),
                            error
                        ))
                    })?;
            }
        }
        sources.sort();
        Ok(sources)
    }

    fn collect(&self, path: &Path, name: &Path, sources: &mut Vec<PathBuf>) -> io::Result<()> {
        for entry in fs::read_dir(path)? {
            let entry = entry?;
            let (path, name) = (entry.path(), name.join(entry.file_name()));
            let is_source = name
                .extension()
                .is_some_and(|it| self.extensions.iter().any(|extension| it == *extension));
            if path.is_dir() {
                self.collect(&path, &name, sources)?;
            } else if is_source {
                sources.push(name);
            }
        }
        Ok(())
    }
}

/// Whether a line includes a header that is not there without a standard library.
fn is_library_header(line: &str, dialect: &Dialect) -> bool {
    const FREESTANDING: [&str; 8] = [
        "stdint.h",
        "stddef.h",
        "stdbool.h",
        "stdarg.h",
        "limits.h",
        "float.h",
        "stdalign.h",
        "stdnoreturn.h",
    ];
    let Some(rest) = line.trim_start().strip_prefix("#include <") else {
        return false;
    };
    let header = rest.split('>').next().unwrap_or_default();
    let is_c = header.ends_with(".h");
    !FREESTANDING.contains(&header) && (is_c || dialect.driver == "c++")
}

/// How a target is chosen in the flags.
const TARGET: &str = "--target=";

/// With or without a standard library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Target {
    Freestanding,
    Wasi,
}

impl Target {
    fn of(flags: &[String]) -> Self {
        let is_wasi = |flag: &String| {
            flag.strip_prefix(TARGET)
                .is_some_and(|it| it.contains("wasi"))
        };
        if flags.iter().any(is_wasi) {
            Self::Wasi
        } else {
            Self::Freestanding
        }
    }

    /// Zig has names of its own.
    const fn option(self, is_clang: bool) -> &'static str {
        match (self, is_clang) {
            (Self::Freestanding, false) => "--target=wasm32-freestanding",
            (Self::Freestanding, true) => "--target=wasm32-unknown-unknown",
            (Self::Wasi, _) => "--target=wasm32-wasi",
        }
    }

    fn linking(self) -> impl Iterator<Item = OsString> {
        let options: &[&str] = match self {
            Self::Freestanding => &["-nostdlib", "-Wl,--no-entry"],
            Self::Wasi => &["-mexec-model=reactor"],
        };
        options.iter().map(OsString::from)
    }
}

/// The flags of a project, one a line.
fn read_flags(folder: &Path) -> Result<Vec<String>, Failure> {
    let path = folder.join(FLAGS_FILE);
    let text = fs::read_to_string(&path).map_err(|error| {
        Failure::input(text!(
            "failed to read `{}`: {}",
            Text::of_path(&path),
            error
        ))
        .hint("it has the flags of the compiler, one a line, such as `-O2` and `-I.`")
    })?;
    let lines = text.lines().map(str::trim);
    Ok(lines
        .filter(|it| !it.is_empty())
        .map(str::to_owned)
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_target_is_that_of_the_flags() {
        for (flags, expected) in [
            ("-O2", Target::Freestanding),
            ("--target=wasm32-unknown-unknown", Target::Freestanding),
            ("--target=wasm32-wasi", Target::Wasi),
            ("--target=wasm32-wasip1", Target::Wasi),
        ] {
            assert_eq!(Target::of(&[flags.to_owned()]), expected, "{flags}");
        }
    }

    #[test]
    fn headers_of_the_library_are_known() {
        let (c, cpp) = (&super::super::c::DIALECT, &super::super::cpp::DIALECT);
        assert!(is_library_header("#include <stdio.h>", c));
        assert!(is_library_header("  #include <vector> // all", cpp));
        assert!(!is_library_header("#include <stdint.h>", c));
        assert!(!is_library_header("#include \"robot.h\"", cpp));
    }
}
