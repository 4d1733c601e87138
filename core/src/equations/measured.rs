//! Position quantities of elements at a state, with their rates and accelerations.

use super::kinematics::Motions;
use super::laws::Laws;
use crate::elements::{At, BodyId, Constraint, Coordinate, Measured};
use crate::expression::Tape;
use crate::math::{Jet, Lift, Listed, Local, Pose, Real, Twist, Vec2};
use crate::model::Model;

/// An element of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementId {
    /// A joint or driver, by index.
    Constraint(usize),
    /// A force, by index.
    Force(usize),
}

/// The position quantities that can be measured on an element.
pub fn offered<S>(model: &Model<S>, id: ElementId) -> &'static [Measured] {
    match id {
        ElementId::Constraint(k) => model.constraints[k].element.measured(),
        ElementId::Force(k) => model.forces[k].element.measured(),
    }
}

/// The measured quantities of an element with their first and second time derivatives, in the order of [`offered`].
///
/// `motions` contains positions and velocities, `a` the accelerations, shape (n_q).
pub fn measured<S: Real>(
    model: &Model<S>,
    id: ElementId,
    motions: &Motions<S>,
    a: &[S],
) -> Vec<Jet<S>> {
    let mut values = measured_of_part(model, id, motions, a);
    let further = match id {
        ElementId::Force(k) => model.forces[k].further.clone(),
        ElementId::Constraint(_) => 0..0,
    };
    // the least of several gaps
    for part in further {
        let own = measured_of_part(model, ElementId::Force(part), motions, a);
        for (to, own) in values.iter_mut().zip(own) {
            *to = Jet::select(*to - own, own, *to);
        }
    }
    values
}

fn measured_of_part<S: Real>(
    model: &Model<S>,
    id: ElementId,
    motions: &Motions<S>,
    a: &[S],
) -> Vec<Jet<S>> {
    let mut values = vec![Jet::zero(); offered(model, id).len()];
    let pose = |body: &BodyId| moving(model, *body, motions, a);
    match id {
        ElementId::Constraint(k) => {
            let (item, slots) = (&model.constraints[k], &model.layout.constraints[k]);
            let bodies: Vec<_> = item.bodies.iter().map(pose).list();
            let (own, rates) = motions.own(slots.own);
            let columns = slots.own.range();
            let own: Vec<_> = columns
                .zip(own.iter().zip(rates))
                .map(|(c, (u, rate))| Jet::new(*u, *rate, a[c]))
                .list();
            let at = At { bodies: &bodies, own: &own, t: Jet::zero() };
            item.element.map(&mut |s| Jet::lift(*s)).measure(&at, &mut values);
        }
        ElementId::Force(k) => {
            let item = &model.forces[k];
            let bodies: Vec<_> = item.bodies.iter().map(pose).list();
            let at = At { bodies: &bodies, own: &[], t: Jet::zero() };
            let element = match &item.law {
                Some(law) if item.element.follows() => {
                    let coordinate = |body: BodyId, c: Coordinate| {
                        c.of(&moving(model, body, motions, a), &Twist::zero())
                    };
                    let (parameters, t) = (&model.parameters, Jet::zero());
                    let pieces = &motions.pieces;
                    let values = Laws {
                        parameters,
                        t,
                        coordinate,
                        own: [&[]; 2],
                        z: &[],
                        pieces,
                        function: None,
                    };
                    law.map(&mut |tape: &Tape| tape.evaluate(&values))
                }
                _ => item.element.map(&mut |s| Jet::lift(*s)),
            };
            element.measure(&at, &mut values);
        }
    }
    values
}

/// The lag Φ of the driver whose effort force `k` limits, with its derivatives for accelerations `a`, shape (n_q). Zero for
/// another force.
pub fn lag<S: Real>(model: &Model<S>, k: usize, motions: &Motions<S>, a: &[S], t: S) -> Jet<S> {
    let item = &model.forces[k];
    let bodies: Vec<_> = item.bodies.iter().map(|body| moving(model, *body, motions, a)).list();
    let t = Jet::new(t, S::one(), S::zero());
    let at = At { bodies: &bodies, own: &[], t };
    let mut lag = [Jet::zero()];
    let residual = |driver: Option<&Constraint<Jet<S>>>, lag: &mut [Jet<S>]| {
        driver.into_iter().for_each(|driver| driver.residual(&at, lag));
    };
    match &item.law {
        None => residual(item.element.map(&mut |s| Jet::lift(*s)).driver(), &mut lag),
        Some(law) => {
            let coordinate = |body: BodyId, c: Coordinate| {
                c.of(&moving(model, body, motions, a), &Twist::zero())
            };
            let [own, rates] = motions.internals();
            let places = own.iter().zip(rates).enumerate();
            let first = model.layout.n_q - own.len();
            let own: Vec<_> = places.map(|(k, (u, rate))| Jet::new(*u, *rate, a[first + k])).list();
            let (parameters, pieces) = (&model.parameters, &motions.pieces);
            let own = [&own[..], &[]];
            let values = Laws { parameters, t, coordinate, own, z: &[], pieces, function: None };
            let driver = law.driver().map(|driver| {
                let mut driver = driver.clone();
                driver.lift_limit();
                driver.map(&mut |tape: &Tape| tape.evaluate(&values))
            });
            residual(driver.as_ref(), &mut lag);
        }
    }
    lag[0]
}

/// The position of a body-fixed point, with velocity and acceleration.
pub fn point<S: Real>(
    model: &Model<S>,
    body: BodyId,
    s: Local<S>,
    motions: &Motions<S>,
    a: &[S],
) -> [Jet<S>; 2] {
    let p = moving(model, body, motions, a).point(Local { x: Jet::lift(s.x), y: Jet::lift(s.y) });
    [p.x, p.y]
}

/// The pose of a body as a function of time to second order.
fn moving<S: Real>(model: &Model<S>, body: BodyId, motions: &Motions<S>, a: &[S]) -> Pose<Jet<S>> {
    let motion = &motions[body.0];
    let (pose, twist) = (motion.pose, motion.twist);
    let [ax, ay, alpha] = model.layout.bodies[body.0].of(a);
    let r = Vec2::new(
        Jet::new(pose.r.x, twist.velocity.x, ax),
        Jet::new(pose.r.y, twist.velocity.y, ay),
    );
    Pose::new(r.x, r.y, Jet::new(pose.angle, twist.omega, alpha))
}
