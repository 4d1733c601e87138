//! Quantities of points and elements in formulas: `crank.B.x`, `slide.displacement`.
//!
//! An element states its position quantities once, over any scalar. A jet of symbolic scalars gives each quantity and
//! its rate as a formula of the coordinates of the bodies, and this formula replaces the name in a law.

use super::definition::{Definition, Entry, Value};
use super::items::Body;
use super::link::Linker;
use super::scope::{Quantities, Scope};
use super::variable::Variable;
use crate::elements::derive::{seeded, ByThree};
use crate::elements::{
    At, Attachment, BodyId, Constraint, Coordinate, CoordinateOf, Followed, ForceElement, Group,
    Measured, PointOn, QuantityOf,
};
use crate::expression::{Symbol, Tape, Values};
use crate::math::{Dual, Jet, Lift, Local, Pose, Real, Rotation, Vec2};
use crate::symbolic::{record, Name, Record, Symbolic};
use std::cell::Cell;

/// Elements whose quantities refer to each other are read to this depth.
const DEEPEST: u32 = 8;

/// The quantities of the points and elements of a definition.
pub struct Elements<'a> {
    definition: &'a Definition,
    scope: &'a Scope,
    bodies: &'a [Body<Tape>],
    depth: Cell<u32>,
}

/// An owner of quantities.
enum Owner<S> {
    /// A point of a body; its component x or y is measured.
    Point(PointOn<S>),
    Constraint(Constraint<S>),
    Force(ForceElement<S>),
}

/// Components of a point as quantities.
const OF_POINT: [Measured; 2] = [
    Measured { names: ["x", "vx", "ax"], unit: "m" },
    Measured { names: ["y", "vy", "ay"], unit: "m" },
];

impl<S> Owner<S> {
    fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Owner<T> {
        match self {
            Self::Point(on) => {
                let s = Local { x: f(&on.s.x), y: f(&on.s.y) };
                Owner::Point(PointOn { body: on.body, s })
            }
            Self::Constraint(element) => Owner::Constraint(element.map(f)),
            Self::Force(element) => Owner::Force(element.map(f)),
        }
    }

    fn measured(&self) -> &'static [Measured] {
        match self {
            Self::Point(_) => &OF_POINT,
            Self::Constraint(element) => element.measured(),
            Self::Force(element) => element.measured(),
        }
    }

    fn bodies(&self) -> Vec<BodyId> {
        match self {
            Self::Point(on) => vec![BodyId::GROUND, on.body],
            Self::Constraint(element) => element.bodies(),
            Self::Force(element) => element.bodies(),
        }
    }
}

impl<S: Real> Owner<S> {
    /// The values of all its quantities.
    fn measure(&self, at: &At<'_, S>) -> Vec<S> {
        let mut values = vec![S::zero(); self.measured().len()];
        match self {
            Self::Point(on) => {
                let p = at.j().point(on.s);
                values.copy_from_slice(&[p.x, p.y]);
            }
            Self::Constraint(element) => element.measure(at, &mut values),
            Self::Force(element) => element.measure(at, &mut values),
        }
        values
    }

    /// The frame on body i or j to which an effort is reduced.
    fn attachment(&self, body: usize) -> Attachment<S> {
        let at = |s: Local<S>| Attachment { s, axis: S::zero() };
        match (self, body) {
            (Self::Point(on), 1) => at(on.s),
            (Self::Point(_), _) => at(Local::zero()),
            (Self::Constraint(element), _) => element.attachment(body),
            (Self::Force(element), _) => {
                at(element.points().map_or(Local::zero(), |points| points[body]))
            }
        }
    }
}

/// Parameters as symbols; fields of elements that are laws are not read.
struct Parameters<'a>(&'a [Symbolic]);

impl Values<Symbolic> for Parameters<'_> {
    fn parameter(&self, k: usize) -> Symbolic {
        self.0[k]
    }
    fn time(&self) -> Symbolic {
        Symbolic::constant(f64::NAN)
    }
    fn variable(&self, _: usize) -> Symbolic {
        Symbolic::constant(f64::NAN)
    }
}

impl<'a> Elements<'a> {
    /// Of a definition with linked bodies.
    pub fn new(definition: &'a Definition, scope: &'a Scope, bodies: &'a [Body<Tape>]) -> Self {
        Self { definition, scope, bodies, depth: Cell::new(0) }
    }

    /// The owner with this name; fields with laws are zero in it.
    fn owner(&self, name: &str) -> Option<Owner<Tape>> {
        if let Some((body, point)) = name.rsplit_once('.') {
            let body = self.scope.body(body)?;
            let s = self.bodies[body].point(point)?.clone();
            return Some(Owner::Point(PointOn { body: BodyId(body), s }));
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
            Group::Forces => ForceElement::read(kind, &mut fields)?.map(Owner::Force),
            _ => Constraint::read(group, kind, &mut fields)?.map(Owner::Constraint),
        };
        self.depth.set(self.depth.get() - 1);
        owner
    }

    fn entry(&self, name: &str) -> Option<(Group, &'a Entry)> {
        let definition = self.definition;
        if let Some(k) = self.scope.force(name) {
            return Some((Group::Forces, &definition.forces[k]));
        }
        let (k, joints) = (self.scope.constraint(name)?, &definition.joints);
        match joints.get(k) {
            Some(joint) => Some((Group::Joints, joint)),
            None => Some((Group::Drivers, &definition.drivers[k - joints.len()])),
        }
    }

    /// The quantity of an owner at a place, or its rate, as a formula; and the frames of its ends.
    fn compile(
        &self,
        owner: &Owner<Tape>,
        k: usize,
        order: usize,
    ) -> (Tape, [Attachment<Tape>; 2]) {
        self.recorded(owner, |poses, over, tape| {
            let lifted = over.map(&mut |x| Jet::lift(*x));
            let values = lifted.measure(&At { bodies: poses, own: &[], t: Jet::zero() });
            let of = if order == 0 { values[k].value } else { values[k].rate };
            let ends = [0, 1].map(|body| {
                let Attachment { s, axis } = over.attachment(body);
                Attachment { s: Local { x: tape(s.x), y: tape(s.y) }, axis: tape(axis) }
            });
            (tape(of), ends)
        })
    }

    /// Gives the poses of the bodies of an owner and the owner as symbols, and the way from a symbol to a formula.
    fn recorded<R>(
        &self,
        owner: &Owner<Tape>,
        f: impl FnOnce(&[Pose<Jet<Symbolic>>], &Owner<Symbolic>, &dyn Fn(Symbolic) -> Tape) -> R,
    ) -> R {
        record(|record| {
            let mut symbols = Vec::new();
            let mut symbol = |record: &Record, rate: Option<Symbolic>, meaning: Symbol| {
                let name = Name::field(&format!("s{}", symbols.len()));
                let x = record.changing(name, rate.unwrap_or(Symbolic::zero()));
                symbols.push((x, meaning));
                x
            };
            let parameters: Vec<Symbolic> = (0..self.scope.parameters.len())
                .map(|k| symbol(record, None, Symbol::Parameter(k)))
                .collect();
            let poses: Vec<Pose<Jet<Symbolic>>> = owner
                .bodies()
                .into_iter()
                .map(|body| self.pose(body, &mut |meaning| symbol(record, None, meaning)))
                .collect();
            let over = owner.map(&mut |tape| tape.evaluate(&Parameters(&parameters)));
            f(&poses, &over, &|x| record.tape(x, &symbols))
        })
    }

    /// The derivatives of the quantity of an owner at a place by x, y and angle of its bodies i and j.
    fn gradient_of(&self, owner: &Owner<Tape>, k: usize) -> [[Tape; 3]; 2] {
        self.recorded(owner, |poses, over, tape| {
            let lifted = over.map(&mut |x| Dual::lift(*x));
            [0, 1].map(|seed| {
                let pose = |(body, pose): (usize, &Pose<Jet<Symbolic>>)| {
                    let pose = Pose {
                        r: Vec2::new(pose.r.x.value, pose.r.y.value),
                        angle: pose.angle.value,
                        rotation: Rotation {
                            cos: pose.rotation.cos.value,
                            sin: pose.rotation.sin.value,
                        },
                    };
                    if body == seed {
                        seeded(&pose)
                    } else {
                        pose.lift()
                    }
                };
                let bodies: Vec<Pose<ByThree<Symbolic>>> =
                    poses.iter().enumerate().map(pose).collect();
                let at = At { bodies: &bodies, own: &[], t: Dual::zero() };
                lifted.measure(&at)[k].slope.map(tape)
            })
        })
    }

    /// The pose of a body with its rates; ground rests in the origin.
    fn pose(
        &self,
        body: BodyId,
        symbol: &mut dyn FnMut(Symbol) -> Symbolic,
    ) -> Pose<Jet<Symbolic>> {
        if body.is_ground() {
            return Pose::identity();
        }
        let mut jet = |position: Coordinate, rate: Coordinate| {
            let mut of = |c| symbol(Symbol::Variable(Variable::Coordinate(body, c).index()));
            Jet::new(of(position), of(rate), Symbolic::zero())
        };
        let x = jet(Coordinate::X, Coordinate::Vx);
        let y = jet(Coordinate::Y, Coordinate::Vy);
        let turns = self.scope.bodies[body.0].1;
        let angle = if turns { jet(Coordinate::Angle, Coordinate::Omega) } else { Jet::zero() };
        Pose::new(x, y, angle)
    }
}

/// The place of a quantity and the order of its derivative.
fn place(measured: &[Measured], name: &str) -> Option<(usize, usize)> {
    let mut all = measured.iter().enumerate();
    all.find_map(|(k, of)| Some((k, of.names.iter().position(|known| *known == name)?)))
}

impl Quantities for Elements<'_> {
    fn formula(&self, name: &str, rates: bool) -> Option<Tape> {
        let (owner, word) = name.rsplit_once('.')?;
        let owner = self.owner(owner)?;
        let (k, order) = place(owner.measured(), word)?;
        let highest = usize::from(rates);
        (order <= highest).then(|| self.compile(&owner, k, order).0)
    }

    fn followed(&self, name: &str) -> Option<Followed<Tape>> {
        let (owner, word) = name.rsplit_once('.')?;
        let owner = self.owner(owner)?;
        let (k, order) = place(owner.measured(), word)?;
        if order > 0 {
            return None;
        }
        let (value, ends) = self.compile(&owner, k, 0);
        let measured = owner.measured()[k];
        let bodies = owner.bodies();
        if let (Owner::Point(on), Some(coordinate)) = (&owner, Coordinate::named(word)) {
            let zero = |s: &Tape| s.constant() == Some(0.0);
            if zero(&on.s.x) && zero(&on.s.y) {
                return Some(CoordinateOf { body: on.body, coordinate }.into());
            }
        }
        Some(Followed::Quantity(Box::new(QuantityOf {
            name: name.to_string(),
            kind: measured.names[0],
            unit: measured.unit,
            bodies: [bodies[0], bodies[1]],
            ends,
            value,
        })))
    }

    fn gradient(&self, name: &str) -> Option<[[Tape; 3]; 2]> {
        let (owner, word) = name.rsplit_once('.')?;
        let owner = self.owner(owner)?;
        let (k, _) = place(owner.measured(), word)?;
        Some(self.gradient_of(&owner, k))
    }

    fn offered(&self, owner: &str) -> Option<Vec<&'static str>> {
        let names = self.owner(owner)?.measured().iter().map(|of| of.names[0]);
        Some(names.collect())
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
            names.map(|name| format!("{owner}.{name}")).collect::<Vec<_>>()
        };
        owners.flat_map(of).collect()
    }
}

/// Suggestions consider so many elements and points.
const MOST_SUGGESTED: usize = 200;
