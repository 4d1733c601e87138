//! Kinds of fields: the values that an element may contain, and how each value is read and converted between scalars.

use super::field::{Default, Field, Shape, UNITS_OF_EQUATIONS};
use super::followed::{Acted, BodyId, Followed, JointId, QuantityOf};
use super::plain_bearing::Bearing;
use super::plane_curve::Curve;
use super::quantity_kind::QuantityKind;
use crate::expression::Tape;
use crate::math::{Listed, Local, Real};

/// A point fixed in a body.
#[derive(Clone, Debug, PartialEq)]
pub struct PointOn<S = f64> {
    /// The body.
    pub body: BodyId,
    /// s′, from the origin of the body frame, m.
    pub s: Local<S>,
}

/// The curve of a joint, and the body that carries it.
#[derive(Clone, Debug)]
pub struct CurveOn<S = f64> {
    /// The body.
    pub body: BodyId,
    /// The curve in the frame of the body.
    pub curve: Curve<S>,
}

impl<S: Real> CurveOn<S> {
    /// [`Curve::near`] on the same body.
    pub fn near(&self, u: S) -> Self {
        Self { body: self.body, curve: self.curve.near(u) }
    }
}

/// The source from which fields are read. It keeps the reports of their faults.
pub trait Source {
    /// Whether the source contains a value of the field.
    fn given(&mut self, field: &Field) -> bool;
    /// A body by name.
    fn body(&mut self, field: &Field) -> Option<BodyId>;
    /// A named point of a body.
    fn point(&mut self, field: &Field) -> Option<PointOn<Tape>>;
    /// A named curve of a body.
    fn curve(&mut self, field: &Field) -> Option<CurveOn<Tape>>;
    /// The curve of body i that touches the curve of a contact in place of a point, and its side.
    fn mate(&mut self) -> Option<(CurveOn<Tape>, Side)> {
        None
    }
    /// A position quantity.
    fn coordinate(&mut self, field: &Field) -> Option<Followed<Tape>>;
    /// A position quantity with its gradient.
    fn acted(&mut self, field: &Field) -> Option<Acted<Tape>>;
    /// A joint by name.
    fn joint(&mut self, field: &Field) -> Option<JointId>;
    /// A joint whose bodies slide or rotate, by name.
    fn bearing(&mut self, field: &Field) -> Option<Bearing<Tape>>;
    /// A formula in the parameters.
    fn number(&mut self, field: &Field) -> Option<Tape>;
    /// A formula in the parameters, time and state.
    fn law(&mut self, field: &Field) -> Option<Tape>;
    /// Two formulas in the parameters.
    fn pair(&mut self, field: &Field) -> Option<[Tape; 2]>;
    /// Three formulas in the parameters, each with its own unit.
    fn triple(&mut self, field: &Field) -> Option<[Tape; 3]>;
    /// Two formulas in the parameters, time and state.
    fn law_pair(&mut self, field: &Field) -> Option<[Tape; 2]>;
    /// Formulas in the parameters, time and state.
    fn laws(&mut self, field: &Field) -> Option<Vec<Tape>>;
    /// At least one position quantity, each with a factor in the parameters.
    fn terms(&mut self, field: &Field) -> Option<Vec<(Followed<Tape>, Tape)>>;
    /// The kinds of equations, given by their units.
    fn units(&mut self, field: &Field) -> Option<Vec<QuantityKind>>;
    /// A condition, as it is written.
    fn condition(&mut self, field: &Field) -> Option<String>;
    /// true or false.
    fn flag(&mut self, field: &Field) -> Option<bool>;
    /// The index of a word among the words that the field accepts.
    fn word(&mut self, field: &Field, words: &[&str]) -> Option<usize>;
}

/// A kind of field.
pub trait Kind {
    /// The value in the element over the scalar `S`.
    type Over<S>;
    /// The values that the file may contain.
    const SHAPE: Shape;
    /// The default of a field that declares no default; None if such a field is required.
    const DEFAULT: Option<Default> = None;
    /// Reads one field.
    fn read(source: &mut dyn Source, field: &Field) -> Option<Self::Over<Tape>>;
    /// Converts a value to another scalar.
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
    /// A curve of a body.
    curve, Curve, S => CurveOn<S>, |v, f| CurveOn { body: v.body, curve: v.curve.map(f) }
);
kind!(
    /// A position quantity.
    coordinate, Coordinate, S => Followed<S>, |v, f| match v {
        Followed::Coordinate(of) => Followed::Coordinate(*of),
        Followed::Quantity(of) => Followed::Quantity(Box::new(QuantityOf {
            name: of.name.clone(),
            word: of.word,
            kind: of.kind,
            bodies: of.bodies,
            ends: [of.ends[0].map(f), of.ends[1].map(f)],
            value: f(&of.value),
        })),
    }
);
kind!(
    /// A position quantity on which an effort acts.
    acted, Coordinate, S => Acted<S>, |v, f| Acted {
        of: coordinate::map(&v.of, f),
        gradient: {
            let [i, j] = &v.gradient;
            [[f(&i[0]), f(&i[1]), f(&i[2])], [f(&j[0]), f(&j[1]), f(&j[2])]]
        },
    }
);
kind!(
    /// A joint.
    joint, Joint, S => JointId, |v, _f| *v
);
kind!(
    /// A joint whose bodies slide or rotate.
    bearing, Joint, S => Bearing<S>, |v, f| v.map(f)
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
    /// Three constants, each with its own unit.
    triple, Triple, S => [S; 3], |v, f| [f(&v[0]), f(&v[1]), f(&v[2])]
);
kind!(
    /// Two quantities that may depend on time and state.
    law_pair, LawPair, S => [S; 2], |v, f| [f(&v[0]), f(&v[1])]
);
kind!(
    /// Any number of quantities that may depend on time and state.
    laws, Laws, S => Vec<S>, |v, f| v.iter().map(f).list()
);
kind!(
    /// Position quantities with factors.
    terms, Terms, S => Vec<(Followed<S>, S)>, |v, f| {
        v.iter().map(|(of, factor)| (coordinate::map(of, f), f(factor))).list()
    }
);
kind!(
    /// The kinds of equations, given by their units `m` or `rad`.
    units, Units, S => Vec<QuantityKind>, |v, _f| v.clone()
);
kind!(
    /// A condition on quantities.
    condition, Condition, S => String, |v, _f| v.clone()
);
kind!(
    /// true or false.
    flag, Flag, S => bool, |v, _f| *v
);

/// A point of a body that another form of the element replaces, so that the field may be absent.
#[allow(non_camel_case_types)] // a type in `element!`, written like a word
#[derive(Clone, Copy, Debug)]
pub enum point_or_curves {}

impl Kind for point_or_curves {
    type Over<S> = PointOn<S>;
    const SHAPE: Shape = Shape::Point;
    const DEFAULT: Option<Default> = Some(Default::Absent);
    fn read(source: &mut dyn Source, field: &Field) -> Option<PointOn<Tape>> {
        source.point(field)
    }
    fn map<S, T>(value: &PointOn<S>, f: &mut dyn FnMut(&S) -> T) -> PointOn<T> {
        point::map(value, f)
    }
}

/// Two texts that determine other fields of the element, and are read with them.
#[allow(non_camel_case_types)] // a type in `element!`, written like a word
#[derive(Clone, Copy, Debug)]
pub enum two_texts {}

impl Kind for two_texts {
    type Over<S> = ();
    const SHAPE: Shape = Shape::TwoTexts;
    const DEFAULT: Option<Default> = Some(Default::Absent);
    fn read(_: &mut dyn Source, _: &Field) -> Option<()> {
        Some(())
    }
    fn map<S, T>(_: &(), _: &mut dyn FnMut(&S) -> T) {}
}

/// A field of kind `K` that may be omitted.
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
    /// The unit of an equation that may be left out.
    optional_unit: equation_unit,
    /// A sense of force that may be left out.
    optional_only: only,
    /// A condition that may be left out.
    optional_condition: condition,
}

/// Declares a kind of field that accepts one of several words, and the enum of its values.
macro_rules! words {
    ($(#[$doc:meta])* $kind:ident: $Words:ident { $($(#[$about:meta])* $Word:ident = $word:literal),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $Words {
            $($(#[$about])* $Word,)+
        }
        impl $Words {
            /// The value with this word in a file.
            pub fn named(word: &str) -> Option<Self> {
                $kind::WORDS.iter().position(|own| *own == word).map(|k| $kind::VALUES[k])
            }
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
    /// A side of a curve, seen in the direction of the curve.
    side: Side {
        /// To the right.
        Right = "right",
        /// To the left.
        Left = "left",
    }
}

words! {
    /// The law of the normal force of a compliant contact.
    normal_law: NormalLaw {
        /// Hunt and Crossley.
        HuntCrossley = "hunt_crossley",
        /// Hertz, for cylinders.
        Hertz = "hertz",
        /// Lankarani and Nikravesh.
        LankaraniNikravesh = "lankarani_nikravesh",
        /// Flores and others.
        Flores = "flores",
    }
}

/// The kind of an equation, given by its unit.
#[allow(non_camel_case_types)] // a type in `element!`, written like a word
#[derive(Clone, Copy, Debug)]
pub enum equation_unit {}

impl Kind for equation_unit {
    type Over<S> = QuantityKind;
    const SHAPE: Shape = Shape::Word(UNITS_OF_EQUATIONS);
    fn read(source: &mut dyn Source, field: &Field) -> Option<QuantityKind> {
        source.word(field, UNITS_OF_EQUATIONS).map(|k| QuantityKind::OF_EQUATIONS[k])
    }
    fn map<S, T>(value: &QuantityKind, _: &mut dyn FnMut(&S) -> T) -> QuantityKind {
        *value
    }
}

words! {
    /// The frame of the components of a vector.
    frame: Frame {
        /// The frame of ground.
        Global = "global",
        /// The frame of body i.
        I = "i",
        /// The frame of body j.
        J = "j",
    }
}

words! {
    /// The only sense in which a force may act along a line.
    only: Only {
        /// The force pulls.
        Tension = "tension",
        /// The force pushes.
        Compression = "compression",
    }
}
