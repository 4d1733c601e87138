//! The physics of a force, stated once.

use super::declare::Element;
use super::kinds::{BodyId, JointId};
use super::symbols::SceneSymbol;
use crate::math::{Local, Motion, Real, Wrench};

/// The quantities that a force may depend on.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a, S = f64> {
    /// Motion of each body, in the order of [`Force::bodies`].
    pub bodies: &'a [Motion<S>],
    /// First-order states of the element, in the order of [`Force::states`].
    pub z: &'a [S],
    /// Reaction of the joint that [`Force::reaction`] names, on its body j at its joint point, in the
    /// global frame; zero without such a joint.
    pub reaction: Wrench<S>,
    /// Time, s.
    pub t: S,
}

impl<S> Situation<'_, S> {
    /// Motion of body i, the first one.
    #[inline(always)]
    pub fn i(&self) -> &Motion<S> {
        &self.bodies[0]
    }
    /// Motion of body j, the second one.
    #[inline(always)]
    pub fn j(&self) -> &Motion<S> {
        &self.bodies[1]
    }
}

/// The entry of the energy balance for the work of a part of a force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// The potential energy of the element.
    Conservative,
    /// Dissipated energy.
    Dissipative,
    /// Work from outside.
    Applied,
    /// An exchange between the bodies and the states of the element; the powers of the element count instead.
    Exchanged,
}

/// A named part of a force, such as `stiffness`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Name: `sol["spring"].stiffness_torque(…)`.
    pub name: &'static str,
    /// The entry of its work in the energy balance while the parameters are constant.
    pub nature: Nature,
}

/// A first-order state of an element, such as the current of a motor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OwnState {
    /// Name within the element: `motor.current`.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
}

/// Powers of an element beside those of its wrenches, W: of a circuit, for example.
#[derive(Clone, Copy, Debug)]
pub struct OwnPowers<S> {
    /// Dissipated.
    pub dissipated: S,
    /// Put in from outside.
    pub applied: S,
}

/// A force element: named parts, each with a wrench on every body.
pub trait Force: Element {
    /// The parts, in the order of [`Force::action`].
    const PARTS: &'static [Part];

    /// The bodies on which the force acts: i and j first.
    fn bodies<S>(e: &Self::Over<S>) -> Vec<BodyId>;

    /// The wrench of each part on each body about the origin of its frame: part p on body b at
    /// `p n + b`, n the number of bodies.
    fn action<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>, out: &mut [Wrench<S>]);

    /// The first-order states of an element for which the named fields are `given` and not zero.
    fn states(given: &dyn Fn(&str) -> bool) -> &'static [OwnState] {
        let _ = given;
        &[]
    }

    /// ż, one entry for each state.
    fn state_rates<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let _ = (e, at, out);
    }

    /// Powers beside those of the wrenches.
    fn own_powers<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> OwnPowers<S> {
        let _ = (e, at);
        OwnPowers { dissipated: S::zero(), applied: S::zero() }
    }

    /// The joint whose reaction enters the force, as in friction.
    fn reaction<S>(e: &Self::Over<S>) -> Option<JointId> {
        let _ = e;
        None
    }

    /// The relative angle φⱼ - φᵢ at which a rotational spring is relaxed. Assembly counts whole turns
    /// from it.
    fn free_angle<S: Real>(e: &Self::Over<S>) -> Option<S> {
        let _ = e;
        None
    }

    /// The points of body i and body j between which the force acts along their line.
    fn points<S: Real>(e: &Self::Over<S>) -> Option<[Local<S>; 2]> {
        let _ = e;
        None
    }

    /// Energy stored in the states, J.
    fn own_energy<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> S {
        let _ = (e, at);
        S::zero()
    }

    /// Potential energy of the conservative parts, J.
    fn potential<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> S {
        let _ = (e, at);
        S::zero()
    }

    /// The symbols that a drawing shows for the element; a law that varies is NaN here.
    fn symbols(e: &Self::Over<f64>) -> Vec<SceneSymbol> {
        let _ = e;
        Vec::new()
    }

    /// A field with an impossible value, and the reason; values that are not finite are refused anyway.
    fn fault(e: &Self::Over<f64>) -> Option<(&'static str, String)> {
        let _ = e;
        None
    }
}
