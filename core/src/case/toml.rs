//! TOML → [`Table`] with places. Syntax is read by `toml_parser`, which continues after an error.
//!
//! `DeTable::parse_recoverable` of the crate `toml` would replace this file and `toml_tables`, but it loses the values
//! and faults behind an unclosed header, the place of the first of two equal keys, and any bound on the number of
//! faults.

use crate::math::Listed;
use std::borrow::Cow;
use std::ops::Range;

use toml_parser::decoder::{Encoding, ScalarKind};
use toml_parser::parser::{parse_document, EventReceiver, RecursionGuard, ValidateWhitespace};
use toml_parser::{ErrorSink, Expected, ParseError, Source, Span};

use super::fault::Faults;
use super::toml_tables::Builder;
use super::tree::{number, Data, Table, MOST_DEPTH};

/// Reads a text, and reports all faults of syntax.
pub(super) fn parse(text: &str, faults: &mut Faults) -> Table {
    let source = Source::new(text);
    let tokens = source.lex().into_vec();
    let mut events = Events { source, builder: Builder::default(), joined: false };
    let mut errors = Vec::new();
    let mut sink = |error: ParseError| match errors.len() < super::MOST_REPORTED {
        true => errors.push(error),
        false => faults.1 += 1,
    };
    let mut checked = ValidateWhitespace::new(&mut events, source);
    let mut guarded = RecursionGuard::new(&mut checked, MOST_DEPTH as u32);
    parse_document(&tokens, &mut guarded, &mut sink);
    for error in errors {
        let place = error.unexpected().or(error.context()).map_or(0..0, range);
        let message = slip(text, place.clone()).unwrap_or_else(|| message(&error));
        faults.push(place, message);
    }
    events.builder.finish(faults)
}

fn range(span: Span) -> Range<usize> {
    span.start()..span.end()
}

/// The message of the parser, with the expected tokens.
fn message(error: &ParseError) -> String {
    let mut text = error.description().to_string();
    if text.starts_with("invalid boolean") {
        return "string values must be quoted".to_string(); // a word of letters only
    }
    if text.starts_with("string values") && error.unexpected().is_none_or(|span| span.is_empty()) {
        return "the value is missing".to_string();
    }
    if text.starts_with("cannot recurse") {
        text = super::tree::too_deep();
    }
    let expected: Vec<String> = error.expected().unwrap_or_default().iter().map(word).list();
    if !expected.is_empty() {
        text.push_str("; expected ");
        text.push_str(&expected.join(" or "));
    }
    text
}

/// The message of a frequent slip: a decimal comma, or entries without commas between them.
fn slip(text: &str, place: Range<usize>) -> Option<String> {
    let (before, found) = (text.get(..place.start)?, text.get(place.clone())?);
    let number = |word: &str| word.parse::<f64>().is_ok();
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let mut after = text[place.start..].chars();
    if digit(before.chars().last()) && after.next() == Some(',') && digit(after.next()) {
        return Some("a number with a comma; the decimal mark is a point".to_string());
    }
    let several = found.split_whitespace().count() > 1 && found.split_whitespace().all(number);
    several.then(|| format!("'{found}': write commas between the entries"))
}

fn word(expected: &Expected) -> String {
    match expected {
        Expected::Literal("\n") => "the end of the line".to_string(),
        Expected::Literal(literal) => format!("'{literal}'"),
        Expected::Description(words) => (*words).to_string(),
        _ => "something else".to_string(),
    }
}

/// Turns the events of the parser into tables.
struct Events<'s> {
    source: Source<'s>,
    builder: Builder,
    /// Whether the next key continues a dotted key.
    joined: bool,
}

impl Events<'_> {
    fn decoded(&self, span: Span, encoding: Option<Encoding>, error: &mut dyn ErrorSink) -> Data {
        let Some(raw) = self.source.get(span) else { return Data::Refused("nothing".to_string()) };
        let raw = toml_parser::Raw::new_unchecked(raw.as_str(), encoding, span);
        let mut text = Cow::Borrowed("");
        match raw.decode_scalar(&mut text, error) {
            ScalarKind::String => Data::Text(text.into_owned()),
            ScalarKind::Boolean(flag) => Data::Flag(flag),
            ScalarKind::DateTime => Data::Refused("a date is not a value of a case".to_string()),
            ScalarKind::Float => number(&text, false),
            ScalarKind::Integer(radix) if radix.value() == 10 => number(&text, true),
            ScalarKind::Integer(radix) => match u64::from_str_radix(&text, radix.value()) {
                Ok(x) => number(&x.to_string(), true),
                Err(_) => number("1e17", true), // so many digits that it is beyond 2^53
            },
        }
    }
}

impl EventReceiver for Events<'_> {
    fn std_table_open(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.joined = false;
        self.builder.open_header(span.start());
    }
    fn std_table_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.builder.close_header(span.end(), false);
    }
    fn array_table_open(&mut self, span: Span, error: &mut dyn ErrorSink) {
        self.std_table_open(span, error);
    }
    fn array_table_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.builder.close_header(span.end(), true);
    }
    fn inline_table_open(&mut self, span: Span, _: &mut dyn ErrorSink) -> bool {
        self.builder.open(span.start(), Data::Table(Table::default()));
        true
    }
    fn inline_table_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.builder.close(span.end());
    }
    fn array_open(&mut self, span: Span, _: &mut dyn ErrorSink) -> bool {
        self.builder.open(span.start(), Data::List(Vec::new()));
        true
    }
    fn array_close(&mut self, span: Span, _: &mut dyn ErrorSink) {
        self.builder.close(span.end());
    }
    fn simple_key(&mut self, span: Span, kind: Option<Encoding>, error: &mut dyn ErrorSink) {
        let Some(raw) = self.source.get(span) else { return };
        let raw = toml_parser::Raw::new_unchecked(raw.as_str(), kind, span);
        let mut key = Cow::Borrowed("");
        raw.decode_key(&mut key, error);
        let joined = std::mem::take(&mut self.joined);
        self.builder.key(key.into_owned(), range(span), joined);
    }
    fn key_sep(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.joined = true;
    }
    fn scalar(&mut self, span: Span, kind: Option<Encoding>, error: &mut dyn ErrorSink) {
        let data = self.decoded(span, kind, error);
        self.builder.place(range(span), data);
    }
}
