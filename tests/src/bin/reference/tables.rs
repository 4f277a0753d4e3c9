//! Markdown tables, and numbers in them.

use std::fmt::Display;

use wasmouse::contest::Mean;

/// A Markdown table; columns of numbers are aligned right.
pub struct Table(String);

impl Table {
    /// A table whose first `left` columns are text.
    pub fn new<S: Display>(header: impl IntoIterator<Item = S>, left: usize) -> Self {
        let mut table = Self(String::new());
        let header: Vec<String> = header.into_iter().map(|it| it.to_string()).collect();
        let rule = |column| if column < left { "---" } else { "---:" };
        let rules: Vec<&str> = (0..header.len()).map(rule).collect();
        table.row(header);
        table.row(rules);
        table
    }

    /// Adds a row.
    pub fn row<S: Display>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.0.push('|');
        for cell in cells {
            self.0.push_str(&format!(" {cell} |"));
        }
        self.0.push('\n');
    }

    /// The text, which ends with a newline.
    pub fn finish(self) -> String {
        self.0
    }
}

/// A name in a fixed-width font.
pub fn code(name: impl Display) -> String {
    format!("`{name}`")
}

/// A number with a comma after every third digit: `1,234,567`.
pub fn grouped(number: u64) -> String {
    if number < 1000 {
        return number.to_string();
    }
    format!("{},{:03}", grouped(number / 1000), number % 1000)
}

/// A share with two decimals, `86.96 %`; `-` of nothing.
pub fn share(part: u64, whole: u64) -> String {
    if whole == 0 {
        return "-".to_owned();
    }
    let hundredths = (part * 20_000 + whole) / (whole * 2);
    format!("{}.{:02} %", hundredths / 100, hundredths % 100)
}

/// `420 of 500 (84.00 %)`.
pub fn count(part: u64, whole: u64) -> String {
    format!("{part} of {whole} ({})", share(part, whole))
}

/// An average, or `-`.
pub fn mean(mean: Option<Mean>) -> String {
    mean.map_or_else(|| "-".to_owned(), |mean| mean.to_string())
}

/// An average with its sign, or `-`.
pub fn signed(number: Option<Mean>) -> String {
    let sign = number
        .filter(|it| it.thousandths() >= 0)
        .map_or("", |_| "+");
    format!("{sign}{}", mean(number))
}
