//! Stiffness and mass of a beam: from a section and a material, or as given. All may vary with the arc length `s`.

use super::super::body_reader::{term, Reader};
use super::super::definition::Value;
use super::super::scope::Reach;
use super::along;
use crate::expression::Tape;
use crate::math::{Listed, ShortArray};

/// The constants of a section as texts, which may contain the arc length `s`.
pub struct Stiffness {
    pub axial: String,
    pub shear: String,
    pub bending: String,
    /// Stress for a normal force of 1 N and at the faces for a bending moment of 1 N·m; zero without a section.
    pub by_force: String,
    pub by_moment: String,
    /// Mass and moment of inertia per length.
    pub mass: String,
    pub inertia: String,
}

/// A constant of a section at three arc lengths.
pub fn at(reader: &mut Reader<'_>, text: &str, s: &[String; 3]) -> [Tape; 3] {
    match along::varies(text) {
        true => [0, 1, 2].each(|g| reader.compose(&along::at(text, &s[g]))),
        false => {
            let tape = reader.compose(text);
            [tape.clone(), tape.clone(), tape]
        }
    }
}

/// Reads a number that may vary along the beam, in the places where it must be possible.
fn number(reader: &mut Reader<'_>, key: &str, unit: &str, length: &str) -> Option<String> {
    let value = reader.entry.get(key)?;
    let path = reader.path(key);
    for at in along_beam(reader, key, value, length) {
        reader.scope.formula(&at, &path, unit, Reach::Parameters, reader.problems)?;
    }
    Some(term(value))
}

/// A value at both ends and in the middle of the beam, if it varies.
fn along_beam(reader: &mut Reader<'_>, key: &str, value: &Value, length: &str) -> Vec<Value> {
    match along::uses(reader, key, value) {
        true => {
            let places = ["0".to_string(), format!("{length}/2"), length.to_string()];
            places.iter().map(|s| along::inserted(value, s)).list()
        }
        false => vec![value.clone()],
    }
}

/// A cross section, as texts.
struct SectionTexts {
    area: String,
    /// Second moment of area.
    second: String,
    /// Distance of the faces from the centre line.
    face: String,
    /// Ratio of the effective area in shear to the area.
    factor: &'static str,
}

const GIVEN: [&str; 3] = ["EA", "EI", "GA"];

/// Reads the section and the material of a beam with this length as text.
pub fn read(reader: &mut Reader<'_>, length: &str) -> Option<Stiffness> {
    match reader.entry.get("section") {
        Some(_) => of_section(reader, length),
        None => as_given(reader, length),
    }
}

fn as_given(reader: &mut Reader<'_>, length: &str) -> Option<Stiffness> {
    for key in ["young", "poisson", "density"] {
        if reader.entry.get(key).is_some() {
            let instead = if key == "density" { "mass_per_length" } else { "EA, EI and GA" };
            let message = format!("has no meaning without a section; give section, or {instead}");
            reader.report(key, &message);
            return None;
        }
    }
    let without = [("EA", "inextensible = true"), ("GA", "shear = false")];
    let flags = [("inextensible", true), ("shear", false)];
    let locked = flags.each(|(key, by)| reader.entry.get(key) == Some(&Value::Flag(by)));
    for key in GIVEN {
        let place = without.iter().position(|(of, _)| *of == key);
        if reader.entry.get(key).is_some() || place.is_some_and(|k| locked[k]) {
            continue;
        }
        let or = place.map_or(String::new(), |k| format!("; {} needs no {key}", without[k].1));
        let all = GIVEN.join(", ");
        reader.missing(&format!("'{key}' is missing; give section and young, or all of {all}{or}"));
        return None;
    }
    let mut given = |key: &str, unit: &str| match reader.entry.get(key) {
        Some(_) => number(reader, key, unit, length),
        None => Some("1".to_string()),
    };
    let (axial, shear, bending) = (given("EA", "N")?, given("GA", "N")?, given("EI", "N*m^2")?);
    for (key, text) in [("EA", &axial), ("EI", &bending), ("GA", &shear)] {
        // a quotient of two of them follows
        let x = reader.value(&along::at(text, "0"));
        if x <= 0.0 {
            reader.report(key, &format!("{x}; must be > 0"));
            return None;
        }
    }
    let texts = ["EA", "EI"].each(|key| reader.entry.get(key).map(term));
    let radius = match texts {
        [Some(axial), Some(bending)] => Some(format!("{bending}/{axial}")),
        _ => None,
    };
    let (mass, inertia) = masses(reader, None, radius, length)?;
    let (by_force, by_moment) = ("0".to_string(), "0".to_string());
    Some(Stiffness { axial, shear, bending, by_force, by_moment, mass, inertia })
}

fn of_section(reader: &mut Reader<'_>, length: &str) -> Option<Stiffness> {
    for key in GIVEN {
        if reader.entry.get(key).is_some() {
            let message =
                format!("given beside section, which determines it; remove {key} or section");
            reader.report(key, &message);
            return None;
        }
    }
    let shape = shape(reader, length)?;
    if reader.entry.get("young").is_none() {
        reader.missing("'young' is missing: a section needs Young's modulus, such as \"210 GPa\"");
        return None;
    }
    let young = number(reader, "young", "Pa", length)?;
    let poisson = match reader.entry.get("poisson") {
        Some(value) => {
            reader.number("poisson", "")?;
            term(value)
        }
        None => "0.3".to_string(),
    };
    let of = reader.value(&poisson);
    if !(-1.0 < of && of <= 0.5) {
        reader.report("poisson", &format!("{of}; must be between -1 and 0.5"));
        return None;
    }
    let SectionTexts { area, second, face, factor } = shape;
    let axial = format!("{young}*{area}");
    let bending = format!("{young}*{second}");
    let shear = format!("{factor}*{young}*{area}/(2*(1+{poisson}))");
    let by_force = format!("1/{area}");
    let by_moment = format!("{face}/{second}");
    let (mass, inertia) = masses(reader, Some(&area), Some(format!("{second}/{area}")), length)?;
    Some(Stiffness { axial, shear, bending, by_force, by_moment, mass, inertia })
}

/// Mass and moment of inertia per length. `radius` is the squared radius of gyration of the section, if it is known.
fn masses(
    reader: &mut Reader<'_>,
    area: Option<&str>,
    radius: Option<String>,
    length: &str,
) -> Option<(String, String)> {
    let given = |reader: &Reader<'_>, key: &str| reader.entry.get(key).map(term);
    let mass = match (given(reader, "density"), given(reader, "mass_per_length"), area) {
        (Some(_), Some(_), _) => {
            reader.report("mass_per_length", "given beside density; remove one of them");
            return None;
        }
        (Some(density), None, Some(area)) => {
            number(reader, "density", "kg/m^3", length)?;
            format!("{density}*{area}")
        }
        (_, Some(mass), _) => {
            number(reader, "mass_per_length", "kg/m", length)?;
            mass
        }
        _ => {
            let key =
                if area.is_some() { "'density' or 'mass_per_length'" } else { "'mass_per_length'" };
            reader.missing(&format!(
                "{key} is missing; it may be 0 where only equilibria are computed"
            ));
            return None;
        }
    };
    let inertia = match (given(reader, "inertia_per_length"), radius) {
        (Some(inertia), _) => {
            number(reader, "inertia_per_length", "kg*m", length)?;
            inertia
        }
        (None, Some(radius)) => format!("({mass}*{radius})"),
        (None, None) => {
            reader.missing(
                "'inertia_per_length' is missing, which follows from EA in other beams; it may be 0 where only \
                 equilibria are computed",
            );
            return None;
        }
    };
    Some((format!("({mass})"), inertia))
}

fn shape(reader: &mut Reader<'_>, length: &str) -> Option<SectionTexts> {
    let form =
        "{ rectangle = [height, width] }, { circle = diameter } or { tube = [outer, inner] }";
    let Some(Value::Table(fields)) = reader.entry.get("section") else {
        reader.report("section", &format!("must be {form}"));
        return None;
    };
    let [(kind, value)] = &fields[..] else {
        reader.report("section", &format!("must have exactly one key: {form}"));
        return None;
    };
    let path: Vec<String> = reader.path("section").into_iter().chain([kind.clone()]).list();
    let texts = match (kind.as_str(), value) {
        ("rectangle" | "tube", Value::List(items)) if items.len() == 2 => {
            items.iter().map(term).list()
        }
        ("circle", Value::Number(_) | Value::Text(_)) => vec![term(value)],
        _ => {
            reader.report("section", &format!("must be {form}"));
            return None;
        }
    };
    for (k, at) in along_beam(reader, "section", value, length).iter().enumerate() {
        match at {
            Value::List(_) => {
                reader.scope.pair(at, &path, "m", reader.problems)?;
            }
            _ => {
                let reach = Reach::Parameters;
                reader.scope.formula(at, &path, "m", reach, reader.problems)?;
            }
        }
        let s = ["0", &format!("{length}/2"), length][k].to_string();
        let numbers: Vec<f64> = texts.iter().map(|text| reader.value(&along::at(text, &s))).list();
        if let Some(message) = impossible(kind, &numbers) {
            let varies = texts.iter().any(|text| along::varies(text));
            let place = match varies {
                true => format!(" at s = {} m", reader.value(&s)),
                false => String::new(),
            };
            reader.report("section", &format!("{}{place}; {}", message.0, message.1));
            return None;
        }
    }
    Some(texts_of(kind, &texts))
}

/// The dimensions of an impossible section, and what they must be.
fn impossible(kind: &str, numbers: &[f64]) -> Option<(String, &'static str)> {
    let least = if kind == "tube" { 0.0 } else { f64::MIN_POSITIVE };
    let possible = numbers[0] > 0.0
        && numbers.iter().all(|x| *x >= least && x.is_finite())
        && !(kind == "tube" && numbers[1] >= numbers[0]);
    if possible || numbers.iter().any(|x| x.is_nan()) {
        return None;
    }
    let words = numbers.iter().map(|x| format!("{x} m")).list().join(" and ");
    let must = match kind {
        "tube" => "the outer diameter must be larger than the inner one",
        _ => "must be > 0",
    };
    Some((format!("{kind} of {words}"), must))
}

/// Area, second moment of area, distance of the faces and shear factor of a section with these dimensions.
fn texts_of(kind: &str, texts: &[String]) -> SectionTexts {
    match kind {
        "rectangle" => {
            let (h, w) = (&texts[0], &texts[1]);
            SectionTexts {
                area: format!("({h}*{w})"),
                second: format!("({w}*{h}^3/12)"),
                face: format!("({h}/2)"),
                factor: "(5/6)",
            }
        }
        "circle" => {
            let d = &texts[0];
            SectionTexts {
                area: format!("(pi*{d}^2/4)"),
                second: format!("(pi*{d}^4/64)"),
                face: format!("({d}/2)"),
                factor: "0.9",
            }
        }
        _ => {
            let (outer, inner) = (&texts[0], &texts[1]);
            SectionTexts {
                area: format!("(pi*({outer}^2-{inner}^2)/4)"),
                second: format!("(pi*({outer}^4-{inner}^4)/64)"),
                face: format!("({outer}/2)"),
                factor: "0.5",
            }
        }
    }
}
