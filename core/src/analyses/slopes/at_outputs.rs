//! Extreme values at the outputs, with derivatives. Quantities of a whole run have no other extreme values.

use super::extremes::alike;
use super::statistics::{Found, SlopeRows};
use crate::analyses::statistics::RIVAL;
use crate::analyses::sweep::Statistic;
use crate::math::Listed;

impl SlopeRows {
    /// The derivatives of the largest value, the least value or the largest magnitude of measure `k` at some times.
    ///
    /// # Errors
    /// It is reached at two times, and changes differently there.
    pub(super) fn slopes_of_extreme(&self, times: &[f64], k: usize, statistic: Statistic) -> Found {
        let sides = self.sides(times, k)?;
        let most = sides.iter().map(|(_, x, _)| signed(statistic, *x)).fold(f64::NAN, f64::max);
        let level = most - RIVAL * most.abs();
        let mut largest = sides.into_iter().filter(|(_, x, _)| signed(statistic, *x) >= level);
        let (t, x, slopes) = largest.next().ok_or("it has no value")?;
        let factor = |x: f64| if statistic == Statistic::Peak { x.signum() } else { 1.0 };
        let own: Vec<f64> = slopes.iter().map(|slope| factor(x) * slope).list();
        for (rival, x, slopes) in largest {
            let other: Vec<f64> = slopes.iter().map(|slope| factor(x) * slope).list();
            alike((t, &own), (rival, &other))?;
        }
        Ok(own)
    }

    /// The values at some times with their derivatives; where the motion changes, those before and after it.
    fn sides(&self, times: &[f64], k: usize) -> Result<Vec<(f64, f64, Vec<f64>)>, String> {
        let (mut all, last) = (Vec::new(), times.last());
        for t in times {
            match self.corner(*t) {
                Some(corner) => all.extend(corner.sides.iter().map(|side| {
                    let x = side.values[k][0];
                    (*t, x, corner.whole(k, x))
                })),
                None if last == Some(t) => {
                    let x = self.end_row()?.values[k][0];
                    all.push((*t, x, self.final_slopes(k)?));
                }
                None => {
                    let row = self.at(*t)?;
                    all.push((*t, row.values[k][0], row.slopes[k].clone()));
                }
            }
        }
        Ok(all)
    }
}

/// A value with the sign that makes the extreme value a maximum.
fn signed(statistic: Statistic, x: f64) -> f64 {
    match statistic {
        Statistic::Min => -x,
        Statistic::Peak => x.abs(),
        _ => x,
    }
}
