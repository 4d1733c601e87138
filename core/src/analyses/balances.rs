//! The balances of energies and of reactions in a run up to a state, for conditions.
//!
//! Reports relate a balance to the largest energies or forces of a whole run. A condition can use only the run so
//! far, so its balance is the balance of a run that ends at the state. The scales are those of
//! `python/kempe/results/energy.py` and `python/kempe/results/newton_euler.py`.

use crate::equations::newton_euler::{Balances, BodyBalance};
use crate::math::Listed;
use serde::{Deserialize, Serialize};

/// Kinetic, potential and dissipated energy, work of drivers and of applied forces, J.
pub(super) type Energies<S> = [S; 5];

/// Changes of the potential energy below this fraction of it are rounding errors.
const RESOLVED_ENERGY: f64 = 1e-6;
/// Forces and moments on a body below this fraction of the largest in the mechanism are rounding errors.
const RESOLVED_FORCE: f64 = 1e-4;

/// T + V + dissipated energy - works, J. Constant in an exact solution.
pub(super) fn total<S>([kinetic, potential, dissipated, drivers, forces]: Energies<S>) -> S
where
    S: std::ops::Add<Output = S> + std::ops::Sub<Output = S>,
{
    kinetic + potential + dissipated - drivers - forces
}

/// The balance of energy, and the ranges of the energies in the run so far.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(super) struct EnergyBalance {
    start: Option<f64>,
    low: Energies<f64>,
    high: Energies<f64>,
    /// Change of the total since the start, J.
    pub change: f64,
}

impl EnergyBalance {
    /// The balance at the start, before the first state.
    pub fn new() -> Self {
        let [low, high] = [[f64::INFINITY; 5], [f64::NEG_INFINITY; 5]];
        Self { start: None, low, high, change: f64::NAN }
    }

    /// Adds a state with these energies.
    pub fn add(&mut self, energies: Energies<f64>) {
        for (k, energy) in energies.into_iter().enumerate() {
            self.low[k] = self.low[k].min(energy);
            self.high[k] = self.high[k].max(energy);
        }
        let start = *self.start.get_or_insert(total(energies));
        self.change = total(energies) - start;
    }

    /// Allows for a change of the total by an action of the caller, J.
    pub fn allow(&mut self, change: f64) {
        if let Some(start) = &mut self.start {
            *start += change;
        }
    }

    /// The change of the total since the start, relative to the scale.
    pub fn present(&self) -> f64 {
        self.change / self.scale()
    }

    /// The largest of the kinetic energy and of the ranges of the other energies, J.
    pub fn scale(&self) -> f64 {
        let ranges = (1..5).map(|k| self.high[k] - self.low[k]);
        let resolved = RESOLVED_ENERGY * self.high[1].abs().max(self.low[1].abs());
        or_one(ranges.fold(self.high[0], f64::max).max(resolved))
    }
}

/// The largest balance of a body or of an internal coordinate, and the largest forces and moments in the run so far.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct ReactionBalance {
    /// Largest force, N, and moment, N·m, on each body.
    largest: Vec<[f64; 2]>,
    lever: f64,
    /// Largest effort on each internal coordinate, and its largest lever.
    efforts: Vec<[f64; 2]>,
}

impl ReactionBalance {
    /// Adds a state with these balances.
    pub fn add(&mut self, Balances { bodies, coordinates }: &Balances) {
        self.largest.resize(bodies.len(), [0.0; 2]);
        for (largest, body) in self.largest.iter_mut().zip(bodies) {
            *largest = [largest[0].max(body.largest_force), largest[1].max(body.largest_moment)];
            self.lever = self.lever.max(body.lever);
        }
        self.efforts.resize(coordinates.len(), [0.0; 2]);
        for (largest, own) in self.efforts.iter_mut().zip(coordinates) {
            *largest = [largest[0].max(own.largest_effort), largest[1].max(own.lever)];
        }
    }

    /// The residuals relative to their scales: of each body, the larger of force and moment, then of each internal
    /// coordinate. The scales are at least those of the force `least`, N. NaN where the reactions are not unique.
    pub fn shares(&self, at: &Balances, least: f64) -> Vec<f64> {
        let most = |k: usize| self.largest.iter().fold(0.0, |most: f64, own| most.max(own[k]));
        let [mut force, mut moment] = [most(0), most(1)];
        if self.lever > 0.0 {
            [force, moment] = [force.max(moment / self.lever), moment.max(force * self.lever)];
        }
        let of_body = |(own, body): (&[f64; 2], &BodyBalance)| {
            let force_scale = or_one(own[0].max(RESOLVED_FORCE * force).max(least));
            let moment_scale = or_one(own[1].max(RESOLVED_FORCE * moment).max(least * self.lever));
            larger(body.force / force_scale, body.moment / moment_scale)
        };
        let bodies = self.largest.iter().zip(&at.bodies).map(of_body);
        let coordinates = self.efforts.iter().zip(&at.coordinates);
        let coordinates = coordinates
            .map(|([own, lever], at)| at.effort / or_one(own.max(RESOLVED_FORCE * force * lever)));
        bodies.chain(coordinates).list()
    }

    /// The largest share at a state.
    pub fn largest(&self, at: &Balances) -> f64 {
        self.shares(at, 0.0).into_iter().fold(0.0, larger)
    }
}

/// The larger number; NaN if one of them is NaN.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() {
        a
    } else {
        b
    }
}

/// The scale, or 1 if there is no energy or force.
fn or_one(scale: f64) -> f64 {
    if scale > 0.0 {
        scale
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::newton_euler::CoordinateBalance;

    #[test]
    fn residuals_are_relative_to_the_largest_forces_so_far() {
        let mut balance = ReactionBalance::default();
        let body =
            |force, largest_force| BodyBalance { force, largest_force, ..BodyBalance::default() };
        let mut after = |bodies: &[BodyBalance]| {
            let at = Balances { bodies: bodies.to_vec(), coordinates: Vec::new() };
            balance.add(&at);
            balance.largest(&at)
        };
        assert_eq!(after(&[body(1.0, 4.0), body(0.0, 0.0)]), 0.25);
        assert_eq!(after(&[body(1.0, 2.0), body(0.0, 0.0)]), 0.25);
        assert_eq!(after(&[body(1.0, 8.0), body(0.0, 0.0)]), 0.125);
        // the force on the second body is below 1e-4 of the force on the first body
        assert!((after(&[body(0.0, 0.0), body(2e-4, 0.0)]) - 0.25).abs() < 1e-15);
        assert!(after(&[body(f64::NAN, 1.0), body(0.0, 0.0)]).is_nan());
    }

    #[test]
    fn moments_and_forces_are_compared_by_the_largest_lever() {
        let mut balance = ReactionBalance::default();
        let largest =
            BodyBalance { moment: 1e-3, largest_force: 10.0, lever: 0.5, ..BodyBalance::default() };
        let at = Balances { bodies: vec![largest], coordinates: Vec::new() };
        balance.add(&at);
        // without a moment of its own, 1e-4 of 10 N at 0.5 m
        assert!((balance.largest(&at) - 1e-3 / 5e-4).abs() < 1e-15);
    }

    #[test]
    fn internal_coordinates_count_relative_to_their_largest_effort() {
        let mut balance = ReactionBalance::default();
        let body = BodyBalance { largest_force: 100.0, ..BodyBalance::default() };
        let own = CoordinateBalance { effort: 1.0, largest_effort: 4.0, lever: 0.5 };
        let idle = CoordinateBalance { effort: 0.01, largest_effort: 0.0, lever: 2.0 };
        let at = Balances { bodies: vec![body], coordinates: vec![own, idle] };
        balance.add(&at);
        // the second one has no effort of its own: 1e-4 of 100 N times the lever
        let wanted = [0.0, 0.25, 0.5];
        assert!(balance.shares(&at, 0.0).iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-15));
    }
}
