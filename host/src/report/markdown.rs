//! Pieces of Markdown as GitHub reads it: tables, names, numbers.

use super::visible;
use crate::contest::Mean;

/// A table under construction; its first columns are text and aligned left, the
/// others are numbers and aligned right.
pub(super) struct Table {
    text: String,
    columns: usize,
}

impl Table {
    /// A table with `left` columns of text.
    pub(super) fn new(header: &[&str], left: usize) -> Self {
        let mut table = Self {
            text: String::new(),
            columns: header.len(),
        };
        table.row(header.iter().map(ToString::to_string));
        table.row((0..header.len()).map(|column| {
            let rule = if column < left { "---" } else { "---:" };
            rule.to_owned()
        }));
        table
    }

    /// Adds a row. Cells are Markdown of one line without `|`.
    pub(super) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        let cells: Vec<String> = cells.into_iter().collect();
        debug_assert_eq!(cells.len(), self.columns, "{cells:?}");
        self.text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }

    /// The table; it ends with a newline.
    pub(super) fn finish(self) -> String {
        self.text
    }
}

/// A name as it was given, in the typewriter font. Names of files may come from
/// strangers: nothing in them is taken for Markdown.
pub(super) fn code(text: &str) -> String {
    let harmless = visible(text).replace('`', "'").replace('|', "¦");
    if harmless.is_empty() {
        return "`?`".to_owned();
    }
    format!("`{harmless}`")
}

/// A table that is folded until somebody asks for it.
pub(super) fn folded(summary: &str, table: &str) -> String {
    format!("<details>\n<summary>{summary}</summary>\n\n{table}\n</details>\n")
}

/// A number with a comma at every third digit: `1,234,567`.
pub(super) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3 + 1);
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A share with two decimals, `86.96 %`, rounded half up; `-` of nothing.
pub(super) fn share(part: u32, whole: u32) -> String {
    if whole == 0 {
        return "-".to_owned();
    }
    let (part, whole) = (u64::from(part), u64::from(whole));
    let hundredths = (part * 20_000 + whole) / (whole * 2);
    format!("{}.{:02} %", hundredths / 100, hundredths % 100)
}

/// An average with three decimals, or `-`.
pub(super) fn mean(mean: Option<Mean>) -> String {
    mean.map_or_else(|| "-".to_owned(), |mean| mean.to_string())
}

/// An average with three decimals and always a sign, or `-`.
pub(super) fn signed(mean: Option<Mean>) -> String {
    mean.map_or_else(
        || "-".to_owned(),
        |mean| match mean.thousandths() {
            0.. => format!("+{mean}"),
            _ => mean.to_string(),
        },
    )
}

/// A score given in thousandths of a step.
pub(super) fn thousandths(score: u64) -> String {
    format!("{}.{:03}", score / 1000, score % 1000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_align_numbers_to_the_right() {
        let mut table = Table::new(&["name", "n"], 1);
        table.row([code("a|b`c\u{1b}"), grouped(1_234_567)]);
        assert_eq!(
            table.finish(),
            "| name | n |\n| --- | ---: |\n| `a¦b'c\\u{1b}` | 1,234,567 |\n"
        );
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!([0, 999, 1000].map(grouped), ["0", "999", "1,000"]);
        assert_eq!(share(420, 483), "86.96 %");
        assert_eq!(share(483, 483), "100.00 %");
        assert_eq!(share(0, 0), "-");
        assert_eq!(signed(Some(Mean::fraction(277, 100))), "+2.770");
        assert_eq!(signed(Some(Mean::fraction(-1, 2))), "-0.500");
        assert_eq!(thousandths(20_067), "20.067");
    }
}
