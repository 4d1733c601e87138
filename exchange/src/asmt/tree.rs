//! The tree of an `.asmt` file: each line is a node, and one more tab at its start makes it a child of the line above.

use std::cell::Cell;

/// Deepest nesting that is read; files of the tool have about 12 levels.
const DEEPEST: usize = 64;

/// A line with the lines that belong to it.
#[derive(Debug)]
pub(super) struct Node<'a> {
    pub(super) line: usize,
    pub(super) text: &'a str,
    pub(super) inside: Vec<Node<'a>>,
    used: Cell<bool>,
}

impl<'a> Node<'a> {
    /// The node of this name below this one; the name counts as read.
    pub(super) fn get(&self, name: &str) -> Option<&Node<'a>> {
        let found = self.inside.iter().find(|node| node.text == name && !node.used.get());
        found.inspect(|node| node.used.set(true))
    }

    /// Marks the node as read.
    pub(super) fn take(&self) -> &Self {
        self.used.set(true);
        self
    }

    /// Marks the node and all below it as read.
    pub(super) fn take_all(&self) {
        self.take();
        self.inside.iter().for_each(Node::take_all);
    }

    /// The only line below the node of this name.
    pub(super) fn value(&self, name: &str) -> Option<&'a str> {
        self.get(name)?.inside.first().map(|node| node.take().text)
    }

    /// The numbers of the lines below the node of this name. The error names the line.
    pub(super) fn numbers(&self, name: &str) -> Result<Option<Vec<f64>>, (usize, String)> {
        let Some(node) = self.get(name) else { return Ok(None) };
        let mut found = Vec::new();
        for row in &node.inside {
            row.take();
            for word in row.text.split_whitespace() {
                let number = word.parse::<f64>().ok().filter(|x| x.is_finite());
                found.push(number.ok_or_else(|| {
                    (row.line, format!("{name}: '{}' is not a number", short(word)))
                })?);
            }
        }
        Ok(Some(found))
    }

    /// The highest nodes that nothing has read.
    pub(super) fn unused(&self) -> Vec<&Node<'a>> {
        let mut found = Vec::new();
        for node in &self.inside {
            if node.used.get() {
                found.extend(node.unused());
            } else {
                found.push(node);
            }
        }
        found
    }
}

/// The beginning of a text, for messages.
pub(super) fn short(text: &str) -> String {
    text.chars().take(60).collect()
}

/// Lines with their numbers.
pub(super) type Lines<'a> = Vec<(usize, &'a str)>;

/// Reads the lines up to a line `TimeSeries`, and returns the tree and the lines from there on.
pub(super) fn read(text: &str) -> Result<(Node<'_>, Lines<'_>), (usize, String)> {
    let mut lines = text.lines().enumerate().map(|(k, line)| (k + 1, line.trim_end()));
    let mut open = vec![Node { line: 0, text: "", inside: Vec::new(), used: Cell::new(true) }];
    let mut series = Vec::new();
    while let Some((line, content)) = lines.next() {
        let inner = content.trim_start_matches('\t');
        let depth = content.len() - inner.len() + 1;
        if inner.trim().is_empty() {
            continue;
        }
        if inner == "TimeSeries" && depth == 1 {
            series = lines.by_ref().filter(|(_, text)| !text.is_empty()).collect();
            break;
        }
        if depth > DEEPEST {
            return Err((line, format!("nested more than {DEEPEST} deep")));
        }
        if depth > open.len() {
            return Err((
                line,
                format!(
                    "'{}' has {} tabs more than a line above it allows",
                    short(inner),
                    depth - open.len()
                ),
            ));
        }
        close(&mut open, depth);
        open.push(Node { line, text: inner.trim(), inside: Vec::new(), used: Cell::new(false) });
    }
    close(&mut open, 1);
    Ok((open.pop().expect("the root stays open"), series))
}

/// Ends the nodes from this depth on.
fn close(open: &mut Vec<Node<'_>>, depth: usize) {
    while open.len() > depth {
        let node = open.pop().expect("deeper than the root");
        open.last_mut().expect("the root stays open").inside.push(node);
    }
}
