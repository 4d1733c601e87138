//! A model prepared for many runs gives the same bits as a model at its first run.

use crate::mechanisms::{four_bar, model, start, SLIDER_CRANK};
use kempe::analyses::dynamics::{
    dynamics, Auto, Options, Prepared, Run, Scheme, Stabilization, Statistics,
};
use kempe::analyses::State;
use kempe::integrate::{Dop853, Flow, Radau, Rk45};
use kempe::model::Model;
use std::sync::Arc;

/// Steps and grids of few states and of many, by several methods; some want the model over lanes, some do not.
fn ways() -> Vec<Options> {
    let base = Options::new(0.3);
    let every = |n: f64| Some(0.3 / n);
    vec![
        Options { output_step: every(5.0), ..base.clone() },
        Options { output_step: every(90.0), ..base.clone() },
        base.clone(),
        Options {
            method: Scheme::Dop853(Dop853::new(1e-5, 1e-8)),
            output_step: every(77.0),
            ..base.clone()
        },
        Options {
            method: Scheme::Radau(Radau::new(1e-5, 1e-8)),
            output_step: every(50.0),
            ..base.clone()
        },
        Options {
            method: Scheme::Rk45(Rk45::new(1e-6, 1e-9)),
            stabilization: Stabilization::BaumgarteFromStep,
            output_step: every(40.0),
            ..base.clone()
        },
        Options { output_step: every(90.0), ..Options::classical(0.3) },
    ]
}

fn same(a: &Run, b: &Run) {
    assert_eq!(a.trajectory, b.trajectory);
    assert_eq!(a.dense, b.dense);
    assert_eq!(a.choice, b.choice);
    let taken = |run: &Run| (run.statistics.evaluations, run.statistics.factorisations);
    assert_eq!(taken(a), taken(b));
}

fn alone(m: &Model, s: &State, options: &Options) -> Run {
    dynamics(m, s, options, |_| Flow::Continue).unwrap()
}

#[test]
fn whatever_was_run_before() {
    let (flagship, at) = four_bar();
    let slider = model(SLIDER_CRANK);
    let set = [("crank.angle", "0.5"), ("crank.omega", "6")];
    let (slider_at, _) = start(&slider, &set, &[("piston.x", "0.4")]);
    let redundant = flagship.allowing_redundancy();
    for (m, s) in [(&flagship, &at), (&slider, &slider_at), (&redundant, &at)] {
        let prepared = Prepared::new(m);
        for options in ways().iter().chain(ways().iter().rev()) {
            let run = prepared.dynamics(s, options, |_| Flow::Continue).unwrap();
            same(&run, &alone(m, s, options));
        }
    }
}

#[test]
fn on_several_threads_at_once() {
    let (m, s) = four_bar();
    let expected: Vec<Run> = ways().iter().map(|options| alone(&m, &s, options)).collect();
    let prepared = Prepared::new(Arc::new(m));
    std::thread::scope(|scope| {
        for first in 0..4 {
            let (prepared, s, expected) = (&prepared, &s, &expected);
            scope.spawn(move || {
                for k in 0..expected.len() {
                    let k = (k + first) % expected.len();
                    let run = prepared.dynamics(s, &ways()[k], |_| Flow::Continue).unwrap();
                    same(&run, &expected[k]);
                }
            });
        }
    });
}

#[test]
fn a_foreign_allocator_can_hold_it() {
    assert!(align_of::<Prepared<Arc<Model>>>() <= align_of::<u64>());
}

#[test]
fn the_wall_time_is_that_of_the_given_clock() {
    use std::sync::atomic::{AtomicU32, Ordering};
    static CALLS: AtomicU32 = AtomicU32::new(0);
    let clock = || 2.5 * f64::from(CALLS.fetch_add(1, Ordering::Relaxed));
    let (m, start) = four_bar();
    let prepared = Prepared::new(&m).with_clock(clock);
    let run = prepared.dynamics(&start, &Options::new(0.01), |_| Flow::Continue).unwrap();
    assert_eq!(run.statistics.seconds, 2.5);
}

/// Each evaluation of the equations of motion takes one factorisation; a few more belong to the start and to outputs.
#[test]
fn evaluations_and_factorisations_agree() {
    let (m, s) = four_bar();
    for method in [
        Scheme::Rk45(Rk45::new(1e-6, 1e-9)),
        Scheme::Dop853(Dop853::new(1e-6, 1e-9)),
        Scheme::Auto(Auto::default()),
    ] {
        let options = Options { method, dense_output: false, ..Options::new(0.3) };
        let found = alone(&m, &s, &options).statistics;
        let Statistics { steps, evaluations, factorisations, .. } = found;
        assert!(
            (evaluations..=evaluations + 2 * steps + 10).contains(&factorisations),
            "{factorisations} factorisations in {evaluations} evaluations and {steps} steps"
        );
    }
}
