//! How headers and dotted keys of TOML make tables (TOML 1.0, "Keys", "Table", "Array of Tables").

use std::ops::Range;

use super::fault::{Fault, Faults};
use super::tree::{too_deep, too_many, Data, Node, Origin, Table, MOST_DEPTH, MOST_VALUES};

type Key = (String, Range<usize>);

/// Collects values into tables, in the order in which the parser meets them.
#[derive(Default)]
pub(super) struct Builder {
    root: Table,
    /// The table of the last header, by its path from the root; None after a faulty one.
    header: Option<Vec<Key>>,
    started: bool,
    header_start: usize,
    /// The key that is being read outside of braces and brackets.
    keys: Vec<Key>,
    open: Vec<Open>,
    values: usize,
    faults: Vec<Fault>,
}

/// A list or an inline table of which the end is not yet seen.
struct Open {
    start: usize,
    data: Data,
    keys: Vec<Key>,
}

impl Builder {
    pub(super) fn finish(self, faults: &mut Faults) -> Table {
        for fault in self.faults {
            faults.push(fault.place, fault.message);
        }
        self.root
    }

    fn fault(&mut self, place: Range<usize>, message: String) {
        if self.faults.len() < super::MOST_REPORTED {
            self.faults.push(Fault { place, message });
        }
    }

    pub(super) fn open_header(&mut self, start: usize) {
        self.open.clear(); // brackets that an error left open
        self.keys.clear();
        self.header_start = start;
    }

    /// One part of a key; `joined` if a dot stood before it.
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

    /// A value is complete: puts it where the keys before it say.
    pub(super) fn place(&mut self, span: Range<usize>, data: Data) {
        self.values += 1;
        if self.values == MOST_VALUES + 1 {
            self.fault(span.clone(), too_many());
        }
        if self.values > MOST_VALUES {
            return;
        }
        if self.depth() > MOST_DEPTH {
            return self.fault(span, too_deep());
        }
        if let Some(Open { data: Data::List(items), .. }) = self.open.last_mut() {
            items.push(Node { key: span.clone(), span, data });
            return;
        }
        self.store(span, data);
    }

    /// Keys and indices from the root to the value that is placed next.
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
            self.fault(fault.place, fault.message);
        }
    }

    /// A header is complete: makes its table.
    pub(super) fn close_header(&mut self, end: usize, of_list: bool) {
        self.started = true;
        self.header = None;
        let path = std::mem::take(&mut self.keys);
        let span = self.header_start..end;
        if path.len() > MOST_DEPTH - 1 {
            return self.fault(span, too_deep());
        }
        self.values += 1;
        if self.values > MOST_VALUES {
            return;
        }
        match make(&mut self.root, &path, span, of_list) {
            Ok(()) => self.header = Some(path),
            Err(fault) => self.fault(fault.place, fault.message),
        }
    }
}

fn put(table: &mut Table, mut keys: Vec<Key>, span: Range<usize>, data: Data) -> Result<(), Fault> {
    let Some((key, place)) = keys.pop() else { return Ok(()) };
    let table = descend(table, &keys, Origin::Dotted)?;
    if !keys.is_empty() && matches!(table.origin, Origin::Inline | Origin::Header) {
        return Err(twice(&keys[keys.len() - 1]));
    }
    table.insert(key, Node { key: place.clone(), span, data }).map_err(|key| twice(&(key, place)))
}

fn make(root: &mut Table, path: &[Key], span: Range<usize>, of_list: bool) -> Result<(), Fault> {
    let Some((last, outer)) = path.split_last() else { return Ok(()) };
    let table = descend(root, outer, Origin::Implied)?;
    let (name, place) = last.clone();
    let fresh = || Data::Table(Table::of(Origin::Header));
    match (table.get_mut(&name), of_list) {
        (None, false) => {
            let node = Node { key: place, span, data: fresh() };
            table.insert(name, node).map_err(|_| twice(last))
        }
        (None, true) => {
            let item = Node { key: place.clone(), span: span.clone(), data: fresh() };
            let node = Node { key: place, span, data: Data::List(vec![item]) };
            table.insert(name, node).map_err(|_| twice(last))
        }
        (Some(Node { data: Data::Table(old), key, span: old_span }), false)
            if old.origin == Origin::Implied =>
        {
            old.origin = Origin::Header;
            (*key, *old_span) = (place, span);
            Ok(())
        }
        (Some(Node { data: Data::List(items), .. }), true)
            if !items.is_empty() && items.iter().all(by_header) =>
        {
            items.push(Node { key: place, span, data: fresh() });
            Ok(())
        }
        (Some(_), _) => Err(twice(last)),
    }
}

fn by_header(item: &Node) -> bool {
    matches!(&item.data, Data::Table(table) if table.origin == Origin::Header)
}

/// The table at a path, made where it is absent; the last one of a list of tables.
fn descend<'t>(mut table: &'t mut Table, path: &[Key], by: Origin) -> Result<&'t mut Table, Fault> {
    for part in path {
        let (key, place) = part;
        if table.get(key).is_none() {
            let data = Data::Table(Table::of(by));
            let node = Node { key: place.clone(), span: place.clone(), data };
            table.insert(key.clone(), node).map_err(|_| twice(part))?;
        }
        let node = table.get_mut(key).ok_or_else(|| twice(part))?;
        table = match &mut node.data {
            Data::Table(next) if next.origin != Origin::Inline => next,
            Data::List(items) if by == Origin::Implied => match items.last_mut() {
                Some(Node { data: Data::Table(next), .. }) if next.origin == Origin::Header => next,
                _ => return Err(twice(part)),
            },
            _ => return Err(twice(part)),
        };
    }
    Ok(table)
}

fn twice((key, place): &Key) -> Fault {
    Fault { place: place.clone(), message: format!("key '{}' is given twice", super::shown(key)) }
}
