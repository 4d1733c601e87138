//! The physics of a force, stated once.

use super::declare::Element;
use super::followed::BodyId;
use super::joint_trait::At;
use super::kinds::JointId;
use super::measured::Measured;
use super::symbols::SceneSymbol;
use crate::math::{Local, Motion, Real, Wrench};

/// The quantities that a force may depend on.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a, S = f64> {
    /// Motion of every body of the model, ground first.
    pub motions: &'a [Motion<S>],
    /// The bodies on which the force acts, in the order of [`Force::bodies`].
    pub bodies: &'a [BodyId],
    /// First-order states of the element, in the order of [`Force::states`].
    pub z: &'a [S],
    /// Reaction of the joint that [`Force::reaction`] names, on its body j at its joint point, in the
    /// global frame; zero without such a joint.
    pub reaction: Wrench<S>,
    /// Time, s.
    pub t: S,
}

impl<S> Situation<'_, S> {
    /// Motion of a body of the force, by its place in [`Force::bodies`].
    #[inline(always)]
    pub fn body(&self, place: usize) -> &Motion<S> {
        &self.motions[self.bodies[place].0]
    }
    /// Motion of body i, the first one.
    #[inline(always)]
    pub fn i(&self) -> &Motion<S> {
        self.body(0)
    }
    /// Motion of body j, the second one.
    #[inline(always)]
    pub fn j(&self) -> &Motion<S> {
        self.body(1)
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

impl Nature {
    /// The nature of a part with a law of time or state: it has no potential.
    pub fn under_law(self) -> Self {
        match self {
            Self::Conservative => Self::Applied,
            other => other,
        }
    }
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

/// Takes the wrenches of a force.
pub trait Wrenches<S> {
    /// Takes the wrench of a part on a body about the origin of its frame. `part` is a place in [`Force::PARTS`], `body`
    /// a place in [`Force::bodies`].
    fn put(&mut self, part: usize, body: usize, wrench: Wrench<S>);
}

impl<S, F: FnMut(usize, usize, Wrench<S>)> Wrenches<S> for F {
    fn put(&mut self, part: usize, body: usize, wrench: Wrench<S>) {
        self(part, body, wrench);
    }
}

/// A force element: named parts, each with a wrench on every body.
pub trait Force: Element {
    /// The parts; [`Force::action`] refers to them by their places.
    const PARTS: &'static [Part];

    /// The position quantities that may be measured on the force.
    const MEASURED: &'static [Measured] = &[];

    /// The bodies on which the force acts: i and j first.
    fn bodies<S>(e: &Self::Over<S>) -> Vec<BodyId>;

    /// Puts the wrench of each part on each body into `out`. A wrench that is left out is zero.
    fn action<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>, out: impl Wrenches<S>);

    /// The values of [`Force::MEASURED`] for the poses of [`Force::bodies`].
    fn measure<S: Real>(e: &Self::Over<S>, at: &At<'_, S>, out: &mut [S]) {
        let _ = (e, at, out);
    }

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
