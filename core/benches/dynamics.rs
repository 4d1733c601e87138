//! Time of forward dynamics: nanoseconds per evaluation of the equations of motion, everything
//! included (integrator, error control, output every 10 ms).
//!
//! ```text
//! cargo bench --bench dynamics                      all
//! cargo bench --bench dynamics -- flagship chain    these, or set-up
//! ```
//!
//! The flagship; a four-bar linkage not used for tuning (frames off the mass centres, joints
//! in another order and direction); and the N-four-bar chain of the IFToMM benchmark library, whose
//! cost for each window must not depend on N. Then the time in which order and plan of elimination of the chains are found.

mod mechanisms;

use kempe::analyses::{dynamics, State};
use kempe::equations::Plan;
use kempe::integrate::Flow;
use kempe::model::Model;
use mechanisms::{assembled, chain, FLAGSHIP, OTHER};
use std::hint::black_box;
use std::time::Instant;

/// Runs of which the median is reported.
const RUNS: usize = 15;

/// Runs a mechanism and prints the median time per evaluation, also divided by `windows`.
fn time(name: &str, (model, start): (Model, State), t_end: f64, windows: usize) {
    let options = dynamics::Options {
        output_step: Some(0.01),
        dense_output: false,
        ..dynamics::Options::classical(t_end)
    };
    let run = || {
        let run = dynamics::dynamics(&model, &start, &options, |_| Flow::Continue);
        run.expect("the run ends well").statistics
    };
    let mut runs: Vec<_> = (0..RUNS).map(|_| run()).collect();
    runs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let median = runs[RUNS / 2];
    let each = median.seconds * 1e9 / median.evaluations as f64;
    println!(
        "{name:<12} {:>7} {:>11} {:>9.3} {:>9.1} {:>9.1}",
        median.steps,
        median.evaluations,
        median.seconds * 1e3,
        each,
        each / windows as f64,
    );
}

/// Prints the median time to find order and plan, and the products of an elimination per window.
fn set_up(windows: usize) {
    let (model, _) = chain(windows);
    let find = || {
        let clock = Instant::now();
        black_box(Plan::of_motion(&model));
        clock.elapsed().as_secs_f64() * 1e3
    };
    let mut times: Vec<_> = (0..RUNS).map(|_| find()).collect();
    times.sort_by(f64::total_cmp);
    let products = Plan::of_motion(&model).n_products();
    println!(
        "chain {windows:<6} {:>7} {:>11.3} {:>9}",
        model.layout.n_q,
        times[RUNS / 2],
        products / windows,
    );
}

fn main() {
    println!(
        "{:<12} {:>7} {:>11} {:>9} {:>9} {:>9}",
        "", "steps", "evaluations", "ms", "ns/eval", "/window"
    );
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let asked = |name: &str| wanted.is_empty() || wanted.iter().any(|w| w == name);
    for (name, text) in [("flagship", FLAGSHIP), ("other", OTHER)] {
        if asked(name) {
            time(name, assembled(text), 15.0, 1);
        }
    }
    for windows in [10, 100, 1000] {
        if asked("chain") {
            time(&format!("chain {windows}"), chain(windows), 0.2, windows);
        }
    }
    if asked("set-up") {
        println!("\n{:<12} {:>7} {:>11} {:>9}", "", "coord.", "plan, ms", "products");
        [10, 100, 1000, 4000].into_iter().for_each(set_up);
    }
}
