//! JSON (RFC 8259) → [`Table`] with places. Strict: no comments, no trailing commas.

use std::ops::Range;

use super::fault::Faults;
use super::tree::{number, too_deep, too_many, Data, Node, Table, MOST_DEPTH, MOST_VALUES};

/// Reads a text; the first fault of syntax and all keys that are given twice, or the tree.
pub(super) fn parse(text: &str, faults: &mut Faults) -> Table {
    let mut reader = Reader { text, at: 0, values: 0, faults };
    match reader.document() {
        Ok(table) => table,
        Err((place, message)) => {
            faults.push(place, message);
            Table::default()
        }
    }
}

type Read<T> = Result<T, (Range<usize>, String)>;

struct Reader<'t, 'f> {
    text: &'t str,
    at: usize,
    values: usize,
    faults: &'f mut Faults,
}

impl Reader<'_, '_> {
    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }
    fn next_if(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }
    fn skip(&mut self, wanted: impl Fn(char) -> bool) {
        let rest = &self.text[self.at..];
        self.at += rest.find(|c| !wanted(c)).unwrap_or(rest.len());
    }
    fn blanks(&mut self) {
        self.skip(|c| matches!(c, ' ' | '\t' | '\n' | '\r'));
    }
    fn fail<T>(&self, message: impl Into<String>) -> Read<T> {
        let end = self.at + self.peek().map_or(0, char::len_utf8);
        Err((self.at..end, message.into()))
    }
    /// Fails where something else than `expected` stands.
    fn expected<T>(&self, expected: &str) -> Read<T> {
        let found = match self.peek() {
            None => "the end of the text".to_string(),
            Some('/' | '#') => return self.fail("JSON has no comments"),
            Some(c) => format!("'{}'", super::shown(&c.to_string())),
        };
        self.fail(format!("expected {expected}, not {found}"))
    }

    fn document(&mut self) -> Read<Table> {
        self.blanks();
        if self.peek() != Some('{') {
            return self.expected("'{'");
        }
        let table = self.table(0)?;
        self.blanks();
        match self.peek() {
            None => Ok(table),
            Some(_) => self.expected("the end of the text"),
        }
    }

    fn value(&mut self, depth: usize) -> Read<(Range<usize>, Data)> {
        let start = self.at;
        self.values += 1;
        if self.values > MOST_VALUES {
            return self.fail(too_many());
        }
        if depth > MOST_DEPTH {
            return self.fail(too_deep());
        }
        let data = match self.peek() {
            Some('{') => Data::Table(self.table(depth)?),
            Some('[') => Data::List(self.list(depth)?),
            Some('"') => Data::Text(self.string()?),
            Some(c) if c == '-' || c == '+' || c == '.' || c.is_ascii_digit() => self.number()?,
            Some(c) if c.is_alphabetic() => self.word()?,
            Some('\'') => return self.fail("a text stands in double quotes"),
            _ => return self.expected("a value"),
        };
        Ok((start..self.at, data))
    }

    fn table(&mut self, depth: usize) -> Read<Table> {
        let mut table = Table::default();
        self.at += 1;
        self.blanks();
        if self.next_if('}') {
            return Ok(table);
        }
        loop {
            self.blanks();
            if self.peek() != Some('"') {
                return self.expected("a key in double quotes");
            }
            let start = self.at;
            let key = self.string()?;
            let place = start..self.at;
            self.blanks();
            if !self.next_if(':') {
                return self.expected("':'");
            }
            self.blanks();
            let (span, data) = self.value(depth + 1)?;
            if let Err(fault) = table.insert(key, Node { key: place, span, data }) {
                self.faults.add(fault);
            }
            self.blanks();
            if self.next_if('}') {
                return Ok(table);
            }
            if !self.next_if(',') {
                return self.expected("',' or '}'");
            }
        }
    }

    fn list(&mut self, depth: usize) -> Read<Vec<Node>> {
        let mut items = Vec::new();
        self.at += 1;
        self.blanks();
        if self.next_if(']') {
            return Ok(items);
        }
        loop {
            self.blanks();
            let (span, data) = self.value(depth + 1)?;
            items.push(Node { key: span.clone(), span, data });
            self.blanks();
            if self.next_if(']') {
                return Ok(items);
            }
            if !self.next_if(',') {
                return self.expected("',' or ']'");
            }
        }
    }

    fn word(&mut self) -> Read<Data> {
        let start = self.at;
        self.skip(|c| c.is_alphanumeric() || c == '_');
        let word = &self.text[start..self.at];
        Ok(match word {
            "true" => Data::Flag(true),
            "false" => Data::Flag(false),
            "null" => Data::Refused("null is no value of a case; leave the key out".to_string()),
            "NaN" | "nan" => number("nan", false),
            "Infinity" | "inf" => number("inf", false),
            _ => {
                let place = start..self.at;
                return Err((
                    place,
                    format!("'{}' is no value; a text stands in double quotes", super::shown(word)),
                ));
            }
        })
    }

    fn number(&mut self) -> Read<Data> {
        let start = self.at;
        self.skip(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.' | '_'));
        let digits = &self.text[start..self.at];
        if matches!(digits, "-Infinity" | "-inf" | "+inf" | "+Infinity" | "-NaN") {
            return Ok(number(digits, false));
        }
        match is_number(digits) {
            true => Ok(number(digits, !digits.contains(['.', 'e', 'E']))),
            false => Err((start..self.at, format!("'{}' is no number", super::shown(digits)))),
        }
    }

    fn string(&mut self) -> Read<String> {
        let start = self.at;
        let mut text = String::new();
        self.at += 1;
        loop {
            let from = self.at;
            self.skip(|c| c != '"' && c != '\\' && c >= ' ');
            text.push_str(&self.text[from..self.at]);
            match self.peek() {
                Some('"') => break,
                Some('\\') => text.push(self.escape()?),
                Some('\n' | '\r') | None => {
                    return Err((start..self.at, "the text has no closing '\"'".to_string()))
                }
                Some(_) => return self.fail("a control character must be written as an escape"),
            }
        }
        self.at += 1;
        Ok(text)
    }

    fn escape(&mut self) -> Read<char> {
        let start = self.at;
        self.at += 1;
        let Some(c) = self.peek() else { return self.expected("an escape") };
        self.at += c.len_utf8();
        let decoded = match c {
            '"' | '\\' | '/' => Some(c),
            'b' => Some('\u{8}'),
            'f' => Some('\u{c}'),
            'n' => Some('\n'),
            'r' => Some('\r'),
            't' => Some('\t'),
            'u' => self.code_point(),
            _ => None,
        };
        decoded.ok_or_else(|| (start..self.at, "no such escape".to_string()))
    }

    /// The digits after `\u`, and a second unit after a high surrogate.
    fn code_point(&mut self) -> Option<char> {
        let high = self.unit()?;
        if !(0xD800..0xDC00).contains(&high) {
            return char::from_u32(high);
        }
        if !(self.next_if('\\') && self.next_if('u')) {
            return None;
        }
        let low = self.unit().filter(|low| (0xDC00..0xE000).contains(low))?;
        char::from_u32(0x10000 + ((high - 0xD800) << 10) + (low - 0xDC00))
    }

    fn unit(&mut self) -> Option<u32> {
        let digits = self.text.get(self.at..self.at + 4)?;
        if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
            return None;
        }
        self.at += 4;
        u32::from_str_radix(digits, 16).ok()
    }
}

/// -? (0 | 1-9 digits) (. digits)? ([eE] [+-]? digits)?
fn is_number(text: &str) -> bool {
    let digits = |s: &str| !s.is_empty() && s.bytes().all(|b| b.is_ascii_digit());
    let body = text.strip_prefix('-').unwrap_or(text);
    let (mantissa, exponent) = match body.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (body, None),
    };
    let (whole, fraction) = match mantissa.split_once('.') {
        Some((whole, fraction)) => (whole, Some(fraction)),
        None => (mantissa, None),
    };
    digits(whole)
        && (whole.len() == 1 || !whole.starts_with('0'))
        && fraction.is_none_or(digits)
        && exponent.is_none_or(|e| digits(e.strip_prefix(['+', '-']).unwrap_or(e)))
}
