//! Mass, mass centre and moment of inertia of a body that consists of homogeneous pieces.
//!
//! m = Σ m_k, c = Σ m_k c_k / m, J = Σ m_k (k_k² + |c_k - c|²), where k_k is the radius of gyration of a piece about its
//! own centre c_k (theorem of Huygens and Steiner). A hole has a negative mass. Those of a polygon are Green's sums over its
//! sides; they do not depend on the sense of its corners. Coordinates are taken from its first corner, so that
//! nothing cancels for a polygon far from the origin.

use crate::expression::Tape;
use crate::math::{Local, Real, Rotation};

/// The form of a piece, in its own frame, m.
#[derive(Clone, Debug)]
pub enum Form<S = f64> {
    /// A thin straight rod along x.
    Rod {
        /// From end to end.
        length: S,
    },
    /// A rectangle.
    Plate {
        /// Along x.
        width: S,
        /// Along y.
        height: S,
    },
    /// A disc.
    Disc {
        /// Its radius.
        radius: S,
    },
    /// A disc with a round hole.
    Ring {
        /// Radius of the hole.
        inner: S,
        /// Radius of the outside.
        outer: S,
    },
    /// A polygon.
    Polygon {
        /// Its corners in order.
        points: Vec<Local<S>>,
    },
}

/// The mass of a piece.
#[derive(Clone, Debug)]
pub enum Matter<S = f64> {
    /// Its mass, kg.
    Mass(S),
    /// Its density, kg/m³, and its thickness, m, or its cross-section, m².
    Density {
        /// Mass by volume, kg/m³.
        density: S,
        /// Thickness of an area, m; cross-section of a rod, m².
        section: S,
    },
}

/// A homogeneous piece of a body.
#[derive(Clone, Debug)]
pub struct BodyShape<S = f64> {
    /// Its form.
    pub form: Form<S>,
    /// Origin of its frame in the frame of the body, m.
    pub at: Local<S>,
    /// Angle of its frame in the frame of the body, rad.
    pub angle: S,
    /// Its mass.
    pub matter: Matter<S>,
}

/// Mass, mass centre, and moment of inertia about it.
#[derive(Clone, Copy, Debug)]
pub struct Weighed<S = f64> {
    /// Mass, kg.
    pub mass: S,
    /// Mass centre in the frame of the body, m.
    pub center: Local<S>,
    /// Moment of inertia about the mass centre, kg·m².
    pub inertia: S,
}

impl<S> Form<S> {
    /// The `type` in the file.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Rod { .. } => "rod",
            Self::Plate { .. } => "plate",
            Self::Disc { .. } => "disc",
            Self::Ring { .. } => "ring",
            Self::Polygon { .. } => "polygon",
        }
    }

    fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Form<T> {
        match self {
            Self::Rod { length } => Form::Rod { length: f(length) },
            Self::Plate { width, height } => Form::Plate { width: f(width), height: f(height) },
            Self::Disc { radius } => Form::Disc { radius: f(radius) },
            Self::Ring { inner, outer } => Form::Ring { inner: f(inner), outer: f(outer) },
            Self::Polygon { points } => {
                let points = points.iter().map(|p| Local { x: f(&p.x), y: f(&p.y) });
                Form::Polygon { points: points.collect() }
            }
        }
    }
}

impl<S> BodyShape<S> {
    /// The same piece over another scalar.
    pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> BodyShape<T> {
        BodyShape {
            form: self.form.map(f),
            at: Local { x: f(&self.at.x), y: f(&self.at.y) },
            angle: f(&self.angle),
            matter: match &self.matter {
                Matter::Mass(mass) => Matter::Mass(f(mass)),
                Matter::Density { density, section } => {
                    Matter::Density { density: f(density), section: f(section) }
                }
            },
        }
    }
}

impl BodyShape<Tape> {
    /// Whether its centre is the origin of the body whatever the parameters are.
    pub(super) fn is_centred(&self) -> bool {
        let zero = |tape: &Tape| tape.constant() == Some(0.0);
        !matches!(self.form, Form::Polygon { .. }) && zero(&self.at.x) && zero(&self.at.y)
    }
}

impl<S: Real> Form<S> {
    /// Length of a rod, m, or area of another form, m²; its centre; its radius of gyration about it, squared, m².
    fn measures(&self) -> (S, Local<S>, S) {
        let (number, none) = (S::constant, Local::new(S::zero(), S::zero()));
        let pi = number(std::f64::consts::PI);
        match self {
            Self::Rod { length } => (*length, none, *length * *length / number(12.0)),
            Self::Plate { width: w, height: h } => {
                (*w * *h, none, (*w * *w + *h * *h) / number(12.0))
            }
            Self::Disc { radius: r } => (pi * *r * *r, none, *r * *r / number(2.0)),
            Self::Ring { inner: a, outer: b } => {
                (pi * (*b - *a) * (*b + *a), none, (*a * *a + *b * *b) / number(2.0))
            }
            Self::Polygon { points } => polygon(points),
        }
    }
}

/// Area, centre, and radius of gyration squared of a polygon.
fn polygon<S: Real>(points: &[Local<S>]) -> (S, Local<S>, S) {
    let number = S::constant;
    let Some(first) = points.first() else {
        let nan = number(f64::NAN);
        return (nan, Local::new(nan, nan), nan);
    };
    let (mut twice, mut moment) = (S::zero(), Local::new(S::zero(), S::zero()));
    let mut second = S::zero();
    for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
        let (a, b) = (*a - *first, *b - *first);
        let cross = a.x * b.y - b.x * a.y;
        twice += cross;
        moment.x += cross * (a.x + b.x);
        moment.y += cross * (a.y + b.y);
        second += cross * (a.dot(a) + a.dot(b) + b.dot(b));
    }
    let away = Local::new(moment.x / twice / number(3.0), moment.y / twice / number(3.0));
    let gyration = second / twice / number(6.0) - away.dot(away);
    (twice.abs() / number(2.0), *first + away, gyration)
}

impl<S: Real> BodyShape<S> {
    /// A point of the piece in the frame of the body.
    pub fn place(&self, s: Local<S>) -> Local<S> {
        let turned = Rotation::new(self.angle) * s;
        Local::new(self.at.x + turned.x, self.at.y + turned.y)
    }

    /// Its mass, its centre in the frame of the body, and its moment of inertia about this centre.
    pub fn weighed(&self) -> Weighed<S> {
        let (extent, center, gyration) = self.form.measures();
        let mass = match self.matter {
            Matter::Mass(mass) => mass,
            Matter::Density { density, section } => density * section * extent,
        };
        Weighed { mass, center: self.place(center), inertia: mass * gyration }
    }

    /// Mass, centre and inertia of all pieces together.
    pub fn together(shapes: &[Self]) -> Weighed<S> {
        let zero = S::zero();
        let pieces: Vec<Weighed<S>> = shapes.iter().map(Self::weighed).collect();
        let (mut mass, mut moment) = (zero, Local::new(zero, zero));
        for piece in &pieces {
            mass += piece.mass;
            moment.x += piece.mass * piece.center.x;
            moment.y += piece.mass * piece.center.y;
        }
        let center = Local::new(moment.x / mass, moment.y / mass);
        let mut inertia = zero;
        for piece in &pieces {
            let away = piece.center - center;
            inertia += piece.inertia + piece.mass * away.dot(away);
        }
        Weighed { mass, center, inertia }
    }
}
