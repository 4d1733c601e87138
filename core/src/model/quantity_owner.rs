//! An owner of position quantities, such as a point or a joint, and its quantities as formulas.

use super::variable::Variable;
use crate::elements::derive::{seeded, ByThree};
use crate::elements::{
    At, Attachment, BodyId, Constraint, Coordinate, CoordinateOf, Followed, ForceElement, Measured,
    PointOn, QuantityOf,
};
use crate::expression::{Symbol, Tape, Values};
use crate::math::{Dual, Jet, Lift, Local, Pose, Real, Rotation, Twist, Vec2};
use crate::symbolic::{record, Name, Record, Symbolic};

/// An owner of quantities.
pub(super) enum QuantityOwner<S> {
    /// A point of a body. Its components x and y are quantities.
    Point(PointOn<S>),
    Constraint(Constraint<S>),
    Force(ForceElement<S>),
}

/// Components of a point as quantities.
const OF_POINT: [Measured; 2] = [
    Measured { names: ["x", "vx", "ax"], unit: "m" },
    Measured { names: ["y", "vy", "ay"], unit: "m" },
];

impl<S> QuantityOwner<S> {
    fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> QuantityOwner<T> {
        match self {
            Self::Point(on) => {
                let s = Local { x: f(&on.s.x), y: f(&on.s.y) };
                QuantityOwner::Point(PointOn { body: on.body, s })
            }
            Self::Constraint(element) => QuantityOwner::Constraint(element.map(f)),
            Self::Force(element) => QuantityOwner::Force(element.map(f)),
        }
    }

    pub fn measured(&self) -> &'static [Measured] {
        match self {
            Self::Point(_) => &OF_POINT,
            Self::Constraint(element) => element.measured(),
            Self::Force(element) => element.measured(),
        }
    }

    /// Whether its quantities are formulas of the coordinates.
    pub fn has_formulas(&self) -> bool {
        match self {
            Self::Force(element) => element.has_formulas(),
            _ => true,
        }
    }

    pub fn bodies(&self) -> Vec<BodyId> {
        match self {
            Self::Point(on) => vec![BodyId::GROUND, on.body],
            Self::Constraint(element) => element.bodies(),
            Self::Force(element) => element.bodies(),
        }
    }
}

impl<S: Real> QuantityOwner<S> {
    /// The values of all quantities of the owner.
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

/// Values of parameters, and of the coordinates of the bodies of an owner. Other laws in its fields are not
/// evaluated.
struct KnownValues<'a, S, T> {
    parameters: &'a [S],
    bodies: &'a [BodyId],
    poses: &'a [Pose<T>],
}

impl<S: Real, T: Lift<S>> Values<T> for KnownValues<'_, S, T> {
    fn parameter(&self, k: usize) -> T {
        T::lift(self.parameters[k])
    }
    fn time(&self) -> T {
        T::constant(f64::NAN)
    }
    fn variable(&self, k: usize) -> T {
        let Variable::Coordinate(body, of) = Variable::at(k) else { return self.time() };
        match self.bodies.iter().position(|own| *own == body) {
            Some(place) if !of.is_rate() => of.of(&self.poses[place], &Twist::zero()),
            _ => self.time(),
        }
    }
}

/// An owner with symbols as its numbers.
struct OwnerSymbols<'a> {
    owner: &'a QuantityOwner<Tape>,
    parameters: Vec<Symbolic>,
    bodies: Vec<BodyId>,
    poses: Vec<Pose<Jet<Symbolic>>>,
}

impl OwnerSymbols<'_> {
    /// Converts the owner to a scalar, for poses of its bodies.
    fn over<T: Lift<Symbolic>>(&self, poses: &[Pose<T>]) -> QuantityOwner<T> {
        let known = KnownValues { parameters: &self.parameters, bodies: &self.bodies, poses };
        self.owner.map(&mut |tape| tape.evaluate(&known))
    }
}

/// The model in which the quantities become formulas.
pub(super) struct FormulaModel {
    /// Number of its parameters.
    pub parameters: usize,
    /// Whether each body has an angle, ground first.
    pub turns: Vec<bool>,
}

impl FormulaModel {
    /// The quantity of an owner with index k, or its rate, as a formula; and the frames of its ends.
    pub fn compile(
        &self,
        owner: &QuantityOwner<Tape>,
        k: usize,
        order: usize,
    ) -> (Tape, [Attachment<Tape>; 2]) {
        self.recorded(owner, |own, tape| {
            let (poses, over) = (&own.poses, own.over(&own.poses));
            let values = over.measure(&At { bodies: poses, own: &[], t: Jet::zero() });
            let of = if order == 0 { values[k].value } else { values[k].rate };
            let ends = [0, 1].map(|body| {
                let Attachment { s, axis } = over.attachment(body);
                let [x, y, axis] = [s.x, s.y, axis].map(|x| tape(x.value));
                Attachment { s: Local { x, y }, axis }
            });
            (tape(of), ends)
        })
    }

    /// Passes an owner over symbols to a function, together with the conversion from a symbol to a formula.
    fn recorded<R>(
        &self,
        owner: &QuantityOwner<Tape>,
        f: impl FnOnce(&OwnerSymbols<'_>, &dyn Fn(Symbolic) -> Tape) -> R,
    ) -> R {
        record(|record| {
            let mut symbols = Vec::new();
            let mut symbol = |record: &Record, rate: Option<Symbolic>, meaning: Symbol| {
                let name = Name::field(&format!("s{}", symbols.len()));
                let x = record.changing(name, rate.unwrap_or(Symbolic::zero()));
                symbols.push((x, meaning));
                x
            };
            let parameters: Vec<Symbolic> =
                (0..self.parameters).map(|k| symbol(record, None, Symbol::Parameter(k))).collect();
            let bodies = owner.bodies();
            let poses: Vec<Pose<Jet<Symbolic>>> = bodies
                .iter()
                .map(|body| self.pose(*body, &mut |meaning| symbol(record, None, meaning)))
                .collect();
            let own = OwnerSymbols { owner, parameters, bodies, poses };
            f(&own, &|x| record.tape(x, &symbols))
        })
    }

    /// The derivatives of the quantity of an owner with index k with respect to x, y and angle of its bodies i and j.
    pub fn gradient_of(&self, owner: &QuantityOwner<Tape>, k: usize) -> [[Tape; 3]; 2] {
        self.recorded(owner, |own, tape| {
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
                    own.poses.iter().enumerate().map(pose).collect();
                let at = At { bodies: &bodies, own: &[], t: Dual::zero() };
                own.over(&bodies).measure(&at)[k].slope.map(tape)
            })
        })
    }

    /// The pose of a body with its rates. Ground rests at the origin.
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
        let turns = self.turns[body.0];
        let angle = if turns { jet(Coordinate::Angle, Coordinate::Omega) } else { Jet::zero() };
        Pose::new(x, y, angle)
    }

    /// The position quantity of an owner with index k, with the bodies between which it is measured.
    pub fn followed(&self, owner: &QuantityOwner<Tape>, k: usize, name: &str) -> Followed<Tape> {
        let (value, ends) = self.compile(owner, k, 0);
        let measured = owner.measured()[k];
        let bodies = owner.bodies();
        if let (QuantityOwner::Point(on), Some(coordinate)) =
            (owner, Coordinate::named(measured.names[0]))
        {
            let zero = |s: &Tape| s.constant() == Some(0.0);
            if zero(&on.s.x) && zero(&on.s.y) {
                return CoordinateOf { body: on.body, coordinate }.into();
            }
        }
        Followed::Quantity(Box::new(QuantityOf {
            name: name.to_string(),
            kind: measured.names[0],
            unit: measured.unit,
            bodies: [bodies[0], bodies[1]],
            ends,
            value,
        }))
    }
}

/// The index of a quantity and the order of its derivative.
pub(super) fn place(measured: &[Measured], name: &str) -> Option<(usize, usize)> {
    let mut all = measured.iter().enumerate();
    all.find_map(|(k, of)| Some((k, of.names.iter().position(|known| *known == name)?)))
}
