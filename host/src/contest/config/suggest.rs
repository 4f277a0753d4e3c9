//! [`suggestion`]: what a user may have meant by a misspelt name.

/// How alike two names are for one to be suggested; 1 is equal, 0 is different.
const SIMILARITY_MIN: f64 = 0.7;

/// How many names a suggestion offers.
const SUGGESTED_MAX: usize = 3;

/// ``did you mean `NAME`?`` with the names that are most like the text; `None` when none is.
pub fn suggestion<'a>(text: &str, names: impl Iterator<Item = &'a str>) -> Option<String> {
    let mut alike: Vec<(f64, &str)> = names
        .map(|name| (strsim::jaro_winkler(text, name), name))
        .filter(|&(similarity, _)| similarity >= SIMILARITY_MIN)
        .collect();
    alike.sort_by(|a, b| b.0.total_cmp(&a.0));
    let alike = alike.iter().take(SUGGESTED_MAX);
    let alike: Vec<String> = alike.map(|(_, name)| format!("`{name}`")).collect();
    (!alike.is_empty()).then(|| format!("did you mean {}?", alike.join(" or ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_similar_names_are_suggested() {
        let names = || ["flood", "minnett", "champion"].into_iter();
        let flood = suggestion("fload", names());
        assert_eq!(flood.as_deref(), Some("did you mean `flood`?"));
        assert_eq!(suggestion("zzz", names()), None);
    }
}
