//! A circle of body i that presses on a curve of body j: the physics that all elements with such a contact share.
//!
//! For a compliant contact with the depth δ = -gap, the normal force N follows from the law in `hertz.rs`. N acts at the
//! nearest point C(u) of the curve, on body j along -ν and on body i along ν, where ν is the normal away from body j.
//! With v₀, the friction force on body i is -μ N tanh(v/v₀) along growing u, with the tangential velocity v of body i
//! relative to body j. It acts at C(u), and between two circles or smooth curves in the middle of the depth. Without v₀,
//! the friction slides and sticks; it is an element of its own, the companion of the contact. With a coefficient of
//! restitution, there is no depth, and N is the multiplier of the contact at rest.

mod faults;

use super::hertz::{Compliance, Hertz, Normal, SWITCHES};
use super::touch::{CurveTouch, TouchPoint};
use super::{
    At, Behaviour, BodyId, Clearance, Constraint, ContactFriction, Element, Force, ForceElement,
    Group, Measured, Nature, NormalLaw, OwnState, Part, PointOn, Required, Resting, ResultQuantity,
    Rim, SceneSymbol, Side, Situation, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Real, Vec2};
use std::borrow::Cow;
use std::ops::{Neg, Sub};

/// A contact, as an element describes it.
pub struct Pressing<'e, S: Clone> {
    /// The centre of the circle.
    pub i: &'e PointOn<S>,
    /// The curve.
    pub curve: Cow<'e, Rim<S>>,
    /// Radius of the circle.
    pub radius: S,
    /// The side of the curve.
    pub side: Side,
    /// The law of a compliant contact.
    pub compliance: Compliance<S>,
    /// μ while the contact slides.
    pub friction: S,
    /// μ up to which it sticks.
    pub r#static: Option<S>,
    /// v₀, m/s.
    pub velocity: Option<S>,
    /// e of a rigid contact.
    pub restitution: Option<S>,
    /// Rate below which a rigid contact rests, m/s.
    pub rest_speed: S,
    /// Worn volume for each newton and metre, m²/N.
    pub wear: S,
}

/// A number of a model, or its formula.
pub trait Amount: Clone + Neg<Output = Self> + Sub<Output = Self> {}

impl<S: Clone + Neg<Output = S> + Sub<Output = S>> Amount for S {}

/// An element that is such a contact.
pub trait Presses: Element {
    /// The section of the element in a file.
    const GROUP: Group;

    /// The contact.
    fn pressing<S: Amount>(e: &Self::Over<S>) -> Pressing<'_, S>;

    /// The bodies i and j.
    fn pair<S>(e: &Self::Over<S>) -> [BodyId; 2];

    /// Whether formulas give its forces.
    fn has_formulas<S>(e: &Self::Over<S>) -> bool;

    /// Whether it is compliant.
    fn is_compliant<S>(e: &Self::Over<S>) -> bool;

    /// The law of its normal force.
    fn law<S>(e: &Self::Over<S>) -> NormalLaw;

    /// The distance of the contact.
    fn clearance(e: &Self::Over<f64>) -> Clearance<'_>;

    /// See [`Force::play`].
    fn play(e: &Self::Over<f64>) -> Option<(&'static str, f64)> {
        let _ = e;
        None
    }

    /// See [`Force::requires`].
    fn requires(e: &Self::Over<f64>, at: &At<'_, f64>) -> Option<Required<f64>> {
        let _ = (e, at);
        None
    }

    /// The symbols in a drawing.
    fn symbols(e: &Self::Over<f64>) -> Vec<SceneSymbol>;

    /// A field of the geometry with an impossible value, and the reason.
    fn fault(e: &Self::Over<f64>) -> Option<(&'static str, String)>;
}

impl<S: Clone> Pressing<'_, S> {
    /// Whether it may have friction that sticks.
    fn sticks(&self) -> bool {
        self.velocity.is_none() && self.curve.is_closed_form()
    }
}

/// The states of wear: the length of sliding and the worn volume. The last state is the speed with which the contact
/// began.
const STATES: [OwnState; 3] = [
    OwnState { name: "sliding_distance", unit: "m" },
    OwnState { name: "wear_volume", unit: "m^3" },
    OwnState { name: "impact_speed", unit: "m/s" },
];

impl<S: Real> Pressing<'_, S> {
    fn touch(&self) -> CurveTouch<'_, S> {
        let Self { i, ref curve, radius, side, .. } = *self;
        CurveTouch { i, curve, radius, side }
    }

    /// The state at the place of action.
    fn point(&self, at: &Situation<'_, S>) -> TouchPoint<S> {
        match self.sticks() {
            true => self.touch().at_pitch(at),
            false => self.touch().at_foot(at),
        }
    }

    /// The law of a compliant contact.
    fn law(&self) -> Option<Hertz<S>> {
        self.compliance.law(self.touch().pitch())
    }

    /// The normal force; None if it is zero.
    fn normal(&self, at: &Situation<'_, S>, touch: &TouchPoint<S>) -> Option<Normal<S>> {
        match self.law() {
            Some(law) => law.normal(at, 0, touch.depth()),
            None if at.mode.holds() => Some(Normal { elastic: -at.multiplier, damping: S::zero() }),
            None => None,
        }
    }

    /// The friction force on body j along growing u.
    fn friction(&self, touch: &TouchPoint<S>, normal: S) -> Option<S> {
        let part = (touch.sliding / self.velocity?).tanh();
        Some(self.friction * normal * part)
    }

    /// Whether there is certainly no force, because the bodies were apart at the beginning of the step, or no equation
    /// holds them.
    fn is_free(&self, at: &Situation<'_, S>) -> bool {
        match self.restitution {
            None => at.held.pieces.get(at.held.first).is_some_and(|piece| *piece < 0.0),
            Some(_) => !at.mode.holds(),
        }
    }

    fn gap(&self, at: &Situation<'_, S>) -> S {
        self.touch().gap(&at.i().pose, &at.j().pose)
    }

    fn put(&self, at: &Situation<'_, S>, out: &mut dyn Wrenches<S>) {
        if self.is_free(at) {
            return;
        }
        let touch = self.point(at);
        let Some(normal) = self.normal(at, &touch) else { return };
        let mut put = |part: usize, force: Vec2<S>| {
            for (body, wrench) in touch.wrenches(force).into_iter().enumerate() {
                out.put(part, body, wrench);
            }
        };
        put(0, touch.away.scale(normal.elastic));
        put(1, touch.away.scale(normal.damping));
        if let Some(friction) = self.friction(&touch, normal.sum()) {
            put(2, -touch.along.scale(friction));
        }
    }

    /// Whether the sense of the sliding is a switch, because the rates of the [states](STATES) bend where it changes.
    /// Friction that sticks has events there.
    fn wears_both_ways(&self) -> bool {
        let most = self.r#static.unwrap_or(self.friction);
        let has_events = self.velocity.is_none() && most.largest_magnitude() > 0.0;
        !has_events && self.wear.largest_magnitude() > 0.0
    }

    /// The rates of the [states](STATES); those of wear after Archard (*Contact and rubbing of flat surfaces*, J. Appl.
    /// Phys. 24 (1953) 981).
    fn wearing(&self, at: &Situation<'_, S>, out: &mut [S]) {
        out.fill(S::zero());
        let [distance, volume, ..] = out else { return };
        let touch = self.point(at);
        let Some(normal) = self.normal(at, &touch).map(Normal::sum) else { return };
        let speed = match self.wears_both_ways() {
            true => at.choose(SWITCHES, touch.sliding, touch.sliding, -touch.sliding),
            false => touch.sliding.abs(),
        };
        let speed = at.choose(0, -touch.gap, speed, S::zero());
        (*distance, *volume) = (speed, self.wear * normal * speed);
    }

    fn results(&self, at: &Situation<'_, S>, out: &mut [S]) {
        out.fill(S::zero());
        let touch = self.point(at);
        out[2] = touch.sliding;
        if let Some(normal) = self.normal(at, &touch).map(Normal::sum) {
            out[0] = normal;
            out[1] = self.friction(&touch, normal).unwrap_or(S::zero());
        }
    }
}

impl Pressing<'_, Tape> {
    fn companion(&self) -> Option<ForceElement<Tape>> {
        let most = self.r#static.as_ref().unwrap_or(&self.friction);
        if !self.sticks() || most.constant() == Some(0.0) {
            return None;
        }
        Some(ForceElement::ContactFriction(ContactFriction {
            i: self.i.clone(),
            curve: Rim::clone(&self.curve),
            radius: self.radius.clone(),
            side: self.side,
            stiffness: self.compliance.stiffness.clone(),
            exponent: self.compliance.exponent.clone(),
            damping: self.compliance.damping.clone(),
            young: self.compliance.young.clone(),
            poisson: self.compliance.poisson.clone(),
            width: self.compliance.width.clone(),
            kinetic: self.friction.clone(),
            r#static: most.clone(),
        }))
    }
}

impl<E: Presses> Force for E {
    const PARTS: &'static [Part] = &[
        Part { name: "stiffness", nature: Nature::Conservative },
        Part { name: "damping", nature: Nature::Dissipative },
        Part { name: "friction", nature: Nature::Dissipative },
    ];
    const GROUP: Group = <E as Presses>::GROUP;
    const TOUCHES_OR_RUBS: bool = true;
    const MEASURED: &'static [Measured] = &[Measured::GAP];

    fn bodies<S>(e: &E::Over<S>) -> Vec<BodyId> {
        E::pair(e).into()
    }

    fn has_formulas<S>(e: &E::Over<S>) -> bool {
        <E as Presses>::has_formulas(e)
    }

    fn measure<S: Real>(e: &E::Over<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = E::pressing(e).touch().gap(at.i(), at.j());
    }

    fn arms<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        Some(E::pressing(e).point(at).arms)
    }

    fn action<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        E::pressing(e).put(at, &mut out);
    }

    fn states<'a>(given: &dyn Fn(&str) -> Option<&'a str>) -> &'static [OwnState] {
        let first = if given("wear").is_some() { 0 } else { 2 };
        let keeps = given("law").and_then(NormalLaw::named).is_some_and(NormalLaw::keeps_speed);
        &STATES[first..if keeps { 3 } else { 2 }]
    }

    fn keeps_speed<S>(e: &E::Over<S>) -> bool {
        E::law(e).keeps_speed()
    }

    fn state_rates<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>, out: &mut [S]) {
        if !out.is_empty() {
            E::pressing(e).wearing(at, out);
        }
    }

    fn switch_count<S: Real>(e: &E::Over<S>) -> usize {
        match E::is_compliant(e) {
            true => SWITCHES + usize::from(E::pressing(e).wears_both_ways()),
            false => 0,
        }
    }

    fn switches<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let own = E::pressing(e);
        if let Some(law) = own.law() {
            let touch = own.point(at);
            law.switches(at, touch.depth(), out);
            if let Some(sense) = out.get_mut(SWITCHES) {
                *sense = touch.sliding;
            }
        }
    }

    fn potential<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>) -> S {
        let own = E::pressing(e);
        match own.law() {
            Some(law) if !own.is_free(at) => law.potential(at, 0, -own.gap(at)),
            _ => S::zero(),
        }
    }

    fn result_quantities<S>(_: &E::Over<S>) -> &'static [ResultQuantity] {
        &[
            ResultQuantity { name: "force", unit: "N", negative: None },
            ResultQuantity { name: "tangential", unit: "N", negative: None },
            ResultQuantity { name: "sliding", unit: "m/s", negative: None },
            ResultQuantity { name: "sticking", unit: "", negative: None },
        ]
    }

    /// N, the friction force on body j along growing u, and the sliding velocity. Friction that sticks replaces the
    /// last three.
    fn results<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>, out: &mut [S]) {
        E::pressing(e).results(at, out);
    }

    fn behaviour<S: Real>(e: &E::Over<S>) -> Option<Behaviour<S>> {
        let own = E::pressing(e);
        let rest_speed = own.rest_speed;
        let impacts = |restitution| Behaviour::Impacts { restitution, rest_speed };
        let compliant = |law: Hertz<S>| {
            let [stiffness, exponent] = law.power();
            Behaviour::Compliant { stiffness, exponent, damping: law.constant_damping() }
        };
        own.restitution.map(impacts).or_else(|| own.law().map(compliant))
    }

    fn threshold<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>) -> S {
        E::pressing(e).gap(at)
    }

    fn companion(e: &E::Over<Tape>) -> Option<ForceElement<Tape>> {
        E::pressing(e).companion()
    }

    fn clearances(e: &E::Over<f64>) -> Vec<Clearance<'_>> {
        vec![E::clearance(e)]
    }

    fn play(e: &E::Over<f64>) -> Option<(&'static str, f64)> {
        <E as Presses>::play(e)
    }

    fn requires(e: &E::Over<f64>, at: &At<'_, f64>) -> Option<Required<f64>> {
        <E as Presses>::requires(e, at)
    }

    fn side<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>) -> f64 {
        E::pressing(e).touch().side(at)
    }

    fn margin<S: Real>(e: &E::Over<S>, at: &Situation<'_, S>) -> Option<S> {
        E::pressing(e).touch().margin(at)
    }

    fn holding(e: &E::Over<Tape>, at: f64, _: f64) -> Option<Constraint<Tape>> {
        let Pressing { i, curve, radius, side, .. } = E::pressing(e);
        let curve = curve.supporting(at);
        Some(Constraint::Resting(Resting { i: i.clone(), curve, radius, side }))
    }

    fn symbols(e: &E::Over<f64>) -> Vec<SceneSymbol> {
        <E as Presses>::symbols(e)
    }

    fn fault(e: &E::Over<f64>) -> Option<(&'static str, String)> {
        let own = E::pressing(e);
        <E as Presses>::fault(e).or_else(|| own.fault()).or_else(|| own.fault_of_law())
    }
}
