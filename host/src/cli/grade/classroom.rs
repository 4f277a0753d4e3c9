//! [`context`]: what the runner of Classroom 50 puts into the environment.

use std::env;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::super::failure::Failure;
use crate::report::grade::ClassroomContext;
use crate::report::text::text;

/// The context of the submission.
///
/// # Errors
///
/// With the variables that are missing.
pub fn context() -> Result<ClassroomContext, Failure> {
    let (mut missing, get) = (Vec::new(), |names: &[&str]| {
        let values = names.iter().filter_map(|name| env::var(name).ok());
        let mut values = values.filter(|it| !it.is_empty());
        values.next()
    });
    let mut require = |names: &[&'static str]| {
        get(names).unwrap_or_else(|| {
            missing.push(names[0]);
            String::new()
        })
    };
    let context = ClassroomContext {
        classroom: require(&["CLASSROOM"]),
        assignment: require(&["ASSIGNMENT"]),
        assignment_type: get(&["ASSIGNMENT_TYPE"]).unwrap_or_else(|| "individual".to_owned()),
        owner: require(&["OWNER", "USERNAME"]),
        submission: require(&["SUBMISSION_TAG"]),
        commit: require(&["COMMIT_URL"]),
        release: require(&["RELEASE_URL"]),
        review: require(&["REVIEW_URL", "COMMIT_URL"]),
        datetime: date(SystemTime::now()),
    };
    if missing.is_empty() {
        return Ok(context);
    }
    let message = text!(
        "a result for Classroom 50 needs its environment: {} not set",
        missing.join(", ")
    );
    Err(Failure::usage(message).hint("the runner of Classroom 50 sets them"))
}

/// `YYYY-MM-DDTHH:MM:SSZ`. The runner of Classroom 50 replaces it by that of the commit.
fn date(time: SystemTime) -> String {
    let since = time.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO);
    let (days, seconds) = (since.as_secs() / 86_400, since.as_secs() % 86_400);
    // Howard Hinnant's `civil_from_days`: years begin in March, so that leap days come last.
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = era * 400 + year + u64::from(month <= 2);
    format!(
        "{year:04}-{month:02}-{day:02}T{:02}:{:02}:{:02}Z",
        seconds / 3600,
        seconds / 60 % 60,
        seconds % 60
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, expected) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (1_709_251_199, "2024-02-29T23:59:59Z"),
            (1_798_761_599, "2026-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(date(UNIX_EPOCH + Duration::from_secs(seconds)), expected);
        }
    }
}
