//! The switch functions of a model, and the laws of constraints with their time derivatives.

use super::forces::{self, Acting};
use super::kinematics::Motions;
use super::laws::{self, Laws};
use crate::elements::derive::moving;
use crate::elements::{BodyId, Coordinate};
use crate::expression::Tape;
use crate::math::{Jet, Lift, Listed, Real, Twist};
use crate::model::Model;

/// σ of every switch, in the order of [`Model::switches`]. The held pieces of `motions` apply to the switches inside
/// σ.
pub fn functions<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    acting: Acting<'_, S>,
    out: &mut [S],
) {
    let parameters = &model.parameters;
    let laws = model.constraints.iter().filter_map(|item| item.law.as_ref());
    for law in laws {
        let values = laws::held(parameters, motions, &[], acting.t);
        law.visit(&mut |tape: &Tape| tape.switch_functions(&values, |k, sigma| out[k] = sigma));
    }
    for (item, slots) in model.constraints.iter().zip(&model.layout.constraints) {
        if let Some(k) = item.curve_switch {
            out[k] = motions.own(slots.own).0[0];
        }
    }
    for (k, item) in model.forces.iter().enumerate() {
        if let Some(law) = &item.law {
            let values = laws::held(parameters, motions, acting.z, acting.t);
            law.visit(&mut |tape: &Tape| tape.switch_functions(&values, |k, sigma| out[k] = sigma));
        }
        forces::switches(model, k, motions, acting, &mut out[item.first_switch..]);
    }
}

/// The value of each formula of constraint `k`, with its time derivatives along a motion without accelerations.
pub fn law_values(model: &Model, k: usize, motions: &Motions, t: f64) -> Vec<Jet> {
    let Some(law) = &model.constraints[k].law else { return Vec::new() };
    let coordinate =
        |body: BodyId, c: Coordinate| -> Jet { c.of(&moving(&motions[body.0]), &Twist::zero()) };
    let t = Jet::new(t, 1.0, 0.0);
    let (parameters, pieces) = (&model.parameters, &motions.pieces);
    let values = Laws { parameters, t, coordinate, own: [&[]; 2], z: &[], pieces, function: None };
    let mut all = Vec::new();
    law.visit(&mut |tape: &Tape| all.push(tape.evaluate(&values)));
    all
}

/// The functions of all switches with their time derivatives along the motion (v, a, ż). The second derivative of a
/// function of rates is incomplete.
pub fn functions_in_time(
    model: &Model,
    t: f64,
    [q, v, z]: [&[f64]; 3],
    [a, dz]: [&[f64]; 2],
) -> Vec<Jet> {
    let lifted: Model<Jet> = model.lift();
    let of = |x: &[f64], rate: &[f64], second: &[f64]| -> Vec<Jet> {
        let second = second.iter().copied().chain(std::iter::repeat(0.0));
        let both = x.iter().zip(rate).zip(second);
        both.map(|((x, rate), second)| Jet::new(*x, *rate, second)).list()
    };
    let (q, v, z) = (of(q, v, a), of(v, a, &[]), of(z, dz, &[]));
    let motions = Motions::at(&lifted.layout, &q, &v);
    let mut out = vec![Jet::lift(0.0); model.switches.len()];
    let acting = Acting { z: &z, lam: None, t: Jet::new(t, 1.0, 0.0) };
    functions(&lifted, &motions, acting, &mut out);
    out
}
