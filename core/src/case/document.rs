//! The text of a case with the places of its values.

use crate::math::{Listed, Ordered};
use std::ops::Range;

use super::diagnostic::Diagnostic;
use super::fault::{Faults, TextFault};
use super::tree::{Data, Node, Table};
use super::{json, toml, Format, MOST_BYTES};
use crate::model::{Problem, Value};

/// A text that has been read. It converts later [`Problem`]s into [`Diagnostic`]s.
#[derive(Debug)]
pub struct Document {
    text: String,
    root: Node,
}

impl Document {
    /// Reads the syntax. Returns the document and the keys that occur twice. Errors: all faults of syntax that the
    /// reader could distinguish, one for each line.
    pub(super) fn parse(
        text: &str,
        format: Format,
    ) -> Result<(Self, Vec<Diagnostic>), Vec<Diagnostic>> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.len() > MOST_BYTES {
            let message = format!("{} bytes; at most {MOST_BYTES} are read", text.len());
            return Err(vec![Diagnostic::new(text, 0..0, message)]);
        }
        let mut faults = Faults::default();
        let table = match format {
            Format::Toml => toml::parse(text, &mut faults),
            Format::Json => json::parse(text, &mut faults),
        };
        let (sound, dropped) = (faults.sound(), faults.1);
        faults.0.order_by_key(|fault| (fault.place.start, fault.place.end));
        let mut found: Vec<Diagnostic> =
            faults.0.into_iter().map(|fault| of_fault(text, fault)).list();
        if !sound {
            found.dedup_by_key(|fault| fault.line);
            found.extend((dropped > 0).then(|| Diagnostic::more(dropped)));
            return Err(found);
        }
        let root = Node { key: 0..0, span: 0..0, data: Data::Table(table) };
        Ok((Self { text: text.to_string(), root }, found))
    }

    /// The top of the tree.
    pub(super) fn root(&self) -> &Table {
        match &self.root.data {
            Data::Table(table) => table,
            _ => unreachable!("the root is made as a table"),
        }
    }

    /// All values, without places.
    pub(super) fn value(&self) -> Value {
        self.root.value()
    }

    /// A problem with line, column and excerpt. A path that is not in the text, such as a missing
    /// key, is shown at the key of its nearest ancestor.
    pub fn diagnose(&self, problem: &Problem) -> Diagnostic {
        let mut found = Diagnostic::new(&self.text, self.place(problem), problem.message.clone());
        found.path = problem.path.clone();
        found.hint = problem.hint.clone();
        found
    }

    /// Line and column, from 1, of the key at a path. Names with dots may be split into several entries of the path.
    /// None if the text does not contain the key.
    pub fn position(&self, path: &[&str]) -> Option<(usize, usize)> {
        let node = below(&self.root, path)?;
        let found = Diagnostic::new(&self.text, node.key.clone(), String::new());
        Some((found.line, found.column))
    }

    /// The bytes of a problem.
    pub(super) fn place(&self, problem: &Problem) -> Range<usize> {
        let mut node = &self.root;
        for key in &problem.path {
            match node.child(key).or_else(|| dotted(node, key)) {
                Some(child) => node = child,
                None => return node.key.clone(),
            }
        }
        match &problem.within {
            _ if problem.at_key => node.key.clone(),
            Some(part) => self.part(node, part),
            None => node.span.clone(),
        }
    }

    /// The bytes of a part of a text value, if the file contains the text without escapes; otherwise the bytes of the
    /// entire value.
    fn part(&self, node: &Node, part: &Range<usize>) -> Range<usize> {
        let (Data::Text(text), Some(raw)) = (&node.data, self.text.get(node.span.clone())) else {
            return node.span.clone();
        };
        let inside = raw.get(1..raw.len().saturating_sub(1));
        if inside != Some(text.as_str()) || part.start > part.end || part.end > text.len() {
            return node.span.clone();
        }
        let first = node.span.start + 1;
        first + part.start..first + part.end
    }
}

/// The node at a path; a key of the text may contain several names, joined by dots.
fn below<'n>(node: &'n Node, path: &[&str]) -> Option<&'n Node> {
    if path.is_empty() {
        return Some(node);
    }
    (1..=path.len()).find_map(|n| below(node.child(&path[..n].join("."))?, &path[n..]))
}

/// The node of a key with dots that the file contains as nested tables.
fn dotted<'n>(node: &'n Node, key: &str) -> Option<&'n Node> {
    let (outer, inner) = key.split_once('.')?;
    let node = node.child(outer)?;
    node.child(inner).or_else(|| dotted(node, inner))
}

fn of_fault(text: &str, fault: TextFault) -> Diagnostic {
    let mut found = Diagnostic::new(text, fault.place, fault.message);
    found.hint = fault.earlier.and_then(|earlier| {
        let line = Diagnostic::new(text, earlier, String::new()).line;
        (line != found.line).then(|| format!("it already exists in line {line}"))
    });
    found
}
