//! The extreme value of a quantity over a run, from its outputs and its interpolant.

use super::{largest, Maxima};

/// Values that differ by less than this fraction of the largest magnitude count as equal.
const SAME: f64 = 1e-12;
/// Extreme values that differ by less than this fraction are equally large.
pub const RIVAL: f64 = 1e-9;
/// Maxima that differ by less than this fraction are equal within the error of the interpolant.
const EQUAL: f64 = 1e-7;

/// An extreme value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// Its value.
    pub value: f64,
    /// The time at which it is reached first, s.
    pub t: f64,
}

/// Times and values of a quantity. The sign makes the requested extreme value a maximum.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a> {
    /// Times, s.
    pub t: &'a [f64],
    /// Values, multiplied by the sign.
    pub values: &'a [f64],
}

/// Whether values differ by more than rounding errors.
pub fn changes(values: &[f64]) -> bool {
    let span = largest(values.iter().copied()) + largest(values.iter().map(|x| -x));
    // a span that is NaN counts as a change
    span.is_nan() || span > SAME * largest(values.iter().map(|x| x.abs()))
}

/// The largest signed value among the outputs and the maxima on the interpolant with its samples. Without an
/// interpolant, and for a constant quantity, only the outputs are used.
pub fn extreme(
    sign: f64,
    outputs: Samples<'_>,
    between: Option<(Samples<'_>, &Maxima)>,
) -> Extreme {
    let output = first(sign, outputs);
    let Some((samples, maxima)) = between.filter(|(_, maxima)| !maxima.values.is_empty()) else {
        return output;
    };
    let most = largest(maxima.values.iter().copied());
    let start = samples.t[0];
    let mut found: Option<(f64, Extreme)> = None;
    for (x, t) in maxima.values.iter().zip(&maxima.t) {
        let away = (t - start).abs();
        let equal = *x >= most - EQUAL * most.abs();
        if equal && found.is_none_or(|(least, _)| away < least) {
            found = Some((away, Extreme { value: sign * x, t: *t }));
        }
    }
    let Some((_, mut found)) = found else { return output };
    if samples.values[0] >= sign * found.value - EQUAL * found.value.abs() {
        found.t = start; // it begins at its extreme value
    }
    let room = SAME * output.value.abs();
    let is_higher = sign * output.value > sign * found.value + room;
    if is_higher && maxima.near.is_empty() {
        output
    } else {
        found
    }
}

/// The largest of the values, and the first time at which it occurs.
fn first(sign: f64, Samples { t, values }: Samples<'_>) -> Extreme {
    let most = largest(values.iter().copied());
    let room = SAME * largest(values.iter().map(|x| x.abs()));
    let k = values.iter().position(|x| *x >= most - room).unwrap_or(0);
    Extreme { value: sign * values[k], t: t[k] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equal_maxima_counts() {
        let outputs = Samples { t: &[0.0, 1.0, 2.0], values: &[0.0, 3.0, 3.0] };
        assert_eq!(extreme(1.0, outputs, None), Extreme { value: 3.0, t: 1.0 });
        let values = vec![4.0, 4.0 + 1e-9];
        let maxima = Maxima { values, t: vec![0.5, 1.5], ..Maxima::default() };
        let found = extreme(1.0, outputs, Some((outputs, &maxima)));
        assert_eq!(found, Extreme { value: 4.0, t: 0.5 });
    }

    #[test]
    fn a_minimum_has_the_sign_minus_one() {
        let outputs = Samples { t: &[0.0, 1.0], values: &[1.0, 2.0] };
        assert_eq!(extreme(-1.0, outputs, None), Extreme { value: -2.0, t: 1.0 });
    }

    #[test]
    fn rounding_errors_are_no_change() {
        assert!(!changes(&[1.0, 1.0 + 1e-13]));
        assert!(changes(&[1.0, 1.0 + 1e-11]));
    }
}
