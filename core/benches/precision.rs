//! Work and precision of forward dynamics: cost and accuracy of each tolerance, for each method
//! and stabilization.
//!
//! ```text
//! cargo bench --bench precision
//! ```
//!
//! The error is the largest difference of any coordinate (m, rad) from a run at rtol 1e-13, on a grid of
//! 10 ms; the residual the largest |Φ| there. Times are medians, without output between the steps.

mod mechanisms;

use kempe::analyses::dynamics::{dynamics, Options, Run, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::equations::{constraints, kinematics, Gains};
use kempe::integrate::{Dop853, Flow, Rk45};
use kempe::model::Model;
use kempe::stabilize::Projection;
use mechanisms::{assembled, chain, FLAGSHIP, OTHER};

/// Runs of which the median time is reported.
const RUNS: usize = 9;
const TOLERANCES: [f64; 4] = [1e-3, 1e-6, 1e-8, 1e-10];

const PROJECTION: Stabilization = Stabilization::Projection(Projection { tolerance: 1e-12 });

fn baumgarte(alpha: f64, beta: f64) -> Stabilization {
    Stabilization::Baumgarte(Gains { alpha, beta })
}

fn scheme(name: &str, rtol: f64) -> Scheme {
    match name {
        "dop853" => Scheme::Dop853(Dop853::new(rtol, 1e-3 * rtol)),
        _ => Scheme::Rk45(Rk45::new(rtol, 1e-3 * rtol)),
    }
}

fn options(t_end: f64, scheme: Scheme, stabilization: Stabilization) -> Options {
    let output_step = Some(0.01);
    Options {
        output_step,
        method: scheme,
        stabilization,
        dense_output: false,
        ..Options::classical(t_end)
    }
}

fn run(model: &Model, start: &State, options: &Options) -> Run {
    dynamics(model, start, options, |_| Flow::Continue).expect("the run ends well")
}

fn residual(model: &Model, run: &Run) -> f64 {
    let mut phi = vec![0.0; model.layout.n_rows];
    let states = run.trajectory.t.iter().zip(run.trajectory.q.chunks_exact(model.layout.n_q));
    states.fold(0.0, |worst, (&t, q)| {
        constraints::residual(model, &kinematics::Motions::at_rest(&model.layout, q), t, &mut phi);
        phi.iter().fold(worst, |worst, phi| worst.max(phi.abs()))
    })
}

/// Median time of a run, ms.
fn time(model: &Model, start: &State, options: &Options) -> f64 {
    let bare = Options { output_step: Some(options.t_end), ..options.clone() };
    let mut times: Vec<f64> =
        (0..RUNS).map(|_| 1e3 * run(model, start, &bare).statistics.seconds).collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}

fn measure(name: &str, (model, start): (Model, State), t_end: f64) {
    let exact = run(&model, &start, &options(t_end, scheme("dop853", 1e-13), PROJECTION));
    println!("\n{name}, {t_end} s");
    let stabilizations = [
        ("baumgarte 10, 200", baumgarte(10.0, 200.0)),
        ("baumgarte 20, 20", baumgarte(20.0, 20.0)),
        ("baumgarte, step", Stabilization::BaumgarteFromStep),
        ("projection", PROJECTION),
    ];
    for method in ["rk45", "dop853"] {
        for (told, stabilization) in stabilizations {
            for rtol in TOLERANCES {
                let options = options(t_end, scheme(method, rtol), stabilization);
                let found = run(&model, &start, &options);
                let pairs = found.trajectory.q.iter().zip(&exact.trajectory.q);
                let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                println!(
                    "{method:<7} {told:<18} {rtol:>7.0e} {:>6} {:>8} {error:>9.1e} {:>9.1e} {:>8.2}",
                    found.statistics.steps,
                    found.statistics.evaluations,
                    residual(&model, &found),
                    time(&model, &start, &options),
                );
            }
        }
    }
}

fn main() {
    println!("method  stabilization         rtol  steps    evals     error  residual       ms");
    measure("flagship", assembled(FLAGSHIP), 15.0);
    measure("other", assembled(OTHER), 15.0);
    measure("chain 10", chain(10), 0.3);
}
