//! A case while it is assembled: a tree of values as in a file of kempe.

use serde_json::{json, Map, Value};
use std::collections::{HashMap, HashSet};

/// A table of a case.
pub(crate) type Table = Map<String, Value>;

/// A case while it is assembled.
#[derive(Debug, Default)]
pub(crate) struct Draft {
    pub(crate) title: String,
    pub(crate) gravity: [f64; 2],
    /// Whether redundant constraints are accepted, as the other tool does.
    pub(crate) redundant: bool,
    pub(crate) bodies: Table,
    pub(crate) joints: Table,
    pub(crate) drivers: Table,
    pub(crate) forces: Table,
    pub(crate) set: Table,
    pub(crate) guess: Table,
    pub(crate) analyses: Table,
    names: Names,
    /// The names of points by body, wanted name and place, and the last number of equal names.
    points: HashMap<(String, String), HashMap<[u64; 2], String>>,
    next_point: HashMap<(String, String), usize>,
}

impl Draft {
    /// A case with a title and a ground, which accepts redundant constraints.
    pub(crate) fn titled(title: &str) -> Self {
        let mut draft = Self { title: title.into(), redundant: true, ..Self::default() };
        draft.bodies.insert("ground".into(), json!({}));
        draft
    }

    /// A name for an element or a body, as near to the given one as kempe allows, and different from all others.
    pub(crate) fn name(&mut self, wanted: &str) -> String {
        self.names.take(wanted)
    }

    /// Adds a named point to a body and returns its reference, `body.point`. The same point is not added twice.
    pub(crate) fn point(&mut self, body: &str, wanted: &str, at: [f64; 2]) -> String {
        let entry = self.bodies.entry(body).or_insert_with(|| json!({}));
        let points = entry
            .as_object_mut()
            .expect("a body is a table")
            .entry("points")
            .or_insert_with(|| json!({}));
        let points = points.as_object_mut().expect("points are a table");
        let of = (body.to_string(), allowed(wanted));
        let same = self.points.entry(of.clone()).or_default();
        let known = same.entry(at.map(f64::to_bits)).or_insert_with(|| {
            let (mut name, next) = (of.1.clone(), self.next_point.entry(of).or_insert(1));
            while points.contains_key(&name) {
                *next += 1;
                name = format!("{}_{next}", allowed(wanted));
            }
            points.insert(name.clone(), json!(at));
            name
        });
        format!("{body}.{known}")
    }

    /// The case as JSON.
    pub(crate) fn text(self) -> String {
        let mut case = Table::new();
        case.insert("kempe".into(), json!(1));
        case.insert("title".into(), json!(shown(&self.title)));
        if self.gravity != [0.0, 0.0] {
            case.insert("gravity".into(), json!(self.gravity));
        }
        if self.redundant {
            case.insert("redundancy".into(), json!("allow"));
        }
        let mut start = Table::new();
        for (name, table) in [("set", self.set), ("guess", self.guess)] {
            if !table.is_empty() {
                start.insert(name.into(), Value::Object(table));
            }
        }
        let sections = [
            ("bodies", self.bodies),
            ("joints", self.joints),
            ("drivers", self.drivers),
            ("forces", self.forces),
            ("start", start),
            ("analyses", self.analyses),
        ];
        for (name, table) in sections.into_iter().filter(|(_, table)| !table.is_empty()) {
            case.insert(name.into(), Value::Object(table));
        }
        serde_json::to_string_pretty(&case).expect("a tree of finite numbers and texts")
    }
}

/// Least length of a body for its mass, m.
const SHORTEST: f64 = 0.01;

/// Mass, inertia and centre of a rod around the middle of some points, which reaches the farthest of them.
pub(crate) fn rod(points: &[[f64; 2]], density: f64) -> Value {
    let count = points.len().max(1) as f64;
    let middle = [0, 1].map(|k| points.iter().map(|at| at[k]).sum::<f64>() / count);
    let reach = |at: &[f64; 2]| (at[0] - middle[0]).hypot(at[1] - middle[1]);
    let length = 2.0 * points.iter().map(reach).fold(SHORTEST / 2.0, f64::max);
    let mass = density * length;
    json!({ "mass": mass, "inertia": mass * length * length / 12.0, "center": middle })
}

/// The text of a title: one line without control characters.
fn shown(title: &str) -> String {
    title.chars().filter(|c| !hidden(*c)).take(150).collect()
}

/// The names of a case, each once.
#[derive(Debug, Default)]
struct Names {
    taken: HashSet<String>,
    next: HashMap<String, usize>,
}

impl Names {
    fn take(&mut self, wanted: &str) -> String {
        let base = allowed(wanted);
        let mut name = base.clone();
        while !self.taken.insert(name.clone()) {
            let next = self.next.entry(base.clone()).or_insert(1);
            *next += 1;
            name = format!("{base}_{next}");
        }
        name
    }
}

/// Longest name that is kept.
const MOST_CHARACTERS: usize = 100;

/// Control characters, and characters that hide or reorder text.
fn hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{061C}' | '\u{200B}'..='\u{200F}' | '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{206F}' | '\u{FEFF}')
}

/// The nearest name that kempe allows.
fn allowed(name: &str) -> String {
    let kept = |c: char| if c == '.' || c == '`' || hidden(c) { '_' } else { c };
    let name: String = name.trim().chars().map(kept).take(MOST_CHARACTERS).collect();
    match name.trim() {
        "" => "unnamed".into(),
        reserved @ ("t" | "pi" | "deg" | "ground" | "energy" | "drift") => format!("{reserved}_"),
        other => other.into(),
    }
}

/// A name in a formula: in backticks where it has characters other than letters, digits and `_`.
pub(crate) fn in_formula(name: &str) -> String {
    let plain = |part: &str| {
        part.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
            && !part.starts_with(|c: char| c.is_ascii_digit())
    };
    let parts =
        name.split('.')
            .map(|part| if plain(part) { part.to_string() } else { format!("`{part}`") });
    parts.collect::<Vec<_>>().join(".")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_allowed_and_differ() {
        let mut draft = Draft::default();
        let made =
            ["a.b", "a.b", "a_b", "t", "", "\u{202E}x", "a_b_2"].map(|name| draft.name(name));
        assert_eq!(made, ["a_b", "a_b_2", "a_b_3", "t_", "unnamed", "_x", "a_b_2_2"]);
    }

    #[test]
    fn equal_points_share_a_name() {
        let mut draft = Draft::default();
        assert_eq!(draft.point("ground", "A", [0.0, 1.0]), "ground.A");
        assert_eq!(draft.point("ground", "A", [0.0, 1.0]), "ground.A");
        assert_eq!(draft.point("ground", "A", [0.0, 2.0]), "ground.A_2");
    }

    #[test]
    fn names_in_formulas_are_quoted_where_needed() {
        assert_eq!(in_formula("crank.B"), "crank.B");
        assert_eq!(in_formula("part 1.2nd"), "`part 1`.`2nd`");
    }
}
