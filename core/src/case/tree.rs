//! The values of a file with their places in bytes.

use crate::math::Listed;
use std::collections::HashMap;
use std::ops::Range;

use super::fault::TextFault;
use crate::model::Value;

/// Largest nesting depth of values.
pub const MOST_DEPTH: usize = 64;
/// Largest number of values that are read.
pub const MOST_VALUES: usize = 1_000_000;

/// A value and its place.
#[derive(Debug)]
pub(super) struct Node {
    /// Bytes of its key; in a list, the bytes of the value.
    pub key: Range<usize>,
    /// Bytes of the value; for a table with a header, the bytes of the header.
    pub span: Range<usize>,
    /// The value.
    pub data: Data,
}

/// A value of a file.
#[derive(Debug)]
pub(super) enum Data {
    /// A finite number.
    Number(f64),
    /// A text.
    Text(String),
    /// true or false.
    Flag(bool),
    /// A list.
    List(Vec<Node>),
    /// A table.
    Table(Table),
    /// A value that a case must not contain, with the reason.
    Refused(String),
}

/// Keys with values in the order of the file.
#[derive(Debug, Default)]
pub(super) struct Table {
    /// Entries in order.
    pub entries: Vec<(String, Node)>,
    index: HashMap<String, usize>,
    /// The way in which the file defines the table.
    pub origin: Origin,
}

/// The way in which a table is defined; TOML allows the extension of some tables only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Origin {
    /// Written in braces.
    #[default]
    Inline,
    /// Implicitly, as the table `a` of a header such as `[a.b]`.
    Implied,
    /// By its own header.
    Header,
    /// By a dotted key.
    Dotted,
}

impl Table {
    pub(super) fn of(origin: Origin) -> Self {
        Self { origin, ..Self::default() }
    }
    pub(super) fn get(&self, key: &str) -> Option<&Node> {
        self.index.get(key).map(|&k| &self.entries[k].1)
    }
    pub(super) fn get_mut(&mut self, key: &str) -> Option<&mut Node> {
        self.index.get(key).map(|&k| &mut self.entries[k].1)
    }
    /// Adds an entry, unless the key already exists.
    pub(super) fn insert(&mut self, key: String, node: Node) -> Result<(), TextFault> {
        if let Some(earlier) = self.get(&key) {
            return Err(TextFault::twice(&key, node.key, earlier.key.clone()));
        }
        self.index.insert(key.clone(), self.entries.len());
        self.entries.push((key, node));
        Ok(())
    }
    /// The value of a key, created if it is absent.
    pub(super) fn get_or_insert(&mut self, key: &str, make: impl FnOnce() -> Node) -> &mut Node {
        let next = self.entries.len();
        let at = *self.index.entry(key.to_string()).or_insert(next);
        if at == next {
            self.entries.push((key.to_string(), make()));
        }
        &mut self.entries[at].1
    }
}

impl Node {
    /// The value without places; a refused value becomes an empty text.
    pub(super) fn value(&self) -> Value {
        match &self.data {
            Data::Number(x) => Value::Number(*x),
            Data::Text(text) => Value::Text(text.clone()),
            Data::Flag(flag) => Value::Flag(*flag),
            Data::List(items) => Value::List(items.iter().map(Node::value).list()),
            Data::Table(table) => Value::Table(table.values()),
            Data::Refused(_) => Value::Text(String::new()),
        }
    }
    /// The kind of value, in the words of error messages.
    pub(super) fn noun(&self) -> &'static str {
        match &self.data {
            Data::Number(_) => "a number",
            Data::Text(_) => "a text",
            Data::Flag(_) => "true or false",
            Data::List(_) => "a list",
            Data::Table(_) => "a table",
            Data::Refused(_) => "no value of a case",
        }
    }
    /// The value at a key of a table or an index of a list.
    pub(super) fn child(&self, key: &str) -> Option<&Node> {
        match &self.data {
            Data::Table(table) => table.get(key),
            Data::List(items) => items.get(key.parse::<usize>().ok()?),
            _ => None,
        }
    }
}

impl Table {
    /// The entries without places.
    pub(super) fn values(&self) -> Vec<(String, Value)> {
        self.entries.iter().map(|(key, node)| (key.clone(), node.value())).list()
    }
}

/// A number from the digits of a file, or the reason why it is not allowed.
pub(super) fn number(digits: &str, whole: bool) -> Data {
    const EXACT: i64 = 1 << 53;
    let exact = || digits.parse::<i64>().is_ok_and(|n| (-EXACT..=EXACT).contains(&n));
    match digits.parse::<f64>() {
        Ok(x) if !x.is_finite() && digits.contains(['n', 'N']) => {
            Data::Refused(format!("{digits}; must be a finite number"))
        }
        Ok(x) if x.is_infinite() => Data::Refused("number is too large".to_string()),
        Ok(_) if whole && !exact() => Data::Refused(
            "integer is beyond 2^53 and would be rounded; write it with an exponent".to_string(),
        ),
        Ok(x) => Data::Number(x),
        Err(_) => Data::Refused("not a number".to_string()),
    }
}

pub(super) fn too_deep() -> String {
    format!("values are nested deeper than {MOST_DEPTH} levels")
}

pub(super) fn too_many() -> String {
    format!("more than {MOST_VALUES} values")
}
