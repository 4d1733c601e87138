//! Extreme values of measures with derivatives.

use super::reader::SlopeRow;
use super::statistics::{Found, RunTimes, SlopeRows};
use crate::analyses::statistics::Extreme;
use crate::math::ShortArray;

/// Part of the span of a measure by which it may change within a step at the time of its extreme value.
const FLAT: f64 = 1e-4;
/// Part of the span of a measure within a step below which its change counts as zero at an end of the run.
const STILL: f64 = 1e-9;
/// Part of its change beside an extreme value by which the rate of a measure may differ from a line there.
const LINEAR: f64 = 0.25;
/// Derivatives of two equally large maxima that differ by less than this fraction are equal.
const ALIKE: f64 = 1e-6;

/// The derivatives of an extreme value and of its time.
pub(super) struct Stationary {
    pub of_value: Vec<f64>,
    pub of_time: Found,
}

impl Stationary {
    /// The derivatives of an extreme value near `t`.
    ///
    /// # Errors
    /// The measure is not stationary there: it has a kink, which may move.
    fn at(
        rows: &SlopeRows,
        k: usize,
        (t, value): (f64, f64),
        times: RunTimes<'_>,
    ) -> Result<Self, String> {
        if let Some(corner) = rows.corner(t) {
            let (of_value, of_time) = (corner.whole(k, value), Ok(corner.late.clone()));
            return Ok(Self { of_value, of_time });
        }
        if let Some(end) = times.near_end(t) {
            let change = (rows.at(end)?.values[k][1] * times.step(end)).abs();
            let is_still = change <= STILL * rows.span[k];
            if end == t || is_still {
                return Self::at_end(rows, k, end, (times.outputs.last() == Some(&end), is_still));
            }
        }
        let (row, beside) = (rows.at(t)?, times.beside(t));
        let fixed =
            || Self { of_value: row.slopes[k].clone(), of_time: Ok(vec![0.0; rows.variables]) };
        let d = beside[2] - t;
        let change = (row.values[k][1] * times.step(t)).abs();
        if d <= 0.0 || rows.span[k] == 0.0 {
            return Ok(fixed());
        }
        if change > FLAT * rows.span[k] {
            return Err(format!("the value has a kink at t = {t:.6} s, which may move"));
        }
        let [a, b, c, e] = beside.each(|t| rows.at(t));
        let [a, b, c, e] = [a?, b?, c?, e?];
        let sample =
            |of: &dyn Fn(&SlopeRow) -> f64| Quartic::through([of(a), of(b), of(row), of(c), of(e)]);
        let rate = sample(&|row| row.values[k][1]);
        let second = rate.slope(0.0);
        if rate.bends() >= LINEAR * second.abs() {
            let text =
                format!("the value is flat near t = {t:.6} s, so that this time is not determined");
            return Ok(Self { of_time: Err(text), ..fixed() });
        }
        // the value is stationary at t + late d
        let late = -row.values[k][1] / second;
        if late.abs() > 1.0 {
            return Err(format!("the value has a kink near t = {t:.6} s, which may move"));
        }
        let second = rate.slope(late);
        let (mut of_value, mut of_time) = (Vec::new(), Vec::new());
        for j in 0..rows.variables {
            let slopes = sample(&|row| row.slopes[k][j]);
            of_value.push(slopes.value(late));
            of_time.push(-slopes.slope(late) / second);
        }
        Ok(Self { of_value, of_time: Ok(of_time) })
    }

    /// The derivatives of an extreme value at the first or the last time of a run.
    ///
    /// # Errors
    /// The reason for which there are no derivatives.
    fn at_end(
        rows: &SlopeRows,
        k: usize,
        t: f64,
        (is_last, is_still): (bool, bool),
    ) -> Result<Self, String> {
        let (of_value, late) = match is_last {
            true => (rows.final_slopes(k)?, rows.end.clone()),
            false => (rows.at(t)?.slopes[k].clone(), vec![0.0; rows.variables]),
        };
        let end = if is_last { "end" } else { "start" };
        let of_time = match is_still && !rows.is_constant(k) {
            true => Err(format!(
                "the value is stationary at the {end} of the run, t = {t:.6} s, so that this time can move to one side only"
            )),
            false => Ok(late),
        };
        Ok(Self { of_value, of_time })
    }
}

/// A polynomial through values at -2, -1, 0, 1 and 2.
struct Quartic([f64; 5]);

impl Quartic {
    fn through([a, b, o, c, e]: [f64; 5]) -> Self {
        let first = (8.0 * (c - b) - (e - a)) / 12.0;
        let second = (16.0 * (b + c) - (a + e) - 30.0 * o) / 24.0;
        let third = ((e - a) - 2.0 * (c - b)) / 12.0;
        let fourth = ((a + e) - 4.0 * (b + c) + 6.0 * o) / 24.0;
        Self([o, first, second, third, fourth])
    }

    /// The largest coefficient of the third and the fourth degree.
    fn bends(&self) -> f64 {
        self.0[3].abs().max(self.0[4].abs())
    }

    fn value(&self, x: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    fn slope(&self, x: f64) -> f64 {
        let [_, a, b, c, d] = self.0;
        a + x * (2.0 * b + x * (3.0 * c + x * 4.0 * d))
    }
}

impl SlopeRows {
    /// The derivatives of an extreme value that is reached at one time or more.
    ///
    /// # Errors
    /// It has a kink, or the values at the times change differently, so that there is no derivative.
    pub(super) fn agreed(
        &self,
        k: usize,
        (found, rivals): (&Extreme, &[f64]),
        times: RunTimes<'_>,
    ) -> Result<Stationary, String> {
        let (t, value) = (found.t, found.value);
        let first = Stationary::at(self, k, (t, value), times)?;
        for rival in rivals {
            let other = Stationary::at(self, k, (*rival, value), times)?;
            alike((t, &first.of_value), (*rival, &other.of_value))?;
        }
        Ok(first)
    }
}

/// Checks that the derivatives of equal values at two times are equal.
///
/// # Errors
/// They are not, so that the larger of both values has no derivative.
pub(super) fn alike((t, a): (f64, &[f64]), (rival, b): (f64, &[f64])) -> Result<(), String> {
    let size = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if a.iter().zip(b).any(|(a, b)| (a - b).abs() > ALIKE * size) {
        return Err(format!(
            "the value is reached at t = {t:.6} s and at t = {rival:.6} s, and changes differently there"
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_of_fourth_degree_is_reproduced() {
        let of = |x: f64| 1.0 + x * (2.0 - x * (3.0 + x * (0.5 - 0.25 * x)));
        let rate = |x: f64| 2.0 - x * (6.0 + x * (1.5 - x));
        let found = Quartic::through([-2.0, -1.0, 0.0, 1.0, 2.0].map(of));
        for x in [-1.5, 0.0, 0.3, 0.9] {
            assert!((found.value(x) - of(x)).abs() < 1e-14, "{x}");
            assert!((found.slope(x) - rate(x)).abs() < 1e-14, "{x}");
        }
    }
}
