//! The construction of tables from headers and dotted keys of TOML (TOML 1.0, "Keys", "Table", "Array of Tables").

use std::ops::Range;

use super::fault::{Faults, TextFault};
use super::tree::{too_deep, too_many, Data, Node, Origin, Table, MOST_DEPTH, MOST_VALUES};

type Key = (String, Range<usize>);

/// Collects values into tables, in the order in which the parser reads them.
#[derive(Default)]
pub(super) struct Builder {
    root: Table,
    /// The path of the table of the last header; None after a faulty header.
    header: Option<Vec<Key>>,
    started: bool,
    header_start: usize,
    /// The key that is being read outside of braces and brackets.
    keys: Vec<Key>,
    open: Vec<Open>,
    values: usize,
    faults: Faults,
}

/// A list or an inline table whose end has not been read.
struct Open {
    start: usize,
    data: Data,
    keys: Vec<Key>,
}

impl Builder {
    pub(super) fn finish(self, faults: &mut Faults) -> Table {
        for fault in self.faults.0 {
            faults.add(fault);
        }
        self.root
    }

    pub(super) fn open_header(&mut self, start: usize) {
        self.open.clear(); // brackets that an error left open
        self.keys.clear();
        self.header_start = start;
    }

    /// One part of a key; `joined` if a dot precedes it.
    pub(super) fn key(&mut self, key: String, place: Range<usize>, joined: bool) {
        let keys = self.open.last_mut().map_or(&mut self.keys, |open| &mut open.keys);
        if !joined {
            keys.clear();
        }
        if keys.len() <= MOST_DEPTH {
            keys.push((key, place));
        }
    }

    pub(super) fn open(&mut self, start: usize, data: Data) {
        self.open.push(Open { start, data, keys: Vec::new() });
    }

    pub(super) fn close(&mut self, end: usize) {
        if let Some(open) = self.open.pop() {
            self.place(open.start..end, open.data);
        }
    }

    /// Stores a complete value under the preceding keys.
    pub(super) fn place(&mut self, span: Range<usize>, data: Data) {
        self.values += 1;
        if self.values == MOST_VALUES + 1 {
            self.faults.push(span.clone(), too_many());
        }
        if self.values > MOST_VALUES {
            return;
        }
        if self.depth() > MOST_DEPTH {
            return self.faults.push(span, too_deep());
        }
        if let Some(Open { data: Data::List(items), .. }) = self.open.last_mut() {
            items.push(Node { key: span.clone(), span, data });
            return;
        }
        self.store(span, data);
    }

    /// The number of keys and indices from the root to the next value.
    fn depth(&self) -> usize {
        let inside: usize = self.open.iter().map(|open| open.keys.len().max(1)).sum();
        self.header.as_ref().map_or(0, Vec::len) + self.keys.len() + inside
    }

    fn store(&mut self, span: Range<usize>, data: Data) {
        let (table, keys) = match self.open.last_mut() {
            Some(Open { data: Data::Table(table), keys, .. }) => (table, std::mem::take(keys)),
            Some(_) => return,
            None => {
                let keys = std::mem::take(&mut self.keys);
                match (&self.header, self.started) {
                    (_, false) => (&mut self.root, keys),
                    (None, true) => return,
                    (Some(path), true) => match descend(&mut self.root, path, Origin::Implied) {
                        Ok(table) => (table, keys),
                        Err(_) => return,
                    },
                }
            }
        };
        if let Err(fault) = put(table, keys, span, data) {
            self.faults.add(fault);
        }
    }

    /// Creates the table of a complete header.
    pub(super) fn close_header(&mut self, end: usize, of_list: bool) {
        self.started = true;
        self.header = None;
        let path = std::mem::take(&mut self.keys);
        let span = self.header_start..end;
        if path.len() > MOST_DEPTH - 1 {
            return self.faults.push(span, too_deep());
        }
        self.values += 1;
        if self.values > MOST_VALUES {
            return;
        }
        match make(&mut self.root, &path, span, of_list) {
            Ok(()) => self.header = Some(path),
            Err(fault) => self.faults.add(fault),
        }
    }
}

fn put(
    table: &mut Table,
    mut keys: Vec<Key>,
    span: Range<usize>,
    data: Data,
) -> Result<(), TextFault> {
    let Some((name, key)) = keys.pop() else { return Ok(()) };
    let table = descend(table, &keys, Origin::Dotted)?;
    match keys.last() {
        // dotted keys must not extend a table that has its own header
        Some((outer, place)) if table.origin == Origin::Header => {
            Err(TextFault::twice(outer, place.clone(), place.clone()))
        }
        _ => table.insert(name, Node { key, span, data }),
    }
}

fn make(
    root: &mut Table,
    path: &[Key],
    span: Range<usize>,
    of_list: bool,
) -> Result<(), TextFault> {
    let Some((last, outer)) = path.split_last() else { return Ok(()) };
    let table = descend(root, outer, Origin::Implied)?;
    let (name, key) = last.clone();
    let fresh = || Data::Table(Table::of(Origin::Header));
    match table.get_mut(&name) {
        None if of_list => {
            let item = Node { key: key.clone(), span: span.clone(), data: fresh() };
            table.insert(name, Node { key, span, data: Data::List(vec![item]) })
        }
        None => table.insert(name, Node { key, span, data: fresh() }),
        Some(old) => match &mut old.data {
            Data::Table(implied) if !of_list && implied.origin == Origin::Implied => {
                implied.origin = Origin::Header;
                (old.key, old.span) = (key, span);
                Ok(())
            }
            Data::List(items) if of_list && !items.is_empty() && items.iter().all(by_header) => {
                items.push(Node { key, span, data: fresh() });
                Ok(())
            }
            _ => Err(TextFault::twice(&name, key, old.key.clone())),
        },
    }
}

fn by_header(item: &Node) -> bool {
    matches!(&item.data, Data::Table(table) if table.origin == Origin::Header)
}

/// The table at a path, created if it is absent. In a list of tables, it is the last table.
fn descend<'t>(
    mut table: &'t mut Table,
    path: &[Key],
    by: Origin,
) -> Result<&'t mut Table, TextFault> {
    for (name, key) in path {
        let absent =
            || Node { key: key.clone(), span: key.clone(), data: Data::Table(Table::of(by)) };
        let node = table.get_or_insert(name, absent);
        let fault = || TextFault::twice(name, key.clone(), node.key.clone());
        table = match &mut node.data {
            Data::Table(next) if next.origin != Origin::Inline => next,
            Data::List(items) if by == Origin::Implied => match items.last_mut() {
                Some(Node { data: Data::Table(next), .. }) if next.origin == Origin::Header => next,
                _ => return Err(fault()),
            },
            _ => return Err(fault()),
        };
    }
    Ok(table)
}
