//! The entities of a DXF file: pairs of a group code and a value, one below the other.

use crate::unread::UnreadList;

/// A pair, with the line of its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    pub(super) line: usize,
    pub(super) code: i32,
    pub(super) value: &'a str,
}

/// An entity or the head of a section: the pair with code 0 and the pairs after it.
#[derive(Debug)]
pub(super) struct Entity<'a> {
    pub(super) line: usize,
    pub(super) kind: &'a str,
    pub(super) pairs: Vec<Pair<'a>>,
}

/// The line of an entry that cannot be read, and the reason.
pub(super) type Fault = (usize, &'static str);

impl<'a> Entity<'a> {
    /// The first text of a code.
    pub(super) fn text(&self, code: i32) -> Option<&'a str> {
        self.pairs.iter().find(|pair| pair.code == code).map(|pair| pair.value)
    }

    pub(super) fn layer(&self) -> &'a str {
        self.text(8).unwrap_or("0")
    }

    /// The first number of a code. The error gives the line.
    pub(super) fn number(&self, code: i32) -> Result<Option<f64>, usize> {
        self.pairs.iter().find(|pair| pair.code == code).map(number).transpose()
    }

    /// A number that the entity must have.
    pub(super) fn required(&self, code: i32) -> Result<f64, Fault> {
        let found = self.number(code).map_err(|line| (line, "not a number"))?;
        found.ok_or((self.line, "a coordinate is missing"))
    }

    pub(super) fn flag(&self, code: i32, bit: i64) -> bool {
        self.text(code)
            .and_then(|text| text.parse::<i64>().ok())
            .is_some_and(|flags| flags & bit != 0)
    }
}

/// The number of a pair; the error is its line.
pub(super) fn number(pair: &Pair<'_>) -> Result<f64, usize> {
    let found = pair.value.parse::<f64>().ok().filter(|x| x.is_finite() && x.abs() < 1e15);
    found.ok_or(pair.line)
}

/// The pairs of a text. A code that is no number ends the reading, since no later line can be trusted.
fn pairs<'a>(text: &'a str, unread: &mut UnreadList) -> Vec<Pair<'a>> {
    let mut lines = text.lines().enumerate().map(|(k, line)| (k + 1, line.trim()));
    let mut found = Vec::new();
    while let Some((line, code)) = lines.next() {
        let Ok(code) = code.parse::<i32>() else {
            if !code.is_empty() {
                let short: String = code.chars().take(40).collect();
                unread.lost(
                    line,
                    format!("'{short}' is not a group code; nothing after this line is read"),
                );
            }
            break;
        };
        let Some((line, value)) = lines.next() else {
            unread.lost(line, "the file ends within an entry");
            break;
        };
        // a remark
        if code != 999 {
            found.push(Pair { line, code, value });
        }
    }
    found
}

/// The entities of the sections `HEADER` and `ENTITIES`, and the names of the others.
pub(super) fn read<'a>(text: &'a str, unread: &mut UnreadList) -> (Vec<Pair<'a>>, Vec<Entity<'a>>) {
    let (mut header, mut entities) = (Vec::new(), Vec::<Entity<'a>>::new());
    let (mut section, mut named, mut ended) = ("", false, false);
    for pair in pairs(text, unread) {
        match (pair.code, pair.value) {
            (0, "SECTION") => (section, named) = ("", true),
            (0, "ENDSEC") => section = "",
            (0, "EOF") => {
                ended = true;
                break;
            }
            (2, name) if named => (section, named) = (name, false),
            (0, kind) if section == "ENTITIES" => {
                entities.push(Entity { line: pair.line, kind, pairs: Vec::new() });
            }
            _ if section == "HEADER" => header.push(pair),
            _ if section == "ENTITIES" => match entities.last_mut() {
                Some(entity) => entity.pairs.push(pair),
                None => unread.lost(pair.line, "an entry before the first entity"),
            },
            _ => {}
        }
    }
    let empty = header.is_empty() && entities.is_empty();
    if !(ended || empty) {
        unread.lost(0, "the file has no end, EOF; a part of the drawing may be missing");
    }
    (header, entities)
}

/// The size of the unit `$INSUNITS` in metres; `None` if it is not known.
pub(super) fn unit(header: &[Pair<'_>]) -> Result<Option<f64>, (usize, String)> {
    let at = header.iter().position(|pair| pair.code == 9 && pair.value == "$INSUNITS");
    let Some(pair) = at.and_then(|at| header.get(at + 1)) else { return Ok(None) };
    Ok(Some(match pair.value.parse::<i64>() {
        Ok(0) => return Ok(None),
        Ok(1) => 0.0254,
        Ok(2) => 0.3048,
        Ok(3) => 1609.344,
        Ok(4) => 1e-3,
        Ok(5) => 1e-2,
        Ok(6) => 1.0,
        Ok(7) => 1e3,
        Ok(8) => 0.0254e-6,
        Ok(9) => 0.0254e-3,
        Ok(10) => 0.9144,
        Ok(11) => 1e-10,
        Ok(12) => 1e-9,
        Ok(13) => 1e-6,
        Ok(14) => 0.1,
        Ok(15) => 10.0,
        Ok(16) => 100.0,
        _ => {
            return Err((
                pair.line,
                format!("$INSUNITS = {} is not a unit of length here", pair.value),
            ))
        }
    }))
}
