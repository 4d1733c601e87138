//! The settling time of a quantity.

use super::{largest, Read};
use crate::math::Listed;

/// Half width of the settling band, relative to the largest deviation from the final value.
pub const BAND: f64 = 0.005;
/// A motion has settled only if it stays in the band during this final fraction of the time.
const QUIET_SHARE: f64 = 0.1;
/// Smaller deviations are rounding errors, relative to the largest magnitude or to 1.
const NOISE: f64 = 1e-12;
/// Refinement of the time: number of intervals, and number of rounds.
const INTERVALS: usize = 8;
const ROUNDS: usize = 12;

/// Settling of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Settling {
    /// The quantity does not change.
    Constant,
    /// The quantity does not stay in the band during the last tenth of the time.
    Never,
    /// The time from which the quantity stays in the band, s.
    At(f64),
    /// The quantity has no value at one of the times that the search uses.
    Unknown,
}

/// The settling of a quantity, with a band of 0.5 % of the largest deviation from the final value.
///
/// `noise` is the largest deviation of a quantity that counts as constant. The default is 10⁻¹² of the largest
/// magnitude, and at least 10⁻¹². With `between`, the settling time is the time at which the quantity enters the
/// band; otherwise it is the first of the times `t` from which it stays in the band.
///
/// # Panics
/// If there are no values, or if the numbers of values and times differ.
pub fn settling(
    t: &[f64],
    values: &[f64],
    noise: Option<f64>,
    between: Option<Read<'_>>,
) -> Settling {
    assert_eq!(t.len(), values.len(), "a value for each time");
    let last = t.len() - 1;
    let deviation = |x: &f64| (x - values[last]).abs();
    let peak = largest(values.iter().map(deviation));
    let usual = || NOISE * largest(values.iter().map(|x| x.abs())).max(1.0);
    if peak <= noise.unwrap_or_else(usual) {
        return Settling::Constant;
    }
    // the last value is in the band
    let Some(before) = values.iter().rposition(|x| deviation(x) > BAND * peak) else {
        return Settling::Never;
    };
    let mut entered = t[before + 1];
    if let Some(read) = between {
        let band = (values[last], BAND * peak);
        match entry(t[before], entered, band, read) {
            Some(t) => entered = t,
            None => return Settling::Unknown,
        }
    }
    let is_quiet = (t[last] - entered).abs() >= QUIET_SHARE * (t[last] - t[0]).abs();
    if is_quiet {
        Settling::At(entered)
    } else {
        Settling::Never
    }
}

/// The time of the last entry into the band, between a time outside and a time inside.
fn entry(
    mut outside: f64,
    mut inside: f64,
    (last, width): (f64, f64),
    read: Read<'_>,
) -> Option<f64> {
    for _ in 0..ROUNDS {
        let step = (inside - outside) / INTERVALS as f64;
        let mut times: Vec<f64> = (0..INTERVALS).map(|k| outside + k as f64 * step).list();
        times.push(inside);
        let values = read(&times)?;
        let beyond = |k: &usize| (values[*k] - last).abs() > width;
        let k = (1..INTERVALS).rev().find(beyond).unwrap_or(0);
        (outside, inside) = (times[k], times[k + 1]);
    }
    Some(inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decay_settles_at_its_band() {
        let f = |t: f64| (-t).exp();
        let t: Vec<f64> = (0..=200).map(|k| f64::from(k) / 10.0).collect();
        let values: Vec<f64> = t.iter().map(|t| f(*t)).collect();
        let mut read = |t: &[f64]| Some(t.iter().map(|t| f(*t)).collect());
        let Settling::At(found) = settling(&t, &values, None, Some(&mut read)) else {
            panic!("it settles")
        };
        let deviation = 1.0 - f(20.0);
        assert!((found + (BAND * deviation + f(20.0)).ln()).abs() < 1e-6);
    }

    #[test]
    fn a_line_never_settles_and_a_constant_does_not_move() {
        let t = [0.0, 1.0, 2.0];
        assert_eq!(settling(&t, &[0.0, 1.0, 2.0], None, None), Settling::Never);
        assert_eq!(settling(&t, &[5.0; 3], None, None), Settling::Constant);
    }
}
