//! Baumgarte's stabilization with gains from the step: order, residual and energy against fixed gains.

use crate::mechanisms::{
    self, every, four_bar, largest, model, motor, residual, run, start, tolerances, worst, GRAVITY,
};
use kempe::analyses::assemble::{assemble, Request};
use kempe::analyses::dynamics::{Options, Run, Scheme, Stabilization, Stepper};
use kempe::analyses::State;
use kempe::equations::Gains;
use kempe::integrate::{Dop853, Rk4, Rk45, StepControl};
use kempe::model::Model;

const FROM_STEP: Stabilization = Stabilization::BaumgarteFromStep;
const FIXED: Stabilization = Stabilization::Baumgarte(Gains { alpha: 10.0, beta: 200.0 });

/// A crank driven along a law of time, a rod, and a slider on a spring: Φ_t and a slide are in it.
fn slider_crank() -> (Model, State) {
    let text = mechanisms::slider_crank(
        [0.5, 1.5, 0.0, 0.0],
        ["1", "2"],
        "mass = 3\ninertia = 0.1\ncenter = [0, -0.05]",
    );
    let m = model(&format!(
        "{GRAVITY}{text}{}[forces.spring]\ntype = 'spring_damper'\ni = 'ground.O'\nj = 'piston.B'\n\
         stiffness = 200\ndamping = 5\nfree_length = 1.5\n",
        motor("crank.angle", "1 + 3*t + 0.4*sin(5*t)")
    ));
    let (state, _) = start(&m, &[], &[("piston.x", "1.7")]);
    (m, state)
}

fn with(options: Options, stabilization: Stabilization) -> Options {
    Options { stabilization, ..options }
}

/// State number k of a run.
fn state(m: &Model, run: &Run, k: usize) -> State {
    let rows = k * m.layout.n_q..(k + 1) * m.layout.n_q;
    let pick = |table: &[f64]| table[rows.clone()].to_vec();
    let (q, v) = (pick(&run.trajectory.q), pick(&run.trajectory.v));
    State { t: run.trajectory.t[k], q, v, z: Vec::new() }
}

/// Largest |Φ| of all reported states.
fn open(m: &Model, run: &Run) -> f64 {
    let gaps = (0..run.trajectory.t.len()).map(|k| largest(&residual(m, &state(m, run, k))));
    gaps.fold(0.0, f64::max)
}

/// Largest change of the energy balance, J.
fn unbalanced(m: &Model, run: &Run) -> f64 {
    let energies = run.energies(m).unwrap();
    let sums: Vec<f64> =
        energies.chunks_exact(5).map(|e| e[0] + e[1] + e[2] - e[3] - e[4]).collect();
    sums.iter().fold(0.0, |most: f64, sum| most.max((sum - sums[0]).abs()))
}

/// q and v at the end of a run.
fn end(m: &Model, from: &State, options: &Options) -> Vec<f64> {
    let run = run(m, from, options);
    let State { q, v, .. } = state(m, &run, run.trajectory.t.len() - 1);
    q.into_iter().chain(v).collect()
}

fn constant(order: i32, step: f64) -> Scheme {
    match order {
        4 => Scheme::Rk4(Rk4::new(step)),
        5 => Scheme::Rk45(Rk45 {
            control: StepControl { step: Some(step), ..StepControl::default() },
        }),
        _ => Scheme::Dop853(Dop853 {
            control: StepControl { step: Some(step), ..StepControl::default() },
        }),
    }
}

/// Evaluated at every stage, gains of 1/h make RK4 one of order 2.
#[test]
fn the_order_is_kept() {
    for ((m, from), t_end) in [(four_bar(), 0.1), (slider_crank(), 0.5)] {
        let exact = end(&m, &from, &with(tolerances(t_end, 1e-13, 1e-15), Stabilization::None));
        for (order, steps) in [(4, 32), (5, 16), (8, 4)] {
            let found: Vec<(f64, f64)> = (0..3)
                .map(|halved| {
                    let scheme = constant(order, t_end / f64::from(steps << halved));
                    let options =
                        Options { method: scheme, ..with(Options::classical(t_end), FROM_STEP) };
                    let gap = open(&m, &run(&m, &from, &options));
                    (worst(&end(&m, &from, &options), &exact), gap)
                })
                .collect();
            for pair in found.windows(2).filter(|pair| pair[1].0 > 1e-12) {
                let slopes = [pair[0].0 / pair[1].0, pair[0].1 / pair[1].1].map(f64::log2);
                let least = f64::from(order) - 0.5;
                assert!(slopes[0] > least && slopes[1] > least, "{order}: {found:?}");
            }
        }
    }
}

/// Fixed gains hold the steps at the limit of stability, and leave larger errors than gains from the step.
#[test]
fn fewer_evaluations_leave_less_than_fixed_gains() {
    for ((m, from), rtol) in [(four_bar(), 1e-8), (slider_crank(), 1e-10)] {
        let fixed = run(&m, &from, &every(0.01, with(tolerances(3.0, 1e-6, 1e-9), FIXED)));
        let scheme = Scheme::Dop853(Dop853::new(rtol, 1e-3 * rtol));
        let options = Options { method: scheme, ..with(Options::classical(3.0), FROM_STEP) };
        let found = run(&m, &from, &every(0.01, options));
        let (few, many) = (found.statistics.evaluations, fixed.statistics.evaluations);
        assert!(2 * few < many, "{few} and {many} evaluations");
        let (gap, wide) = (open(&m, &found), open(&m, &fixed));
        assert!(gap < 0.2 * wide, "{gap:.1e} and {wide:.1e} m");
        let (energy, off) = (unbalanced(&m, &found), unbalanced(&m, &fixed));
        assert!(energy < 0.5 * off, "{energy:.1e} and {off:.1e} J");
    }
}

#[test]
fn the_steps_are_those_of_accuracy() {
    for (m, from) in [four_bar(), slider_crank()] {
        for rtol in [1e-3, 1e-6, 1e-9] {
            let steps = |stabilization| {
                let options = with(tolerances(2.0, rtol, 1e-3 * rtol), stabilization);
                run(&m, &from, &options).statistics.steps as f64
            };
            let (free, held) = (steps(Stabilization::None), steps(FROM_STEP));
            assert!((held / free - 1.0).abs() < 0.1, "{held} and {free} steps");
        }
    }
}

/// Over constant steps: each evaluation once more, for the derivative at the beginning.
#[test]
fn constant_steps_leave_a_hundredth_of_what_fixed_gains_do() {
    for (m, from) in [four_bar(), slider_crank()] {
        let at = |stabilization| {
            let options = with(Options::classical(2.0), stabilization);
            run(&m, &from, &Options { method: constant(4, 1e-3), ..options })
        };
        let (held, fixed) = (at(FROM_STEP), at(FIXED));
        assert!(open(&m, &held) < 1e-2 * open(&m, &fixed));
        assert!(unbalanced(&m, &held) < unbalanced(&m, &fixed));
        assert_eq!(held.statistics.evaluations, 5 * 2000 + 1);
    }
}

/// The first steps grow tenfold; joints that are open by the error of integration close nevertheless.
#[test]
fn a_state_off_the_constraints_comes_back() {
    let (m, start) = four_bar();
    let mut from = start.clone();
    for (k, q) in from.q.iter_mut().enumerate() {
        *q += 1e-5 * (1.0 + k as f64).sin();
    }
    let first = largest(&residual(&m, &from));
    let method =
        Rk45 { control: StepControl { first_step: Some(1e-9), ..StepControl::new(1e-8, 1e-11) } };
    let options = Options {
        method: Scheme::Rk45(method),
        output_step: None,
        ..with(Options::classical(0.2), FROM_STEP)
    };
    // a run refuses such a start, a restart accepts it
    let mut stepper = Stepper::new(&m, &start, &options).expect("a start");
    stepper.restart(&from).expect("a state");
    let mut gaps = vec![first];
    while !stepper.is_at_end() {
        stepper.step().expect("a step");
        gaps.push(largest(&residual(&m, &stepper.state())));
    }
    assert!(first > 1e-5 && largest(&gaps) < 1.5 * first, "{gaps:?}");
    let left = gaps[gaps.len() / 2];
    assert!(left < 1e-7, "{left:.1e} of {first:.1e}");
}

#[test]
fn backward_in_time_it_holds_as_well() {
    let (m, from) = slider_crank();
    let back = with(tolerances(-1.0, 1e-8, 1e-11), FROM_STEP);
    let there = run(&m, &from, &back);
    assert!(there.reached && open(&m, &there) < 1e-6);
    let again = with(tolerances(0.0, 1e-8, 1e-11), FROM_STEP);
    let last = state(&m, &there, there.trajectory.t.len() - 1);
    let request = Request { t: last.t, state: Some(last), ..Request::default() };
    let (closed, _) = assemble(&m, &request).expect("it closes");
    let off = worst(&end(&m, &closed, &again)[..m.layout.n_q], &from.q);
    assert!(off < 1e-5, "{off:.1e}");
}
