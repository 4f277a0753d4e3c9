//! [`Outputs`]: the files that grades are written to.

use std::collections::BTreeSet;
use std::env;
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::super::failure::Failure;
use super::super::output::{self, Draft, Existing, message};
use super::classroom;
use crate::contest::grade::Submission;
use crate::report::grade::{
    ClassroomContext, Report, STEP_SUMMARY_BYTES_MAX, csv, gradescope, json, junit, markdown, tap,
};
use crate::report::text::{Text, text};

/// Where the runner of GitHub takes the summary of a step from.
const STEP_SUMMARY_VARIABLE: &str = "GITHUB_STEP_SUMMARY";

/// What grades are written to.
#[derive(clap::Args, Debug)]
pub struct OutputArgs {
    /// Write all grades to FILE as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write all grades to FILE as JUnit XML
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Write all grades to FILE as Markdown
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    /// Write all grades to FILE in the Test Anything Protocol
    #[arg(long, value_name = "FILE")]
    tap: Option<PathBuf>,
    /// Write all grades to FILE as CSV, a line for each robot
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write the grade of one robot to FILE as results.json of Gradescope
    #[arg(long, value_name = "FILE")]
    gradescope: Option<PathBuf>,
    /// Write the grade of one robot to FILE as result.json of Classroom 50
    #[arg(long, value_name = "FILE")]
    classroom: Option<PathBuf>,
    /// Write all formats to DIR: a summary, and a folder for each robot
    #[arg(long, value_name = "DIR")]
    output_dir: Option<PathBuf>,
    /// Append Markdown to the summary of a GitHub Actions step
    #[arg(long)]
    step_summary: bool,
    /// Print what was missed as annotations of GitHub Actions
    #[arg(long)]
    pub annotations: bool,
    /// Overwrite files that exist
    #[arg(long)]
    pub force: bool,
}

/// A format for one robot or many.
type Format = fn(&Report<'_>) -> String;

/// Files that have been begun, so that work is not lost over a name.
pub struct Outputs {
    files: Vec<(PathBuf, Draft, Format)>,
    gradescope: Option<(PathBuf, Draft)>,
    classroom: Option<(PathBuf, Draft)>,
    context: Option<ClassroomContext>,
    folder: Option<(PathBuf, Existing)>,
    step_summary: Option<PathBuf>,
}

fn whole_markdown(report: &Report<'_>) -> String {
    markdown(report, usize::MAX)
}

impl Outputs {
    /// Begins all files.
    ///
    /// # Errors
    ///
    /// When one of them cannot be written, or is not for as many robots.
    pub fn create(args: &OutputArgs, robots: usize) -> Result<Self, Failure> {
        let existing = Existing::from_flag(args.force);
        let draft = |path: &Option<PathBuf>| {
            let begin = |path: &PathBuf| Ok((path.clone(), Draft::create(path, existing)?));
            path.as_ref().map(begin).transpose()
        };
        if robots > 1 {
            only_one(args.gradescope.is_some(), args.classroom.is_some(), robots)?;
        }
        let mut files = Vec::new();
        let formats: [(&Option<PathBuf>, Format); 5] = [
            (&args.json, json),
            (&args.junit, junit),
            (&args.markdown, whole_markdown),
            (&args.tap, tap),
            (&args.csv, csv),
        ];
        let context = match args.classroom {
            Some(_) => Some(classroom::context()?),
            None => classroom::context().ok(),
        };
        let step_summary = args.step_summary.then(step_summary_path).transpose()?;
        for (path, format) in formats {
            let begun = draft(path)?;
            files.extend(begun.map(|(path, draft)| (path, draft, format)));
        }
        let (gradescope, classroom) = (draft(&args.gradescope)?, draft(&args.classroom)?);
        let folder = args.output_dir.as_ref();
        let folder =
            folder.map(|path| begin_folder(path, existing).map(|()| (path.clone(), existing)));
        Ok(Self {
            files,
            gradescope,
            classroom,
            context,
            folder: folder.transpose()?,
            step_summary,
        })
    }

    /// Checks that a format for one robot gets one, now that it is known how many there are.
    ///
    /// # Errors
    ///
    /// When there are more.
    pub fn check(&self, submissions: &[Submission]) -> Result<(), Failure> {
        only_one(
            self.gradescope.is_some(),
            self.classroom.is_some(),
            submissions.len(),
        )
    }

    /// Writes everything. What fails keeps nothing else from being written.
    ///
    /// # Errors
    ///
    /// The first failure.
    pub fn write(self, report: &Report<'_>) -> Result<(), Failure> {
        let mut first = Ok(());
        let mut keep = |written: Result<(), Failure>| {
            if first.is_ok() {
                first = written;
            }
        };
        for (path, draft, format) in self.files {
            keep(commit(&path, draft, &format(report)));
        }
        if let [grade] = report.grades {
            if let Some((path, draft)) = self.gradescope {
                keep(commit(&path, draft, &gradescope(report, grade)));
            }
            if let (Some((path, draft)), Some(context)) = (self.classroom, &self.context) {
                let text = crate::report::grade::classroom(report, grade, context);
                keep(commit(&path, draft, &text));
            }
        }
        if let Some((folder, existing)) = &self.folder {
            keep(write_folder(
                folder,
                *existing,
                report,
                self.context.as_ref(),
            ));
        }
        if let Some(path) = &self.step_summary {
            keep(append(path, report));
        }
        first
    }
}

fn only_one(gradescope: bool, classroom: bool, robots: usize) -> Result<(), Failure> {
    let flag = match (gradescope, classroom) {
        (true, _) => "--gradescope",
        (_, true) => "--classroom",
        _ => return Ok(()),
    };
    if robots == 1 {
        return Ok(());
    }
    let message = text!("{} is for one robot, and there are {}", flag, robots);
    Err(Failure::usage(message).hint("--output-dir writes a file for each robot"))
}

fn commit(path: &Path, mut draft: Draft, text: &str) -> Result<(), Failure> {
    let written = draft.write_all(text.as_bytes());
    written.map_err(|error| output::failure(path, &error))?;
    draft.commit()
}

fn step_summary_path() -> Result<PathBuf, Failure> {
    let path = env::var_os(STEP_SUMMARY_VARIABLE).filter(|it| !it.is_empty());
    path.map(PathBuf::from).ok_or_else(|| {
        let message = text!(
            "--step-summary needs the variable {}",
            STEP_SUMMARY_VARIABLE
        );
        Failure::usage(message).hint("the runner of GitHub sets it; --markdown writes a file")
    })
}

/// Appends the summary; what is in the file by now counts for the limit.
fn append(path: &Path, report: &Report<'_>) -> Result<(), Failure> {
    let failed = |error: &std::io::Error| output::failure(path, error);
    let file = OpenOptions::new().append(true).create(true).open(path);
    let mut file = file.map_err(|error| failed(&error))?;
    let length = file.metadata().map_err(|error| failed(&error))?.len();
    let length = usize::try_from(length).unwrap_or(usize::MAX);
    let text = markdown(report, STEP_SUMMARY_BYTES_MAX.saturating_sub(length + 1));
    let written = file.write_all(format!("\n{text}").as_bytes());
    written.map_err(|error| failed(&error))
}

/// Makes the folder.
fn begin_folder(path: &Path, existing: Existing) -> Result<(), Failure> {
    fs::create_dir_all(path).map_err(|error| output::failure(path, &error))?;
    let entries = fs::read_dir(path).map_err(|error| output::failure(path, &error))?;
    if existing == Existing::Keep && entries.count() > 0 {
        let message = text!("the folder `{}` is not empty", Text::of_path(path));
        return Err(Failure::input(message).hint("replace its files with --force"));
    }
    // Whether files can be written there.
    Draft::create(&path.join("grade.json"), existing).map(drop)
}

/// A summary of all robots, and a folder for each.
fn write_folder(
    folder: &Path,
    existing: Existing,
    report: &Report<'_>,
    context: Option<&ClassroomContext>,
) -> Result<(), Failure> {
    let save = |path: PathBuf, text: String| output::save(&path, text.as_bytes(), existing);
    save(folder.join("summary.csv"), csv(report))?;
    save(folder.join("summary.md"), whole_markdown(report))?;
    save(folder.join("grade.json"), json(report))?;
    save(folder.join("junit.xml"), junit(report))?;
    save(folder.join("grade.tap"), tap(report))?;
    let mut names = BTreeSet::new();
    for grade in report.grades {
        let own = folder.join(folder_name(grade.robot.raw(), &mut names));
        fs::create_dir_all(&own).map_err(|error| output::failure(&own, &error))?;
        let alone = report.of(grade);
        save(own.join("grade.json"), json(&alone))?;
        save(own.join("junit.xml"), junit(&alone))?;
        save(own.join("grade.md"), whole_markdown(&alone))?;
        save(own.join("grade.tap"), tap(&alone))?;
        save(own.join("results.json"), gradescope(report, grade))?;
        if let Some(context) = context {
            let text = crate::report::grade::classroom(report, grade, context);
            save(own.join("result.json"), text)?;
        }
    }
    message!("wrote grades to {}", Text::of_path(folder));
    Ok(())
}

/// The longest name of a folder, without a number that tells it from others. Unit: bytes.
const NAME_BYTES_MAX: usize = 64;

/// A name that every file system takes, and that no other robot has.
fn folder_name(robot: &str, taken: &mut BTreeSet<String>) -> String {
    let is_plain = |it: char| it.is_ascii_alphanumeric() || matches!(it, '-' | '_' | '.');
    let name = robot.chars().take(NAME_BYTES_MAX);
    let name: String = name.map(|it| if is_plain(it) { it } else { '_' }).collect();
    let name = name.trim_matches('.');
    let reserved = ["con", "prn", "aux", "nul"];
    let name = match name.to_ascii_lowercase().as_str() {
        "" => "robot".to_owned(),
        lower if reserved.contains(&lower) => format!("{name}_"),
        _ => name.to_owned(),
    };
    // Some file systems do not tell capital letters from small ones.
    let mut unique = name.clone();
    let mut number = 2;
    while !taken.insert(unique.to_ascii_lowercase()) {
        unique = format!("{name}-{number}");
        number += 1;
    }
    unique
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_stay_inside_and_apart() {
        let mut taken = BTreeSet::new();
        let long = "x".repeat(500);
        let names = [
            "a",
            "A",
            "../b",
            "..",
            "",
            "c:\\d",
            "NUL",
            "\u{1f42d}",
            "a b",
            &long,
        ];
        let names = names.map(|it| folder_name(it, &mut taken));
        let expected = [
            "a", "A-2", "_b", "robot", "robot-2", "c__d", "NUL_", "_", "a_b",
        ];
        assert_eq!(names[..9], expected);
        assert_eq!(names[9].len(), NAME_BYTES_MAX);
    }
}
