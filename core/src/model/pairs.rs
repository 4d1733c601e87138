//! Contacts of two curves, and contacts with a polygon.
//!
//! Such a contact consists of contacts of a point or circle with a curve. Of two polygons, each convex corner of one may
//! touch each convex part of the other: the first touch of two polygons is that of a corner. A line is a polygon with
//! two corners. A circle is the circle around its centre. A smooth curve touches as a whole another smooth curve, or each
//! convex part of a polygon. All of these contacts have the name of the written contact.

use super::definition::Value;
use super::link::{Linker, Pairing};
use crate::elements::{
    catalogue, convex_corners, convex_parts, Curve, CurveOn, Field, ForceElement, Group, PointOn,
    Polygon, Side, Source, Table,
};
use crate::expression::Tape;
use crate::math::{Listed, Local, ShortArray};

/// The fields of the two forms of a contact.
const OF_POINT: [&str; 3] = ["i", "curve", "side"];
const OF_CURVES: [&str; 2] = ["curves", "sides"];

/// Fields of a contact at one place, its wear, the cylinders of Hertz's law and another law, each with what to do instead.
const OF_ONE_PLACE: [[&str; 2]; 3] = [
    ["wear", "remove wear"],
    ["young", "give stiffness in place of law, young, poisson and width"],
    ["law", "give stiffness and damping in place of law"],
];
/// Largest number of contacts of a point or circle in one contact.
const MOST: usize = 2000;

/// Reads a force: several elements, if it is a contact of two curves or with a polygon. The outer option is None if
/// there is no such type.
pub(super) fn read(kind: &str, linker: &mut Linker<'_>) -> Option<Option<Vec<ForceElement<Tape>>>> {
    let given = |field: &str| linker.entry.get(field).is_some();
    if !given(OF_CURVES[0]) && !given(OF_CURVES[1]) && !given(OF_POINT[1]) {
        return ForceElement::read(Group::Forces, kind, linker).map(|e| e.map(|e| vec![e]));
    }
    let tables = catalogue().into_iter();
    let has_curves = |table: &Table| table.fields.iter().any(|of| of.name == OF_CURVES[0]);
    let own = |(group, table): &(Group, Table)| {
        *group == Group::Forces && table.name == kind && has_curves(table)
    };
    let Some((_, table)) = { tables }.find(own) else {
        return ForceElement::read(Group::Forces, kind, linker).map(|e| e.map(|e| vec![e]));
    };
    let pairings = match linker.entry.get(OF_CURVES[0]) {
        Some(_) => of_curves(&table.fields, linker),
        None => of_point(&table.fields, linker),
    };
    let Some(pairings) = pairings else { return Some(None) };
    if pairings.is_empty() {
        return ForceElement::read(Group::Forces, kind, linker).map(|e| e.map(|e| vec![e]));
    }
    if pairings.len() > 1 {
        for [name, instead] in OF_ONE_PLACE {
            let usual = || Value::Text("hunt_crossley".to_string());
            if linker.entry.get(name).is_some_and(|given| *given != usual()) {
                let message =
                    "belongs to a contact at one place; this one touches at several".to_string();
                let hint =
                    format!("{instead}, or write a contact of a point or circle for each place");
                linker.report::<()>(field(&table.fields, name), message, Some(hint));
                return Some(None);
            }
        }
    }
    let mut found = Vec::new();
    for pairing in pairings {
        linker.pairing = Some(pairing);
        match ForceElement::read(Group::Forces, kind, linker) {
            Some(Some(element)) => found.push(element),
            other => return other.map(|_| None),
        }
    }
    Some(Some(found))
}

fn field<'f>(fields: &'f [Field], name: &str) -> &'f Field {
    fields.iter().find(|field| field.name == name).expect("a field of a contact")
}

/// The pairings of a point and a polygon; none for another curve, or where `sides` stands without `curves`.
fn of_point(fields: &[Field], linker: &mut Linker<'_>) -> Option<Vec<Pairing>> {
    if linker.entry.get(OF_CURVES[1]).is_some() {
        let hint = "give curves too, or side";
        let message = "belongs to a contact of two curves".to_string();
        return linker.report(field(fields, OF_CURVES[1]), message, Some(hint.to_string()));
    }
    let [point, curve, side] = OF_POINT.each(|name| field(fields, name));
    let on = linker.curve(curve)?;
    let TouchForm::Edged { parts, .. } = TouchForm::of(&on, Side::Right) else {
        return Some(Vec::new());
    };
    let Curve::Polygon(_) = on.curve else { return Some(Vec::new()) };
    if matches!(linker.entry.get(OF_POINT[2]), Some(Value::Text(word)) if word == "left") {
        return linker.report(side, INSIDE.to_string(), None);
    }
    let point = linker.point(point)?;
    let of = |curve: CurveOn<Tape>| Pairing {
        point: point.clone(),
        curve,
        side: Side::Right,
        radius: None,
        rounding: 0.0,
        mate: None,
    };
    soft_corners(fields, linker)?;
    Some(parts.into_iter().map(of).list())
}

const INSIDE: &str = "a polygon is touched from outside, at its right; \
                      write walls around a body as lines or as several polygons";

/// The pairings of two curves.
fn of_curves(fields: &[Field], linker: &mut Linker<'_>) -> Option<Vec<Pairing>> {
    let [curves, sides] = OF_CURVES.each(|name| field(fields, name));
    if let Some(name) = OF_POINT.iter().find(|name| linker.entry.get(name).is_some()) {
        let hint = format!("keep either {name} or curves");
        let message = "takes the place of i, curve and side".to_string();
        return linker.report(curves, message, Some(hint));
    }
    let [i, j] = two_texts(curves, linker)?;
    let both = [linker.curve_named(curves, i), linker.curve_named(curves, j)];
    let both = match both {
        [Some(i), Some(j)] => [i, j],
        _ => return None,
    };
    let sides_of = sides_of(sides, &both, linker)?;
    let sharp = matches!(linker.entry.get("radius"), None | Some(Value::Number(0.0)));
    let Some(pairings) = pairings([&both[0], &both[1]], sides_of, sharp) else {
        let message = format!(
            "no contact of '{i}' with '{j}': inside a circle, another circle, a polygon or a line may touch, but no other \
             curve"
        );
        let hint = "write the other curve as a polygon; n corners on a curve with a radius of curvature r differ from \
                    it by 5 r/n² at most";
        return linker.report(curves, message, Some(hint.to_string()));
    };
    if pairings.iter().any(|of| of.radius.is_some()) && linker.entry.get("radius").is_some() {
        let message = "a circle has its own radius; remove it".to_string();
        return linker.report(field(fields, "radius"), message, None);
    }
    if pairings.iter().any(|of| of.mate.is_some()) {
        firm(curves, [i, j], (&both, &pairings), linker)?;
    }
    let polygon = |of: &Pairing| matches!(of.curve.curve, Curve::Polygon(_)) && of.mate.is_none();
    if pairings.iter().any(|of| of.radius.is_none() && polygon(of)) {
        soft_corners(fields, linker)?;
    }
    if pairings.len() > MOST {
        let message = format!(
            "the corners of '{i}' and '{j}' have {} possible contacts; at most {MOST} are allowed",
            pairings.len()
        );
        let hint =
            "give the contact only the parts of the curves that meet, as polygons of their own";
        return linker.report(curves, message, Some(hint.to_string()));
    }
    Some(pairings)
}

/// The sides on which two curves touch.
fn sides_of(
    sides: &Field,
    both: &[CurveOn<Tape>; 2],
    linker: &mut Linker<'_>,
) -> Option<[Side; 2]> {
    let both_sides = match linker.entry.get(OF_CURVES[1]) {
        None => [Side::Right; 2],
        Some(_) => {
            let words = two_texts(sides, linker)?;
            let of = |word: &str| match word {
                "right" => Some(Side::Right),
                "left" => Some(Side::Left),
                _ => None,
            };
            let (Some(i), Some(j)) = (of(words[0]), of(words[1])) else {
                let message = "each must be 'right' or 'left'".to_string();
                return linker.report(sides, message, None);
            };
            [i, j]
        }
    };
    for (on, side) in both.iter().zip(both_sides) {
        if matches!((&on.curve, side), (Curve::Polygon(_), Side::Left)) {
            return linker.report(sides, INSIDE.to_string(), None);
        }
    }
    Some(both_sides)
}

/// Refuses a compliant contact of two curves whose bodies are not known behind the places that press: where a body is
/// thin or divided, a depth would push it out at its back.
fn firm(
    curves: &Field,
    names: [&str; 2],
    (both, pairings): (&[CurveOn<Tape>; 2], &[Pairing]),
    linker: &mut Linker<'_>,
) -> Option<()> {
    if linker.entry.get("stiffness").is_none() {
        return Some(());
    }
    let open = |on: &CurveOn<Tape>| !on.curve.periodic() && !matches!(on.curve, Curve::Line { .. });
    let message = match both.iter().position(open) {
        Some(k) => format!("'{}' is open, and its depth is not known behind it", names[k]),
        None if pairings.len() > 1 => {
            "the polygon has inward corners, at which two of its parts would press".to_string()
        }
        None => return Some(()),
    };
    let hint = "give restitution in place of stiffness, or a closed curve and polygons without inward corners";
    linker.report(curves, message, Some(hint.to_string()))
}

/// Refuses a compliant contact of sharp corners, in which the force would jump from one edge to another.
fn soft_corners(fields: &[Field], linker: &mut Linker<'_>) -> Option<()> {
    let given = |name: &str| linker.entry.get(name).is_some();
    if given("radius") || !given("stiffness") {
        return Some(());
    }
    let message =
        "a corner that presses into a polygon needs a radius larger than its depth".to_string();
    let hint = "give radius, or restitution in place of stiffness";
    linker.report(field(fields, "radius"), message, Some(hint.to_string()))
}

/// The two texts of a field.
fn two_texts<'a>(field: &Field, linker: &mut Linker<'a>) -> Option<[&'a str; 2]> {
    if let Some(Value::List(items)) = linker.entry.get(field.name) {
        if let [Value::Text(first), Value::Text(last)] = &items[..] {
            return Some([first, last]);
        }
    }
    linker.report(field, "must be a list of two names".to_string(), None)
}

/// The form in which a curve takes part in a contact.
#[allow(clippy::large_enum_variant)] // only two exist at a time
enum TouchForm {
    /// A circle that is touched from outside.
    Disc { center: PointOn<Tape>, radius: Tape },
    /// A polygon or line.
    Edged { corners: Vec<PointOn<Tape>>, rounding: f64, parts: Vec<CurveOn<Tape>> },
    /// A circle that is touched from inside.
    Hollow,
    /// Any other curve.
    Smooth,
}

impl TouchForm {
    fn of(on: &CurveOn<Tape>, side: Side) -> Self {
        let body = on.body;
        let point = |s: &Local<Tape>| PointOn { body, s: s.clone() };
        match &on.curve {
            Curve::Circle { center, radius } if side == Side::Right => {
                Self::Disc { center: point(center), radius: radius.clone() }
            }
            Curve::Circle { .. } => Self::Hollow,
            Curve::Line { from, to } => {
                let corners = vec![point(from), point(to)];
                Self::Edged { corners, rounding: 0.0, parts: vec![on.clone()] }
            }
            Curve::Polygon(own) => {
                let all = own.corners();
                let at = |s: Local| Local { x: Tape::from(s.x), y: Tape::from(s.y) };
                let part = |corners: Vec<(Local, bool)>| CurveOn {
                    body,
                    curve: Curve::Polygon(Polygon::part(&corners)),
                };
                let (centres, rounding) = convex_corners(&all);
                Self::Edged {
                    corners: centres.into_iter().map(|s| point(&at(s))).list(),
                    rounding,
                    parts: convex_parts(&all).into_iter().map(part).list(),
                }
            }
            _ => Self::Smooth,
        }
    }
}

/// The pairings of a smooth curve with parts of another one. The smooth curve touches in place of a point.
fn smooth_on(
    parts: &[CurveOn<Tape>],
    (own, [own_side, side]): (&CurveOn<Tape>, [Side; 2]),
) -> Vec<Pairing> {
    let zero = || Tape::from(0.0);
    let one = |curve: &CurveOn<Tape>| Pairing {
        point: PointOn { body: own.body, s: Local { x: zero(), y: zero() } },
        curve: curve.clone(),
        side,
        radius: None,
        rounding: 0.0,
        mate: Some((own.clone(), own_side)),
    };
    parts.iter().map(one).list()
}

/// All pairings in which two curves may touch. None if the curves are refused.
fn pairings(both: [&CurveOn<Tape>; 2], sides: [Side; 2], sharp: bool) -> Option<Vec<Pairing>> {
    // a sharp corner does not touch another one
    let blunt = |on: &CurveOn<Tape>| match &on.curve {
        Curve::Polygon(own) => {
            CurveOn { body: on.body, curve: Curve::Polygon(own.clone().sharp()) }
        }
        _ => on.clone(),
    };
    let circle_on = |(center, radius): (&PointOn<Tape>, &Tape), other: &TouchForm, k: usize| {
        let one = |curve: &CurveOn<Tape>| Pairing {
            point: center.clone(),
            curve: curve.clone(),
            side: sides[k],
            radius: Some(radius.clone()),
            rounding: 0.0,
            mate: None,
        };
        match other {
            TouchForm::Edged { parts, .. } => parts.iter().map(one).list(),
            _ => vec![one(both[k])],
        }
    };
    let corners_on = |form: &TouchForm, parts: &[CurveOn<Tape>], k: usize| {
        let TouchForm::Edged { corners, rounding, .. } = form else { return Vec::new() };
        let one = |(curve, point): (&CurveOn<Tape>, &PointOn<Tape>)| Pairing {
            point: point.clone(),
            curve: if sharp { blunt(curve) } else { curve.clone() },
            side: sides[k],
            radius: None,
            rounding: *rounding,
            mate: None,
        };
        parts.iter().flat_map(|part| corners.iter().map(move |of| (part, of))).map(one).list()
    };
    let forms = [TouchForm::of(both[0], sides[0]), TouchForm::of(both[1], sides[1])];
    let [i, j] = &forms;
    Some(match [i, j] {
        [TouchForm::Disc { center, radius }, other] => circle_on((center, radius), other, 1),
        [other, TouchForm::Disc { center, radius }] => circle_on((center, radius), other, 0),
        [TouchForm::Edged { parts, .. }, TouchForm::Edged { parts: of_j, .. }] => {
            let mut found: Vec<Pairing> = corners_on(i, of_j, 1);
            found.extend::<Vec<Pairing>>(corners_on(j, parts, 0));
            found
        }
        [TouchForm::Edged { .. }, TouchForm::Hollow] => corners_on(i, &[both[1].clone()], 1),
        [TouchForm::Hollow, TouchForm::Edged { .. }] => corners_on(j, &[both[0].clone()], 0),
        [TouchForm::Smooth, TouchForm::Edged { parts, .. }] => smooth_on(parts, (both[0], sides)),
        [TouchForm::Edged { parts, .. }, TouchForm::Smooth] => {
            smooth_on(parts, (both[1], [sides[1], sides[0]]))
        }
        [TouchForm::Smooth, TouchForm::Smooth] => smooth_on(&[both[1].clone()], (both[0], sides)),
        _ => return None,
    })
}
