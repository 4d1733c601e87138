//! From the entry of a beam to its nodes, its elastic pieces, and the welds of its rigid form.

use super::super::beam_names::{self as nodes, BEAM, NODE, WELD};
use super::super::body_reader::{term, Reader};
use super::super::definition::Value;
use super::super::items::Body;
use super::super::scope::Reach;
use super::along;
use super::centre_line::CentreLine;
use super::pieces::{divide, Division};
use super::stiffness::{self, Stiffness};
use crate::elements::beam_line::{GAUSS, NODES, SHARES};
use crate::elements::{
    beam_lock, elastic_piece, welded, BodyId, Constraint, ForceElement, PieceNumbers, PointOn,
};
use crate::expression::Tape;
use crate::math::{Listed, Local, Ordered, ShortArray};

/// Elements with their names.
type Named<E> = Vec<(String, E)>;

/// A linked beam.
pub struct Linked {
    /// Its nodes: the first end, then in the order of [`nodes::names`].
    pub bodies: Vec<Body<Tape>>,
    /// Its elastic pieces.
    pub pieces: Named<ForceElement<Tape>>,
    /// The locks of their strains, which hold in the elastic form only.
    pub locks: Named<Constraint<Tape>>,
    /// The welds that carry its nodes in the rigid form of the model.
    pub welds: Named<Constraint<Tape>>,
}

/// Reads a beam whose first node has the index `first`.
pub fn read(reader: &mut Reader<'_>, first: BodyId) -> Linked {
    let problems = reader.problems.len();
    let made = parts(reader).map(|parts| parts.link(reader, first));
    match made {
        Some(made) if reader.problems.len() == problems => made,
        _ => placeholder(reader),
    }
}

/// A faulty beam, so that references to it cause no further reports.
fn placeholder(reader: &mut Reader<'_>) -> Linked {
    let mut first = reader.blank(BEAM);
    first.points.push((nodes::ends(reader.entry)[0].clone(), zero()));
    first.points.push((String::new(), zero()));
    let further = nodes::names(reader.entry);
    let further = further.into_iter().map(|name| Body { name, ..reader.blank(NODE) }).list();
    let bodies = std::iter::once(first).chain(further).list();
    let (pieces, locks, welds) = (Vec::new(), Vec::new(), Vec::new());
    Linked { bodies, pieces, locks, welds }
}

fn zero() -> Local<Tape> {
    Local { x: Tape::from(0.0), y: Tape::from(0.0) }
}

/// What the entry of a beam contains.
struct BeamParts {
    line: CentreLine,
    stiffness: Stiffness,
    damping: Option<Tape>,
    /// The places with names along the beam, from end to end: name, arc length as text and as number.
    places: Vec<(String, String, f64)>,
}

fn parts(reader: &mut Reader<'_>) -> Option<BeamParts> {
    let line = CentreLine::read(reader);
    let length = line.as_ref().map_or("1", |line| &line.length).to_string();
    let stiffness = stiffness::read(reader, &length);
    let damping = match reader.entry.get("damping") {
        Some(Value::Number(0.0)) | None => None,
        Some(_) => Some(reader.number("damping", "s")?),
    };
    let line = line?;
    let places = places(reader, &line.length)?;
    Some(BeamParts { line, stiffness: stiffness?, damping, places })
}

/// The ends and named points in the order of their arc lengths.
fn places(reader: &mut Reader<'_>, length: &str) -> Option<Vec<(String, String, f64)>> {
    let [first, last] = nodes::ends(reader.entry);
    let whole = reader.value(length);
    if !(whole.is_finite() && whole > 0.0) {
        let key =
            ["length", "through", "arc"].into_iter().find(|key| reader.entry.get(key).is_some());
        reader.report(key.unwrap_or("length"), &format!("{whole} m; must be > 0"));
        return None;
    }
    let mut all =
        vec![(first.clone(), "0".to_string(), 0.0), (last.clone(), length.to_string(), whole)];
    if first == last {
        reader.report("ends", "must name two different points, such as [\"A\", \"B\"]");
        return None;
    }
    for (name, value) in nodes::points(reader.entry) {
        let place = ["points", name].join(".");
        if name.contains('.') || name.starts_with('#') {
            reader.report(
                "points",
                &format!("'{name}': a name must not contain '.' or begin with '#'"),
            );
            return None;
        }
        let text = arc_length(reader, (name, value), length)?;
        let at = reader.value(&text);
        if all.iter().any(|(known, ..)| known == name) {
            reader.report(&place, &format!("'{name}' is the name of an end; choose another name"));
            return None;
        }
        if !(at > 0.0 && at < whole) {
            let message = format!(
                "{name} is at {at} m, outside the beam of {whole} m; its arc length must be between 0 and the \
                 length, or a share such as \"50 %\""
            );
            reader.report("points", &message);
            return None;
        }
        if let Some((other, ..)) =
            all.iter().find(|(_, _, known)| (*known - at).abs() < 1e-9 * whole)
        {
            reader.report(
                "points",
                &format!("{name} is at the same place as {other}; remove one of them"),
            );
            return None;
        }
        all.push((name.clone(), text, at));
    }
    count(reader)?;
    all.order_by(|a, b| a.2.total_cmp(&b.2));
    Some(all)
}

/// The arc length of a named point as text.
fn arc_length(
    reader: &mut Reader<'_>,
    (name, value): (&str, &Value),
    length: &str,
) -> Option<String> {
    let path: Vec<String> = reader.path("points").into_iter().chain([name.to_string()]).list();
    let share = match value {
        Value::Text(text) => text.trim().strip_suffix('%').map(str::trim),
        _ => None,
    };
    let (value, unit) = match share {
        Some(share) => (Value::Text(share.to_string()), ""),
        None => (value.clone(), "m"),
    };
    let reach = Reach::Parameters;
    reader.scope.formula(&value, &path, unit, reach, reader.problems)?;
    Some(match share {
        Some(share) => format!("(({share})/100*{length})"),
        None => term(&value),
    })
}

/// Checks the number of elements.
fn count(reader: &mut Reader<'_>) -> Option<()> {
    let (written, least) = (nodes::written(reader.entry), nodes::points(reader.entry).len() + 1);
    match (reader.entry.get("elements"), written) {
        (Some(_), None) => {
            let most = nodes::MOST;
            reader.report(
                "elements",
                &format!("must be a whole number from 1 to {most}, not a formula"),
            );
            None
        }
        (_, Some(written)) if written < least => {
            let message = format!(
                "{written}; the named points divide the beam into {least} parts, so that at least {least} elements are needed"
            );
            reader.report("elements", &message);
            None
        }
        _ => Some(()),
    }
}

impl BeamParts {
    fn link(self, reader: &mut Reader<'_>, first: BodyId) -> Linked {
        let along = self.places.iter().map(|(_, text, x)| (text.clone(), *x)).list();
        let division = divide(&along, nodes::elements(reader.entry));
        let ids = self.ids(reader, &division, first);
        let bodies = self.bodies(reader, &division, &ids, first);
        let (pieces, locks) = self.pieces(reader, &division, &ids);
        let mut welds = Vec::new();
        for (k, s) in division.at.iter().enumerate() {
            if k > 0 {
                // a chain, so that the factors of the rigid form stay sparse
                let [x, y, angle] = self.line.step(reader, &division.at[k - 1], s);
                let i = PointOn { body: ids[k - 1], s: Local { x, y } };
                let j = PointOn { body: ids[k], s: zero() };
                let name = format!("{}{WELD}", bodies[ids[k].0 - first.0].name);
                welds.push((name, welded(i, j, angle)));
            }
        }
        Linked { bodies, pieces, locks, welds }
    }

    /// The bodies of the nodes along the beam.
    fn ids(&self, reader: &Reader<'_>, division: &Division, first: BodyId) -> Vec<BodyId> {
        let beam = &reader.entry.name;
        let names = nodes::names(reader.entry);
        let of = |name: &str| {
            let k = names.iter().position(|known| known == name);
            BodyId(first.0 + k.map_or(0, |k| k + 1))
        };
        let (mut named, mut inner) = (self.places.iter(), 0);
        let mut id = |is_named: &bool| match is_named {
            true => named.next().map_or(first, |(name, ..)| of(&format!("{beam}.{name}"))),
            false => {
                inner += 1;
                of(&nodes::inner(beam, inner - 1))
            }
        };
        division.named.iter().map(&mut id).list()
    }

    fn bodies(
        &self,
        reader: &mut Reader<'_>,
        division: &Division,
        ids: &[BodyId],
        first: BodyId,
    ) -> Vec<Body<Tape>> {
        let of = &self.stiffness;
        let mut carried = vec![Vec::new(); ids.len()];
        for element in &division.elements {
            for k in 0..NODES {
                carried[element.nodes[k]].push(format!("({:?})*{}", SHARES[k], element.length));
            }
        }
        let names = nodes::names(reader.entry);
        let mut bodies = vec![Body { drawn: self.line.drawn.clone(), ..reader.blank(BEAM) }];
        bodies[0].points.push((self.places[0].0.clone(), zero()));
        bodies.extend(names.into_iter().map(|name| Body { name, ..reader.blank(NODE) }));
        for ((carried, id), s) in carried.iter().zip(ids).zip(&division.at) {
            let length = carried.join("+");
            let body = &mut bodies[id.0 - first.0];
            body.mass = reader.compose(&format!("{}*({length})", along::at(&of.mass, s)));
            body.inertia = reader.compose(&format!("{}*({length})", along::at(&of.inertia, s)));
        }
        bodies
    }

    fn pieces(
        &self,
        reader: &mut Reader<'_>,
        division: &Division,
        ids: &[BodyId],
    ) -> (Named<ForceElement<Tape>>, Named<Constraint<Tape>>) {
        let of = &self.stiffness;
        let locked = [("inextensible", true), ("shear", false)]
            .each(|(key, by)| reader.entry.get(key) == Some(&Value::Flag(by)));
        // a locked strain is zero, so that any stiffness exerts no force
        let one = "1".to_string();
        let stiffness = [&of.axial, &of.shear, &of.bending];
        let soft = [0, 1, 2].each(|k| if k < 2 && locked[k] { &one } else { stiffness[k] });
        let (mut made, mut locks) = (Vec::new(), Vec::new());
        for (k, element) in division.elements.iter().enumerate() {
            let (start, length) = (&element.start, &element.length);
            let share = |xi: f64| format!("({start}+({:?})*{length})", 0.5 * (1.0 + xi));
            let gauss = GAUSS.each(share);
            let numbers = PieceNumbers {
                start: reader.compose(start),
                length: reader.compose(length),
                stiffness: soft.each(|text| stiffness::at(reader, text, &gauss)),
                strains: self.line.strains(reader, start, length),
                damping: self.damping.clone(),
                stresses: [&of.by_force, &of.by_moment]
                    .each(|text| stiffness::at(reader, text, &gauss)),
            };
            let of = element.nodes.each(|node| ids[node]);
            let name = |of: &str| format!("{}.{of}_{}", reader.entry.name, k + 1);
            for axis in [0, 1].into_iter().filter(|axis| locked[*axis]) {
                locks.push((name(nodes::LOCKS[axis]), beam_lock(of, axis, &numbers)));
            }
            made.push((name("piece"), elastic_piece(of, numbers)));
        }
        (made, locks)
    }
}
