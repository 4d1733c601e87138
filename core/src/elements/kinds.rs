//! Kinds of fields: the values that an element may hold, and how each is read and converted between scalars.

use super::attachment::Attachment;
use super::field::{Default, Field, Shape};
use crate::expression::Tape;
use crate::math::{Local, Pose, Real, Twist};

/// A body of a model: 0 is ground, moving bodies count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyId(pub usize);

impl BodyId {
    /// The body with zero columns.
    pub const GROUND: Self = Self(0);

    /// Whether this is ground.
    pub fn is_ground(self) -> bool {
        self == Self::GROUND
    }
}

/// A joint or driver of a model, in the order of the rows of Φ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointId(pub usize);

/// A point fixed in a body.
#[derive(Clone, Debug, PartialEq)]
pub struct PointOn<S = f64> {
    /// The body.
    pub body: BodyId,
    /// s′, from the origin of the body frame, m.
    pub s: Local<S>,
}

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
    /// From its name.
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
    pub kind: &'static str,
    /// SI unit: `m` or `rad`.
    pub unit: &'static str,
    /// Bodies i and j: it is the motion of j as seen from i.
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

impl<S> From<CoordinateOf> for Followed<S> {
    fn from(coordinate: CoordinateOf) -> Self {
        Self::Coordinate(coordinate)
    }
}

impl<S> Followed<S> {
    /// Bodies i and j: the effort acts on j, the opposite on i.
    pub fn bodies(&self) -> [BodyId; 2] {
        match self {
            Self::Coordinate(of) => [BodyId::GROUND, of.body],
            Self::Quantity(of) => of.bodies,
        }
    }

    /// Its name in labels, and its SI unit.
    pub fn label(&self) -> (&'static str, &'static str) {
        match self {
            Self::Coordinate(of) => (of.coordinate.name(), of.coordinate.unit()),
            Self::Quantity(of) => (of.kind, of.unit),
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

    /// The frame on a body, by its place among [`Followed::bodies`], to which its effort is reduced.
    pub fn attachment(&self, body: usize) -> Attachment<S> {
        match self {
            Self::Coordinate(_) => Attachment { s: Local::zero(), axis: S::zero() },
            Self::Quantity(of) => of.ends[body],
        }
    }
}

/// Where fields are read from; it keeps the reports of their faults.
pub trait Source {
    /// Whether the field has a value of its own.
    fn given(&mut self, field: &Field) -> bool;
    /// A body by name.
    fn body(&mut self, field: &Field) -> Option<BodyId>;
    /// A named point of a body.
    fn point(&mut self, field: &Field) -> Option<PointOn<Tape>>;
    /// A position quantity.
    fn coordinate(&mut self, field: &Field) -> Option<Followed<Tape>>;
    /// A joint by name.
    fn joint(&mut self, field: &Field) -> Option<JointId>;
    /// A formula in the parameters.
    fn number(&mut self, field: &Field) -> Option<Tape>;
    /// A formula in the parameters, time and state.
    fn law(&mut self, field: &Field) -> Option<Tape>;
    /// Two formulas in the parameters.
    fn pair(&mut self, field: &Field) -> Option<[Tape; 2]>;
    /// Two formulas in the parameters, time and state.
    fn law_pair(&mut self, field: &Field) -> Option<[Tape; 2]>;
    /// Formulas in the parameters, time and state.
    fn laws(&mut self, field: &Field) -> Option<Vec<Tape>>;
    /// true or false.
    fn flag(&mut self, field: &Field) -> Option<bool>;
    /// The place of a word among those that the field may hold.
    fn word(&mut self, field: &Field, words: &[&str]) -> Option<usize>;
}

/// A kind of field.
pub trait Kind {
    /// The value that the element holds over the scalar `S`.
    type Over<S>;
    /// The values that the file may hold.
    const SHAPE: Shape;
    /// The default of a field that declares none; None if the field must then be given.
    const DEFAULT: Option<Default> = None;
    /// Reads one field.
    fn read(source: &mut dyn Source, field: &Field) -> Option<Self::Over<Tape>>;
    /// Converts it to another scalar.
    fn map<S, T>(value: &Self::Over<S>, f: &mut dyn FnMut(&S) -> T) -> Self::Over<T>;
}

macro_rules! kind {
    ($(#[$doc:meta])* $kind:ident, $Shape:ident, $S:ident => $Over:ty, |$v:ident, $f:ident| $map:expr) => {
        $(#[$doc])*
        #[allow(non_camel_case_types)] // a type in `element!`, written like a word
        #[derive(Clone, Copy, Debug)]
        pub enum $kind {}
        impl Kind for $kind {
            type Over<$S> = $Over;
            const SHAPE: Shape = Shape::$Shape;
            fn read(source: &mut dyn Source, field: &Field) -> Option<Self::Over<Tape>> {
                source.$kind(field)
            }
            fn map<S, T>($v: &Self::Over<S>, $f: &mut dyn FnMut(&S) -> T) -> Self::Over<T> {
                $map
            }
        }
    };
}

kind!(
    /// A body.
    body, Body, S => BodyId, |v, _f| *v
);
kind!(
    /// A point of a body.
    point, Point, S => PointOn<S>, |v, f| PointOn {
        body: v.body, s: Local { x: f(&v.s.x), y: f(&v.s.y) }
    }
);
kind!(
    /// A position quantity.
    coordinate, Coordinate, S => Followed<S>, |v, f| match v {
        Followed::Coordinate(of) => Followed::Coordinate(*of),
        Followed::Quantity(of) => Followed::Quantity(Box::new(QuantityOf {
            name: of.name.clone(),
            kind: of.kind,
            unit: of.unit,
            bodies: of.bodies,
            ends: of.ends.each_ref().map(|end| Attachment {
                s: Local { x: f(&end.s.x), y: f(&end.s.y) },
                axis: f(&end.axis),
            }),
            value: f(&of.value),
        })),
    }
);
kind!(
    /// A joint.
    joint, Name, S => JointId, |v, _f| *v
);
kind!(
    /// A constant.
    number, Number, S => S, |v, f| f(v)
);
kind!(
    /// A quantity that may depend on time and state.
    law, Law, S => S, |v, f| f(v)
);
kind!(
    /// Two constants.
    pair, Pair, S => [S; 2], |v, f| [f(&v[0]), f(&v[1])]
);
kind!(
    /// Two quantities that may depend on time and state.
    law_pair, LawPair, S => [S; 2], |v, f| [f(&v[0]), f(&v[1])]
);
kind!(
    /// Any number of quantities that may depend on time and state.
    laws, Laws, S => Vec<S>, |v, f| v.iter().map(f).collect()
);
kind!(
    /// true or false.
    flag, Flag, S => bool, |v, _f| *v
);

/// A field of kind `K` that may be left out.
#[derive(Clone, Copy, Debug)]
pub struct Optional<K>(std::marker::PhantomData<K>);

impl<K: Kind> Kind for Optional<K> {
    type Over<S> = Option<K::Over<S>>;
    const SHAPE: Shape = K::SHAPE;
    const DEFAULT: Option<Default> = Some(Default::Absent);
    fn read(source: &mut dyn Source, field: &Field) -> Option<Self::Over<Tape>> {
        match source.given(field) {
            true => K::read(source, field).map(Some),
            false => Some(None),
        }
    }
    fn map<S, T>(value: &Self::Over<S>, f: &mut dyn FnMut(&S) -> T) -> Self::Over<T> {
        value.as_ref().map(|value| K::map(value, f))
    }
}

macro_rules! optional {
    ($($(#[$doc:meta])* $kind:ident: $of:ident),+ $(,)?) => {
        $(
            $(#[$doc])*
            #[allow(non_camel_case_types)] // a type in `element!`, written like a word
            pub type $kind = Optional<$of>;
        )+
    };
}

optional! {
    /// A constant that may be left out.
    optional_number: number,
    /// Two constants that may be left out.
    optional_pair: pair,
    /// A quantity that may be left out.
    optional_law: law,
}

/// Declares a kind of field that holds one of some words, and the enum of its values.
macro_rules! words {
    ($(#[$doc:meta])* $kind:ident: $Words:ident { $($(#[$about:meta])* $Word:ident = $word:literal),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $Words {
            $($(#[$about])* $Word,)+
        }
        $(#[$doc])*
        #[allow(non_camel_case_types)] // a type in `element!`, written like a word
        #[derive(Clone, Copy, Debug)]
        pub enum $kind {}
        impl $kind {
            const WORDS: &'static [&'static str] = &[$($word),+];
            const VALUES: &'static [$Words] = &[$($Words::$Word),+];
        }
        impl Kind for $kind {
            type Over<S> = $Words;
            const SHAPE: Shape = Shape::Word(Self::WORDS);
            fn read(source: &mut dyn Source, field: &Field) -> Option<$Words> {
                source.word(field, Self::WORDS).map(|k| Self::VALUES[k])
            }
            fn map<S, T>(value: &$Words, _: &mut dyn FnMut(&S) -> T) -> $Words {
                *value
            }
        }
    };
}

words! {
    /// A side of a curve, seen along it.
    side: Side {
        /// To the right.
        Right = "right",
        /// To the left.
        Left = "left",
    }
}
