//! Friction of a contact that slides and sticks: Coulomb's law with the normal force N of the contact.
//!
//! While the contact slides with the velocity v of body i relative to body j along growing u, the friction force on body
//! i is -μ N sign v along growing u. Where v is zero, it may have any value up to μ_s N, and an equation holds the
//! contact: it rolls without slip, or sticks. A compliant contact determines N from its depth. N of a rigid contact is
//! the multiplier of the equation with which it rests, so that the friction belongs to the equations of motion, see
//! `equations/reactive.rs`. `elements/touch.rs` contains v, the place of action and the equation.
//!
//! The friction is a part of a `contact`: it has the name of the contact, and no file contains it.

use crate::elements::hertz::{Compliance, Normal};
use crate::elements::touch::{CurveTouch, TouchPoint};
use crate::elements::{
    element, At, Attachment, Behaviour, BodyId, Constraint, Equation, Force, Joint, Mode, Nature,
    NormalLaw, Part, ResultQuantity, Situation, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Local, Real, Wrench};

element! {
    /// Friction of a contact.
    ContactFriction, "contact (friction)" {
        /// Point of body i.
        i: point,
        /// Curve of body j.
        curve: rim,
        /// Radius of the circle around the point.
        radius: number [m],
        /// Side of the curve.
        side: side,
        /// Stiffness of a compliant contact.
        stiffness: optional_number [any],
        /// Exponent of the depth.
        exponent: number,
        /// Damping factor.
        damping: number [s/m],
        /// Modulus of elasticity of cylinders.
        young: optional_number [Pa],
        /// Their ratio of Poisson.
        poisson: optional_number,
        /// Their width.
        width: optional_number [m],
        /// Coefficient of friction while the contact slides.
        kinetic: number,
        /// Coefficient of friction up to which the contact sticks.
        r#static: number,
    }
}

element! {
    /// Equation of a contact that sticks: the length rolled along the curve keeps its value.
    ContactSticking, "contact (sticking)" {
        /// Point of body i.
        i: point,
        /// Curve of body j.
        curve: rim,
        /// Radius of the circle around the point.
        radius: number [m],
        /// Side of the curve.
        side: side,
        /// The length.
        value: number [m],
    }
}

impl<S: Real> ContactFriction<S> {
    fn touch(&self) -> CurveTouch<'_, S> {
        let Self { ref i, ref curve, radius, side, .. } = *self;
        CurveTouch { i, curve, radius, side }
    }

    /// N with its derivatives with respect to the reaction, whose first component is the multiplier of a rigid
    /// contact.
    fn normal(&self, at: &Situation<'_, S>, point: &TouchPoint<S>) -> (S, Wrench<S>) {
        let Self { stiffness, exponent, damping, young, poisson, width, .. } = *self;
        let (law, restitution) = (NormalLaw::HuntCrossley, None);
        let law =
            Compliance { law, stiffness, exponent, damping, young, poisson, width, restitution };
        match law.law(self.touch().pitch()) {
            Some(law) => {
                let normal = law.normal(at, 0, point.depth());
                (normal.map_or(S::zero(), Normal::sum), Wrench::zero())
            }
            None => {
                let mut slope = Wrench::zero();
                slope.force.x = -S::one();
                (-at.reaction.force.x, slope)
            }
        }
    }

    /// A coefficient of friction times N, as an effort along s.
    fn times(
        &self,
        coefficient: S,
        at: &Situation<'_, S>,
        point: &TouchPoint<S>,
    ) -> (S, Wrench<S>) {
        let factor = coefficient / point.ratio;
        let (normal, slope) = self.normal(at, point);
        let slope = Wrench { force: slope.force.scale(factor), torque: S::zero() };
        (factor * normal, slope)
    }

    /// The effort on body i along s.
    fn effort_at(&self, at: &Situation<'_, S>, point: &TouchPoint<S>) -> (S, Wrench<S>) {
        let (one, zero) = (S::one(), S::zero());
        let sense = match at.mode {
            Mode::Free => return (zero, Wrench::zero()),
            mode if mode.holds() => return (-at.multiplier, Wrench::zero()),
            Mode::Slides(sign) => S::constant(sign),
            _ => S::select(point.sliding, one, S::select(-point.sliding, -one, zero)),
        };
        self.times(-sense * self.kinetic, at, point)
    }

    fn put(&self, point: &TouchPoint<S>, effort: S, out: &mut impl Wrenches<S>) {
        let force = point.along.scale(effort * point.ratio);
        for (body, wrench) in point.wrenches(force).into_iter().enumerate() {
            out.put(0, body, wrench);
        }
    }
}

impl Force for ContactFriction {
    const PARTS: &'static [Part] = &[Part { name: "friction", nature: Nature::Dissipative }];
    const TOUCHES_OR_RUBS: bool = true;

    fn bodies<S>(e: &ContactFriction<S>) -> Vec<BodyId> {
        vec![e.i.body, e.curve.on.body]
    }

    fn effort<S: Real>(e: &ContactFriction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        e.effort_at(at, &e.touch().at_pitch(at))
    }

    fn put_effort<S: Real>(
        e: &ContactFriction<S>,
        at: &Situation<'_, S>,
        effort: S,
        mut out: impl Wrenches<S>,
    ) {
        e.put(&e.touch().at_pitch(at), effort, &mut out);
    }

    fn action<S: Real>(e: &ContactFriction<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        if at.mode == Mode::Free {
            return;
        }
        let point = e.touch().at_pitch(at);
        let (effort, _) = e.effort_at(at, &point);
        e.put(&point, effort, &mut out);
    }

    fn result_quantities<S>(_: &ContactFriction<S>) -> &'static [ResultQuantity] {
        const fn of(name: &'static str, unit: &'static str) -> ResultQuantity {
            ResultQuantity { name, unit, negative: None }
        }
        const { &[of("tangential", "N"), of("sliding", "m/s"), of("sticking", "")] }
    }

    /// The friction force on body j along growing u, the sliding velocity, and 1 while the contact sticks.
    fn results<S: Real>(e: &ContactFriction<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let point = e.touch().at_pitch(at);
        let effort = e.effort_at(at, &point).0;
        let sticks = if at.mode.holds() { S::one() } else { S::zero() };
        out.copy_from_slice(&[S::zero() - effort * point.ratio, point.sliding, sticks]);
    }

    fn behaviour<S: Real>(_: &ContactFriction<S>) -> Option<Behaviour<S>> {
        Some(Behaviour::Sticks)
    }

    fn threshold<S: Real>(e: &ContactFriction<S>, at: &Situation<'_, S>) -> S {
        e.touch().at_pitch(at).sliding
    }

    fn limit<S: Real>(e: &ContactFriction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        e.times(e.r#static, at, &e.touch().at_pitch(at))
    }

    fn coefficients(e: &ContactFriction) -> [f64; 2] {
        [e.kinetic, e.r#static]
    }

    fn side<S: Real>(e: &ContactFriction<S>, at: &Situation<'_, S>) -> f64 {
        e.touch().side(at)
    }

    fn margin<S: Real>(e: &ContactFriction<S>, at: &Situation<'_, S>) -> Option<S> {
        e.touch().margin(at)
    }

    fn holding(e: &ContactFriction<Tape>, side: f64, value: f64) -> Option<Constraint<Tape>> {
        let (i, curve, radius) = (e.i.clone(), e.curve.supporting(side), e.radius.clone());
        let value = Tape::from(value);
        let equation = ContactSticking { i, curve, radius, side: e.side, value };
        Some(Constraint::ContactSticking(equation))
    }
}

impl<S: Real> ContactSticking<S> {
    fn touch(&self) -> CurveTouch<'_, S> {
        let Self { ref i, ref curve, radius, side, .. } = *self;
        CurveTouch { i, curve, radius, side }
    }
}

impl Joint for ContactSticking {
    fn bodies<S>(e: &ContactSticking<S>) -> Vec<BodyId> {
        vec![e.i.body, e.curve.on.body]
    }

    fn equations<S>(_: &ContactSticking<S>) -> Vec<Equation> {
        vec![Equation::length("rolled")]
    }

    fn residual<S: Real>(e: &ContactSticking<S>, at: &At<'_, S>, phi: &mut [S]) {
        phi[0] = e.touch().rolled(at.i(), at.j(), e.value);
    }

    fn attachment<S: Real>(e: &ContactSticking<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, Local::zero()][body], axis: S::zero() }
    }

    fn contact<S: Real>(e: &ContactSticking<S>, at: &At<'_, S>) -> Option<Local<S>> {
        Some(e.touch().near(at.i(), at.j()).place)
    }
}
