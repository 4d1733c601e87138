//! What the statements of a model may contain: all other words and keys are named, and so are repetitions.

use super::statements::{short, Statement};
use std::collections::HashSet;

/// The keys and the words that are read, by the kind of the statement. Words of joints are read by the joint.
const KNOWN: [(&str, &[&str], &[&str]); 9] = [
    ("UNITS", &["FORCE", "MASS", "LENGTH", "TIME"], &[]),
    (
        "PART",
        &[
            "MASS", "CM", "IP", "IM", "QG", "REULER", "ZG", "XG", "VX", "VY", "VZ", "WX", "WY",
            "WZ", "MATERIAL",
        ],
        &["GROUND"],
    ),
    ("MARKER", &["PART", "QP", "REULER", "ZP", "XP"], &[]),
    ("JOINT", &["I", "J"], &[]),
    ("JPRIM", &["I", "J"], &[]),
    (
        "MOTION",
        &["JOINT", "FUNCTION"],
        &["ROTATION", "TRANSLATION", "DISPLACEMENT", "VELOCITY", "ACCELERATION"],
    ),
    ("SFORCE", &["I", "J", "FUNCTION"], &["TRANSLATIONAL", "ROTATIONAL"]),
    (
        "SPRINGDAMPER",
        &["I", "J", "K", "C", "LENGTH", "FORCE"],
        &["TRANSLATION", "TRANSLATIONAL", "ROTATION", "ROTATIONAL"],
    ),
    ("ACCGRAV", &["IGRAV", "JGRAV", "KGRAV"], &[]),
];

/// The lines and texts of what the reader does not read in the statements of a model.
pub(super) fn unknown(all: &[Statement]) -> Vec<(usize, String)> {
    let (mut found, mut ids, mut once) = (Vec::new(), HashSet::new(), HashSet::new());
    for one in all {
        let Some((kind, keys, words)) = KNOWN.iter().find(|(kind, ..)| *kind == one.kind) else {
            continue;
        };
        let mut tell = |what: String| {
            found.push((one.line, format!("{}/{}: {what}", short(&one.kind), short(&one.id))));
        };
        let numbered = !matches!(*kind, "UNITS" | "ACCGRAV");
        if numbered && !ids.insert((kind, &one.id)) {
            tell("there is another statement with this number".into());
        } else if !numbered && !once.insert(kind) {
            tell("there is another such statement".into());
        }
        let mut given = HashSet::new();
        for (key, values) in &one.fields {
            if !keys.contains(&key.as_str()) {
                tell(format!("{} is not supported", short(key)));
            } else if !given.insert(key) {
                tell(format!("{} is given twice", short(key)));
            }
            if values.len() > most(key) {
                tell(format!("{}: {} values", short(key), values.len()));
            }
        }
        let joint = matches!(*kind, "JOINT" | "JPRIM");
        for (k, word) in one.words.iter().enumerate() {
            let known = words.contains(&word.as_str()) || joint && k == 0;
            if !known {
                tell(format!("{} is not supported", short(word)));
            }
        }
    }
    found
}

/// The largest number of values of a key.
fn most(key: &str) -> usize {
    match key {
        "QG" | "QP" | "REULER" | "ZG" | "XG" | "ZP" | "XP" => 3,
        "IP" => 6,
        _ => 1,
    }
}

/// Gives equal names of parts, of joints and of the markers of a part their numbers, so that paths differ.
pub(super) fn tell_apart(all: &mut [Statement]) {
    let mut taken = HashSet::new();
    for one in all {
        let within = match one.kind.as_str() {
            "PART" => "parts".to_string(),
            "JOINT" | "JPRIM" => "joints".to_string(),
            "MARKER" => format!("part {}", one.reference("PART").unwrap_or_default()),
            _ => continue,
        };
        // the reader of assemblies gives this name to the mass centre, and divides paths at the slash
        let base = one.name.replace('/', "_");
        let mut name = base.clone();
        while name == "MassMarker" || !taken.insert((within.clone(), name.clone())) {
            name = match name == base {
                true => format!("{base}_{}", one.id),
                false => format!("{name}_"),
            };
        }
        one.name = name;
    }
}
