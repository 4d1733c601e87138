//! Names of bodies, their coordinates and their points.

use crate::elements::{Coordinate, Curve};
use crate::expression::is_identifier;
use crate::math::{each, indexed, Listed, Local, Pose, Real};
use crate::symbolic::{upright, Axis, Name, NameKind, Record, Symbolic};

/// Letters for the bodies of an element, and the same letters as Unicode subscripts.
const LETTERS: [(&str, &str); 6] =
    [("i", "ᵢ"), ("j", "ⱼ"), ("k", "ₖ"), ("l", "ₗ"), ("m", "ₘ"), ("n", "ₙ")];

/// The name of a body in three forms, for `i.x`, xᵢ and x_{i}.
pub(super) struct BodyName {
    pub text: String,
    pub unicode: String,
    pub latex: String,
}

impl BodyName {
    /// A body of a model.
    pub fn given(name: &str) -> Self {
        Self { text: quoted(name), unicode: format!("_{name}"), latex: upright(name) }
    }

    /// The letter for a position among the bodies of an element.
    pub fn letter(position: usize) -> Self {
        let (letter, index) = LETTERS[position % LETTERS.len()];
        Self { text: letter.into(), unicode: index.into(), latex: letter.into() }
    }

    /// The name of an element field that contains a point: `i` as a subscript, other names in full.
    pub fn field(name: &str) -> Self {
        match LETTERS.iter().position(|(letter, _)| *letter == name) {
            Some(position) => Self::letter(position),
            None => Self::given(name),
        }
    }
}

/// The coordinates of a body and their rates.
pub(super) struct Coordinates {
    pub position: [Symbolic; 3],
    rates: [Symbolic; 3],
}

impl Coordinates {
    /// Creates named symbols.
    pub fn new(record: &Record, body: &BodyName, owner: usize) -> Self {
        let symbol = |k: usize, rate: Symbolic| {
            let name = coordinate(Coordinate::ALL[k], body, owner);
            record.changing(name, rate)
        };
        let rates = each([3, 4, 5], |k| symbol(k, Symbolic::zero()));
        Self { position: each([0, 1, 2], |k| symbol(k, rates[k])), rates }
    }

    /// The pose of the body.
    pub fn pose(&self) -> Pose<Symbolic> {
        let [x, y, angle] = self.position;
        Pose::new(x, y, angle)
    }

    /// One coordinate or rate.
    pub fn of(&self, coordinate: Coordinate) -> Symbolic {
        let from = if coordinate.is_rate() { self.rates } else { self.position };
        from[coordinate.column()]
    }
}

fn coordinate(coordinate: Coordinate, body: &BodyName, owner: usize) -> Name {
    let (unicode, latex, axis) = match coordinate {
        Coordinate::X => ("x", "x", Some(Axis::X)),
        Coordinate::Y => ("y", "y", Some(Axis::Y)),
        Coordinate::Angle => ("φ", "\\varphi", None),
        Coordinate::Vx => ("ẋ", "\\dot{x}", Some(Axis::X)),
        Coordinate::Vy => ("ẏ", "\\dot{y}", Some(Axis::Y)),
        Coordinate::Omega => ("φ̇", "\\dot{\\varphi}", None),
    };
    let kind = if coordinate.is_rate() { NameKind::Rate } else { NameKind::Coordinate };
    Name {
        text: format!("{}.{}", body.text, coordinate.name()),
        unicode: format!("{unicode}{}", body.unicode),
        latex: format!("{latex}_{{{}}}", body.latex),
        kind,
        axis,
        owner: Some(owner),
    }
}

/// The components of a body-fixed point. The components marked in `zero` are zero. In the global frame, the vector to
/// the point is written a with the field as subscript: aᵢ = Aᵢ s′ᵢ.
pub(super) fn point(
    record: &Record,
    field: &str,
    label: Option<&str>,
    owner: usize,
    zero: [bool; 2],
) -> Local<Symbolic> {
    let index = BodyName::field(field);
    let component = |axis: Axis, zero: bool| {
        if zero {
            return Symbolic::zero();
        }
        let c = ["x", "y"][axis as usize];
        let [text, unicode, latex] = match label {
            Some(label) => {
                let quoted: Vec<String> = label.split('.').map(quoted).list();
                let text = format!("{}.{c}", quoted.join("."));
                [text.clone(), text, format!("{c}'_{{{}}}", upright(label))]
            }
            None => [
                format!("{}.s.{c}", index.text),
                format!("s′{}.{c}", index.unicode),
                format!("s'_{{{},{c}}}", index.latex),
            ],
        };
        let name = Name::new(&text, &unicode, &latex, NameKind::Field);
        record.symbol(Name { axis: Some(axis), owner: Some(owner), ..name })
    };
    let s = Local { x: component(Axis::X, zero[0]), y: component(Axis::Y, zero[1]) };
    let turned = [format!("a_{}", index.text), format!("a{}", index.unicode), index.latex];
    record.vector(s.x, s.y, turned, Some(owner));
    s
}

/// A curve as the names of C and its derivatives at `u`. `label` is its name in a model.
pub(super) fn curve(record: &Record, label: Option<&str>, u: Symbolic) -> Curve<Symbolic> {
    let component = |axis: Axis| {
        let c = ["x", "y"][axis as usize];
        let named = |order: usize| {
            let (us, primes) = ("u".repeat(order), "′".repeat(order));
            let quoted: Vec<String> = label.unwrap_or("curve").split('.').map(quoted).list();
            let derivative = if order == 0 { String::new() } else { format!("_{us}") };
            let text = format!("{}.{c}{derivative}", quoted.join("."));
            let unicode = format!("C{primes}.{c}");
            let latex = format!("C{}_{{{c}}}", "'".repeat(order));
            Name::new(&text, &unicode, &latex, NameKind::Field)
        };
        let third = record.symbol(named(3));
        let second = record.along(named(2), u, third);
        let first = record.along(named(1), u, second);
        [record.along(named(0), u, first), first, second, third]
    };
    let (x, y) = (component(Axis::X), component(Axis::Y));
    Curve::Near { at: u, terms: indexed(|n| Local { x: x[n], y: y[n] }) }
}

/// A given function of time, with its derivatives.
pub(super) fn function(record: &Record, name: &str) -> Symbolic {
    let latex = upright(name);
    let derivative = |order: &str, dots: &str, rate: Symbolic| {
        let unicode = match order {
            "" => name.to_string(),
            "t" => format!("d{name}/dt"),
            _ => format!("d²{name}/dt²"),
        };
        let text = if order.is_empty() { name.to_string() } else { format!("{name}_{order}") };
        let latex = if dots.is_empty() { latex.clone() } else { format!("\\{dots}{{{latex}}}") };
        record.changing(Name::new(&text, &unicode, &latex, NameKind::Field), rate)
    };
    let second = derivative("tt", "ddot", Symbolic::zero());
    let first = derivative("t", "dot", second);
    derivative("", "", first)
}

/// The internal coordinates of an element: u, or u1, u2, ….
pub(super) fn internal(record: &Record, count: usize) -> Vec<Symbolic> {
    let one = |k: usize| {
        let (text, index) = match count {
            1 => ("u".to_string(), String::new()),
            _ => (format!("u{}", k + 1), format!("_{{{}}}", k + 1)),
        };
        let latex = [format!("u{index}"), format!("\\dot{{u}}{index}")];
        let rate_name =
            Name::new(&format!("{text}_rate"), &format!("d{text}/dt"), &latex[1], NameKind::Rate);
        let rate = record.changing(rate_name, Symbolic::zero());
        record.changing(Name::new(&text, &text, &latex[0], NameKind::Coordinate), rate)
    };
    (0..count).map(one).list()
}

/// A part of a name, quoted in the language of expressions where necessary.
fn quoted(name: &str) -> String {
    if is_identifier(name) {
        name.to_string()
    } else {
        format!("`{name}`")
    }
}
