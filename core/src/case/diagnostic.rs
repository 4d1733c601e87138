//! A fault for the author of a file: its place, description and remedy.

use crate::math::Listed;
use crate::model::more_problems;
use std::fmt;
use std::ops::Range;

/// One fault of a text. Displayed as
///
/// ```text
/// bodies.crank.mass: -1 kg; must not be negative (line 7, column 8)
///   7 | mass = -1
///     |        ^^
/// hint: ...
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Line, from 1; 0 for the entry that contains the number of further faults.
    pub line: usize,
    /// Column in characters, from 1; a tab is one character.
    pub column: usize,
    /// Keys from the top of the file; empty for a fault of syntax.
    pub path: Vec<String>,
    /// Description.
    pub message: String,
    /// Remedy, if there is one.
    pub hint: Option<String>,
    /// The line with a caret below it: two lines of text.
    pub excerpt: String,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            let part = |key: &String| if key.is_empty() { "\"\"".to_string() } else { shown(key) };
            let path: Vec<String> = self.path.iter().map(part).list();
            write!(f, "{}: ", path.join("."))?;
        }
        if self.line == 0 {
            return f.write_str(&self.message); // the number of further faults
        }
        write!(f, "{} (line {}, column {})", self.message, self.line, self.column)?;
        write!(f, "\n{}", self.excerpt)?;
        match &self.hint {
            Some(hint) => write!(f, "\nhint: {hint}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Diagnostic {}

/// Largest number of characters of a line that are shown.
const WIDTH: usize = 100;
/// Smallest number of characters that are shown before the caret.
const BEFORE: usize = 30;
/// Largest number of characters of a name that are shown.
const MOST_SHOWN: usize = 80;

impl Diagnostic {
    /// The last entry of a shortened list, which contains the number of further faults.
    pub fn more(faults: usize) -> Self {
        let (message, excerpt) = (more_problems(faults), String::new());
        Self { line: 0, column: 0, path: Vec::new(), message, hint: None, excerpt }
    }

    /// A fault at some bytes of a text.
    pub(super) fn new(text: &str, place: Range<usize>, message: String) -> Self {
        // a fault at the end of the text is shown after the last word
        let last = text.trim_end().len();
        let start = boundary(text, place.start).min(last);
        let end = boundary(text, place.end.max(start));
        let line_start = text[..start].rfind('\n').map_or(0, |k| k + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |k| start + k);
        let line = text[..line_start].bytes().filter(|&b| b == b'\n').count() + 1;
        let column = text[line_start..start].chars().count() + 1;
        let marked = text[start..end.min(line_end)].trim_end_matches('\r').chars().count();
        let content = text[line_start..line_end].trim_end_matches('\r');
        let excerpt = excerpt(line, content, column - 1, marked.max(1));
        Self { line, column, path: Vec::new(), message, hint: None, excerpt }
    }
}

/// The nearest boundary of a character at or before a byte.
fn boundary(text: &str, byte: usize) -> usize {
    let mut k = byte.min(text.len());
    while !text.is_char_boundary(k) {
        k -= 1;
    }
    k
}

/// The line, shortened around the marked characters, and the carets below.
fn excerpt(line: usize, content: &str, first: usize, marked: usize) -> String {
    let skipped = if first + marked.min(BEFORE) <= WIDTH { 0 } else { first - BEFORE };
    let mut shown_line = String::new();
    let (mut indent, mut carets) = (0, 0);
    let mut rest = content.chars().skip(skipped);
    if skipped > 0 {
        shown_line.push('…');
        indent += 1;
    }
    for (k, c) in rest.by_ref().take(WIDTH).enumerate() {
        let width = push_shown(&mut shown_line, c);
        match skipped + k {
            at if at < first => indent += width,
            at if at < first + marked => carets += width,
            _ => {}
        }
    }
    if rest.next().is_some() {
        shown_line.push('…');
    }
    let number = line.to_string();
    let gutter = " ".repeat(number.len());
    let caret = "^".repeat(carets.max(1));
    format!("  {number} | {shown_line}\n  {gutter} | {}{caret}", " ".repeat(indent))
}

/// Adds a character in printable form and returns its number of columns.
fn push_shown(out: &mut String, c: char) -> usize {
    let before = out.chars().count();
    match c {
        '\t' => out.push_str("    "),
        c if is_hidden(c) => out.extend(c.escape_unicode()),
        c => out.push(c),
    }
    out.chars().count() - before
}

/// Whether a character is invisible or changes the direction of the surrounding text: control characters,
/// bidirectional controls, and blanks of zero width.
pub(super) fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{061C}' | '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{206F}' | '\u{FEFF}')
}

/// A name or text in the form for messages: on one line, shortened, with visible characters only.
pub(super) fn shown(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars().take(MOST_SHOWN) {
        match c {
            c if is_hidden(c) => out.extend(c.escape_default()),
            c => out.push(c),
        }
    }
    if text.chars().nth(MOST_SHOWN).is_some() {
        out.push('…');
    }
    out
}
