//! Bodies of a model that is written in Rust.

use crate::elements::{Number, Pair, Value};
use crate::math::Listed;
use crate::model::Entry;
use std::marker::PhantomData;

/// The ground, which has points but no mass.
#[derive(Clone, Copy, Debug)]
pub enum Ground {}
/// A uniform slender bar.
#[derive(Clone, Copy, Debug)]
pub enum Bar {}
/// A point with mass.
#[derive(Clone, Copy, Debug)]
pub enum PointMass {}
/// A link that bends.
#[derive(Clone, Copy, Debug)]
pub enum Beam {}
/// A rigid body of any form.
#[derive(Clone, Copy, Debug)]
pub enum General {}

/// A body of a [`ModelBuilder`](super::ModelBuilder); each type of body has the methods of its fields.
#[derive(Debug)]
pub struct BodyBuilder<'m, Type> {
    entry: &'m mut Entry,
    kind: PhantomData<Type>,
}

impl<'m, Type> BodyBuilder<'m, Type> {
    pub(super) fn new(entry: &'m mut Entry) -> Self {
        Self { entry, kind: PhantomData }
    }

    fn with(self, field: &str, value: impl Into<Value>) -> Self {
        let fields = &mut self.entry.fields;
        fields.retain(|(name, _)| name != field);
        fields.push((field.to_string(), value.into()));
        self
    }

    /// Adds to a table of points or curves.
    fn place(self, field: &str, name: &str, value: impl Into<Value>) -> Self {
        let point = (name.to_string(), value.into());
        let table = self.entry.fields.iter_mut().find(|(key, _)| key == field);
        match table {
            Some((_, Value::Table(points))) => points.push(point),
            _ => self.entry.fields.push((field.to_string(), Value::Table(vec![point]))),
        }
        self
    }
}

/// Methods of all bodies that have named points.
macro_rules! extended {
    ($($Type:ident),+) => {
        $(impl BodyBuilder<'_, $Type> {
            /// A named point in the frame of the body, m.
            pub fn point(self, name: &str, x: impl Into<Number>, y: impl Into<Number>) -> Self {
                self.place("points", name, Pair::from((x, y)))
            }

            /// A named curve in the frame of the body, by the keys of its form: `[("circle", …)]`.
            pub fn curve<'k>(
                self,
                name: &str,
                form: impl IntoIterator<Item = (&'k str, Value)>,
            ) -> Self {
                let fields = form.into_iter().map(|(key, value)| (key.to_string(), value));
                self.place("curves", name, Value::Table(fields.list()))
            }
        })+
    };
}
extended!(Ground, Bar, General);

/// Methods of all bodies.
macro_rules! drawn {
    ($($Type:ident),+) => {
        $(impl BodyBuilder<'_, $Type> {
            /// The outline in drawings: a list of points, or a table with the key `circle` or `path`.
            pub fn outline(self, outline: impl Into<Value>) -> Self {
                self.with("outline", outline)
            }
        })+
    };
}
drawn!(Ground, Bar, PointMass, General);

/// Methods of all bodies that have mass.
macro_rules! heavy {
    ($($Type:ident),+) => {
        $(impl BodyBuilder<'_, $Type> {
            /// Mass, kg.
            pub fn mass(self, mass: impl Into<Number>) -> Self {
                self.with("mass", mass.into())
            }
        })+
    };
}
heavy!(Bar, PointMass, General);

/// Methods of all bodies that can rotate.
macro_rules! moving {
    ($($Type:ident),+) => {
        $(impl BodyBuilder<'_, $Type> {
            /// The global position of a named point of the body when assembly starts, m. Two such points determine
            /// the position of the body. A bar with two such points needs no length and no ends.
            pub fn through(self, name: &str, x: impl Into<Number>, y: impl Into<Number>) -> Self {
                self.place("through", name, Pair::from((x, y)))
            }
        })+
    };
}
moving!(Bar, General);

impl BodyBuilder<'_, Bar> {
    /// Length, m.
    pub fn length(self, length: impl Into<Number>) -> Self {
        self.with("length", length.into())
    }

    /// Names of the points at (-length/2, 0) and (length/2, 0).
    pub fn ends(self, first: &str, last: &str) -> Self {
        self.with("ends", Value::List(vec![first.into(), last.into()]))
    }
}

/// Declares the methods of a beam for fields with one value.
macro_rules! of_beam {
    ($($(#[$doc:meta])* $field:ident: $Type:ty),+ $(,)?) => {
        impl BodyBuilder<'_, Beam> {
            $($(#[$doc])*
            pub fn $field(self, value: impl Into<$Type>) -> Self {
                self.with(stringify!($field), value.into())
            })+
        }
    };
}

of_beam! {
    /// Length of a straight beam, m.
    length: Number,
    /// Global positions of points of the centre line when assembly starts, a list of pairs, m.
    through: Value,
    /// Centre x and y, radius, first and last angle of a circular centre line, a list of five numbers.
    arc: Value,
    /// Cross section: a table with one of the keys `rectangle`, `circle` and `tube`.
    section: Value,
    /// Young's modulus of a section, Pa.
    young: Number,
    /// Poisson's ratio of a section.
    poisson: Number,
    /// Density of a section, kg/m³.
    density: Number,
    /// Mass per length, kg/m.
    mass_per_length: Number,
    /// Moment of inertia of the sections per length, kg·m.
    inertia_per_length: Number,
    /// Damping in proportion to stiffness, s.
    damping: Number,
    /// Number of elements.
    elements: Number,
    /// Whether sections may shear.
    shear: bool,
    /// Whether the centre line keeps its length.
    inextensible: bool,
}

impl BodyBuilder<'_, Beam> {
    /// Names of the first and the last end.
    pub fn ends(self, first: &str, last: &str) -> Self {
        self.with("ends", Value::List(vec![first.into(), last.into()]))
    }

    /// Axial stiffness (N), bending stiffness (N·m²) and effective shear stiffness (N), in place of a section.
    pub fn stiffness(
        self,
        axial: impl Into<Number>,
        bending: impl Into<Number>,
        shear: impl Into<Number>,
    ) -> Self {
        let of_two = self.with("EA", axial.into()).with("EI", bending.into());
        of_two.with("GA", shear.into())
    }

    /// A named point by its arc length from the first end, m, or a share such as "50 %".
    pub fn point(self, name: &str, s: impl Into<Number>) -> Self {
        self.place("points", name, s.into())
    }
}

impl BodyBuilder<'_, PointMass> {
    /// Position in the global frame when assembly starts, m.
    pub fn at(self, x: impl Into<Number>, y: impl Into<Number>) -> Self {
        self.with("at", Pair::from((x, y)))
    }
}

impl BodyBuilder<'_, General> {
    /// Adds a shape to a body without `mass`, `inertia` and `center`: its type and its fields by key, `[("radius",
    /// 0.1.into()), ("mass", 2.0.into())]`.
    pub fn shape<'k>(self, kind: &str, fields: impl IntoIterator<Item = (&'k str, Value)>) -> Self {
        let fields = fields.into_iter().map(|(key, value)| (key.to_string(), value));
        let shape = std::iter::once(("type".to_string(), kind.into())).chain(fields);
        let shape = Value::Table(shape.list());
        match self.entry.fields.iter_mut().find(|(key, _)| key == "shapes") {
            Some((_, Value::List(shapes))) => shapes.push(shape),
            _ => self.entry.fields.push(("shapes".to_string(), Value::List(vec![shape]))),
        }
        self
    }

    /// Moment of inertia about the mass centre, kg·m²; 0 for a point mass.
    pub fn inertia(self, inertia: impl Into<Number>) -> Self {
        self.with("inertia", inertia.into())
    }

    /// Mass centre in the frame of the body, m; its origin if it is not given.
    pub fn center(self, x: impl Into<Number>, y: impl Into<Number>) -> Self {
        self.with("center", Pair::from((x, y)))
    }
}
