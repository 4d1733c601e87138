//! Changes of sign within a step.

use super::*;
use kempe::integrate::{
    locate, scan, Bounds, Direction, Rk4, Rk45, Scan, StepControl, StepPath, Watch,
};
use std::f64::consts::PI;

/// All events of cos t - c on (0, 20) at the given tolerance.
fn crossings(direction: Direction, span: (f64, f64), level: f64) -> Vec<f64> {
    let mut found = vec![];
    let mut z = [0.0; 2];
    let mut system = plain(2, oscillator);
    let mut observer = |step: &Step<'_>| {
        let g = |_: f64, y: &[f64]| y[0] - level;
        if let Some(t) = locate(step, &mut z, g, direction, 1e-13) {
            assert!((z[0] - level).abs() < 1e-12);
            found.push(t);
        }
        Flow::Continue
    };
    let method = Rk45 { control: StepControl { max_step: 0.01, ..StepControl::new(1e-12, 1e-14) } };
    let mut y = [span.0.cos(), -span.0.sin()];
    method.integrate(&mut system, span.0, span.1, &mut y, &mut observer).unwrap();
    found
}

#[test]
fn events_are_located() {
    let falling = crossings(Direction::Falling, (0.0, 20.0), 0.0);
    let rising = crossings(Direction::Rising, (0.0, 20.0), 0.0);
    let any = crossings(Direction::Any, (0.0, 20.0), 0.0);
    assert_eq!((falling.len(), rising.len(), any.len()), (3, 3, 6));
    for (k, t) in any.iter().enumerate() {
        assert!((t - PI * (k as f64 + 0.5)).abs() < 1e-12, "{t}");
        assert_eq!(*t, if k % 2 == 0 { falling[k / 2] } else { rising[k / 2] });
    }
    let backward = crossings(Direction::Any, (20.0, 0.0), 0.5);
    assert_eq!(backward.len(), 7);
    assert!(backward.windows(2).all(|w| w[0] > w[1]));
    assert!((backward[6] - PI / 3.0).abs() < 1e-12, "{:e}", backward[6] - PI / 3.0);
}

/// A single step of y′ = 1 from -1 to 1, so that y = t.
fn with_unit_step(mut look: impl FnMut(&Step<'_>)) {
    let mut observer = |step: &Step<'_>| {
        look(step);
        Flow::Continue
    };
    let mut system = plain(1, |_: f64, _: &[f64], dy: &mut [f64]| dy[0] = 1.0);
    Rk4::new(2.0).integrate(&mut system, -1.0, 1.0, &mut [-1.0], &mut observer).unwrap();
}

#[test]
fn hard_roots_are_bracketed_in_few_evaluations() {
    let functions: [fn(f64) -> f64; 6] = [
        |t| t - 0.3,
        |t| (t - 0.3).powi(3),
        |t| if t < 0.3 { -1.0 } else { 1e9 },
        |t| (t - 0.3).cbrt(),
        |t| (20.0 * (t - 0.3)).exp() - 1.0,
        |t| (50.0 * (t - 0.3)).tanh(),
    ];
    for (k, f) in functions.iter().enumerate() {
        with_unit_step(|step| {
            let mut count = 0;
            let g = |_: f64, y: &[f64]| {
                count += 1;
                f(y[0])
            };
            let t = locate(step, &mut [0.0], g, Direction::Rising, 1e-12).unwrap();
            assert!((0.3 - 1e-15..=0.3 + 1.1e-12).contains(&t), "{k}: {:e}", t - 0.3);
            assert!(count <= 2 + 2 * 41, "{k}: {count} evaluations");
            if [0, 4, 5].contains(&k) {
                assert!(count <= 16, "{k}: {count} evaluations of a smooth function");
            }
        });
    }
}

#[test]
fn roots_at_the_ends_belong_to_one_step() {
    with_unit_step(|step| {
        let at = |c: f64| move |_: f64, y: &[f64]| y[0] - c;
        let mut y = [f64::NAN];
        assert_eq!(locate(step, &mut y, at(1.0), Direction::Any, 1e-9), Some(1.0));
        assert_eq!(y, [1.0]);
        assert_eq!(locate(step, &mut y, at(-1.0), Direction::Any, 1e-9), None);
        assert_eq!(locate(step, &mut y, at(0.0), Direction::Falling, 1e-9), None);
        assert_eq!(locate(step, &mut y, |_, _| f64::NAN, Direction::Any, 1e-9), None);
    });
}

type Functions<'a> = &'a mut dyn FnMut(f64, &[f64], &mut [f64]);

/// Functions without bounds.
struct Unbounded<'a>(Functions<'a>);

impl Watch for Unbounded<'_> {
    fn values(&mut self, t: f64, y: &[f64], _: &[usize], out: &mut [f64]) {
        self.0(t, y, out);
    }
    fn bounds(&mut self, _: usize, _: &StepPath<'_>, _: [f64; 2]) -> Option<Bounds> {
        None
    }
}

fn first(
    step: &Step<'_>,
    count: usize,
    functions: Functions<'_>,
    direction: Direction,
    until: &dyn Fn(usize) -> Option<f64>,
) -> Scan {
    let path = StepPath::new(step);
    scan(&path, (count, 12), &mut Unbounded(functions), direction, until).expect("few changes")
}

#[test]
fn several_functions_are_scanned_for_their_first_changes() {
    let band = |t: f64, middle: f64, half: f64| half - (t - middle).abs();
    let mut evaluate = |t: f64, y: &[f64], out: &mut [f64]| {
        assert!((t - y[0]).abs() < 1e-15 && out.len() == 9);
        out.copy_from_slice(&[
            t - 0.25,                         // one change
            band(t, -0.3, 0.15),              // two in a step
            (t - 0.26) * (t - 0.26) - 0.0001, // two between samples: the parabola finds them
            (t - 0.26) * (t - 0.26) + 0.0001, // none
            t + 1.0,                          // zero at the beginning: of the step before
            -1.0 - t * t,                     // always negative
            f64::NAN,                         // no sign
            1.0 - t,                          // zero at the end
            3.0 * (t - 0.25),                 // together with the first one
        ]);
    };
    with_unit_step(|step| {
        // the first ones are left out in turn
        let mut check = |without: &[usize], expected: &[(usize, bool)], t: f64| {
            let until = |k: usize| without.contains(&k).then_some(-0.9);
            let found = first(step, 9, &mut evaluate, Direction::Any, &until);
            let which: Vec<_> = found.first.iter().map(|c| (c.index, c.rising)).collect();
            assert_eq!(which, expected);
            assert!(found.first.iter().all(|c| (c.t - t).abs() < 1e-14), "{found:?}");
            assert_eq!(found.negative, [5]);
        };
        check(&[], &[(1, true)], -0.45);
        check(&[1, 2], &[(0, true), (8, true)], 0.25);
        check(&[0, 1, 2, 8], &[(7, false)], 1.0);
        let falling = first(step, 9, &mut evaluate, Direction::Falling, &|_| None);
        assert_eq!(falling.first.len(), 1);
        assert_eq!(falling.first[0].index, 1);
        assert!((falling.first[0].t + 0.15).abs() < 1e-14);
    });
}

/// Each evaluation has the cost of all functions: their number must not grow with that of the changes.
#[test]
fn a_thousand_changes_in_a_step_cost_few_evaluations() {
    for spread in [0.0, 1e-12, 1e-3] {
        let mut evaluations = 0;
        let mut evaluate = |t: f64, _: &[f64], out: &mut [f64]| {
            evaluations += 1;
            for (k, out) in out.iter_mut().enumerate() {
                let at = 0.3 + spread * ((k * 617) % 1000) as f64;
                *out = (at - t) * (2.0 + t);
            }
        };
        with_unit_step(|step| {
            let found = first(step, 1000, &mut evaluate, Direction::Any, &|_| None);
            assert_eq!(found.first.len(), if spread == 0.0 { 1000 } else { 1 });
            assert_eq!(found.first[0].index, 0);
            assert!((found.first[0].t - 0.3).abs() < 1e-14);
        });
        assert!(evaluations < 300, "{evaluations} with {spread}");
    }
}
