//! The paths and macro calls in a Rust file, found without a compiler: comments
//! and literals are taken out, items under `#[cfg(test)]` are skipped, and what is
//! left is read word by word.

use std::iter::Peekable;
use std::slice::{self, Iter};

/// What a file names.
#[derive(Debug, Default)]
pub struct Source {
    /// Every path of two or more names, with groups in braces unfolded.
    pub paths: Vec<Vec<String>>,
    /// Macros that are called, by their last name.
    pub macros: Vec<String>,
    /// Modules in files of their own that are only there for tests.
    pub test_modules: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Token {
    Word(String),
    /// `::`.
    Colons,
    Other(char),
}

type Tokens<'a> = Peekable<Iter<'a, Token>>;

impl Source {
    /// Reads the text of a file.
    pub fn parse(text: &str) -> Self {
        let mut source = Self::default();
        let tokens = source.without_tests(tokens(&without_literals(text)));
        let mut tokens = tokens.iter().peekable();
        let mut follows_colons = false;
        while let Some(token) = tokens.next() {
            if let Token::Word(name) = token
                && !follows_colons
            {
                source.path(vec![name.clone()], &mut tokens);
            }
            follows_colons = *token == Token::Colons;
        }
        source
    }

    /// Reads the rest of a path, of which the beginning has been read.
    fn path(&mut self, mut path: Vec<String>, tokens: &mut Tokens<'_>) {
        while tokens.next_if_eq(&&Token::Colons).is_some() {
            match tokens.peek() {
                Some(Token::Word(name)) => {
                    path.push(name.clone());
                    tokens.next();
                }
                Some(Token::Other('{')) => {
                    tokens.next();
                    return self.group(&path, tokens);
                }
                Some(Token::Other('*')) => path.push("*".into()),
                _ => break,
            }
        }
        if tokens.peek() == Some(&&Token::Other('!')) {
            self.macros.extend(path.last().cloned());
        }
        if path.len() > 1 {
            self.paths.push(path);
        }
    }

    /// Reads `a, b::c, ...}` behind a path.
    fn group(&mut self, prefix: &[String], tokens: &mut Tokens<'_>) {
        let mut is_first_word = true;
        while let Some(token) = tokens.next() {
            match token {
                Token::Word(name) if is_first_word => {
                    let path = [prefix, slice::from_ref(name)].concat();
                    self.path(path, tokens);
                    is_first_word = false;
                }
                Token::Other(',') => is_first_word = true,
                Token::Other('}') => return,
                _ => {}
            }
        }
    }

    /// Takes out the items under `#[cfg(test)]` and notes modules among them that
    /// are in other files.
    fn without_tests(&mut self, tokens: Vec<Token>) -> Vec<Token> {
        let attribute = self::tokens("#[cfg(test)]");
        let mut kept = Vec::with_capacity(tokens.len());
        let mut rest = &tokens[..];
        while let Some(token) = rest.first() {
            let Some(item) = rest.strip_prefix(&attribute[..]) else {
                kept.push(token.clone());
                rest = &rest[1..];
                continue;
            };
            let length = item_length(item);
            if let [
                ..,
                Token::Word(keyword),
                Token::Word(name),
                Token::Other(';'),
            ] = &item[..length]
                && keyword == "mod"
            {
                self.test_modules.push(name.clone());
            }
            rest = &item[length..];
        }
        kept
    }
}

/// Tokens up to the end of the item: its `;`, or the brace that closes it.
fn item_length(item: &[Token]) -> usize {
    let mut depth = 0_usize;
    for (index, token) in item.iter().enumerate() {
        match token {
            Token::Other('{' | '(' | '[') => depth += 1,
            Token::Other(')' | ']') => depth = depth.saturating_sub(1),
            Token::Other('}') => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return index + 1;
                }
            }
            Token::Other(';') if depth == 0 => return index + 1,
            _ => {}
        }
    }
    item.len()
}

fn tokens(code: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        let is_in_word = |character: char| character.is_alphanumeric() || character == '_';
        let length = if is_in_word(first) {
            let word = rest.split(|character| !is_in_word(character)).next();
            let word = word.expect("a split has a first part");
            tokens.push(Token::Word(word.to_owned()));
            word.len()
        } else if rest.starts_with("::") {
            tokens.push(Token::Colons);
            2
        } else {
            if !first.is_whitespace() {
                tokens.push(Token::Other(first));
            }
            first.len_utf8()
        };
        rest = &rest[length..];
    }
    tokens
}

/// The text with a space for every comment and literal.
fn without_literals(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = match literal_length(rest, code.chars().next_back()) {
            Some(length) => {
                code.push(' ');
                length
            }
            None => {
                code.push(first);
                first.len_utf8()
            }
        };
        rest = &rest[length..];
    }
    code
}

/// Bytes of the comment or literal that begins here, if one does.
fn literal_length(rest: &str, before: Option<char>) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    if rest.starts_with("/*") {
        return Some(comment_length(rest));
    }
    if let Some(text) = rest.strip_prefix('"') {
        return Some(1 + quoted_length(text, '"'));
    }
    let is_in_word = before.is_some_and(|before| before.is_alphanumeric() || before == '_');
    if !is_in_word && (rest.starts_with('r') || rest.starts_with("br")) {
        return raw_length(rest);
    }
    let text = rest.strip_prefix('\'')?;
    let mut characters = text.chars();
    // A lifetime is a quote and a name without a quote behind its first letter.
    let is_character = characters.next() == Some('\\') || characters.next() == Some('\'');
    is_character.then(|| 1 + quoted_length(text, '\''))
}

/// Bytes to the end of a quoted text, its closing quote included.
fn quoted_length(text: &str, quote: char) -> usize {
    let mut is_escaped = false;
    for (index, character) in text.char_indices() {
        if is_escaped {
            is_escaped = false;
        } else if character == '\\' {
            is_escaped = true;
        } else if character == quote {
            return index + quote.len_utf8();
        }
    }
    text.len()
}

fn raw_length(rest: &str) -> Option<usize> {
    let text = rest.trim_start_matches('b').strip_prefix('r')?;
    let hashes = text.len() - text.trim_start_matches('#').len();
    let body = text[hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    let length = body.find(&end).map_or(body.len(), |at| at + end.len());
    Some(rest.len() - body.len() + length)
}

/// Block comments nest.
fn comment_length(rest: &str) -> usize {
    let mut depth = 0_usize;
    let mut at = 0;
    while at < rest.len() {
        let here = &rest[at..];
        if here.starts_with("/*") {
            depth += 1;
            at += 2;
        } else if here.starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += here.chars().next().map_or(1, char::len_utf8);
        }
    }
    rest.len()
}
