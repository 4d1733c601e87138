//! Implicit methods: steps, work, error and time on the flagship with soft and stiff dampers, and the time of
//! a step on chains.
//!
//! ```text
//! cargo bench --bench implicit
//! ```
//!
//! The error is the largest difference of any coordinate (m, rad) from a run of Radau at rtol 1e-10, on a grid of
//! 10 ms. Times are medians, without output between the steps.

mod mechanisms;

use kempe::analyses::dynamics::{dynamics, Auto, Options, Run, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::integrate::{AlphaParameters, Dop853, Flow, GeneralizedAlpha, Radau};
use kempe::model::Model;
use kempe::stabilize::Projection;
use mechanisms::{assembled, chain, FLAGSHIP};

/// Runs of which the median time is reported.
const RUNS: usize = 9;

fn alpha(rtol: f64) -> Scheme {
    let parameters = AlphaParameters::chung_hulbert(0.8);
    Scheme::GeneralizedAlpha(GeneralizedAlpha::new(parameters, rtol, 1e-3 * rtol))
}

fn radau(rtol: f64) -> Scheme {
    Scheme::Radau(Radau::new(rtol, 1e-3 * rtol))
}

fn dop853(rtol: f64) -> Scheme {
    Scheme::Dop853(Dop853::new(rtol, 1e-3 * rtol))
}

fn run(model: &Model, start: &State, t_end: f64, scheme: &Scheme, output: f64) -> Run {
    let options = Options {
        output_step: Some(output),
        method: scheme.clone(),
        stabilization: Stabilization::Projection(Projection::default()),
        dense_output: false,
        ..Options::classical(t_end)
    };
    dynamics(model, start, &options, |_| Flow::Continue).expect("the run ends well")
}

/// Median time of a run without output between the steps, s.
fn time(model: &Model, start: &State, t_end: f64, scheme: &Scheme) -> f64 {
    let mut times: Vec<f64> =
        (0..RUNS).map(|_| run(model, start, t_end, scheme, t_end).statistics.seconds).collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}

fn measure((model, start): &(Model, State), t_end: f64, schemes: &[(&str, Scheme)]) {
    let exact = run(model, start, t_end, &radau(1e-10), 0.01);
    for (told, scheme) in schemes {
        let found = run(model, start, t_end, scheme, 0.01);
        let pairs = found.trajectory.q.iter().zip(&exact.trajectory.q);
        let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let s = found.statistics;
        println!(
            "{told:<12} {:>6} {:>5} {:>7} {:>6} {:>6} {error:>9.1e} {:>8.2} {:>7.2}",
            s.steps,
            s.rejected,
            s.evaluations,
            s.jacobians,
            s.iterations,
            1e3 * time(model, start, t_end, scheme),
            1e6 * time(model, start, t_end, scheme) / s.steps as f64,
        );
        if let Some(choice) = found.choice {
            println!("             {}: {}", choice.method, choice.why);
        }
    }
}

fn main() {
    let schemes = [
        ("alpha 1e-3", alpha(1e-3)),
        ("alpha 1e-4", alpha(1e-4)),
        ("radau 1e-3", radau(1e-3)),
        ("radau 1e-6", radau(1e-6)),
        ("radau 1e-8", radau(1e-8)),
        ("dop853 1e-8", dop853(1e-8)),
        ("auto", Scheme::Auto(Auto::default())),
    ];
    for (c, t_end) in [("1e4", 15.0), ("1e6", 15.0), ("1e7", 15.0), ("1e8", 1.0)] {
        let text = FLAGSHIP.replace("c = 1e4", &format!("c = {c}"));
        assert!(c == "1e4" || text != FLAGSHIP, "the damper is where it was");
        println!("\nflagship with c = {c} N m s/rad, {t_end} s");
        println!("method        steps  rej.   evals tangents Newton     error       ms us/step");
        measure(&assembled(&text), t_end, &schemes);
    }
    println!("\nchains, 0.1 s: microseconds for a step and window");
    for windows in [10, 100, 1000] {
        let (model, start) = chain(windows);
        for (told, scheme) in [("alpha 1e-6", alpha(1e-6)), ("radau 1e-8", radau(1e-8))] {
            let steps = run(&model, &start, 0.1, &scheme, 0.1).statistics.steps;
            let per_step = 1e6 * time(&model, &start, 0.1, &scheme) / steps as f64;
            println!("{told}  {windows:>5}  {steps:>4} steps  {:>6.2}", per_step / windows as f64);
        }
    }
}
