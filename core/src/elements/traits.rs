//! The physics of an element, stated once.

use super::declare::Element;
use super::derive;
use super::kinds::BodyId;
use crate::math::{Local, Motion, Pose, Real, Wrench};

/// One of the two bodies of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The first body.
    I,
    /// The second body.
    J,
}

/// A scalar constraint equation of a joint: its name in labels and its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Equation {
    /// Name within the joint, such as `x`.
    pub name: &'static str,
    /// Unit of the residual: `m` or `rad`.
    pub unit: &'static str,
}

/// The joint frame on one body: its origin s′ and the angle of its x″ axis in the body frame; C of
/// (6.6.8) is the rotation by that angle.
#[derive(Clone, Copy, Debug)]
pub struct Attachment<S = f64> {
    /// Origin, m.
    pub s: Local<S>,
    /// Angle of x″ from the body's x axis, rad.
    pub axis: S,
}

/// A joint or driver with `M` equations Φ(qᵢ, qⱼ, t) = 0.
pub trait Joint<const M: usize>: Element {
    /// Whether the joint points of i and j coincide: what assembly walks along to place bodies.
    const PINS: bool = false;

    /// Whether body j can only slide along the x axis of the joint frame of body i, so that the axes
    /// of both joint frames keep one direction: the other thing that assembly walks along.
    const SLIDES: bool = false;

    /// Bodies i and j; ground where a body is missing.
    fn ends<S>(e: &Self::Over<S>) -> [BodyId; 2];

    /// Names and units of the equations.
    fn equations<S>(e: &Self::Over<S>) -> [Equation; M];

    /// Φ.
    fn residual<S: Real>(e: &Self::Over<S>, i: &Pose<S>, j: &Pose<S>, t: S) -> [S; M];

    /// A field whose value cannot be, and why; values that are not finite are refused anyway.
    fn fault(e: &Self::Over<f64>) -> Option<(&'static str, String)> {
        let _ = e;
        None
    }

    /// The joint frame on a body.
    fn attachment<S: Real>(e: &Self::Over<S>, side: Side) -> Attachment<S>;

    /// ∂Φ/∂(xᵢ yᵢ φᵢ xⱼ yⱼ φⱼ); derived from [`Joint::residual`] unless a closed form is given.
    fn jacobian<S: Real>(e: &Self::Over<S>, i: &Pose<S>, j: &Pose<S>, t: S) -> [[S; 6]; M] {
        derive::derived_jacobian::<M, Self, S>(e, i, j, t)
    }

    /// Φ, Φ̇ and γ at known velocities, for parameters that do not vary in time; derived from
    /// [`Joint::residual`] unless a closed form is given.
    fn velocity_terms<S: Real>(
        e: &Self::Over<S>,
        i: &Motion<S>,
        j: &Motion<S>,
        t: S,
    ) -> derive::VelocityTerms<S, M> {
        derive::derived_velocity_terms::<M, Self, S>(e, i, j, t)
    }

    /// [`Joint::velocity_terms`] and [`Joint::jacobian`] together; closed forms may share what they
    /// have in common.
    fn linearize<S: Real>(
        e: &Self::Over<S>,
        i: &Motion<S>,
        j: &Motion<S>,
        t: S,
    ) -> (derive::VelocityTerms<S, M>, [[S; 6]; M]) {
        (Self::velocity_terms(e, i, j, t), Self::jacobian(e, &i.pose, &j.pose, t))
    }
}

/// Forces and torques of an element on its two bodies.
#[derive(Clone, Copy, Debug)]
pub struct Action<S = f64> {
    /// On body i, about its frame's origin.
    pub on_i: Wrench<S>,
    /// On body j, about its frame's origin.
    pub on_j: Wrench<S>,
}

/// What a force may see. Joint reactions (for friction) and first-order states of the element will
/// be further members; an element names only those it uses.
#[derive(Clone, Copy, Debug)]
pub struct Situation<S = f64> {
    /// Motion of body i.
    pub i: Motion<S>,
    /// Motion of body j.
    pub j: Motion<S>,
    /// Time, s.
    pub t: S,
}

/// Where the work of a part of a force goes in the energy balance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// Into the potential of the element.
    Conservative,
    /// Lost.
    Dissipative,
    /// Done from outside.
    Applied,
}

/// A named part of a force, such as `stiffness`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Name: `sol["spring"].stiffness_torque(…)`.
    pub name: &'static str,
    /// Where its work goes while the parameters are constant.
    pub nature: Nature,
}

/// A force element with `P` named parts.
pub trait Force<const P: usize>: Element {
    /// The parts, in the order of [`Force::action`].
    const PARTS: [Part; P];

    /// Bodies i and j; ground where a body is missing.
    fn ends<S>(e: &Self::Over<S>) -> [BodyId; 2];

    /// The wrench of each part on both bodies.
    fn action<S: Real>(e: &Self::Over<S>, at: &Situation<S>) -> [Action<S>; P];

    /// The relative angle φⱼ - φᵢ at which a rotational spring is relaxed: what whole turns are
    /// counted from at assembly.
    fn free_angle<S: Real>(e: &Self::Over<S>) -> Option<S> {
        let _ = e;
        None
    }

    /// The points of body i and body j between which the force acts along their line.
    fn points<S: Real>(e: &Self::Over<S>) -> Option<[Local<S>; 2]> {
        let _ = e;
        None
    }

    /// Potential energy of the conservative parts, J.
    fn potential<S: Real>(e: &Self::Over<S>, at: &Situation<S>) -> S {
        let _ = (e, at);
        S::zero()
    }
}
