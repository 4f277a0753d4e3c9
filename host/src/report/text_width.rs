//! [`width_of`] a text in a drawing, and [`cut`], which makes it fit.

/// The text, or its beginning and an ellipsis if it is wider than that many hundredths of its size.
pub(super) fn cut(text: &str, width: u32) -> String {
    if width_of(text) <= width {
        return text.to_owned();
    }
    let mut rest = width.saturating_sub(character_width('…'));
    let fits = text.chars().take_while(|&character| {
        let width = character_width(character);
        let fits = width <= rest;
        rest = rest.saturating_sub(width);
        fits
    });
    fits.chain(['…']).collect()
}

/// About how wide a text is, in hundredths of its size; rather more than less. Which font a reader
/// has is not known.
pub(super) fn width_of(text: &str) -> u32 {
    text.chars().map(character_width).sum()
}

/// About how wide a character is, in hundredths of its size.
const fn character_width(character: char) -> u32 {
    match character {
        'i' | 'j' | 'l' | 'I' | ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 34,
        'f' | 'r' | 't' | '(' | ')' | '[' | ']' | '/' | '-' | '"' => 42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | '…' => 100,
        'A'..='Z' => 72,
        ' '..='~' => 64,
        '\u{a1}'..='\u{52f}' => 72,
        _ => 105,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_cut_to_their_width() {
        assert_eq!(cut("abc", 200), "abc");
        assert_eq!(cut("abc", 191), "a…");
        assert_eq!(cut("abc", 120), "…");
        assert_eq!(cut("abcdef", 300), "abc…");
        assert_eq!(cut(&"日".repeat(10_000), 420), "日日日…");
    }
}
