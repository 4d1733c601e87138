//! The problems found so far, and the path of the current value.

use super::tree::{Node, Table};
use super::Format;
use crate::expression::suggest::did_you_mean;
use crate::model::Problem;

/// Collects problems during one traversal of a tree.
pub(super) struct ProblemList {
    format: Format,
    path: Vec<String>,
    problems: Vec<Problem>,
    /// Number of problems that are not kept.
    dropped: usize,
}

impl ProblemList {
    /// An empty list for a text in a format.
    pub(super) fn new(format: Format) -> Self {
        Self { format, path: Vec::new(), problems: Vec::new(), dropped: 0 }
    }
    /// An example in the format of the text.
    pub(super) fn example(&self, toml: &str, json: &str) -> String {
        match self.format {
            Format::Toml => toml.to_string(),
            Format::Json => json.to_string(),
        }
    }
    /// Calls `look` with the value of `key` as the current value.
    pub(super) fn within<T>(&mut self, key: &str, look: impl FnOnce(&mut Self) -> T) -> T {
        self.enter(key);
        let result = look(self);
        self.path.pop();
        result
    }
    /// Calls `look` with each item of a list as the current value.
    pub(super) fn items(&mut self, items: &[Node], mut look: impl FnMut(&mut Self, &Node)) {
        for (k, item) in items.iter().enumerate() {
            self.within(&k.to_string(), |report| look(report, item));
        }
    }
    /// Calls `look` with the key and the value of each entry of a table, as the current value.
    pub(super) fn entries(&mut self, table: &Table, mut look: impl FnMut(&mut Self, &str, &Node)) {
        for (key, node) in &table.entries {
            self.within(key, |report| look(report, key, node));
        }
    }
    #[inline(never)] // one copy for all calls of `within`
    fn enter(&mut self, key: &str) {
        self.path.push(key.to_string());
    }
    /// A problem of the current value, not yet reported.
    pub(super) fn here(&self, message: impl Into<String>) -> Problem {
        Problem::at(&self.path, message)
    }
    /// The key of the current value.
    pub(super) fn key(&self) -> &str {
        self.path.last().map_or("", String::as_str)
    }
    /// Reports a problem. Problems beyond [`MOST_REPORTED`](super::MOST_REPORTED) are only counted.
    pub(super) fn add(&mut self, problem: Problem) {
        match self.problems.len() < super::MOST_REPORTED {
            true => self.problems.push(problem),
            false => self.dropped += 1,
        }
    }
    /// Reports a problem of the current value.
    pub(super) fn say(&mut self, message: impl Into<String>) {
        self.add(self.here(message));
    }
    /// Reports a problem of the key of the current value.
    pub(super) fn say_of_key(&mut self, message: impl Into<String>) {
        self.add(self.here(message).at_key());
    }
    /// Reports an unknown key. The hint suggests the closest known key, or lists all known keys.
    pub(super) fn unknown_key(&mut self, message: impl Into<String>, key: &str, known: &[&str]) {
        let hint = did_you_mean(key, known).unwrap_or_else(|| among("it may have", known));
        self.add(self.here(message).at_key().hint(hint));
    }
    /// Reports the key of the current value as an unknown `what`, " of a section".
    pub(super) fn unknown(&mut self, what: &str, key: &str, of: &str, known: &[&str]) {
        self.unknown_key(format!("unknown {what} '{}'{of}", super::shown(key)), key, known);
    }
    /// Reports each of the keys that a table lacks.
    pub(super) fn missing(&mut self, table: &Table, keys: &[&str]) {
        for key in keys.iter().filter(|key| table.get(key).is_none()) {
            self.say(format!("{key} is missing"));
        }
    }
    /// The kept problems, and the number of further problems.
    pub(super) fn finish(self) -> (Vec<Problem>, usize) {
        (self.problems, self.dropped)
    }
}

/// "it may have a, b or c".
pub(super) fn among(words: &str, known: &[&str]) -> String {
    match known.split_last() {
        None => format!("{words} nothing"),
        Some((last, [])) => format!("{words} {last}"),
        Some((last, others)) => format!("{words} {} or {last}", others.join(", ")),
    }
}
