//! Integrals of a quantity and of its square over a run.
//!
//! In each step of the interpolant, Gauss's rule with two points at the ends of the step (Lobatto's rule) is exact for
//! polynomials of degree 15 with nine points, and of degree 7 with five points. Its error has order 17 or 9 in the step.
//! That of an interpolant has at most order 10, and at most order 6 if its degree is 4 or less, where five points
//! suffice. Motions that drivers determine have no error between the outputs. Their interpolant has degree 5.
//!
//! A quantity that jumps or has a kink within a step, or that a step does not resolve, shows in its series of Legendre
//! polynomials, whose coefficients do not decay: such steps get nine points, and are then halved. Events, switches and
//! phases end steps. The last point of a step is the number before its end, so that it belongs to the step.

use super::instants::below;
use super::Read;
use crate::math::{each, Listed, Ordered};

/// The points from 1 to 0 with their weights on [-1, 1]: of nine points, and of five.
const NINE: [[f64; 2]; 5] = [
    [1.0, 1.0 / 36.0],
    [0.899_757_995_411_460_2, 0.165_495_361_560_805_52],
    [0.677_186_279_510_737_7, 0.274_538_712_500_161_7],
    [0.363_117_463_826_178_2, 0.346_428_510_973_046_33],
    [0.0, 4096.0 / 11025.0],
];
const FIVE: [[f64; 2]; 3] =
    [[1.0, 0.1], [0.654_653_670_707_977_1, 49.0 / 90.0], [0.0, 32.0 / 45.0]];
/// Number of points in a part of a step.
const POINTS: usize = 9;
/// Highest degree of an interpolant for which five points suffice.
const LOW: usize = 4;
/// Number of times that are read together. It is a multiple of the number of lanes, so that the grouping of states does
/// not depend on the blocks.
const BLOCK: usize = 1024;
/// Error of a panel, relative to the integral of the magnitude.
const TOLERANCE: f64 = 1e-12;
/// Largest deviation within a panel, relative to the mean magnitude. It bounds the error of derivatives beside a kink.
const DEVIATION: f64 = 1e-9;
/// A series whose last coefficients are below this fraction of those before them decays.
const DECAY: f64 = 0.125;
/// Smaller deviations that halving does not reduce are errors of the values, relative to the mean magnitude. Any
/// deviations are after some halvings: such values are zero with rounding errors.
const NOISE: f64 = 1e-4;
const HALVINGS: u32 = 3;
/// Width of a panel that is not halved, relative to the largest time or to the whole span.
const NARROW: f64 = 1e-13;
/// Largest number of panels that are halved.
const MOST: usize = 20_000;

/// A quantity at points with weights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Integrals {
    /// The points in the order of the run, s, with their weights and values.
    pub t: Vec<f64>,
    pub weights: Vec<f64>,
    pub values: Vec<f64>,
    /// The times at which the quantity jumps within a step.
    pub jumps: Vec<f64>,
}

impl Integrals {
    /// By the trapezoidal rule, for a run without an interpolant.
    pub fn of_outputs(t: &[f64], values: &[f64]) -> Self {
        let last = t.len() - 1;
        let weight = |k: usize| (t[(k + 1).min(last)] - t[k.saturating_sub(1)]) / 2.0;
        let weights = (0..=last).map(weight).list();
        Self { t: t.to_vec(), weights, values: values.to_vec(), jumps: Vec::new() }
    }

    /// The points in the steps between `bounds` of an interpolant.
    pub fn points(bounds: &[f64], degree: usize) -> Vec<f64> {
        let rule = rule_of(degree);
        bounds.windows(2).flat_map(|ends| points([ends[0], ends[1]], rule)).list()
    }

    /// In the steps between `bounds` of an interpolant, with the values at their [`points`](Self::points). Steps beside
    /// the times `near` are not halved. None if `read` has no value.
    pub fn of_steps(
        (bounds, degree): (&[f64], usize),
        values: &[f64],
        near: &[f64],
        read: Read<'_>,
    ) -> Option<Self> {
        let ends = bounds.windows(2).map(|ends| [ends[0], ends[1]]);
        let values = values.chunks_exact(2 * rule_of(degree).len() - 1);
        let mut panels: Vec<Panel> = ends.zip(values).map(Panel::new).list();
        for panel in &mut panels {
            let [a, b] = panel.ends;
            panel.done = near.iter().any(|t| (2.0 * t - a - b).abs() <= 5.0 * (b - a).abs());
        }
        let mut jumps = Vec::new();
        let whole = bounds[bounds.len() - 1] - bounds[0];
        while panels.len() <= bounds.len() + MOST
            && refine(&mut panels, whole.abs(), &mut jumps, read)?
        {}
        let place = |t: &f64| whole.signum() * t;
        panels.order_by(|a, b| place(&a.ends[0]).total_cmp(&place(&b.ends[0])));
        jumps.order_by(f64::total_cmp);
        let weights = panels.iter().flat_map(|of| {
            let half = (of.ends[1] - of.ends[0]) / 2.0;
            both_sides(of.rule()).map(move |[_, weight]| half * weight)
        });
        Some(Self {
            weights: weights.list(),
            t: panels.iter().flat_map(|of| points(of.ends, of.rule())).list(),
            values: panels.iter().flat_map(|of| of.values.iter().copied()).list(),
            jumps,
        })
    }

    /// The integral of the quantity, or of its square.
    pub fn of_power(&self, power: i32) -> f64 {
        self.weights.iter().zip(&self.values).map(|(w, x)| w * x.powi(power)).sum()
    }

    /// The mean of the quantity, or of its square: the last value if all times are equal.
    pub fn mean_of_power(&self, power: i32) -> f64 {
        match self.weights.iter().sum::<f64>() {
            0.0 => self.values.last().map_or(f64::NAN, |x| x.powi(power)),
            span => self.of_power(power) / span,
        }
    }
}

/// Reads values in blocks of times.
pub fn in_blocks(t: &[f64], read: Read<'_>) -> Option<Vec<f64>> {
    let mut values = Vec::with_capacity(t.len());
    for block in t.chunks(BLOCK) {
        values.extend(read(block)?);
    }
    Some(values)
}

/// Divides the panels with the largest errors; returns whether there were any.
fn refine(
    panels: &mut Vec<Panel>,
    span: f64,
    jumps: &mut Vec<f64>,
    read: Read<'_>,
) -> Option<bool> {
    let means = each([0, 1], |k| panels.iter().map(|of| of.size(k)).sum::<f64>() / span);
    let excesses = panels.iter().map(|of| of.excess(means, span)).list();
    let most = excesses.iter().copied().fold(0.0, f64::max);
    let is_rough = |k: &usize| excesses[*k] > 1.0 && excesses[*k] >= most / 16.0;
    let mut rough: Vec<usize> = (0..panels.len()).filter(is_rough).list();
    let found = !rough.is_empty();
    rough.retain(|k| !panels[*k].ends_at_a_jump(span, jumps));
    let parts = rough.iter().flat_map(|k| panels[*k].parts());
    let values = in_blocks(&parts.flat_map(|ends| points(ends, &NINE)).list(), read)?;
    let mut values = values.chunks_exact(POINTS);
    for k in rough {
        let parts = panels[k].parts().into_iter().zip(&mut values);
        let mut parts: Vec<Panel> = parts.map(Panel::new).list();
        let done = panels[k].is_noise(&parts, means, span);
        let halvings = panels[k].halvings + parts.len() as u32 - 1;
        parts.iter_mut().for_each(|part| (part.done, part.halvings) = (done, halvings));
        panels.append(&mut parts);
        panels.swap_remove(k);
    }
    Some(found)
}

/// The rule for the steps of an interpolant.
fn rule_of(degree: usize) -> &'static [[f64; 2]] {
    if degree <= LOW {
        &FIVE
    } else {
        &NINE
    }
}

/// The points and weights on [-1, 1], ascending.
fn both_sides(rule: &'static [[f64; 2]]) -> impl Iterator<Item = [f64; 2]> {
    let below = rule.iter().map(|[x, weight]| [-x, *weight]);
    below.chain(rule.iter().rev().skip(1).copied())
}

fn points([a, b]: [f64; 2], rule: &'static [[f64; 2]]) -> Vec<f64> {
    let at = |[x, _]: [f64; 2]| (a + b) / 2.0 + x * (b - a) / 2.0;
    let mut found: Vec<f64> = both_sides(rule).map(at).list();
    let (forward, last) = ((b - a).signum(), found.len() - 1);
    found[0] = a;
    found[last] = if a == b { b } else { forward * below(forward * b) };
    found
}

/// A quantity in a step or in a part of one.
struct Panel {
    ends: [f64; 2],
    values: Vec<f64>,
    /// The rest of the series of the quantity and of its square.
    rest: [f64; 2],
    /// Whether it is not divided.
    done: bool,
    /// The number of halvings that have led to it.
    halvings: u32,
}

impl Panel {
    fn new((ends, values): ([f64; 2], &[f64])) -> Self {
        let values = values.to_vec();
        let mut found = Self { ends, values, rest: [0.0; 2], done: false, halvings: 0 };
        found.rest = each([1, 2], |power| found.rest_of(power));
        found
    }

    fn rule(&self) -> &'static [[f64; 2]] {
        if self.values.len() < POINTS {
            &FIVE
        } else {
            &NINE
        }
    }

    fn width(&self) -> f64 {
        (self.ends[1] - self.ends[0]).abs()
    }

    /// The parts with nine points that replace it.
    fn parts(&self) -> Vec<[f64; 2]> {
        let [a, b] = self.ends;
        let middle = (a + b) / 2.0;
        match self.values.len() < POINTS {
            true => vec![[a, b]],
            false => vec![[a, middle], [middle, b]],
        }
    }

    /// The integral of the magnitude of the quantity, or of its square.
    fn size(&self, k: usize) -> f64 {
        let size = |([_, weight], x): ([f64; 2], &f64)| weight * x.abs().powi(k as i32 + 1);
        self.width() / 2.0 * both_sides(self.rule()).zip(&self.values).map(size).sum::<f64>()
    }

    /// The rests of both as multiples of the allowed ones; zero if the panel is not divided.
    fn excesses(&self, means: [f64; 2], span: f64) -> [f64; 2] {
        let allowed = (TOLERANCE * span / self.width()).min(DEVIATION);
        let is_counted = |k: usize| !self.done && self.rest[k] > 0.0;
        each([0, 1], |k| if is_counted(k) { self.rest[k] / (allowed * means[k]) } else { 0.0 })
    }

    fn excess(&self, means: [f64; 2], span: f64) -> f64 {
        self.excesses(means, span).into_iter().fold(0.0, f64::max)
    }

    /// Whether it is too narrow for halves, so that the quantity jumps in it.
    fn ends_at_a_jump(&mut self, span: f64, jumps: &mut Vec<f64>) -> bool {
        let [a, b] = self.ends;
        self.done = (b - a).abs() <= NARROW * a.abs().max(b.abs()).max(span);
        if self.done {
            jumps.push((a + b) / 2.0);
        }
        self.done
    }

    /// Whether its rests are small or both halves keep them.
    fn is_noise(&self, halves: &[Self], means: [f64; 2], span: f64) -> bool {
        let excesses = self.excesses(means, span);
        let is_noise = |k: usize| {
            let keep = halves.iter().all(|half| half.rest[k] > DECAY * self.rest[k]);
            let is_small = self.rest[k] < NOISE * means[k] || self.halvings >= HALVINGS;
            excesses[k] <= 1.0 || keep && is_small
        };
        halves.len() > 1 && is_noise(0) && is_noise(1)
    }

    /// A bound of the rest of the series of Legendre polynomials through powers of the values: the last coefficients,
    /// and less if they decay. Jumps, kinks and roots let the last coefficients of nine decay by less than 0.2 for each
    /// two, wherever they are.
    fn rest_of(&self, power: i32) -> f64 {
        let (mut series, count) = ([0.0; POINTS], self.values.len());
        for ([x, weight], value) in both_sides(self.rule()).zip(&self.values) {
            let [mut p, mut next] = [1.0, x];
            for (k, coefficient) in series[..count].iter_mut().enumerate() {
                let order = k as f64;
                let norm = if k + 1 < count { order + 0.5 } else { order / 2.0 };
                *coefficient += norm * weight * p * value.powi(power);
                let after = (2.0 * order + 3.0) * x * next - (order + 1.0) * p;
                [p, next] = [next, after / (order + 2.0)];
            }
        }
        let pair = |k: usize| series[k].hypot(series[k + 1]);
        let [last, before] = [pair(count - 2), pair(count - 4)];
        let (decay, power) = match count < POINTS {
            true => (last / before, 3),
            false => ((last / before).max(before / pair(count - 6)), 4),
        };
        match decay < DECAY {
            true => last * decay.powi(power),
            false => last,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(bounds: &[f64], f: impl Fn(f64) -> f64) -> (Integrals, usize) {
        with_degree(9, bounds, f)
    }

    fn with_degree(degree: usize, bounds: &[f64], f: impl Fn(f64) -> f64) -> (Integrals, usize) {
        let mut count = 0;
        let mut read = |t: &[f64]| {
            count += t.len();
            Some(t.iter().map(|t| f(*t)).collect())
        };
        let values = in_blocks(&Integrals::points(bounds, degree), &mut read).expect("values");
        let found = Integrals::of_steps((bounds, degree), &values, &[], &mut read).expect("values");
        (found, count)
    }

    #[test]
    fn a_smooth_quantity_needs_no_other_points() {
        let bounds: Vec<f64> = (0..=20).map(|k| f64::from(k) / 2.0).collect();
        let (found, count) = found(&bounds, f64::sin);
        assert_eq!((count, found.jumps.len()), (180, 0));
        assert!((found.of_power(1) - (1.0 - 10f64.cos())).abs() < 1e-13);
        assert!((found.of_power(2) - (5.0 - 20f64.sin() / 4.0)).abs() < 1e-13);
    }

    #[test]
    fn five_points_serve_short_steps() {
        let bounds: Vec<f64> = (0..=50).map(|k| f64::from(k) / 5.0).collect();
        let (smooth, count) = with_degree(4, &bounds, f64::sin);
        assert!(count == 250 && (smooth.of_power(1) - (1.0 - 10f64.cos())).abs() < 1e-11);
        let (kinked, _) = with_degree(4, &bounds, |t| t.sin().abs());
        assert!((kinked.of_power(1) - (7.0 + 10f64.cos())).abs() < 1e-11);
    }

    #[test]
    fn jumps_and_kinks_within_a_step_cost_no_accuracy() {
        let bounds = [0.0, 0.7, 3.0];
        let (kinked, count) = found(&bounds, |t| (t - 1.1).abs());
        let expected = (1.1 * 1.1 + 1.9 * 1.9) / 2.0;
        assert!((kinked.of_power(1) - expected).abs() < 5e-12, "{}", kinked.of_power(1) - expected);
        assert!(kinked.jumps.is_empty() && count < 1000, "{count}");
        let (stepped, _) = found(&bounds, |t| if t < 1.1 { 2.0 } else { -1.0 });
        assert!((stepped.of_power(1) - 0.3).abs() < 1e-11);
        assert!((stepped.of_power(2) - 6.3).abs() < 1e-11);
        assert!(stepped.jumps.len() == 1 && (stepped.jumps[0] - 1.1).abs() < 1e-11);
        let (back, _) = found(&[3.0, 0.7, 0.0], |t| (t - 1.1).abs());
        assert!((back.of_power(1) + expected).abs() < 5e-12);
        assert!(back.t.windows(2).all(|pair| pair[0] > pair[1]));
    }

    #[test]
    fn a_jump_beside_the_end_of_a_step_is_found() {
        for place in [1e-3, 1e-9, 0.019, 0.98, 1.0 - 1e-9] {
            let (found, _) = found(&[0.0, 1.0, 2.0], |t| if t < place { 2.0 } else { 0.5 });
            assert!((found.of_power(1) - 1.0 - 1.5 * place).abs() < 1e-11, "{place}");
        }
        let (found, count) = found(&[0.0, 1.0, 2.0], |t| if t < 1.0 { 2.0 } else { 0.5 });
        assert!((found.of_power(1) - 2.5).abs() < 1e-15 && count == 18);
    }

    #[test]
    fn a_quantity_that_oscillates_within_a_step_is_resolved() {
        let (found, _) = found(&[0.0, 10.0], |t| (9.0 * t).sin());
        assert!((found.of_power(1) - (1.0 - 90f64.cos()) / 9.0).abs() < 1e-11);
        assert!((found.of_power(2) - (5.0 - 180f64.sin() / 36.0)).abs() < 1e-11);
    }

    #[test]
    fn errors_of_the_values_are_not_resolved() {
        let noise = |t: f64| 1e-7 * (1e9 * t).sin();
        let bounds: Vec<f64> = (0..=50).map(f64::from).collect();
        let (found, count) = found(&bounds, |t| 1.0 + noise(t));
        assert!(count <= 6 * 9 * 50 && found.jumps.is_empty(), "{count}");
        assert!((found.of_power(1) - 50.0).abs() < 1e-6);
    }

    #[test]
    fn rounding_errors_are_not_resolved() {
        let bounds: Vec<f64> = (0..=50).map(f64::from).collect();
        let (found, count) = found(&bounds, |t| 1e-17 * (1e9 * t).sin());
        assert!(count <= 40 * 9 * 50 && found.jumps.is_empty(), "{count}");
    }

    #[test]
    fn a_line_at_outputs() {
        let t = [0.0, 0.5, 2.0];
        let found = Integrals::of_outputs(&t, &t.map(|t| 3.0 * t + 1.0));
        assert!((found.of_power(1) - 8.0).abs() < 1e-15);
        assert_eq!(Integrals::of_outputs(&[1.0, 1.0], &[2.0, 3.0]).of_power(1), 0.0);
    }
}
