//! An owner of position quantities, such as a point or a joint, and its quantities as formulas.

use super::variable::Variable;
use crate::elements::{
    At, Attachment, Backlash, BodyId, Constraint, Coordinate, CoordinateOf, Followed, ForceElement,
    Measured, PointOn, QuantityOf, Strands, PLACE,
};
use crate::expression::{Symbol, Tape, Values};
use crate::math::{Listed, Local, Pose, Real, ShortArray, Twist};
use crate::symbolic::{record, Name, Record, Symbolic};

/// An owner of quantities.
pub(super) enum QuantityOwner<S> {
    /// A point of a body. Its components x and y are quantities.
    Point(PointOn<S>),
    Constraint(Constraint<S>),
    Force(ForceElement<S>),
    /// The first of several parts of a force, whose quantities have no formulas.
    Several(ForceElement<S>),
    /// A joint with play; a belt also has the body that carries both wheels.
    Play(Constraint<S>, Option<Carrier<S>>),
}

/// The body on which both wheels of a belt are pinned, with their centres.
#[derive(Clone)]
pub(super) struct Carrier<S> {
    pub body: BodyId,
    pub centres: [Local<S>; 2],
}

impl<S: Real> Carrier<S> {
    /// The opposite of the equation of the belt, without a whole turn of the wheels or of the carrier taken away.
    fn play(&self, belt: &Strands<S>, at: &At<'_, S>) -> S {
        let d = self.centres[1] - self.centres[0];
        let theta = at.bodies[2].angle + d.y.atan2(d.x);
        let ([r_i, r_j], turned) = (belt.radii, |of: &Pose<S>| of.angle - theta);
        let r_j = if belt.crossed { r_j } else { -r_j };
        belt.offset - r_i * turned(at.i()) - r_j * turned(at.j())
    }
}

/// Components of a point as quantities.
const OF_POINT: [Measured; 2] =
    [Measured::length(["x", "vx", "ax"]), Measured::length(["y", "vy", "ay"])];

impl<S> QuantityOwner<S> {
    fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> QuantityOwner<T> {
        match self {
            Self::Point(on) => {
                let s = Local { x: f(&on.s.x), y: f(&on.s.y) };
                QuantityOwner::Point(PointOn { body: on.body, s })
            }
            Self::Constraint(element) => QuantityOwner::Constraint(element.map(f)),
            Self::Force(element) => QuantityOwner::Force(element.map(f)),
            Self::Several(element) => QuantityOwner::Several(element.map(f)),
            Self::Play(joint, carrier) => {
                let joint = joint.map(f);
                let carrier = carrier.as_ref().map(|Carrier { body, centres }| Carrier {
                    body: *body,
                    centres: centres.each_ref().each(|s| Local { x: f(&s.x), y: f(&s.y) }),
                });
                QuantityOwner::Play(joint, carrier)
            }
        }
    }

    pub fn measured(&self) -> &'static [Measured] {
        match self {
            Self::Point(_) => &OF_POINT,
            Self::Constraint(element) => element.measured(),
            Self::Force(element) | Self::Several(element) => element.measured(),
            Self::Play(..) => &Measured::OF_PLAY,
        }
    }

    /// Whether its quantities are formulas of the coordinates.
    pub fn has_formulas(&self) -> bool {
        match self {
            Self::Force(element) => element.has_formulas(),
            Self::Several(_) => false,
            _ => true,
        }
    }

    /// Whether it is a belt with elastic strands whose wheels are not pinned on one body. Their turns against the line of
    /// centres are then not known.
    pub fn lacks_carrier(&self) -> bool
    where
        S: Clone,
    {
        let Self::Play(joint, None) = self else { return false };
        joint.strands().is_some_and(|of| of.stiffness.is_some())
    }

    pub fn bodies(&self) -> Vec<BodyId> {
        match self {
            Self::Point(on) => vec![BodyId::GROUND, on.body],
            Self::Constraint(element) => element.bodies(),
            Self::Force(element) | Self::Several(element) => element.bodies(),
            Self::Play(joint, carrier) => {
                joint.bodies().into_iter().chain(carrier.iter().map(|of| of.body)).list()
            }
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
            Self::Force(element) | Self::Several(element) => element.measure(at, &mut values),
            Self::Play(joint, carrier) => {
                let play = match carrier.as_ref().zip(joint.strands()) {
                    Some((carrier, belt)) => carrier.play(&belt, at),
                    None => joint.play(at),
                };
                let half = |own: Backlash<S>| S::constant(own.half) * own.size;
                let half = joint.backlash().map_or(S::zero(), half);
                values.copy_from_slice(&[half - play.abs(), play]);
            }
        }
        values
    }

    /// The frame on body i or j to which an effort is reduced.
    fn attachment(&self, body: usize) -> Attachment<S> {
        let at = |s: Local<S>| Attachment { s, axis: S::zero() };
        match (self, body) {
            (Self::Point(on), 1) => at(on.s),
            (Self::Point(_), _) => at(Local::zero()),
            (Self::Constraint(element) | Self::Play(element, _), _) => element.attachment(body),
            (Self::Force(element) | Self::Several(element), _) => {
                at(element.points().map_or(Local::zero(), |points| points[body]))
            }
        }
    }
}

impl QuantityOwner<Tape> {
    /// The place of a joint on its curve, its only internal coordinate, by its index among those of all joints.
    pub fn on_curve(&self, name: &str, place: usize) -> Option<Followed<Tape>> {
        let Self::Constraint(element) = self else { return None };
        let curve = element.curve().filter(|_| element.own() == 1)?;
        let bodies = element.bodies();
        let variable = Variable::Internal { place, rate: false };
        let zero = || Tape::from(0.0);
        let origin = Attachment { s: Local { x: zero(), y: zero() }, axis: zero() };
        Some(Followed::Quantity(Box::new(QuantityOf {
            name: name.to_string(),
            word: PLACE,
            kind: curve.curve.kind(),
            bodies: [bodies[0], bodies[1]],
            ends: [0, 1].each(|_| origin.clone()),
            value: Tape::shifted(Symbol::Variable(variable.index()), 0.0),
        })))
    }
}

/// An owner with symbols as its numbers.
struct OwnerSymbols {
    parameters: Vec<Symbolic>,
    bodies: Vec<BodyId>,
    poses: Vec<Pose<Symbolic>>,
}

/// Symbols of parameters, and of the coordinates of the bodies. Other laws in the fields of the owner are not
/// evaluated.
impl Values<Symbolic> for OwnerSymbols {
    fn parameter(&self, k: usize) -> Symbolic {
        self.parameters[k]
    }
    fn time(&self) -> Symbolic {
        Symbolic::constant(f64::NAN)
    }
    fn variable(&self, k: usize) -> Symbolic {
        let Variable::Coordinate(body, of) = Variable::at(k) else { return self.time() };
        match self.bodies.iter().position(|own| *own == body) {
            Some(place) if !of.is_rate() => of.of(&self.poses[place], &Twist::zero()),
            _ => self.time(),
        }
    }
}

/// The record of an owner over symbols.
struct OwnerRecord<'a> {
    record: &'a Record,
    own: OwnerSymbols,
    over: QuantityOwner<Symbolic>,
    /// The meaning of each symbol in a formula.
    symbols: Vec<(Symbolic, Symbol)>,
}

impl OwnerRecord<'_> {
    /// The quantity with index k.
    fn quantity(&self, k: usize) -> Symbolic {
        let at = At { bodies: &self.own.poses, own: &[], t: Symbolic::zero() };
        self.over.measure(&at)[k]
    }

    /// An expression as a formula.
    fn tape(&self, x: Symbolic) -> Tape {
        self.record.tape(x, &self.symbols)
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
        self.recorded(owner, |all| {
            let value = all.quantity(k);
            let of = if order == 0 { value } else { all.record.rate(value) };
            let end = |body: usize| {
                let Attachment { s, axis } = all.over.attachment(body);
                let s = Local { x: all.tape(s.x), y: all.tape(s.y) };
                Attachment { s, axis: all.tape(axis) }
            };
            (all.tape(of), [end(0), end(1)])
        })
    }

    /// Passes the record of an owner over symbols to a function.
    fn recorded<R>(&self, owner: &QuantityOwner<Tape>, f: impl FnOnce(&OwnerRecord<'_>) -> R) -> R {
        record(|record| {
            let mut symbols = Vec::new();
            let mut symbol = |rate: Symbolic, meaning: Symbol| {
                let x = record.changing(Name::field(&format!("s{}", symbols.len())), rate);
                symbols.push((x, meaning));
                x
            };
            let constant = |k| symbol(Symbolic::zero(), Symbol::Parameter(k));
            let parameters: Vec<Symbolic> = (0..self.parameters).map(constant).list();
            let bodies = owner.bodies();
            let poses = bodies.iter().map(|body| self.pose(*body, &mut symbol)).list();
            let own = OwnerSymbols { parameters, bodies, poses };
            let over = owner.map(&mut |tape| tape.evaluate(&own));
            f(&OwnerRecord { record, own, over, symbols })
        })
    }

    /// The derivatives of the quantity of an owner with index k with respect to x, y and angle of its bodies i and j.
    pub fn gradient_of(&self, owner: &QuantityOwner<Tape>, k: usize) -> [[Tape; 3]; 2] {
        self.recorded(owner, |all| {
            let value = all.quantity(k);
            let by = |symbol| all.tape(all.record.derivative(value, symbol));
            let by_body = |body: usize| {
                let Pose { r, angle, .. } = all.own.poses[body];
                [by(r.x), by(r.y), by(angle)]
            };
            [by_body(0), by_body(1)]
        })
    }

    /// The pose of a body, whose coordinates have symbols as rates. Ground rests at the origin.
    fn pose(
        &self,
        body: BodyId,
        symbol: &mut dyn FnMut(Symbolic, Symbol) -> Symbolic,
    ) -> Pose<Symbolic> {
        if body.is_ground() {
            return Pose::identity();
        }
        let mut moving = |position: Coordinate, rate: Coordinate| {
            let meaning = |c| Symbol::Variable(Variable::Coordinate(body, c).index());
            let rate = symbol(Symbolic::zero(), meaning(rate));
            symbol(rate, meaning(position))
        };
        let x = moving(Coordinate::X, Coordinate::Vx);
        let y = moving(Coordinate::Y, Coordinate::Vy);
        let turns = self.turns[body.0];
        let angle =
            if turns { moving(Coordinate::Angle, Coordinate::Omega) } else { Symbolic::zero() };
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
            word: measured.names[0],
            kind: measured.kind,
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
