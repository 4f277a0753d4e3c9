//! Errors in configuration files, for the terminal: the line with what is wrong marked in it.

use super::text::{Text, text};
use crate::contest::config::{ConfigError, Excerpt};

/// The place, the message and the line. The file is how the user calls it.
///
/// ```
/// use wasmouse::contest::config;
/// use wasmouse::report::config::config_error;
/// use wasmouse::report::text::Printable as _;
///
/// let error = config::read::<std::collections::BTreeMap<String, u32>>("a = \"b\"");
/// let shown = config_error(&"contest.toml".to_text(), &error.expect_err("no number"));
/// assert_eq!(shown.as_str(), "\
/// contest.toml, line 1, column 5: `a`: expected an integer from 0 to 4294967295, found the string \"b\"
///   |
/// 1 | a = \"b\"
///   |     ^^^");
/// ```
pub fn config_error(file: &Text, error: &ConfigError) -> Text {
    let Excerpt { text, marked } = &*error.excerpt;
    let message = text!(
        "{}, line {}, column {}: {}",
        file,
        error.line,
        error.column,
        error.message
    );
    if text.is_empty() {
        return message;
    }
    // What is escaped is longer.
    let parts = [&text[..marked.start], &text[marked.clone()]];
    let [before, inside] = parts.map(|it| text!("{}", it).as_str().chars().count());
    let number = error.line.to_string();
    let margin = " ".repeat(number.len());
    let blank = " ".repeat(before);
    let carets = "^".repeat(inside.max(1));
    text!(
        "{}\n{} |\n{} | {}\n{} | {}{}",
        message,
        margin,
        number,
        text,
        margin,
        blank,
        carets
    )
}

#[cfg(test)]
mod tests {
    use super::super::text::Printable as _;
    use super::*;
    use crate::contest::config;

    #[test]
    fn carets_are_below_escaped_text() {
        let text = "# \n'\u{202e}' = { x = 1, \"y\" = 'ä' }\n";
        let error = config::read::<std::collections::BTreeMap<String, u32>>(text);
        let shown = config_error(&"c.toml".to_text(), &error.expect_err("no number"));
        assert_eq!(
            shown.as_str(),
            "c.toml, line 2, column 7: `\\u{202e}`: expected an integer from 0 to 4294967295, \
             found a table\n  |\n2 | '\\u{202e}' = { x = 1, \"y\" = 'ä' }\n  |              \
             ^^^^^^^^^^^^^^^^^^^^"
        );
    }

    #[test]
    fn long_lines_are_cut() {
        let text = format!("a = [{}\"x\", {}]", "1, ".repeat(1000), "2, ".repeat(1000));
        let error = config::read::<std::collections::BTreeMap<String, Vec<u32>>>(&text);
        let shown = config_error(&"c.toml".to_text(), &error.expect_err("no number"));
        assert!(
            shown.as_str().contains("column 3006: `a[1000]`"),
            "{shown:?}"
        );
        let lines: Vec<&str> = shown.as_str().lines().collect();
        assert!(
            lines[2].len() < 110 && lines[3].ends_with(" ^^^"),
            "{shown:?}"
        );
    }
}
