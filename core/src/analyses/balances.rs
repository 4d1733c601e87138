//! The balances of energies and of reactions in a run up to a state, for conditions.
//!
//! Reports relate a balance to the largest energies or forces of a whole run. A condition can use only the run so
//! far, so its balance is the balance of a run that ends at the state. The scales are those of
//! `python/kempe/energy.py` and `python/kempe/newton_euler.py`.

use crate::equations::newton_euler::BodyBalance;

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
#[derive(Clone, Copy, Debug)]
pub(super) struct EnergyBalance {
    start: Option<f64>,
    low: Energies<f64>,
    high: Energies<f64>,
    /// Change of the total since the start, relative to the scale.
    pub present: f64,
}

impl EnergyBalance {
    /// The balance at the start, before the first state.
    pub fn new() -> Self {
        let [low, high] = [[f64::INFINITY; 5], [f64::NEG_INFINITY; 5]];
        Self { start: None, low, high, present: f64::NAN }
    }

    /// Adds a state with these energies.
    pub fn add(&mut self, energies: Energies<f64>) {
        for (k, energy) in energies.into_iter().enumerate() {
            self.low[k] = self.low[k].min(energy);
            self.high[k] = self.high[k].max(energy);
        }
        let start = *self.start.get_or_insert(total(energies));
        self.present = (total(energies) - start) / self.scale();
    }

    /// The largest of the kinetic energy and of the ranges of the other energies, J.
    fn scale(&self) -> f64 {
        let ranges = (1..5).map(|k| self.high[k] - self.low[k]);
        let resolved = RESOLVED_ENERGY * self.high[1].abs().max(self.low[1].abs());
        or_one(ranges.fold(self.high[0], f64::max).max(resolved))
    }
}

/// The largest balance of a body, and the largest forces and moments in the run so far.
#[derive(Clone, Debug)]
pub(super) struct ReactionBalance {
    /// Largest force, N, and moment, N·m, on each body.
    largest: Vec<[f64; 2]>,
    lever: f64,
    /// The larger of the residuals of forces and moments of all bodies, relative to their scales.
    pub present: f64,
}

impl ReactionBalance {
    /// The balance at the start, before the first state.
    pub fn new() -> Self {
        Self { largest: Vec::new(), lever: 0.0, present: f64::NAN }
    }

    /// Adds a state with these balances of the bodies.
    pub fn add(&mut self, bodies: &[BodyBalance]) {
        self.largest.resize(bodies.len(), [0.0; 2]);
        for (largest, body) in self.largest.iter_mut().zip(bodies) {
            *largest = [largest[0].max(body.largest_force), largest[1].max(body.largest_moment)];
            self.lever = self.lever.max(body.lever);
        }
        let most = |k: usize| self.largest.iter().fold(0.0, |most: f64, own| most.max(own[k]));
        let [mut force, mut moment] = [most(0), most(1)];
        if self.lever > 0.0 {
            [force, moment] = [force.max(moment / self.lever), moment.max(force * self.lever)];
        }
        let shares = self.largest.iter().zip(bodies).flat_map(|(own, body)| {
            let force_scale = or_one(own[0].max(RESOLVED_FORCE * force));
            let moment_scale = or_one(own[1].max(RESOLVED_FORCE * moment));
            [body.force / force_scale, body.moment / moment_scale]
        });
        // NaN where the reactions are not unique
        let larger =
            |most: f64, share: f64| if most >= share || most.is_nan() { most } else { share };
        self.present = shares.fold(0.0, larger);
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

    #[test]
    fn residuals_are_relative_to_the_largest_forces_so_far() {
        let mut balance = ReactionBalance::new();
        let body =
            |force, largest_force| BodyBalance { force, largest_force, ..BodyBalance::default() };
        let mut after = |bodies: &[BodyBalance]| {
            balance.add(bodies);
            balance.present
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
        let mut balance = ReactionBalance::new();
        let largest =
            BodyBalance { moment: 1e-3, largest_force: 10.0, lever: 0.5, ..BodyBalance::default() };
        balance.add(&[largest]);
        // without a moment of its own, 1e-4 of 10 N at 0.5 m
        assert!((balance.present - 1e-3 / 5e-4).abs() < 1e-15);
    }
}
