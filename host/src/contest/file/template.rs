//! [`template`]: a contest file to begin with.

/// `{{name}}` stands for the name of the contest, as a TOML string.
const TEMPLATE: &str = include_str!("../../../templates/contest/contest.toml");

/// A contest file with comments, for a contest of that name. Everything that is commented out is
/// valid, too: lines that begin with `#` and no space are keys and tables.
///
/// The name is quoted, and has to be one to make a valid file.
pub fn template(name: &str) -> String {
    let quoted = toml::Value::from(name).to_string();
    TEMPLATE.replace("{{name}}", &quoted)
}
