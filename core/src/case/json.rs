//! JSON (RFC 8259) → [`Table`] with places. `serde_json` checks the syntax; its raw values are slices of the text,
//! whose addresses determine the places of keys and values.

use std::ops::Range;

use serde_json::value::RawValue;
use serde_json::{from_str, Deserializer, Error};

use super::fault::Faults;
use super::tree::{number, too_deep, too_many, Data, Node, Table, MOST_DEPTH, MOST_VALUES};

/// Reads a text. The faults are the first fault of syntax, or all keys that are given twice.
pub(super) fn parse(text: &str, faults: &mut Faults) -> Table {
    let mut reader = Reader { text, values: 0, faults };
    let root = from_str::<&RawValue>(text).map_err(|error| fault(text, &error));
    match root.and_then(|root| reader.data(root.get(), 0)) {
        Ok(Data::Table(table)) => return table,
        Ok(_) => faults.push(0..1, "expected '{'; a case is a table"),
        Err((place, message)) => faults.push(place, message),
    }
    Table::default()
}

type TextFault = (Range<usize>, String);

struct Reader<'t, 'f> {
    text: &'t str,
    values: usize,
    faults: &'f mut Faults,
}

impl<'t> Reader<'t, '_> {
    fn place(&self, raw: &str) -> Range<usize> {
        let start = raw.as_ptr() as usize - self.text.as_ptr() as usize;
        start..start + raw.len()
    }

    fn data(&mut self, raw: &'t str, depth: usize) -> Result<Data, TextFault> {
        self.values += 1;
        if self.values > MOST_VALUES {
            return Err((self.place(raw), too_many()));
        }
        if depth > MOST_DEPTH {
            return Err((self.place(raw), too_deep()));
        }
        Ok(match raw.as_bytes()[0] {
            b'{' => Data::Table(self.table(raw, depth)?),
            b'[' => {
                let item = |raw| self.node(raw, raw, depth);
                Data::List(Parts::of(raw).map(item).collect::<Result<_, TextFault>>()?)
            }
            b'"' => Data::Text(self.string(raw)?),
            b't' | b'f' => Data::Flag(raw == "true"),
            b'n' => Data::Refused("null is not a value of a case; omit the key".to_string()),
            _ => number(raw, !raw.contains(['.', 'e', 'E'])),
        })
    }

    fn node(&mut self, key: &str, raw: &'t str, depth: usize) -> Result<Node, TextFault> {
        Ok(Node { key: self.place(key), span: self.place(raw), data: self.data(raw, depth + 1)? })
    }

    fn table(&mut self, raw: &'t str, depth: usize) -> Result<Table, TextFault> {
        let mut table = Table::default();
        let mut parts = Parts::of(raw);
        while let (Some(key), Some(value)) = (parts.next(), parts.next()) {
            let node = self.node(key, value, depth)?;
            if let Err(fault) = table.insert(self.string(key)?, node) {
                self.faults.add(fault);
            }
        }
        Ok(table)
    }

    /// A text with its escapes replaced. An unpaired surrogate is detected only here.
    fn string(&self, raw: &str) -> Result<String, TextFault> {
        from_str(raw).map_err(|error| (self.place(raw), words(&error)))
    }
}

/// The items of a list, or the keys and values of a table in turn; the syntax has been checked.
struct Parts<'t>(&'t str);

impl<'t> Parts<'t> {
    fn of(raw: &'t str) -> Self {
        Self(&raw[1..raw.len() - 1])
    }
}

impl<'t> Iterator for Parts<'t> {
    type Item = &'t str;

    fn next(&mut self) -> Option<&'t str> {
        let rest = self.0.trim_start_matches([' ', '\t', '\n', '\r', ',', ':']);
        let mut stream = Deserializer::from_str(rest).into_iter::<&RawValue>();
        let part = stream.next()?.ok()?;
        self.0 = &rest[stream.byte_offset()..];
        Some(part.get())
    }
}

/// The message of an error without its line and column.
fn words(error: &Error) -> String {
    let text = error.to_string();
    text.rsplit_once(" at line ").map_or(text.as_str(), |(words, _)| words).to_string()
}

/// A fault of syntax with its place, and with advice for frequent mistakes.
fn fault(text: &str, error: &Error) -> TextFault {
    let before: usize = text.split_inclusive('\n').take(error.line() - 1).map(str::len).sum();
    let mut message = words(error);
    // before a control character, the column of serde_json is that of the last accepted byte
    let late = usize::from(!message.starts_with("control character"));
    let mut at = before + error.column().saturating_sub(late);
    if error.is_eof() {
        at = text.len();
    }
    message += match text.as_bytes().get(at) {
        Some(b'/' | b'#') => "; JSON has no comments",
        Some(b'\'') => "; a text is written in double quotes",
        Some(b'N' | b'I') => "; a number must be finite",
        Some(b'\n' | b'\r') => "; the text has no closing '\"'",
        _ => "",
    };
    (at..at + 1, message)
}
