//! The angles at which a wheel meshes.
//!
//! The equation of meshed wheels is linear in the angle of a wheel about its centre, and holds modulo a constant.
//! Wheels of radii 1 and 2 mesh at two angles of the second wheel, half a turn apart, for each position of the first
//! wheel.

use super::equation_placement::Freedom;
use super::placer::Placer;
use crate::math::Listed;
use std::f64::consts::TAU;

/// Largest number of angles.
const MOST: usize = 1000;
/// Largest difference between two angles that count as equal up to whole turns, rad.
const SAME: f64 = 1e-7;

impl Placer<'_> {
    /// The angles at which the equation `f` of constraint `k` holds, up to whole turns. `x` is one of them, and the
    /// angles nearest to `x` come first. Also returns whether the list is complete.
    pub fn meshes(&self, k: usize, x: f64, f: impl Fn(f64) -> f64) -> (Vec<f64>, bool) {
        let h = 1e-5;
        let slope = (f(x + h) - f(x - h)) / (2.0 * h);
        let modulus = self.equations.model.constraints[k].element.modulus();
        let Some(step) = modulus.map(|modulus| modulus / slope) else { return (vec![x], true) };
        let returns = |n: &usize| {
            let turned = *n as f64 * step;
            (turned - TAU * (turned / TAU).round()).abs() <= SAME
        };
        let all = (1..=MOST).find(returns);
        let nth = |n: usize| if n % 2 == 1 { n.div_ceil(2) as f64 } else { -((n / 2) as f64) };
        ((0..all.unwrap_or(MOST)).map(|n| x + nth(n) * step).list(), all.is_some())
    }

    /// Whether body `b` turns about the point at which constraint `k` holds it, so that the equation is linear.
    pub fn turns_about_its_centre(&self, k: usize, b: usize, freedom: &Freedom) -> bool {
        let item = &self.equations.model.constraints[k];
        let end = item.bodies.iter().position(|body| body.0 == b);
        match (freedom, end) {
            (Freedom::Turn(leg, _), Some(end)) => item.element.attachment(end).s == leg.own,
            _ => false,
        }
    }
}
