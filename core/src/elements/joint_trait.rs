//! The physics of a joint or driver.

use super::attachment::Attachment;
use super::declare::Element;
use super::derive;
use super::followed::{BodyId, CoordinateOf, Followed};
use super::kinds::CurveOn;
use super::loose::{Backlash, Slips, Strands};
use super::measured::Measured;
use super::quantity_kind::QuantityKind;
use super::symbols::SceneSymbol;
use crate::math::{Local, Motion, Pose, Real, Wrench};

/// A scalar constraint equation of a joint: its name in labels and its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Equation {
    /// Name within the joint, such as `x`.
    pub name: &'static str,
    /// Kind of the residual.
    pub kind: QuantityKind,
}

impl Equation {
    /// An equation whose residual is a length.
    pub const fn length(name: &'static str) -> Self {
        Self { name, kind: QuantityKind::Length }
    }
    /// An equation whose residual is an angle.
    pub const fn angle(name: &'static str) -> Self {
        Self { name, kind: QuantityKind::Angle }
    }
}

/// Positions of the participants of a joint, and the time.
#[derive(Clone, Copy, Debug)]
pub struct At<'a, S> {
    /// Pose of each body, in the order of [`Joint::bodies`].
    pub bodies: &'a [Pose<S>],
    /// Internal coordinates of the joint, such as the parameter of a curve.
    pub own: &'a [S],
    /// Time, s.
    pub t: S,
}

impl<S> At<'_, S> {
    /// Pose of body i, the first body.
    #[inline(always)]
    pub fn i(&self) -> &Pose<S> {
        &self.bodies[0]
    }
    /// Pose of body j, the second body.
    #[inline(always)]
    pub fn j(&self) -> &Pose<S> {
        &self.bodies[1]
    }
}

/// Positions and velocities of the participants of a joint, and the time.
#[derive(Clone, Copy, Debug)]
pub struct Moving<'a, S> {
    /// Motion of each body, in the order of [`Joint::bodies`].
    pub bodies: &'a [Motion<S>],
    /// Internal coordinates of the joint.
    pub own: &'a [S],
    /// Rates of the internal coordinates.
    pub own_rates: &'a [S],
    /// Time, s.
    pub t: S,
}

/// Φ, Φ̇, γ and Φ_q of one joint: one entry for each of its `m` equations.
#[derive(Debug)]
pub struct Linearized<'a, S> {
    /// Φ(q, t).
    pub residual: &'a mut [S],
    /// Φ_q q̇ + Φ_t.
    pub rate: &'a mut [S],
    /// γ = -d²Φ/dt² at q̈ = 0 (Haug 3.6.11).
    pub gamma: &'a mut [S],
    /// Row r of participant p at `p m + r`: ∂Φ_r/∂(x, y, φ) of a body; the internal coordinates are
    /// the last participant, padded with zeros to three.
    pub columns: &'a mut [[S; 3]],
}

impl<S: Real> Linearized<'_, S> {
    /// Sets Φ, Φ̇ and γ of `M` equations, and their columns.
    #[allow(clippy::manual_memcpy)] // a copy of slices is not inlined without optimisation across crates
    #[inline(always)]
    pub fn put<const M: usize, const COLUMNS: usize>(
        self,
        [residual, rate, gamma]: [[S; M]; 3],
        columns: [[S; 3]; COLUMNS],
    ) {
        for r in 0..M {
            (self.residual[r], self.rate[r], self.gamma[r]) = (residual[r], rate[r], gamma[r]);
        }
        for k in 0..COLUMNS {
            self.columns[k] = columns[k];
        }
    }
}

/// The geometry that a joint fixes between its bodies i and j. Assembly uses it to place bodies.
#[derive(Clone, Debug, PartialEq)]
pub enum Fixes<S> {
    /// The origins of both joint frames coincide.
    Points,
    /// The origin of the joint frame on body j lies on the x″ axis of the joint frame on body i.
    Line,
    /// The origin of the joint frame on body j lies at this distance to the left of the x″ axis of the joint frame on
    /// body i, m.
    Beside(S),
    /// The angle of body j, if the pose of body i and the position of body j are known. The last equation is linear
    /// in this angle, possibly modulo a constant.
    Turn,
    /// The distance of the two bodies, which touch at the nearest value of the internal coordinate. There are two
    /// equations, and their derivative with respect to this coordinate is directed along the contact.
    Contact,
    /// The x″ axes of both joint frames have the same direction.
    Direction,
    /// The distance of the origins of both joint frames, m.
    Distance(S),
    /// A coordinate of body j, measured from ground.
    Coordinate(CoordinateOf, S),
}

/// A quantity that the other joints of the mechanism must hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Required<S> {
    /// Its description, as in "the distance of the centres is 0.31 m".
    pub what: &'static str,
    /// Its value, m.
    pub is: S,
    /// The value that it must have; None if any constant value other than zero is allowed.
    pub must: Option<S>,
    /// The remedy if the quantity has another value or is not held.
    pub remedy: &'static str,
}

/// A result of a joint in addition to its reaction, such as the normal force of a roller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ResultQuantity {
    /// Name within the joint: `sol["cam.normal"]`.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// The name of the event in a run at which it becomes negative.
    pub negative: Option<&'static str>,
}

/// A joint or driver: equations Φ(q, t) = 0 between any number of bodies and internal coordinates.
pub trait Joint: Element {
    /// Whether there are two equations whose columns of translation are constant: -I for body i, +I for body j, as in
    /// Φ = point_j - point_i (Haug 3.3.12).
    const CONSTANT_COLUMNS: bool = false;

    /// Whether it may have two equations between two bodies, without internal coordinates. Only such joints are
    /// condensed with a body that they connect to ground.
    const CONDENSES: bool = Self::CONSTANT_COLUMNS;

    /// Number of internal coordinates, 0 to 3.
    const OWN: usize = 0;

    /// Fields that turn the joint into a force, such as the play of its teeth, unless they are 0.
    const LOOSE: &'static [&'static str] = &[];

    /// Whether its bodies slide or rotate along the first quantity of [`Joint::MEASURED`], so that there may be
    /// friction.
    const RUBS: bool = false;

    /// Whether files contain elements of the type. Others are made by the reader of bodies.
    const IN_FILES: bool = true;

    /// Results in addition to the reaction, in the order of [`Joint::results`].
    const RESULTS: &'static [ResultQuantity] = &[];

    /// The position quantities that can be measured on the joint.
    const MEASURED: &'static [Measured] = &[];

    /// The bodies whose poses enter Φ: i and j first.
    fn bodies<S>(e: &Self::Over<S>) -> Vec<BodyId>;

    /// The position quantity that a driver moves.
    #[inline]
    fn drives<S>(e: &Self::Over<S>) -> Option<&Followed<S>> {
        let _ = e;
        None
    }

    /// The law of a driver.
    #[inline]
    fn value<S>(e: &Self::Over<S>) -> Option<&S> {
        let _ = e;
        None
    }

    /// The largest effort of a driver.
    #[inline]
    fn limit<S>(e: &Self::Over<S>) -> Option<&S> {
        let _ = e;
        None
    }

    /// Lets a driver have any effort.
    #[inline]
    fn lift_limit<S>(e: &mut Self::Over<S>) {
        let _ = e;
    }

    /// The condition at which a driver is released.
    #[inline]
    fn release<S>(e: &Self::Over<S>) -> Option<&str> {
        let _ = e;
        None
    }

    /// Names and kinds of the equations.
    fn equations<S>(e: &Self::Over<S>) -> Vec<Equation>;

    /// Φ, one entry for each equation.
    fn residual<S: Real>(e: &Self::Over<S>, at: &At<'_, S>, phi: &mut [S]);

    /// The joint frame on a body, given by its index in [`Joint::bodies`].
    fn attachment<S: Real>(e: &Self::Over<S>, body: usize) -> Attachment<S>;

    /// The point at which the reaction acts, in the frame of body j. None if it acts at the origins of the joint
    /// frames.
    #[inline]
    fn contact<S: Real>(e: &Self::Over<S>, at: &At<'_, S>) -> Option<Local<S>> {
        let _ = (e, at);
        None
    }

    /// The [`RESULTS`](Joint::RESULTS) for the multipliers `lam` of the rows of the joint.
    #[inline]
    fn results<S: Real>(e: &Self::Over<S>, at: &At<'_, S>, lam: &[S], out: &mut [S]) {
        let _ = (e, at, lam, out);
    }

    /// Whether the joint has a [`load`](Joint::load).
    #[inline]
    fn has_load<S: Real>(e: &Self::Over<S>) -> bool {
        let _ = e;
        false
    }

    /// Wrenches that the multipliers `lam` of the joint cause in addition to -Φ_qᵀ λ, such as the radial force of
    /// gear teeth. They are proportional to the magnitude of the first multiplier. Each is passed to `out` with the
    /// index of its body in [`Joint::bodies`], about the origin of the
    /// frame of this body. The wrenches do no work in any motion that the other joints permit, so that they change
    /// only the reactions of these joints.
    #[inline]
    fn load<S: Real>(
        e: &Self::Over<S>,
        at: &At<'_, S>,
        lam: &[S],
        out: &mut dyn FnMut(usize, Wrench<S>),
    ) {
        let _ = (e, at, lam, out);
    }

    /// The curve along which the first internal coordinate is measured.
    #[inline]
    fn curve<S>(e: &Self::Over<S>) -> Option<&CurveOn<S>> {
        let _ = e;
        None
    }

    /// The mutable curve along which the first internal coordinate is measured.
    #[inline]
    fn curve_mut<S>(e: &mut Self::Over<S>) -> Option<&mut CurveOn<S>> {
        let _ = e;
        None
    }

    /// The geometry that the joint fixes, for assembly.
    #[inline]
    fn fixes<S: Clone>(e: &Self::Over<S>) -> Vec<Fixes<S>> {
        let _ = e;
        Vec::new()
    }

    /// The values of [`Joint::MEASURED`].
    #[inline]
    fn measure<S: Real>(e: &Self::Over<S>, at: &At<'_, S>, out: &mut [S]) {
        let _ = (e, at, out);
    }

    /// Initial values of the internal coordinates for bodies at given poses.
    #[inline]
    fn own_start(e: &Self::Over<f64>, bodies: &[Pose]) -> Vec<f64> {
        let _ = (e, bodies);
        vec![0.0; Self::OWN]
    }

    /// Quantities that the other joints of the mechanism must hold, for bodies at the given poses.
    #[inline]
    fn requires<S: Real>(e: &Self::Over<S>, at: &At<'_, S>) -> Vec<Required<S>> {
        let _ = (e, at);
        Vec::new()
    }

    /// The constant modulo which the last equation is taken, if any. A body may then have several angles for one
    /// position of the other bodies, as meshed wheels have.
    #[inline]
    fn modulus(e: &Self::Over<f64>) -> Option<f64> {
        let _ = e;
        None
    }

    /// The play of the teeth. With play, the element is a force between two limits of its only equation.
    #[inline]
    fn backlash<S: Clone>(e: &Self::Over<S>) -> Option<Backlash<S>> {
        let _ = e;
        None
    }

    /// The friction along the quantity [`Measured::SLIP`] of a joint that may slip. Its load is the magnitude of the
    /// reaction of the joint, and its results are the last ones of the joint.
    #[inline]
    fn slips<S: Clone>(e: &Self::Over<S>) -> Option<Slips<S>> {
        let _ = e;
        None
    }

    /// The strands of a belt that acts as a force.
    #[inline]
    fn strands<S: Clone>(e: &Self::Over<S>) -> Option<Strands<S>> {
        let _ = e;
        None
    }

    /// The opposite of the only equation of a joint with play, without a jump.
    fn play<S: Real>(e: &Self::Over<S>, at: &At<'_, S>) -> S {
        let mut equation = [S::zero()];
        Self::residual(e, at, &mut equation);
        -equation[0]
    }

    /// The constant of the last equation that the start may change, m: wheels may be mounted at any phase.
    #[inline]
    fn phase_mut<S>(e: &mut Self::Over<S>) -> Option<&mut S> {
        let _ = e;
        None
    }

    /// The length by whose multiples the start may change this constant, m. None if any change is possible.
    #[inline]
    fn pitch(e: &Self::Over<f64>) -> Option<f64> {
        let _ = e;
        None
    }

    /// The symbols of the element in a drawing. A varying law is NaN here.
    #[inline]
    fn symbols(e: &Self::Over<f64>) -> Vec<SceneSymbol> {
        let _ = e;
        Vec::new()
    }

    /// A field with an impossible value, and the reason. Values that are not finite are rejected elsewhere.
    #[inline]
    fn fault(e: &Self::Over<f64>) -> Option<(&'static str, String)> {
        let _ = e;
        None
    }

    /// Φ, Φ̇, γ and Φ_q for fields that do not vary with time or state. They are derived from [`Joint::residual`]
    /// unless the joint has a closed form.
    #[inline]
    fn linearize<S: Real>(e: &Self::Over<S>, at: &Moving<'_, S>, out: Linearized<'_, S>) {
        derive::linearize::<Self, S>(e, at, out);
    }
}
