//! Mass, mass centre and moment of inertia of a body composed of homogeneous pieces.
//!
//! m = Σ m_k, c = Σ m_k c_k / m, J = Σ m_k (k_k² + |c_k - c|²), where k_k is the radius of gyration of a piece about
//! its own centre c_k (Huygens–Steiner theorem). A hole has a negative mass. The values of a polygon follow from
//! Green's theorem as sums over its sides, and do not depend on the orientation of its corners. Coordinates are
//! relative to the first corner, so that no digits cancel for a polygon far from the origin.

use crate::expression::Tape;
use crate::math::{Listed, Local, Real, Rotation};

/// The form of a piece, in its own frame, m.
#[derive(Clone, Debug)]
pub enum Form<S = f64> {
    /// A thin straight rod along x.
    Rod {
        /// Length from end to end, m.
        length: S,
    },
    /// A rectangle.
    Plate {
        /// Length along x, m.
        width: S,
        /// Length along y, m.
        height: S,
    },
    /// A disc.
    Disc {
        /// Radius, m.
        radius: S,
    },
    /// A disc with a round hole.
    Ring {
        /// Radius of the hole, m.
        inner: S,
        /// Outer radius, m.
        outer: S,
    },
    /// A polygon.
    Polygon {
        /// Corners in order, m.
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
        /// Mass per volume, kg/m³.
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
    /// Mass of the piece.
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
                Form::Polygon { points: points.list() }
            }
        }
    }
}

impl<S> BodyShape<S> {
    /// Converts the piece to another scalar.
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
    /// Whether the centre is the origin of the body for all parameter values.
    pub(super) fn is_centred(&self) -> bool {
        let zero = |tape: &Tape| tape.constant() == Some(0.0);
        !matches!(self.form, Form::Polygon { .. }) && zero(&self.at.x) && zero(&self.at.y)
    }
}

impl<S: Real> Form<S> {
    /// Length of a rod, m, or area of another form, m²; its centre; the square of its radius of gyration about the
    /// centre, m².
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

/// Area, centre, and square of the radius of gyration of a polygon.
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

    /// Mass of the piece, its centre in the frame of the body, and its moment of inertia about this centre.
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
        let pieces: Vec<Weighed<S>> = shapes.iter().map(Self::weighed).list();
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
