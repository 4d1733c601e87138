//! Bodies, their coordinates, and the position quantities that an element follows or acts on.

use super::attachment::Attachment;
use super::quantity_kind::QuantityKind;
use crate::math::{Local, Pose, Real, ShortArray, Twist, Vec2, Wrench};

/// A body of a model: 0 is ground, and moving bodies are numbered from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyId(pub usize);

impl BodyId {
    /// The ground, which has no columns in Φ_q.
    pub const GROUND: Self = Self(0);

    /// Whether this is ground.
    pub fn is_ground(self) -> bool {
        self == Self::GROUND
    }
}

/// A joint or driver of a model, in the order of the rows of Φ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointId(pub usize);

/// A coordinate of a body or its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Position of the frame's origin, m.
    X,
    /// Position of the frame's origin, m.
    Y,
    /// Angle of the frame, rad.
    Angle,
    /// Velocity of the frame's origin, m/s.
    Vx,
    /// Velocity of the frame's origin, m/s.
    Vy,
    /// Angular velocity, rad/s.
    Omega,
}

impl Coordinate {
    /// All, in the order of their index.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Angle, Self::Vx, Self::Vy, Self::Omega];

    /// The name in files, expressions and Python.
    pub fn name(self) -> &'static str {
        ["x", "y", "angle", "vx", "vy", "omega"][self as usize]
    }
    /// SI unit.
    pub fn unit(self) -> &'static str {
        ["m", "m", "rad", "m/s", "m/s", "rad/s"][self as usize]
    }
    /// Its kind, or the kind of the coordinate of which it is the rate.
    pub fn kind(self) -> QuantityKind {
        QuantityKind::OF_BODY[self.column()]
    }
    /// The coordinate with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|c| c.name() == name)
    }
    /// Whether it is a velocity.
    pub fn is_rate(self) -> bool {
        self as usize >= 3
    }
    /// Index 0 to 2 within the body's columns.
    pub fn column(self) -> usize {
        self as usize % 3
    }
    /// Its value on a body.
    pub fn of<S: Real>(self, pose: &Pose<S>, twist: &Twist<S>) -> S {
        match self {
            Self::X => pose.r.x,
            Self::Y => pose.r.y,
            Self::Angle => pose.angle,
            Self::Vx => twist.velocity.x,
            Self::Vy => twist.velocity.y,
            Self::Omega => twist.omega,
        }
    }
}

/// A coordinate of one body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoordinateOf {
    /// The body.
    pub body: BodyId,
    /// Which coordinate.
    pub coordinate: Coordinate,
}

/// A position quantity of an element or of a point, as a formula of the coordinates of bodies.
#[derive(Clone, Debug)]
pub struct QuantityOf<S = f64> {
    /// Its name as written, such as `slide.displacement`.
    pub name: String,
    /// The last part of its name.
    pub word: &'static str,
    /// A length or an angle.
    pub kind: QuantityKind,
    /// Bodies i and j. The quantity is the motion of j relative to i.
    pub bodies: [BodyId; 2],
    /// The frame on each of these bodies to which forces are reduced.
    pub ends: [Attachment<S>; 2],
    /// Its value, m or rad.
    pub value: S,
}

/// A position quantity that an element follows or acts on.
#[derive(Clone, Debug)]
pub enum Followed<S = f64> {
    /// A coordinate of a body, measured from ground.
    Coordinate(CoordinateOf),
    /// A quantity of an element or of a point.
    Quantity(Box<QuantityOf<S>>),
}

/// A position quantity on which an effort acts.
#[derive(Clone, Debug)]
pub struct Acted<S = f64> {
    /// The quantity.
    pub of: Followed<S>,
    /// Its derivatives with respect to x, y and angle of its bodies i and j.
    pub gradient: [[S; 3]; 2],
}

impl<S: Real> Acted<S> {
    /// The wrenches on bodies i and j of an effort along the quantity, about the origins of their frames.
    #[inline(always)]
    pub fn wrenches(&self, effort: S) -> [Wrench<S>; 2] {
        self.gradient.each(|[x, y, torque]| Wrench {
            force: Vec2::new(x, y).scale(effort),
            torque: torque * effort,
        })
    }
}

impl<S: From<f64>> From<CoordinateOf> for Acted<S> {
    fn from(of: CoordinateOf) -> Self {
        let along = |step: f64| {
            [0, 1, 2].each(|k| S::from(if k == of.coordinate.column() { step } else { 0.0 }))
        };
        Self { of: of.into(), gradient: [along(-1.0), along(1.0)] }
    }
}

impl<S> From<CoordinateOf> for Followed<S> {
    fn from(coordinate: CoordinateOf) -> Self {
        Self::Coordinate(coordinate)
    }
}

/// The name of the place of a joint on its curve.
pub const PLACE: &str = "u";

impl<S> Followed<S> {
    /// Whether it is the place of a joint on its curve, an internal coordinate. No force acts along it on the bodies.
    pub fn is_place(&self) -> bool {
        matches!(self, Self::Quantity(of) if of.word == PLACE)
    }

    /// Bodies i and j. The effort acts on j, and the opposite effort on i.
    pub fn bodies(&self) -> [BodyId; 2] {
        match self {
            Self::Coordinate(of) => [BodyId::GROUND, of.body],
            Self::Quantity(of) => of.bodies,
        }
    }

    /// Its name in labels.
    pub fn label(&self) -> &'static str {
        match self {
            Self::Coordinate(of) => of.coordinate.name(),
            Self::Quantity(of) => of.word,
        }
    }

    /// A length or an angle.
    pub fn kind(&self) -> QuantityKind {
        match self {
            Self::Coordinate(of) => of.coordinate.kind(),
            Self::Quantity(of) => of.kind,
        }
    }
}

impl<S: Real> Followed<S> {
    /// Its value, m or rad, for bodies i and j at given poses.
    pub fn value(&self, i: &Pose<S>, j: &Pose<S>) -> S {
        let of = match self {
            Self::Quantity(of) => return of.value,
            Self::Coordinate(of) => of,
        };
        let from_ground = i.rotation.inverse(j.r - i.r);
        match of.coordinate {
            Coordinate::X | Coordinate::Vx => from_ground.x,
            Coordinate::Y | Coordinate::Vy => from_ground.y,
            Coordinate::Angle | Coordinate::Omega => j.angle - i.angle,
        }
    }

    /// The frame on a body to which the effort is reduced. `body` is the index in [`Followed::bodies`].
    pub fn attachment(&self, body: usize) -> Attachment<S> {
        match self {
            Self::Coordinate(_) => Attachment { s: Local::zero(), axis: S::zero() },
            Self::Quantity(of) => of.ends[body],
        }
    }
}
