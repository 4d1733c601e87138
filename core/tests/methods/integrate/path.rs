//! Bounds of the interpolant, and the sign changes that they find.

use super::*;
use kempe::integrate::{crossings, Bounds, Direction, Dop853, Rk4, Rk45, StepPath, TooFast, Watch};
use kempe::math::Real;

/// Steps of the oscillator y = cos t by several methods, forward and backward, with a large offset.
fn each_step(mut look: impl FnMut(&Step<'_>)) {
    for [from, to] in [[0.0, 30.0], [30.0, 0.0]] {
        for offset in [0.0, 1e3] {
            let mut system = plain(2, |_, y, dy| dy.copy_from_slice(&[y[1], offset - y[0]]));
            let mut observer = |step: &Step<'_>| {
                look(step);
                Flow::Continue
            };
            let start = || [offset + f64::cos(from), -f64::sin(from)];
            let (system, observer) = (&mut system, &mut observer);
            Rk4::new(0.7).integrate(system, from, to, &mut start(), observer).unwrap();
            Rk45::new(1e-4, 1e-6).integrate(system, from, to, &mut start(), observer).unwrap();
            Dop853::new(1e-9, 1e-9).integrate(system, from, to, &mut start(), observer).unwrap();
        }
    }
}

#[test]
fn bounds_contain_the_interpolant_and_its_slope() {
    let mut count = 0;
    each_step(|step| {
        let path = StepPath::new(step);
        let at = |part: f64| step.t_old + part * (step.t - step.t_old);
        for [from, to] in [[0.0, 1.0], [0.2, 0.3], [0.9, 1.0], [0.4, 0.4 + 1e-6], [0.7, 0.7]] {
            let mut last: Option<(f64, [f64; 2])> = None;
            for k in 0..=8 {
                let ends = [at(from).min(at(to)), at(from).max(at(to))];
                let t = at(from + (to - from) * f64::from(k) / 8.0).clamp(ends[0], ends[1]);
                let mut y = [0.0; 2];
                step.interpolate(t, &mut y);
                for (component, value) in y.into_iter().enumerate() {
                    let Bounds { value: bounds, slope: [slope] } =
                        path.component(component, [at(from), at(to)]);
                    assert!(bounds.low <= value && value <= bounds.high, "{value} in {bounds:?}");
                    assert!(
                        (path.value(component, t) - value).abs() < 1e-12 * value.abs().max(1.0)
                    );
                    if let Some((before, old)) =
                        last.filter(|(before, _)| (before - t).abs() > 1e-3)
                    {
                        let mean = (value - old[component]) / (t - before);
                        let error = 1e-11 * value.abs().max(1.0);
                        assert!(slope.low <= mean + error && mean - error <= slope.high);
                    }
                    count += 1;
                }
                last = Some((t, y));
            }
        }
    });
    assert!(count > 10_000);
}

/// One function of t and y, with its bounds.
struct Bounded<F, G>(F, G);

impl<F: Fn(f64, f64) -> f64, G: Fn(Bounds, Bounds) -> Bounds> Watch for Bounded<F, G> {
    fn values(&mut self, t: f64, y: &[f64], _: &[usize], out: &mut [f64]) {
        out[0] = (self.0)(t, y[0]);
    }
    fn bounds(&mut self, _: usize, path: &StepPath<'_>, span: [f64; 2]) -> Option<Bounds> {
        Some((self.1)(path.time(span), path.component(0, span)))
    }
}

/// The sign changes in steps of y = t over [-1, 1] and back.
fn changes(mut watch: impl Watch) -> [Vec<f64>; 2] {
    [[-1.0, 1.0], [1.0, -1.0]].map(|[from, to]| {
        let mut found = Vec::new();
        let mut system = plain(1, |_: f64, _: &[f64], dy: &mut [f64]| dy[0] = 1.0);
        let mut observer = |step: &Step<'_>| {
            let path = StepPath::new(step);
            let all = crossings(&path, 6, &[Direction::Any], &mut watch, &|_| false);
            found = all.expect("not too fast").into_iter().map(|crossing| crossing.t).collect();
            Flow::Continue
        };
        Rk4::new(2.0).integrate(&mut system, from, to, &mut [from], &mut observer).unwrap();
        found.sort_by(f64::total_cmp);
        found
    })
}

#[test]
fn every_change_in_a_step_is_found() {
    let constant = Bounds::constant;
    for found in changes(Bounded(|_, y: f64| (1e4 * y).sin(), |_, y| (constant(1e4) * y).sin())) {
        assert_eq!(found.len(), 2 * 3183 + 1);
        let pi = std::f64::consts::PI;
        let exact = |k: usize| (k as f64 - 3183.0) * pi * 1e-4;
        assert!(found.iter().enumerate().all(|(k, t)| (t - exact(k)).abs() < 1e-14));
    }
    for half in [1e-3, 1e-8, 1e-13] {
        let narrow = Bounded(
            |t: f64, _| half - (t - 0.3).abs(),
            |t: Bounds, _| constant(half) - (t - constant(0.3)).abs(),
        );
        for found in changes(narrow) {
            assert!(
                found.len() == 2 && (found[1] - found[0] - 2.0 * half).abs() < 1e-15,
                "{found:?}"
            );
        }
    }
    let touching = |above: f64| {
        let square = |y: Bounds| (y - constant(0.3)) * (y - constant(0.3)) + constant(above);
        changes(Bounded(move |_, y: f64| (y - 0.3) * (y - 0.3) + above, move |_, y| square(y)))
    };
    assert!(touching(1e-12).iter().all(Vec::is_empty) && touching(0.0).iter().all(|t| t.len() < 2));
    assert!(touching(-1e-12).iter().all(|found| found.len() == 2));
}

#[test]
fn functions_that_are_too_fast_are_named() {
    let mut watch = Bounded(|_, y: f64| (1e9 * y).sin(), |_, y| (Bounds::constant(1e9) * y).sin());
    let mut system = plain(1, |_: f64, _: &[f64], dy: &mut [f64]| dy[0] = 1.0);
    let mut observer = |step: &Step<'_>| {
        let path = StepPath::new(step);
        let found = crossings(&path, 6, &[Direction::Any], &mut watch, &|_| false);
        assert_eq!(found, Err(TooFast(0)));
        Flow::Continue
    };
    Rk4::new(2.0).integrate(&mut system, -1.0, 1.0, &mut [-1.0], &mut observer).unwrap();
}

/// Ten distances, like those of contacts, that stay above zero.
#[derive(Default)]
struct Apart {
    bounds: usize,
    values: usize,
}

impl Watch for Apart {
    fn values(&mut self, _: f64, y: &[f64], _: &[usize], out: &mut [f64]) {
        self.values += 1;
        out.iter_mut().enumerate().for_each(|(k, out)| *out = y[0] + 2.0 + k as f64);
    }
    fn bounds(&mut self, index: usize, path: &StepPath<'_>, span: [f64; 2]) -> Option<Bounds> {
        self.bounds += 1;
        Some(path.component(0, span) + Bounds::constant(2.0 + index as f64))
    }
}

/// The certainty that nothing happens costs one bound for each function in a step, and their values at its ends.
#[test]
fn functions_away_from_zero_cost_one_bound_in_each_step() {
    let (mut watch, mut steps) = (Apart::default(), 0);
    each_step(|step| {
        let found =
            crossings(&StepPath::new(step), 6, &[Direction::Any; 10], &mut watch, &|_| true);
        assert_eq!(found, Ok(Vec::new()));
        steps += 1;
    });
    assert!(steps > 100);
    assert_eq!([watch.bounds, watch.values], [10 * steps, 2 * steps]);
}
