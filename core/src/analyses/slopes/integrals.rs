//! Integrals, means and root mean squares with derivatives.

use super::statistics::{Found, SlopePlan, SlopeRows};
use crate::analyses::statistics::Integrals;
use crate::analyses::sweep::{Series, Statistic};
use crate::math::{Listed, ShortArray};

/// Distance of points from the end of a step, relative to that of the next ones.
const INSIDE: f64 = 1e-8;

impl SlopePlan {
    /// The plan of a statistic that follows from integrals.
    pub(super) fn of_integral(series: &Series<'_>, statistic: Statistic) -> Option<Self> {
        let found = series.integrals().ok()?;
        Some(match found.jumps.first() {
            None => Self::Integral(statistic, Integrals { t: inside(&found.t), ..found.clone() }),
            Some(t) => Self::None(format!("the value jumps at t = {t:.6} s, which may move")),
        })
    }
}

impl SlopeRows {
    /// Integrals with the values of measure `k`.
    fn integrals(&self, k: usize, at: &Integrals) -> Result<Integrals, String> {
        let values = at.t.iter().map(|t| Ok(self.at(*t)?.values[k][0]));
        Ok(Integrals { values: values.collect::<Result<_, String>>()?, ..at.clone() })
    }

    /// The derivatives of a statistic that follows from integrals of measure `k`: those within the run, and those of
    /// the times at which the motion changes or the run ends.
    pub(super) fn slopes_of_integral(&self, of: Statistic, k: usize, at: &Integrals) -> Found {
        let found = self.integrals(k, at)?;
        let (value, span) = (of.of_integrals(&found), found.weights.iter().sum::<f64>());
        let end = self.end_row()?.values[k][0];
        // the integral of f(x), a factor on it, and its change with the last time
        let (power, factor, grows) = match of {
            Statistic::Integral => (1, 1.0, end),
            _ if span == 0.0 => return self.final_slopes(k),
            Statistic::Mean => (1, 1.0 / span, end - value),
            _ if value == 0.0 => {
                return Err("the value is zero, where a magnitude has no derivative".to_string())
            }
            _ => (2, 0.5 / (span * value), end * end - value * value),
        };
        let f = |x: f64| [x.powi(power), f64::from(power) * x.powi(power - 1)];
        let mut slopes: Vec<f64> = self.end.iter().map(|late| grows * late).list();
        let mut add = |factor: f64, of: &[f64]| {
            slopes.iter_mut().zip(of).for_each(|(sum, slope)| *sum += factor * slope);
        };
        // where something decays fast, the time moves with the change that has begun it
        let zero = vec![0.0; self.variables];
        let (mut before, mut last, mut past) = (&zero, 0.0, f64::NEG_INFINITY);
        for (t, (weight, x)) in found.t.iter().zip(found.weights.iter().zip(&found.values)) {
            let (row, [value, by_x]) = (self.at(*t)?, f(*x));
            if row.late != *before {
                let corner = self.last_corner(*t).filter(|corner| corner.t() > past);
                let begun = corner.map(|corner| f(corner.sides[1].values[k][0])[0]);
                add(-last, &changed(before, &row.late));
                add(begun.unwrap_or(value), &changed(&row.late, before));
            }
            add(weight * by_x, &row.slopes[k]);
            add(weight * by_x * row.values[k][1], &row.late);
            (before, last, past) = (&row.late, value, *t);
        }
        add(-last, before);
        for corner in &self.corners {
            let [before, after] = [0, 1].each(|side| f(corner.sides[side].values[k][0])[0]);
            add(before - after, &corner.late);
        }
        Ok(slopes.iter().map(|slope| factor * slope).list())
    }
}

/// The numbers that differ from others, and 0 in place of the rest.
fn changed(of: &[f64], others: &[f64]) -> Vec<f64> {
    of.iter().zip(others).map(|(x, other)| if x == other { 0.0 } else { *x }).list()
}

/// Moves those of some points that are at the ends of steps a little inside. At the end itself, a kink such as that of
/// |x| where x is zero may have the derivatives of either side.
fn inside(all: &[f64]) -> Vec<f64> {
    let gap = |k: usize, other: Option<usize>| Some(all.get(other?)? - all[k]);
    let moved = |k: usize| {
        let next = match (gap(k, k.checked_sub(1)), gap(k, Some(k + 1))) {
            (Some(a), Some(b)) if a.abs() < INSIDE * b.abs() => b,
            (Some(a), Some(b)) if b.abs() < INSIDE * a.abs() => a,
            (Some(only), None) | (None, Some(only)) => only,
            _ => 0.0,
        };
        all[k] + INSIDE * next
    };
    (0..all.len()).map(moved).list()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_points_at_the_ends_of_steps_move() {
        for bounds in [[-1.0, 0.0, 3.0], [3.0, 0.0, -1.0]] {
            let (points, way) = (Integrals::points(&bounds, 9), bounds[2] - bounds[0]);
            for (k, (t, moved)) in points.iter().zip(inside(&points)).enumerate() {
                let ways = [moved - bounds[k / 9], bounds[k / 9 + 1] - moved];
                assert!(ways.iter().all(|own| own * way > 0.0), "{t} {moved}");
                assert!((t - moved).abs() < 2e-9 && (k % 9 % 8 == 0 || *t == moved), "{t} {moved}");
            }
        }
        assert_eq!(inside(&[2.0]), [2.0]);
    }
}
