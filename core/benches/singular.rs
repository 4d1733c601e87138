//! Passing singular positions: N windows of parallelograms over 10 s (IFToMM benchmark A02), against
//! the exact motion of one pendulum.
//!
//! ```text
//! cargo bench --bench singular                all
//! cargo bench --bench singular -- 1 40        these N
//! ```
//!
//! The error is the largest distance of B0 from the truth on a grid of 10 ms, m; the residual the largest
//! |Φ| there. ψ from upright obeys ψ″ = ω² sin ψ, ω² = 3 g (3 N + 1) / (2 L (4 N + 1)); its integration at
//! rtol 1e-14 serves as the truth here, `tests/truth` compares with elliptic functions.

mod mechanisms;

use kempe::analyses::dynamics::{dynamics, Options, Run, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::equations::{constraints, kinematics};
use kempe::integrate::{Atol, Dop853, ExplicitMethod, Flow, Ode, Rk45, StepControl};
use kempe::model::Model;
use kempe::stabilize::Projection;
use mechanisms::chain;

const T_END: f64 = 10.0;
const GRID: f64 = 0.01;

/// The chain upright, every crank turning at -1 rad/s.
fn upright(windows: usize) -> (Model, State) {
    let (model, mut state) = chain(windows);
    for k in 0..=windows {
        let crank = 3 * k..3 * k + 3;
        state.q[crank.clone()].copy_from_slice(&[k as f64, 0.5, std::f64::consts::FRAC_PI_2]);
        state.v[crank].copy_from_slice(&[0.5, 0.0, -1.0]);
    }
    for k in 0..windows {
        let coupler = 3 * (windows + 1 + k)..3 * (windows + 2 + k);
        state.q[coupler.clone()].copy_from_slice(&[k as f64 + 0.5, 1.0, 0.0]);
        state.v[coupler].copy_from_slice(&[1.0, 0.0, 0.0]);
    }
    (model, state)
}

/// ψ″ = ω² sin ψ.
struct Pendulum(f64);

impl Ode for Pendulum {
    type Stop = ();
    fn len(&self) -> usize {
        2
    }
    fn rate(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), ()> {
        dy.copy_from_slice(&[y[1], self.0 * y[0].sin()]);
        Ok(())
    }
}

/// B0 on the grid.
fn truth(windows: usize) -> Vec<[f64; 2]> {
    let n = windows as f64;
    let w2 = 1.5 * 9.81 * (3.0 * n + 1.0) / (4.0 * n + 1.0);
    let method = Dop853::new(1e-14, 1e-15);
    let mut y = [0.0, 1.0];
    let mut all = vec![[0.0, 1.0]];
    for k in 0..(T_END / GRID).round() as usize {
        let ends = (k as f64 * GRID, (k + 1) as f64 * GRID);
        let mut stepper = method.start(&Pendulum(w2), ends, &y).expect("a pendulum swings");
        while stepper.t() != ends.1 {
            stepper.step(&mut Pendulum(w2)).expect("a pendulum swings");
        }
        y.copy_from_slice(stepper.y());
        all.push([y[0].sin(), y[0].cos()]);
    }
    all
}

fn options(scheme: &str, rtol: f64) -> Options {
    let atol = Atol::Scalar(1e-3 * rtol);
    Options {
        output_step: Some(GRID),
        dense_output: false,
        stabilization: Stabilization::Projection(Projection::default()),
        method: match scheme {
            "rk45" => {
                Scheme::Rk45(Rk45 { control: StepControl { rtol, atol, ..StepControl::default() } })
            }
            _ => Scheme::Dop853(Dop853 {
                control: StepControl { rtol, atol, ..StepControl::default() },
            }),
        },
        ..Options::classical(T_END)
    }
}

/// Largest error of B0 and largest |Φ|.
fn errors(model: &Model, run: &Run, truth: &[[f64; 2]]) -> (f64, f64) {
    let n = model.layout.n_q;
    let mut phi = vec![0.0; model.layout.n_rows];
    let (mut error, mut residual) = (0.0_f64, 0.0_f64);
    for ((q, t), [x, y]) in run.trajectory.q.chunks_exact(n).zip(&run.trajectory.t).zip(truth) {
        error = error.max((2.0 * q[0] - x).hypot(2.0 * q[1] - y));
        constraints::residual(model, &kinematics::Motions::at_rest(&model.layout, q), *t, &mut phi);
        residual = phi.iter().fold(residual, |r, phi| r.max(phi.abs()));
    }
    (error, residual)
}

fn measure(windows: usize, scheme: &str, rtol: f64, truth: &[[f64; 2]]) {
    let (model, start) = upright(windows);
    print!("{windows:>5} {scheme:<7} {rtol:>7.0e}");
    match dynamics(&model, &start, &options(scheme, rtol), |_| Flow::Continue) {
        Ok(run) => {
            let (error, residual) = errors(&model, &run, truth);
            let s = run.statistics;
            let plain = Options { output_step: None, ..options(scheme, rtol) };
            let bare = dynamics(&model, &start, &plain, |_| Flow::Continue);
            let ms = bare.map_or(f64::NAN, |run| run.statistics.seconds * 1e3);
            println!(
                " {:>6} {:>9} {:>12} {:>15} {:>10.1e} {:>10.1e} {:>9.2}",
                s.steps, s.rejected, s.evaluations, s.factorisations, error, residual, ms
            );
        }
        Err(failure) => println!(" {} ({} steps)", failure.reason, failure.run.statistics.steps),
    }
}

fn main() {
    println!(
        "{:>5} {:<7} {:>7} {:>6} {:>9} {:>12} {:>15} {:>10} {:>10} {:>9}",
        "N",
        "scheme",
        "rtol",
        "steps",
        "rejected",
        "evaluations",
        "factorisations",
        "error",
        "residual",
        "ms"
    );
    let wanted: Vec<usize> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    for windows in [1, 2, 3, 10, 40, 1000] {
        if !wanted.is_empty() && !wanted.contains(&windows) {
            continue;
        }
        let truth = truth(windows);
        for rtol in [1e-6, 1e-7, 1e-8, 1e-9, 1e-10] {
            measure(windows, "dop853", rtol, &truth);
        }
        measure(windows, "rk45", 1e-6, &truth);
    }
}
