//! Changes of single values in the text of a case. Comments, order and format of the rest are preserved.

use crate::convert::Fields;
use crate::fault::Fault;
use kempe::case::digits;
use serde_json::{json, Value};
use toml_edit::{Array, DocumentMut, InlineTable, Item, Key, Table, TableLike};

/// Sections whose entries have headers of their own.
const OF_ENTRIES: [&str; 6] = ["tables", "bodies", "joints", "drivers", "forces", "analyses"];
/// Keys whose values are words of the format, or titles.
const OF_WORDS: [&str; 2] = ["type", "title"];

/// The text with all changes: `{ path, value }`, `{ path, rename }` or `{ path, remove: true }`.
pub fn edit(text: &str, changes: &Value) -> Result<Value, Fault> {
    let mut document: DocumentMut = text.parse().map_err(|fault: toml_edit::TomlError| {
        Fault::new(fault.message()).hint("correct the text first")
    })?;
    let changes = changes.as_array().ok_or_else(|| Fault::new("changes must be a list"))?;
    for change in changes {
        let fields = change.as_object().ok_or_else(|| Fault::new("a change must be a table"))?;
        let fields = Fields(fields);
        let path = fields.texts("path")?;
        let Some((last, parents)) = path.split_last() else {
            return Err(Fault::new("a change needs a path"));
        };
        if let Some(new) = fields.get("rename") {
            let new = new.as_str().ok_or_else(|| Fault::new("rename must be a text"))?;
            rename(&mut document, &path, new)?;
        } else if fields.get("remove").is_some() {
            if let Some(table) = find(document.as_table_mut(), parents) {
                table.remove(last);
            }
        } else {
            let value = fields.need("value")?;
            set(document.as_table_mut(), &path, value)?;
        }
    }
    Ok(json!({ "text": document.to_string() }))
}

/// The table at a path, if it exists.
fn find<'t>(mut table: &'t mut dyn TableLike, path: &[&str]) -> Option<&'t mut dyn TableLike> {
    for key in path {
        table = table.get_mut(key)?.as_table_like_mut()?;
    }
    Some(table)
}

/// Sets a value; tables on the way are added.
fn set(root: &mut Table, path: &[&str], value: &Value) -> Result<(), Fault> {
    let mut table: &mut dyn TableLike = root;
    for (depth, key) in path[..path.len() - 1].iter().enumerate() {
        if !table.contains_key(key) {
            let headed = depth == 0 || (depth == 1 && OF_ENTRIES.contains(&path[0]));
            table.insert(key, if headed { header(depth, path[0]) } else { inline() });
        }
        let inner = table.get_mut(key).and_then(Item::as_table_like_mut);
        table = inner.ok_or_else(|| Fault::new(format!("'{}' is not a table", path.join("."))))?;
    }
    let key = path[path.len() - 1];
    // an entry such as [bodies.crank] has a header and one line for each field
    let entry = path.len() == 2 && OF_ENTRIES.contains(&path[0]) && !table.contains_key(key);
    let item = match (entry, value) {
        (true, Value::Object(fields)) => {
            let mut own = Table::new();
            for (name, value) in fields {
                own.insert(name, Item::Value(written(value)?));
            }
            Item::Table(own)
        }
        _ => Item::Value(written(value)?),
    };
    match (table.get_mut(key).and_then(Item::as_value_mut), item) {
        // keep the comment after the value
        (Some(old), Item::Value(mut new)) => {
            *new.decor_mut() = old.decor().clone();
            *old = new;
        }
        (_, item) => {
            table.insert(key, item);
        }
    }
    Ok(())
}

/// A table with a header. The header of a section of entries is not written.
fn header(depth: usize, section: &str) -> Item {
    let mut table = Table::new();
    table.set_implicit(depth == 0 && OF_ENTRIES.contains(&section));
    Item::Table(table)
}

fn inline() -> Item {
    Item::Value(toml_edit::Value::InlineTable(InlineTable::new()))
}

/// Converts a JSON value to TOML.
fn written(value: &Value) -> Result<toml_edit::Value, Fault> {
    Ok(match value {
        Value::Null => return Err(Fault::new("a value must not be null")),
        Value::Bool(flag) => (*flag).into(),
        Value::Number(x) => match x.as_i64() {
            Some(whole) => whole.into(),
            None => number(x.as_f64().unwrap_or_default()),
        },
        Value::String(text) => text.as_str().into(),
        Value::Array(list) => {
            let items: Result<Array, Fault> = list.iter().map(written).collect();
            items?.into()
        }
        Value::Object(table) => {
            let mut found = InlineTable::new();
            for (key, value) in table {
                found.insert(key, written(value)?);
            }
            found.into()
        }
    })
}

/// A number as kempe writes it, with an exponent where this is shorter.
fn number(x: f64) -> toml_edit::Value {
    digits(x).parse().unwrap_or_else(|_| x.into())
}

/// Renames an entry, in its own place and in all references.
fn rename(document: &mut DocumentMut, path: &[&str], new: &str) -> Result<(), Fault> {
    let (last, parents) = path.split_last().expect("a path that is not empty");
    let table = find(document.as_table_mut(), parents)
        .filter(|table| table.contains_key(last))
        .ok_or_else(|| Fault::new(format!("there is no '{}'", path.join("."))))?;
    if table.contains_key(new) {
        return Err(Fault::new(format!("there is a '{new}' already")).hint("choose another name"));
    }
    rename_key(table, last, new);
    // references to a point include its body: "crank.B"
    let (old, new) = match path {
        ["bodies", body, "points" | "curves" | "through", point] => {
            (format!("{body}.{point}"), format!("{body}.{new}"))
        }
        _ => ((*last).to_string(), new.to_string()),
    };
    rename_in(document.as_table_mut(), &old, &new);
    Ok(())
}

/// Renames a key without changing its position.
fn rename_key(table: &mut dyn TableLike, old: &str, new: &str) {
    let keys: Vec<String> = table.iter().map(|(key, _)| key.to_string()).collect();
    for key in keys {
        let decor = table.key(&key).map(|key| key.leaf_decor().clone()).unwrap_or_default();
        let Some(item) = table.remove(&key) else { continue };
        let name = if key == old { new.to_string() } else { key };
        table.entry_format(&Key::new(&name).with_leaf_decor(decor)).or_insert(item);
    }
}

/// Replaces a name in all texts and in the keys that consist of names, such as "crank.angle".
fn rename_in(table: &mut dyn TableLike, old: &str, new: &str) {
    let keys: Vec<String> = table.iter().map(|(key, _)| key.to_string()).collect();
    for key in keys.into_iter().filter(|key| !OF_WORDS.contains(&key.as_str())) {
        if let Some(dotted) = key.contains('.').then(|| replaced(&key, old, new)).flatten() {
            rename_key(table, &key, &dotted);
            continue;
        }
        if let Some(item) = table.get_mut(&key) {
            rename_in_item(item, old, new);
        }
    }
}

fn rename_in_item(item: &mut Item, old: &str, new: &str) {
    if let Some(table) = item.as_table_like_mut() {
        rename_in(table, old, new);
    } else if let Some(value) = item.as_value_mut() {
        rename_in_value(value, old, new);
    }
}

fn rename_in_value(value: &mut toml_edit::Value, old: &str, new: &str) {
    if let Some(text) = value.as_str() {
        if let Some(text) = replaced(text, old, new) {
            let decor = value.decor().clone();
            *value = text.into();
            *value.decor_mut() = decor;
        }
    } else if let Some(list) = value.as_array_mut() {
        list.iter_mut().for_each(|value| rename_in_value(value, old, new));
    } else if let Some(table) = value.as_inline_table_mut() {
        rename_in(table, old, new);
    }
}

/// The text with each occurrence of a whole name replaced. None if the name does not occur.
fn replaced(text: &str, old: &str, new: &str) -> Option<String> {
    let of_name = |c: char| c.is_alphanumeric() || c == '_';
    let (mut out, mut rest, mut found) = (String::new(), text, false);
    while let Some(at) = rest.find(old) {
        let (before, after) = (&rest[..at], &rest[at + old.len()..]);
        let whole = !before.ends_with(|c| of_name(c) || c == '.') && !after.starts_with(of_name);
        let starts = !out.ends_with(of_name) || !before.is_empty();
        out += before;
        out += if whole && starts { new } else { old };
        found |= whole && starts;
        rest = after;
    }
    found.then(|| out + rest)
}
