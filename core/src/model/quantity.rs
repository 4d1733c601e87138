//! Quantities of points and elements in formulas: `crank.B.x`, `slide.displacement`.
//!
//! An element defines its position quantities once, over any scalar. A jet of symbolic scalars gives each quantity
//! and its rate as a formula of the coordinates of the bodies. This formula replaces the name in a law.

use super::blueprint::Blueprint;
use super::definition::{Definition, Entry, Value};
use super::items::Body;
use super::link::Linker;
use super::pairs;
use super::play;
use super::quantities::Quantities;
use super::quantity_owner::{place, Carrier, FormulaModel, QuantityOwner};
use super::scope::Scope;
use crate::elements::{
    pins_points, BodyId, Constraint, Followed, ForceElement, Group, Measured, PointOn, PLACE,
};
use crate::expression::Tape;
use crate::math::{Listed, Local};
use std::cell::Cell;

/// Largest depth of nesting of elements whose quantities refer to each other.
const DEEPEST: u32 = 8;

/// The quantities of the points and elements of a definition.
pub struct Elements<'a> {
    definition: &'a Definition,
    scope: &'a Scope,
    bodies: &'a [Body<Tape>],
    formulas: FormulaModel,
    depth: Cell<u32>,
}

impl<'a> Elements<'a> {
    /// The quantities of a definition with linked bodies.
    pub fn new(definition: &'a Definition, scope: &'a Scope, bodies: &'a [Body<Tape>]) -> Self {
        let turns = scope.bodies.iter().map(|(_, turns)| *turns).list();
        let formulas = FormulaModel { parameters: scope.parameters.len(), turns };
        Self { definition, scope, bodies, formulas, depth: Cell::new(0) }
    }

    /// The owner with this name. Its fields with laws are zero.
    fn owner(&self, name: &str) -> Option<QuantityOwner<Tape>> {
        if let Some((body, point)) = name.rsplit_once('.') {
            let body = self.scope.body(body)?;
            let s = self.bodies[body].point(point)?.clone();
            return Some(QuantityOwner::Point(PointOn { body: BodyId(body), s }));
        }
        let (group, entry) = self.entry(name)?;
        let Some(Value::Text(kind)) = entry.get("type") else { return None };
        if self.depth.get() >= DEEPEST {
            return None;
        }
        self.depth.set(self.depth.get() + 1);
        let mut faults = Vec::new(); // its own link reports them
        let mut fields =
            Linker::of_numbers(group, entry, self.scope, self.bodies, self, &mut faults);
        let owner = match group {
            Group::Joints if play::is_written(entry) => {
                match ForceElement::read(group, kind, &mut fields) {
                    Some(force) => force.map(QuantityOwner::Force),
                    None => Constraint::read(group, kind, &mut fields)?
                        .map(|joint| QuantityOwner::Play(joint, self.carrier(entry))),
                }
            }
            Group::Forces => {
                pairs::read(kind, &mut fields)?.and_then(|all| of_parts(all.into_iter()))
            }
            _ => Constraint::read(group, kind, &mut fields)?.map(QuantityOwner::Constraint),
        };
        self.depth.set(self.depth.get() - 1);
        owner
    }

    /// The body on which joints that pin points, or its own points, hold the centres of both wheels of a belt with elastic
    /// strands.
    fn carrier(&self, belt: &Entry) -> Option<Carrier<Tape>> {
        let [first, second] = [self.mounts(belt, "i")?, self.mounts(belt, "j")?];
        let pairs = first.iter().flat_map(|a| second.iter().map(move |b| (a, b)));
        let ((body, from), (_, to)) = { pairs }.find(|(a, b)| a.0 == b.0)?;
        Some(Carrier { body: BodyId(*body), centres: [from.clone(), to.clone()] })
    }

    /// The bodies that hold a centre of an elastic belt, each with the place of the centre.
    fn mounts(&self, belt: &Entry, end: &str) -> Option<Vec<(usize, Local<Tape>)>> {
        belt.get("stiffness")?;
        let text = |entry: &'a Entry, field: &str| match entry.get(field) {
            Some(Value::Text(text)) => Some(text.as_str()),
            _ => None,
        };
        let Some(Value::Text(centre)) = belt.get(end) else { return None };
        let pins = self.definition.joints.iter();
        let pins = pins.filter(|joint| text(joint, "type").is_some_and(pins_points));
        let ends = pins.filter_map(|joint| Some([text(joint, "i")?, text(joint, "j")?]));
        let others = ends.filter_map(|[i, j]| match centre {
            centre if centre == i => Some(j),
            centre if centre == j => Some(i),
            _ => None,
        });
        let place = |name: &str| {
            let (body, point) = name.rsplit_once('.')?;
            let body = self.scope.body(body)?;
            Some((body, self.bodies[body].point(point)?.clone()))
        };
        Some(others.chain([centre.as_str()]).filter_map(place).list())
    }

    fn entry(&self, name: &str) -> Option<(Group, &'a Entry)> {
        let definition = self.definition;
        if let Some(k) = self.scope.force(name) {
            let entry = &definition.forces[k];
            let group = if play::is_written(entry) { Group::Joints } else { Group::Forces };
            return Some((group, entry));
        }
        let (k, joints) = (self.scope.constraint(name)?, &definition.joints);
        match joints.get(k) {
            Some(joint) => Some((Group::Joints, joint)),
            None => Some((Group::Drivers, &definition.drivers[k - joints.len()])),
        }
    }
}

impl Quantities for Elements<'_> {
    fn formula(&self, name: &str, rates: bool) -> Option<Tape> {
        let (owner, word) = name.rsplit_once('.')?;
        let owner = self.owner(owner).filter(QuantityOwner::has_formulas)?;
        let (k, order) = place(owner.measured(), word)?;
        let highest = usize::from(rates);
        (order <= highest).then(|| self.formulas.compile(&owner, k, order).0)
    }

    fn followed(&self, name: &str) -> Option<Followed<Tape>> {
        let (owner, word) = name.rsplit_once('.')?;
        if let Some(place) = self.scope.places.place_on_curve(name) {
            return self.owner(owner)?.on_curve(name, place);
        }
        let owner = self.owner(owner).filter(QuantityOwner::has_formulas)?;
        let (k, order) = place(owner.measured(), word)?;
        if order > 0 || owner.lacks_carrier() {
            return None;
        }
        Some(self.formulas.followed(&owner, k, name))
    }

    fn gradient(&self, name: &str) -> Option<[[Tape; 3]; 2]> {
        let (owner, word) = name.rsplit_once('.')?;
        let mut owner = self.owner(owner).filter(QuantityOwner::has_formulas)?;
        if let QuantityOwner::Play(_, carrier) = &mut owner {
            // the strands act at the wheels, not on the body that carries them
            *carrier = None;
        }
        let (k, _) = place(owner.measured(), word)?;
        Some(self.formulas.gradient_of(&owner, k))
    }

    fn refusal(&self, name: &str) -> Option<String> {
        let (owner, word) = name.rsplit_once('.')?;
        let found = self.owner(owner).filter(|found| !found.has_formulas())?;
        place(found.measured(), word)?;
        Some(format!("'{name}' has no formula: the nearest point of the curve is searched"))
    }

    fn offered(&self, owner: &str) -> Option<Vec<&'static str>> {
        let found = self.owner(owner)?;
        let place = found.on_curve(owner, 0).map(|_| PLACE);
        Some(found.measured().iter().map(|of| of.names[0]).chain(place).list())
    }

    fn names(&self, rates: bool) -> Vec<String> {
        let orders = 1 + usize::from(rates);
        let definition = self.definition;
        let elements = definition.joints.iter().chain(&definition.forces).map(|e| e.name.clone());
        let points = self.bodies[1..]
            .iter()
            .flat_map(|body| body.points.iter().map(|(point, _)| format!("{}.{point}", body.name)));
        let owners = elements.chain(points).take(MOST_SUGGESTED);
        let of = |owner: String| {
            let measured = self.owner(&owner).map_or(&[][..], |found| found.measured());
            let names = measured.iter().flat_map(|of| of.names.iter().take(orders));
            names.map(|name| format!("{owner}.{name}")).list()
        };
        owners.flat_map(of).list()
    }
}

/// Largest number of elements and points that suggestions consider.
const MOST_SUGGESTED: usize = 200;

/// The name of the rate of a place on a curve.
const PLACE_RATE: &str = "u_rate";

/// A quantity of a point or element of a linked model.
pub enum Offered {
    /// A position quantity or its rate (whether it is a rate), and its SI unit.
    Position(Followed<Tape>, bool, String),
    /// No position quantity or rate has this name. Contains the quantities of the owner.
    Other(&'static [Measured]),
}

/// The quantity `owner.word` of a linked model; None if no point or element has the name.
pub fn quantity_of(blueprint: &Blueprint, owner: &str, word: &str) -> Option<Offered> {
    let formulas = FormulaModel {
        parameters: blueprint.parameters.len(),
        turns: blueprint.bodies.iter().map(|body| body.turns).list(),
    };
    let name = format!("{owner}.{word}");
    let (joint, owner) = (owner, linked(blueprint, owner)?);
    if matches!(word, PLACE | PLACE_RATE) {
        let before = blueprint.constraints.iter().take_while(|(known, ..)| known != joint);
        let place = before.map(|(.., element)| element.own()).sum();
        if let Some(of) = owner.on_curve(&format!("{joint}.{PLACE}"), place) {
            let order = usize::from(word == PLACE_RATE);
            let unit = of.kind().unit_of_rate(order);
            return Some(Offered::Position(of, order == 1, unit));
        }
    }
    Some(match place(owner.measured(), word) {
        Some((k, order @ 0..=1)) if owner.has_formulas() => {
            let unit = owner.measured()[k].kind.unit_of_rate(order);
            Offered::Position(formulas.followed(&owner, k, &name), order == 1, unit)
        }
        _ => Offered::Other(owner.measured()),
    })
}

/// The owner with this name. Its laws are zero, because no quantity contains them.
fn linked(blueprint: &Blueprint, name: &str) -> Option<QuantityOwner<Tape>> {
    if let Some((body, point)) = name.split_once('.') {
        let body = blueprint.body(body)?;
        let s = blueprint.bodies[body.0].point(point)?.clone();
        return Some(QuantityOwner::Point(PointOn { body, s }));
    }
    let fixed = &mut |tape: &Tape| match tape.uses_time() || tape.uses_state() {
        true => Tape::from(0.0),
        false => tape.clone(),
    };
    let mut constraints = blueprint.constraints.iter();
    if let Some((.., element)) = constraints.find(|(known, ..)| known == name) {
        return Some(QuantityOwner::Constraint(element.map(fixed)));
    }
    let k = blueprint.forces.iter().position(|(known, ..)| known == name)?;
    let several = blueprint.further.contains(&k);
    let (.., element) = &blueprint.forces[k];
    let element = if element.follows() { element.clone() } else { element.map(fixed) };
    Some(if several { QuantityOwner::Several(element) } else { QuantityOwner::Force(element) })
}

/// The owner that a force with these parts is.
fn of_parts(
    mut all: impl ExactSizeIterator<Item = ForceElement<Tape>>,
) -> Option<QuantityOwner<Tape>> {
    let several = all.len() > 1;
    let owner = if several { QuantityOwner::Several } else { QuantityOwner::Force };
    all.next().map(owner)
}
