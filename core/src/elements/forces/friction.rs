//! Friction in a joint: it depends on the load that the joint carries (Coulomb, Stribeck).
//!
//! With v the rate of the displacement of a slide, or radius × φ̇ of a pin, the force along the slide, or around the
//! pin, is
//!
//! ```text
//! -(N μ(v) s(v) + c v)        μ = μ_k + (μ_s - μ_k) exp(-(v/v_s)²)        s = tanh(v/v₀)
//! ```
//!
//! on body j, and the opposite on body i at the same point; for a pin, the force times the radius is a torque. N is
//! the magnitude of the reaction of the joint or, for a slide of length l, the larger of |F| and 2 |T| / l, because a
//! torque loads both ends of the slide. Without v₀, s is the sign of v. Where v is zero, the joint may stick: the
//! friction then has any value up to μ_s N, and an equation holds the coordinate of the joint. The reaction in turn
//! depends on the friction, see `equations/reactive.rs`. The load of a slide has bends, at which steps end.

use crate::elements::{
    element, holding, Behaviour, BodyId, Constraint, Followed, Force, JointId, Mark, Mode, Nature,
    Part, ResultQuantity, SceneSymbol, Situation, SymbolEnd, Wrenches,
};
use crate::expression::Tape;
use crate::math::{Real, Vec2, Wrench};

element! {
    /// Friction in a joint: the force on body j along the slide, or around the pin, is -(load μ s +
    /// viscous v). For a pin, this force times the radius is a torque. The opposite force or torque
    /// acts on body i at the same place. v is the rate of the slide, or radius × omega of the pin.
    /// Without `stribeck`, μ = kinetic; with it, μ = kinetic + (static - kinetic)
    /// exp(-(v/stribeck)²). With `velocity`, s = tanh(v/velocity); without it, s is the sign of v.
    /// By default, load is the magnitude of the reaction of the joint.
    Friction, "friction" {
        /// The joint: revolute, translational or pin_in_slot.
        joint: bearing,
        /// Coefficient of friction while the joint slides.
        kinetic: number,
        /// Coefficient of friction up to which the joint sticks; kinetic if absent.
        r#static: optional_number,
        /// Radius of the pin of a revolute joint.
        radius: optional_number [m],
        /// Length of the guide of a translational joint: the load is then the larger of |F| and 2 |T| / guide.
        guide: number [m] = 0.0,
        /// Speed of the Stribeck curve, at which most of the difference between static and kinetic is gone.
        stribeck: optional_number [m/s],
        /// Viscous force per speed, independent of the load.
        viscous: number [N*s/m] = 0.0,
        /// Speed at which the friction is 76 % of its full value. Without it, the joint may stick.
        velocity: optional_number [m/s],
        /// Load that replaces the reaction, as in a brake; may use `t` and the state. Negative loads count as 0.
        load: optional_law [N],
    }
}

/// The indices of the parts.
const DRY: usize = 0;
const VISCOUS: usize = 1;

/// The switches of a slide: the sign of its reaction, and whether the torque decides the load.
const ACROSS: usize = 0;
const TILTS: usize = 1;

/// The results of friction in a slide, and in a pin.
const SLIDING: [ResultQuantity; 3] = results("force", "N");
const TURNING: [ResultQuantity; 3] = results("torque", "N*m");

const fn results(effort: &'static str, unit: &'static str) -> [ResultQuantity; 3] {
    const fn of(name: &'static str, unit: &'static str) -> ResultQuantity {
        ResultQuantity { name, unit, negative: None }
    }
    [of(effort, unit), of("load", "N"), of("sticking", "")]
}

impl<S: Real> Friction<S> {
    /// Converts a force along the slide or around the pin into an effort, and a rate into a speed.
    fn times_radius(&self, x: S) -> S {
        match self.radius {
            Some(radius) => radius * x,
            None => x,
        }
    }

    /// The speed v at which body j slides on body i, m/s.
    fn speed(&self, at: &Situation<'_, S>) -> S {
        self.times_radius(self.joint.rate(at.i(), at.j()))
    }

    /// The load, N, and its derivatives with respect to the reaction.
    fn normal(&self, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        let zero = S::zero();
        if let Some(load) = self.load {
            return (S::select(load, load, zero), Wrench::zero());
        }
        let Wrench { force, torque } = at.reaction;
        let (size, along) = match self.joint.turns() {
            true => {
                let squared = force.dot(force);
                let size = S::select(squared, squared.sqrt(), zero);
                (size, force.scale(S::select(squared, S::one() / size, zero)))
            }
            false => {
                let (across, normal) = self.across(at);
                let sign = at.choose(ACROSS, across, S::one(), -S::one());
                (sign * across, normal.scale(sign))
            }
        };
        if !self.joint.holds_angle {
            return (size, Wrench { force: along, torque: zero });
        }
        let per_torque = self.per_torque();
        let of_torque = per_torque * torque.abs();
        let tilts = |x: S, otherwise: S| at.choose(TILTS, of_torque - size, x, otherwise);
        let slope = Wrench {
            force: along.scale(tilts(zero, S::one())),
            torque: tilts(S::select(torque, per_torque, -per_torque), zero),
        };
        (tilts(of_torque, size), slope)
    }

    /// The reaction of a slide across it, and the normal of the slide.
    fn across(&self, at: &Situation<'_, S>) -> (S, Vec2<S>) {
        let normal = self.joint.direction(&at.i().pose).perp();
        (at.reaction.force.dot(normal), normal)
    }

    /// The load for a torque of 1 N·m.
    fn per_torque(&self) -> S {
        S::select(self.guide, S::constant(2.0) / self.guide, S::zero())
    }

    /// μ at a speed.
    fn coefficient(&self, speed: S) -> S {
        match (self.r#static, self.stribeck) {
            (Some(most), Some(stribeck)) => {
                let part = speed / stribeck;
                self.kinetic + (most - self.kinetic) * (-(part * part)).exp()
            }
            _ => self.kinetic,
        }
    }

    /// s at a speed.
    fn sense(&self, speed: S, mode: Mode) -> S {
        let (one, zero) = (S::one(), S::zero());
        match (self.velocity, mode) {
            (Some(velocity), _) => (speed / velocity).tanh(),
            (None, Mode::Slides(sign)) => S::constant(sign),
            (None, _) => S::select(speed, one, S::select(-speed, -one, zero)),
        }
    }

    /// The efforts of the dry and the viscous part on the coordinate of the joint, N or N·m.
    fn efforts(&self, at: &Situation<'_, S>) -> [S; 2] {
        if at.mode.holds() {
            return [-at.multiplier, S::zero()];
        }
        let viscous = -self.times_radius(self.viscous * self.speed(at));
        [<Friction as Force>::effort(self, at).0, viscous]
    }

    /// Adds an effort on body j, and the opposite effort on body i.
    fn put(&self, part: usize, effort: S, at: &Situation<'_, S>, out: &mut impl Wrenches<S>) {
        if self.joint.turns() {
            out.put(part, 0, Wrench::torque(-effort));
            out.put(part, 1, Wrench::torque(effort));
            return;
        }
        let [from_i, from_j] = self.arms_of_bodies(at);
        let force = self.joint.direction(&at.i().pose).scale(effort);
        out.put(part, 0, Wrench::at(from_i, -force));
        out.put(part, 1, Wrench::at(from_j, force));
    }

    /// The vectors from the origins of bodies i and j to the point of the joint on body j.
    fn arms_of_bodies(&self, at: &Situation<'_, S>) -> [Vec2<S>; 2] {
        let place = self.joint.place(&at.j().pose);
        [place - at.i().pose.r, place - at.j().pose.r]
    }
}

impl Force for Friction {
    const PARTS: &'static [Part] = &[
        Part { name: "dry", nature: Nature::Dissipative },
        Part { name: "viscous", nature: Nature::Dissipative },
    ];
    const TOUCHES_OR_RUBS: bool = true;

    fn bodies<S>(e: &Friction<S>) -> Vec<BodyId> {
        e.joint.bodies().into()
    }

    fn reaction<S>(e: &Friction<S>) -> Option<JointId> {
        e.load.is_none().then_some(e.joint.joint)
    }

    fn effort<S: Real>(e: &Friction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        let speed = e.speed(at);
        let per_load = -e.times_radius(e.coefficient(speed) * e.sense(speed, at.mode));
        times(e.normal(at), per_load)
    }

    fn put_effort<S: Real>(
        e: &Friction<S>,
        at: &Situation<'_, S>,
        effort: S,
        mut out: impl Wrenches<S>,
    ) {
        e.put(DRY, effort, at, &mut out);
    }

    fn arms<S: Real>(e: &Friction<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        Some(e.arms_of_bodies(at))
    }

    fn action<S: Real>(e: &Friction<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let [dry, viscous] = e.efforts(at);
        e.put(DRY, dry, at, &mut out);
        e.put(VISCOUS, viscous, at, &mut out);
    }

    fn result_quantities<S>(e: &Friction<S>) -> &'static [ResultQuantity] {
        match e.joint.turns() {
            true => &TURNING,
            false => &SLIDING,
        }
    }

    fn results<S: Real>(e: &Friction<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let [dry, viscous] = e.efforts(at);
        let sticks = if at.mode.holds() { S::one() } else { S::zero() };
        out.copy_from_slice(&[dry + viscous, e.normal(at).0, sticks]);
    }

    fn switch_count<S: Real>(e: &Friction<S>) -> usize {
        match Self::reaction(e) {
            Some(_) if e.joint.holds_angle => 2,
            Some(_) if !e.joint.turns() => 1,
            _ => 0,
        }
    }

    fn switches<S: Real>(e: &Friction<S>, at: &Situation<'_, S>, out: &mut [S]) {
        let (across, _) = e.across(at);
        out[ACROSS] = across;
        if let Some(tilts) = out.get_mut(TILTS) {
            let more = e.per_torque() * at.reaction.torque.abs() - across.abs();
            *tilts = S::select(e.guide, more, -S::one());
        }
    }

    fn behaviour<S: Real>(e: &Friction<S>) -> Option<Behaviour<S>> {
        e.velocity.is_none().then_some(Behaviour::Sticks)
    }

    fn threshold<S: Real>(e: &Friction<S>, at: &Situation<'_, S>) -> S {
        e.joint.rate(at.i(), at.j())
    }

    fn limit<S: Real>(e: &Friction<S>, at: &Situation<'_, S>) -> (S, Wrench<S>) {
        times(e.normal(at), e.times_radius(e.r#static.unwrap_or(e.kinetic)))
    }

    fn holding(e: &Friction<Tape>, _: f64, value: f64) -> Option<Constraint<Tape>> {
        let coordinate = Followed::Quantity(Box::new((*e.joint.coordinate).clone()));
        Some(holding(coordinate, Tape::from(value)))
    }

    fn symbols(e: &Friction) -> Vec<SceneSymbol> {
        let [body_i, body_j] = e.joint.bodies();
        let end = |body, k: usize| SymbolEnd {
            body,
            point: Some(e.joint.ends[k].s),
            axis: e.joint.ends[k].axis,
        };
        let mark = if e.joint.turns() { Mark::RubbingPin } else { Mark::RubbingSlide };
        vec![SceneSymbol::new(mark, end(body_i, 0), end(body_j, 1))]
    }

    fn fault(e: &Friction) -> Option<(&'static str, String)> {
        let negative = |field, x: f64| (x < 0.0).then(|| (field, must("not be negative")));
        let positive = |field, x: Option<f64>| {
            x.is_some_and(|x| x <= 0.0).then(|| (field, must("be positive")))
        };
        let below = || ("static", must("not be below kinetic"));
        belongs(e)
            .or_else(|| negative("kinetic", e.kinetic))
            .or_else(|| e.r#static.is_some_and(|most| most < e.kinetic).then(below))
            .or_else(|| positive("radius", e.radius))
            .or_else(|| negative("guide", e.guide))
            .or_else(|| positive("stribeck", e.stribeck))
            .or_else(|| negative("viscous", e.viscous))
            .or_else(|| positive("velocity", e.velocity))
            .or_else(|| negative("load", e.load.unwrap_or(0.0)))
    }
}

/// A load with its derivatives, times a factor.
fn times<S: Real>((load, slope): (S, Wrench<S>), factor: S) -> (S, Wrench<S>) {
    (factor * load, Wrench { force: slope.force.scale(factor), torque: factor * slope.torque })
}

fn must(be: &str) -> String {
    format!("must {be}")
}

/// The fault of a field that is missing or does not belong to the joint.
fn belongs(e: &Friction) -> Option<(&'static str, String)> {
    let (field, message) = match (e.joint.turns(), e.radius) {
        (true, None) => {
            ("radius", "missing: friction in a revolute joint needs the radius of its pin")
        }
        (false, Some(_)) => ("radius", "belongs to revolute joints; remove it"),
        _ if e.guide != 0.0 && (e.joint.turns() || !e.joint.holds_angle) => {
            ("guide", "belongs to translational joints; remove it")
        }
        _ => return None,
    };
    Some((field, message.to_string()))
}
