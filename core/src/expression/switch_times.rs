//! The times at which switches that depend on the time alone change their piece.
//!
//! The function σ(t) of a switch is bounded on an interval by interval arithmetic, in the mean value form σ(c) +
//! σ′([a, b]) ([a, b] - c). Where the bounds contain no boundary, no switch lies there. Where σ′ has one sign, each
//! boundary between σ(a) and σ(b) is passed once, at a time found by bisection. Otherwise the interval is halved.
//! Every switch is therefore found, unless σ passes a boundary twice within rounding errors; the signs at the ends of
//! such an interval are compared.
//!
//! σ may contain other switches. The search then proceeds between the times of these switches, where each of them
//! holds one piece.

use super::tape::Values;
use super::{FormulaSwitch, Tape};
use crate::math::{each, Dual, Interval, Lift, Listed, Real, ShortArray};

/// Largest number of times.
const MOST_TIMES: usize = 1_000_000;
/// Largest number of intervals for one switch between two times of other switches.
const MOST_INTERVALS: usize = 20 * MOST_TIMES;
/// Bounds count as rounding errors if they are at most this number of times as wide as those at a single time.
const NOISE: f64 = 4.0;
/// Slopes below this value count as rounding errors of a constant.
const CONSTANT: f64 = 1e-280;

/// More switches than an integration can step to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooManySwitches;

/// Adds the times strictly between `span[0]` < `span[1]` at which a switch of an expression that depends on the time
/// alone changes its piece, ascending.
///
/// # Errors
/// More than a million of them.
pub fn switch_times(
    tape: &Tape,
    parameters: &[f64],
    span: [f64; 2],
    out: &mut Vec<f64>,
) -> Result<(), TooManySwitches> {
    search(tape, &tape.switches(), parameters, span, out)
}

/// The switches of an expression of one variable, such as a curve. The variable replaces the time.
///
/// # Errors
/// As [`switch_times`].
pub fn switch_places(
    tape: &Tape,
    parameters: &[f64],
    span: [f64; 2],
    out: &mut Vec<f64>,
) -> Result<(), TooManySwitches> {
    let varies = |s: FormulaSwitch| FormulaSwitch { time: s.time || s.state, state: false, ..s };
    let switches: Vec<FormulaSwitch> = tape.switches().into_iter().map(varies).list();
    search(tape, &switches, parameters, span, out)
}

fn search(
    tape: &Tape,
    switches: &[FormulaSwitch],
    parameters: &[f64],
    span: [f64; 2],
    out: &mut Vec<f64>,
) -> Result<(), TooManySwitches> {
    let mut times: Vec<f64> = Vec::new();
    let timed = switches.iter().enumerate().filter(|(_, switch)| switch.time && !switch.state);
    for (k, switch) in timed {
        let mut found = Vec::new();
        let cuts: Vec<f64> = [&span[..1], &times, &span[1..]].concat();
        for cut in cuts.windows(2) {
            let mut pieces = natural(tape, switches, parameters, middle(cut[0], cut[1]));
            pieces.truncate(k);
            let search = SwitchSearch { tape, parameters, k, pieces, switch };
            search.run([cut[0], cut[1]], span, &mut found)?;
        }
        times.append(&mut found);
        times.sort_by(f64::total_cmp);
        times.dedup();
        times.retain(|t| span[0] < *t && *t < span[1]);
        if times.len() > MOST_TIMES {
            return Err(TooManySwitches);
        }
    }
    // a boundary that is only touched is not a switch
    let ends: Vec<f64> = [&span[..1], &times, &span[1..]].concat();
    let between = ends.windows(2).map(|w| natural(tape, switches, parameters, middle(w[0], w[1])));
    let between: Vec<Vec<f64>> = between.list();
    let changes = between.windows(2).map(|w| w[0].iter().zip(&w[1]).any(|(a, b)| differ(*a, *b)));
    times.iter().zip(changes).filter(|(_, changes)| *changes).map(|(t, _)| *t).append_to(out);
    Ok(())
}

/// Whether two pieces are different; NaN is equal to NaN.
pub(crate) fn differ(a: f64, b: f64) -> bool {
    a.to_bits() != b.to_bits() && !(a.is_nan() && b.is_nan())
}

/// The piece of each switch at a time; NaN for switches that depend on the state, and on a boundary.
pub fn pieces_at(tape: &Tape, parameters: &[f64], t: f64) -> Vec<f64> {
    natural(tape, &tape.switches(), parameters, t)
}

fn natural(tape: &Tape, switches: &[FormulaSwitch], parameters: &[f64], t: f64) -> Vec<f64> {
    let mut pieces = Vec::with_capacity(switches.len());
    let values = PieceValues { tape, parameters, t, pieces: &[] };
    tape.switch_functions(&values, |_, sigma| {
        let switch = &switches[pieces.len()];
        let state = switch.state;
        pieces.push(if state { f64::NAN } else { switch.boundaries.piece(sigma) });
    });
    pieces
}

fn middle(a: f64, b: f64) -> f64 {
    a + 0.5 * (b - a)
}

/// Values at a time, or at all times of an interval. A switch that depends on the time alone uses no variable. In an
/// expression of one variable, the variable replaces the time.
struct PieceValues<'a, T> {
    tape: &'a Tape,
    parameters: &'a [f64],
    t: T,
    /// The pieces that are held for the first switches.
    pieces: &'a [f64],
}

impl<T: Real> Values<T> for PieceValues<'_, T> {
    fn parameter(&self, k: usize) -> T {
        T::constant(self.parameters[k])
    }
    fn time(&self) -> T {
        self.t
    }
    fn variable(&self, _: usize) -> T {
        self.t
    }
    fn piece(&self, k: usize) -> f64 {
        let k = k - self.tape.switch_range().start;
        self.pieces.get(k).copied().unwrap_or(f64::NAN)
    }
}

/// The search for the times of one switch, while the preceding switches hold their pieces.
struct SwitchSearch<'a> {
    tape: &'a Tape,
    parameters: &'a [f64],
    k: usize,
    pieces: Vec<f64>,
    switch: &'a FormulaSwitch,
}

impl SwitchSearch<'_> {
    fn sigma<T: Real>(&self, t: T) -> T {
        let Self { tape, parameters, pieces, .. } = self;
        let (mut at, mut sigma) = (0, T::zero());
        tape.switch_functions(&PieceValues { tape, parameters, t, pieces }, |_, x| {
            if at == self.k {
                sigma = x;
            }
            at += 1;
        });
        sigma
    }

    fn run(
        &self,
        part: [f64; 2],
        span: [f64; 2],
        out: &mut Vec<f64>,
    ) -> Result<(), TooManySwitches> {
        let spacing = 4.0 * f64::EPSILON * span[0].abs().max(span[1].abs());
        let mut budget = MOST_INTERVALS;
        let mut open = vec![part];
        while let Some([a, b]) = open.pop() {
            budget = budget.checked_sub(1).ok_or(TooManySwitches)?;
            let c = middle(a, b);
            let (bounds, slope, noise) = self.bounds([a, b], c);
            let (_, count) = self.switch.boundaries.between(bounds.low, bounds.high);
            if count == 0.0 || slope.largest_magnitude() < CONSTANT {
                continue;
            }
            if slope.contains_zero() && b - a > spacing && bounds.spread() > NOISE * noise {
                open.extend([[c, b], [a, c]]);
            } else {
                self.pass([a, b], out)?;
            }
        }
        Ok(())
    }

    /// Bounds of σ and of its derivative from a to b, and the width of the bounds at c.
    fn bounds(&self, [a, b]: [f64; 2], c: f64) -> (Interval, Interval, f64) {
        let t = Interval::new(a, b);
        let whole = self.sigma(Dual::<1, Interval>::variable(t, 0));
        let centre = self.sigma(Dual::<1, Interval>::lift(Interval::constant(c))).value;
        let slope = whole.slope[0];
        let mean = centre + slope * (t - Interval::constant(c));
        (whole.value.and(mean), slope, centre.spread())
    }

    /// Adds the times at which σ passes the boundaries between its values at a and b.
    fn pass(&self, ends: [f64; 2], out: &mut Vec<f64>) -> Result<(), TooManySwitches> {
        let [at_a, at_b] = ends.each(|t| self.sigma(t));
        let (first, count) = self.switch.boundaries.between(at_a.min(at_b), at_a.max(at_b));
        if out.len() as f64 + count > MOST_TIMES as f64 {
            return Err(TooManySwitches);
        }
        let sign = (at_b - at_a).signum();
        for k in 0..count as usize {
            let boundary = self.switch.boundaries.at(first + k as f64);
            // a boundary at a belongs to the preceding interval
            if sign * (at_a - boundary) < 0.0 {
                out.push(root(ends, |t| sign * (self.sigma(t) - boundary)));
            }
        }
        Ok(())
    }
}

/// The first time at which g ≥ 0, given that g < 0 at the first end and g ≥ 0 at the second.
fn root([mut a, mut b]: [f64; 2], g: impl Fn(f64) -> f64) -> f64 {
    // the secant is exact for a linear function
    let [at_a, at_b] = each([a, b], &g);
    let guess = a - at_a * (b - a) / (at_b - at_a);
    let near = 4.0 * f64::EPSILON * guess.abs().max((b - a).abs());
    for t in [guess - near, guess, guess + near] {
        if a < t && t < b {
            *(if g(t) < 0.0 { &mut a } else { &mut b }) = t;
        }
    }
    if g(a) >= 0.0 {
        return a;
    }
    loop {
        let t = middle(a, b);
        if t <= a || t >= b {
            return b;
        }
        *(if g(t) < 0.0 { &mut a } else { &mut b }) = t;
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Expression, Names, Symbol};
    use super::*;

    struct OnlyTime;

    impl Names for OnlyTime {
        fn resolve(&self, name: &str) -> Option<Symbol> {
            match name {
                "t" => Some(Symbol::Time),
                "p" => Some(Symbol::Parameter(0)),
                "x" => Some(Symbol::Variable(0)),
                _ => None,
            }
        }
        fn known(&self) -> Vec<String> {
            Vec::new()
        }
    }

    fn times(law: &str, span: [f64; 2]) -> Vec<f64> {
        let tape = Expression::parse(law).expect("a law").compile(&OnlyTime).expect("a tape");
        let mut out = Vec::new();
        switch_times(&tape, &[5.2], span, &mut out).expect("few");
        out.sort_by(f64::total_cmp);
        out
    }

    #[test]
    fn linear_conditions_switch_exactly_where_written() {
        assert_eq!(times("if(t<5, 0, if(t<5.2, 20, 0))", [0.0, 10.0]), [5.0, 5.2]);
        assert_eq!(times("if(t<=p, 1, x) + step(t - 0.3)", [0.0, 10.0]), [0.3, 5.2]);
        assert_eq!(times("max(t, 2) - min(3*t, 12)", [0.0, 10.0]), [2.0, 4.0]);
        assert_eq!(times("if(t<5, 0, 1)", [6.0, 10.0]), [0.0; 0]);
        assert_eq!(times("if(x<5, 0, 1) + abs(p)", [0.0, 10.0]), [0.0; 0]);
        assert_eq!(times("abs(0*t) + floor(0*t + 2)", [0.0, 10.0]), [0.0; 0]);
    }

    #[test]
    fn every_crossing_of_a_curve_is_found() {
        let close = |found: Vec<f64>, expected: Vec<f64>| {
            assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
            let worst = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-14 * 10.0, "{worst:e}: {found:?} {expected:?}");
        };
        let pi = std::f64::consts::PI;
        let both =
            |k: i32| [pi / 6.0, 5.0 * pi / 6.0].map(|x| (x + 2.0 * pi * f64::from(k)) / 30.0);
        let sines = (0..48).flat_map(both).filter(|t| *t < 10.0).collect();
        close(times("if(sin(30*t) > 0.5, 1, 0)", [0.0, 10.0]), sines);
        let floors = (1..70).map(|k| f64::from(k) / 7.0).collect();
        close(times("floor(7*t)", [0.0, 10.0]), floors);
        // two crossings 2e-6 apart, and none for a curve that only touches
        close(times("if((t-3)^2 < 1e-12, 1, 0)", [0.0, 10.0]), vec![3.0 - 1e-6, 3.0 + 1e-6]);
        // 2 e-fold arches of floor(3 sin t)
        let at = |y: f64| [(y / 3.0).asin(), pi - (y / 3.0).asin()];
        let mut arch: Vec<f64> = [at(1.0), at(2.0)].concat();
        arch.sort_by(f64::total_cmp);
        close(times("floor(3*sin(t) + 0*t)", [0.01, 3.0]), arch);
    }

    #[test]
    fn a_switch_inside_a_condition_is_a_switch() {
        // a square wave of period 2
        let found = times("if(floor(t) - 2*floor(t/2) < 0.5, 1, -1)", [0.0, 5.5]);
        assert_eq!(found, [1.0, 2.0, 3.0, 4.0, 5.0]);
        // |t - 1| - 0.5 has zeros at 0.5 and 1.5 and a corner at 1
        let found = times("if(abs(t - 1) < 0.5, 1, 0)", [0.0, 5.0]);
        assert!(found.len() == 3 && (found[0] - 0.5).abs() < 1e-15, "{found:?}");
        assert_eq!(found[1..], [1.0, 1.5]);
    }

    #[test]
    fn too_many_switches_are_refused() {
        let tape = Expression::parse("floor(1e9*t)").expect("a law").compile(&OnlyTime);
        let mut out = Vec::new();
        let found = switch_times(&tape.expect("a tape"), &[], [0.0, 1.0], &mut out);
        assert_eq!(found, Err(TooManySwitches));
    }
}
