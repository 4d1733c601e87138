//! The physics of a force.

use super::clearance::Clearance;
use super::declare::Element;
use super::followed::{Acted, BodyId, Followed, JointId};
use super::group::Group;
use super::joint_trait::{At, Required, ResultQuantity};
use super::measured::Measured;
use super::mode::{Behaviour, Mode};
use super::own_state::{OwnPowers, OwnState};
use super::part::Part;
use super::symbols::SceneSymbol;
use super::{Constraint, ForceElement};
use crate::expression::Tape;
use crate::math::{Local, Motion, Real, Vec2, Wrench};

/// The quantities that a force may depend on.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a, S = f64> {
    /// Motion of every body of the model, ground first.
    pub motions: &'a [Motion<S>],
    /// The bodies on which the force acts, in the order of [`Force::bodies`].
    pub bodies: &'a [BodyId],
    /// First-order states of the element, in the order of [`Force::states`].
    pub z: &'a [S],
    /// Reaction of the joint of [`Force::reaction`] on its body j at its joint point, in the global frame. For a
    /// [companion](Force::companion), the first component is the multiplier with which the contact rests. Zero without
    /// such a joint or multiplier.
    pub reaction: Wrench<S>,
    /// Time, s.
    pub t: S,
    /// The pieces that are held for the switches of the element.
    pub held: Held<'a>,
    /// The mode of the force in this phase of a run.
    pub mode: Mode,
    /// The multiplier of the equation while the force [holds](Mode::holds). The effort on the coordinate is its
    /// negative. It is zero while the equations are being solved, because the equation is then one of them.
    pub multiplier: S,
}

/// The pieces that an integrator holds for the switches of an element during a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Held<'a> {
    /// The pieces of all switches of the model; empty if none is held.
    pub pieces: &'a [f64],
    /// The first switch of the element.
    pub first: usize,
}

impl<S: Real> Situation<'_, S> {
    /// `positive` where function `switch` of [`Force::switches`] is positive, otherwise `otherwise`. During a step of an
    /// integrator, the sign at its beginning is used, so that both values must be defined on both sides.
    #[inline(always)]
    pub fn choose(&self, switch: usize, function: S, positive: S, otherwise: S) -> S {
        match self.held.pieces.get(self.held.first + switch) {
            Some(piece) if *piece > 0.0 => positive,
            Some(piece) if *piece < 0.0 => otherwise,
            _ => S::select(function, positive, otherwise),
        }
    }

    /// The rate of a quantity on which the force acts.
    #[inline(always)]
    pub fn rate(&self, of: &Acted<S>) -> S {
        let mut sum = S::zero();
        for (body, [x, y, angle]) in of.gradient.iter().enumerate() {
            let twist = self.body(body).twist;
            sum += *x * twist.velocity.x + *y * twist.velocity.y + *angle * twist.omega;
        }
        sum
    }
}

impl<S> Situation<'_, S> {
    /// Motion of a body of the force, by its index in [`Force::bodies`].
    #[inline(always)]
    pub fn body(&self, place: usize) -> &Motion<S> {
        &self.motions[self.bodies[place].0]
    }
    /// Motion of body i, the first body.
    #[inline(always)]
    pub fn i(&self) -> &Motion<S> {
        self.body(0)
    }
    /// Motion of body j, the second body.
    #[inline(always)]
    pub fn j(&self) -> &Motion<S> {
        self.body(1)
    }
}

/// A receiver of the wrenches of a force.
pub trait Wrenches<S> {
    /// Receives the wrench of a part on a body about the origin of its frame. `part` is an index in [`Force::PARTS`],
    /// and `body` is an index in [`Force::bodies`].
    fn put(&mut self, part: usize, body: usize, wrench: Wrench<S>);
}

impl<S, F: FnMut(usize, usize, Wrench<S>)> Wrenches<S> for F {
    #[inline]
    fn put(&mut self, part: usize, body: usize, wrench: Wrench<S>) {
        self(part, body, wrench);
    }
}

/// A force element: named parts, each with a wrench on every body.
pub trait Force: Element {
    /// The parts. [`Force::action`] refers to them by their indices.
    const PARTS: &'static [Part];

    /// Whether files contain elements of the type. Others are made by the reader of bodies.
    const IN_FILES: bool = true;

    /// The section of files that contains elements of the type.
    const GROUP: Group = Group::Forces;

    /// The position quantities that can be measured on the force.
    const MEASURED: &'static [Measured] = &[];

    /// Whether the only formulas of the state in the force are those of a position quantity that it follows. Its
    /// parts then keep their nature, and its potential is counted.
    const FOLLOWS: bool = false;

    /// Whether bodies touch or rub in the element, so that its work may be less smooth than the motion.
    const TOUCHES_OR_RUBS: bool = false;

    /// The position quantities of an element, for types in which their units depend on the element.
    #[inline]
    fn measured<S>(e: &Self::Over<S>) -> &'static [Measured] {
        let _ = e;
        Self::MEASURED
    }

    /// Whether laws may use its position quantities. They must be formulas of the coordinates that need no search.
    #[inline]
    fn has_formulas<S>(e: &Self::Over<S>) -> bool {
        let _ = e;
        true
    }

    /// The bodies on which the force acts: i and j first.
    fn bodies<S>(e: &Self::Over<S>) -> Vec<BodyId>;

    /// Puts the wrench of each part on each body into `out`. A wrench that is left out is zero.
    fn action<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>, out: impl Wrenches<S>);

    /// The values of [`Force::MEASURED`] for the poses of [`Force::bodies`].
    #[inline]
    fn measure<S: Real>(e: &Self::Over<S>, at: &At<'_, S>, out: &mut [S]) {
        let _ = (e, at, out);
    }

    /// The first-order states of an element. `given` has the text of a named field: empty for one that is no text, and
    /// None for one that is absent or zero.
    #[inline]
    fn states<'a>(given: &dyn Fn(&str) -> Option<&'a str>) -> &'static [OwnState] {
        let _ = given;
        &[]
    }

    /// ż, one entry for each state.
    #[inline]
    fn state_rates<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let _ = (e, at, out);
    }

    /// Powers in addition to those of the wrenches.
    #[inline]
    fn own_powers<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> OwnPowers<S> {
        let _ = (e, at);
        OwnPowers { dissipated: S::zero(), applied: S::zero() }
    }

    /// The joint with play that the force is.
    #[inline]
    fn joint<S>(e: &Self::Over<S>) -> Option<&Constraint<S>> {
        let _ = e;
        None
    }

    /// The driver whose effort the force limits.
    #[inline]
    fn driver<S>(e: &Self::Over<S>) -> Option<&Constraint<S>> {
        let _ = e;
        None
    }

    /// Lets the force act in place of this driver, or not.
    #[inline]
    fn take_over<S>(e: &mut Self::Over<S>, acts: bool) {
        let _ = (e, acts);
    }

    /// The field that contains the play of a joint, and its value, m.
    #[inline]
    fn play(e: &Self::Over<f64>) -> Option<(&'static str, f64)> {
        let _ = e;
        None
    }

    /// A quantity that a start must meet.
    #[inline]
    fn requires(e: &Self::Over<f64>, at: &At<'_, f64>) -> Option<Required<f64>> {
        let _ = (e, at);
        None
    }

    /// The joint on whose reaction the force depends, as in friction.
    #[inline]
    fn reaction<S>(e: &Self::Over<S>) -> Option<JointId> {
        let _ = e;
        None
    }

    /// For a force that depends on a [reaction](Force::reaction): the part of its action that does, as one effort, and
    /// its derivatives with respect to [`Situation::reaction`].
    #[inline]
    fn effort<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        let _ = (e, at);
        (S::zero(), Wrench::zero())
    }

    /// Puts the wrenches of an [effort](Force::effort) into `out`, in proportion to it.
    #[inline]
    fn put_effort<S: Real>(
        e: &Self::Over<S>,
        at: &Situation<'_, S>,
        effort: S,
        out: impl Wrenches<S>,
    ) {
        let _ = (e, at, effort, out);
    }

    /// Number of switches of an element. A switch is a function of the situation at whose zeros the action is not
    /// smooth.
    #[inline]
    fn switch_count<S: Real>(e: &Self::Over<S>) -> usize {
        let _ = e;
        0
    }

    /// The functions of the switches, into `out`. [`Situation::choose`] uses their signs in [`Force::action`]. Each
    /// zero is located, and steps of an integrator end there.
    #[inline]
    fn switches<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let _ = (e, at, out);
    }

    /// Results in addition to the wrenches, in the order of [`Force::results`].
    #[inline]
    fn result_quantities<S>(e: &Self::Over<S>) -> &'static [ResultQuantity] {
        let _ = e;
        &[]
    }

    /// The values of [`Force::result_quantities`].
    #[inline]
    fn results<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let _ = (e, at, out);
    }

    /// The changes of mode during a run; None for a force without modes or events.
    #[inline]
    fn behaviour<S: Real>(e: &Self::Over<S>) -> Option<Behaviour<S>> {
        let _ = e;
        None
    }

    /// The function whose zeros may change the mode: the sliding speed of friction; for other forces the gap, which
    /// is positive if the bodies are apart.
    #[inline]
    fn threshold<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> S {
        let _ = (e, at);
        S::one()
    }

    /// The distances whose zeros begin and end a contact, one for each contact.
    #[inline]
    fn clearances(e: &Self::Over<f64>) -> Vec<Clearance<'_>> {
        let _ = e;
        Vec::new()
    }

    /// Whether the last state of the element is the rate with which its gap closed when the contact began.
    #[inline]
    fn keeps_speed<S>(e: &Self::Over<S>) -> bool {
        let _ = e;
        false
    }

    /// The position quantity that the element follows.
    #[inline]
    fn followed<S>(e: &Self::Over<S>) -> Option<&Followed<S>> {
        let _ = e;
        None
    }

    /// The largest effort of sticking friction, and its derivatives with respect to [`Situation::reaction`].
    #[inline]
    fn limit<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        let _ = (e, at);
        (S::zero(), Wrench::zero())
    }

    /// The coefficients of friction of a contact that slides and that sticks.
    #[inline]
    fn coefficients(e: &Self::Over<f64>) -> [f64; 2] {
        let _ = e;
        [0.0; 2]
    }

    /// Whether friction acts in one direction only, as a freewheel does: its effort on body j is not negative.
    #[inline]
    fn only_pushes<S>(e: &Self::Over<S>) -> bool {
        let _ = e;
        false
    }

    /// The side at which it touches: -1 for a lower limit, +1 for an upper limit, below -1 for a part of a curve.
    #[inline]
    fn side<S: Real>(_: &Self::Over<S>, _: &Situation<'_, S>) -> f64 {
        -1.0
    }

    /// The distance from the end of the range in which its equation holds it, without unit. None without an end.
    fn margin<S: Real>(_: &Self::Over<S>, _: &Situation<'_, S>) -> Option<S> {
        None
    }

    /// The equation with which the force [holds](Mode::holds). Friction holds its coordinate at `value`. A stop holds
    /// its coordinate at the limit of the `side`, or at `value` for side 0. A contact holds its gap at zero.
    #[inline]
    fn holding(_: &Self::Over<Tape>, _side: f64, _value: f64) -> Option<Constraint<Tape>> {
        None
    }

    /// A second element of the force, with the same name and with modes of its own: the friction of a contact.
    #[inline]
    fn companion(_: &Self::Over<Tape>) -> Option<ForceElement<Tape>> {
        None
    }

    /// The relative angle φⱼ - φᵢ at which a rotational spring is relaxed. Assembly counts whole turns
    /// from it.
    #[inline]
    fn free_angle<S: Real>(e: &Self::Over<S>) -> Option<S> {
        let _ = e;
        None
    }

    /// The points of bodies i and j, if the force acts along the line between them.
    #[inline]
    fn points<S: Real>(e: &Self::Over<S>) -> Option<[Local<S>; 2]> {
        let _ = e;
        None
    }

    /// The vectors from the origins of bodies i and j to the point at which the force acts, in the global frame. Torques
    /// are reported about this point. None for a torque, and for an effort on a quantity.
    #[inline]
    fn arms<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        Self::points(e).map(|[i, j]| [at.i().pose.global(i), at.j().pose.global(j)])
    }

    /// Energy stored in the states, J.
    #[inline]
    fn own_energy<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> S {
        let _ = (e, at);
        S::zero()
    }

    /// Potential energy of the conservative parts, J.
    #[inline]
    fn potential<S: Real>(e: &Self::Over<S>, at: &Situation<'_, S>) -> S {
        let _ = (e, at);
        S::zero()
    }

    /// Whether the dimensions that give a stress are known.
    fn has_stress(_: &Self::Over<f64>) -> bool {
        false
    }

    /// A length of the element that counts for the size of the mechanism, m.
    fn reach<S: Real>(_: &Self::Over<S>) -> Option<S> {
        None
    }

    /// The symbols of the element in a drawing. A varying law is NaN here.
    fn symbols(_: &Self::Over<f64>) -> Vec<SceneSymbol> {
        Vec::new()
    }

    /// A field with an impossible value, and the reason. Values that are not finite are rejected elsewhere.
    #[inline]
    fn fault(e: &Self::Over<f64>) -> Option<(&'static str, String)> {
        let _ = e;
        None
    }
}
