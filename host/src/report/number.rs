//! Numbers for people.

use std::fmt::Display;

/// A number of things, in the plural where it has to be: `1 maze`, `2 matches`.
pub(crate) fn counted<N: Display + PartialEq + From<u8>>(number: N, thing: &str) -> String {
    let ending = match thing {
        _ if number == N::from(1) => "",
        _ if thing.ends_with("match") => "es",
        _ => "s",
    };
    format!("{number} {thing}{ending}")
}

/// As [`counted`], with the verb that goes with it: `1 match was`, `2 matches were`.
pub(crate) fn counted_were<N: Display + PartialEq + From<u8>>(number: N, thing: &str) -> String {
    let verb = if number == N::from(1) { "was" } else { "were" };
    format!("{} {verb}", counted(number, thing))
}

/// A number with its thousands apart: `1,234,567`.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_not_many() {
        let matches = [0_u64, 1, 2].map(|number| counted(number, "match"));
        assert_eq!(matches, ["0 matches", "1 match", "2 matches"]);
        let mazes = [1_usize, 21].map(|number| counted_were(number, "hidden maze"));
        assert_eq!(mazes, ["1 hidden maze was", "21 hidden mazes were"]);
    }
}
