//! The flagship over 15 s: by hand and by kempe, called from Rust, in alternation.

use crate::evaluations::{assembled, FLAGSHIP};
use crate::turns::medians;
use cpu_time::ThreadTime;
use kempe::analyses::dynamics::{dynamics, Options, Scheme};
use kempe::integrate::{Flow, Rk45};
use kempe_floor::chain::Chain;
use kempe_floor::dormand_prince::{integrate, Effort};
use kempe_floor::linkage::{Equations, D, HALF, N_Y};
use kempe_floor::recorded::Recorded;
use kempe_floor::straight::Straight;
use serde_json::{json, Value};

const T_END: f64 = 15.0;
const GRID: f64 = 0.01;

/// CPU time of a call, s, and its result.
pub fn timed<R>(run: impl FnOnce() -> R) -> (f64, R) {
    let clock = ThreadTime::now();
    let result = run();
    (clock.elapsed().as_secs_f64(), result)
}

/// All times at rtol 1e-3, 1e-6 and 1e-9; atol is a thousandth.
pub fn measure(repeat: usize) -> Value {
    let (model, start) = assembled(FLAGSHIP);
    let y: [f64; N_Y] = [start.q.as_slice(), &start.v].concat().try_into().expect("three bodies");
    let at = |rtol: f64| {
        let tolerances = (rtol, 1e-3 * rtol);
        let options = Options {
            output_step: Some(GRID),
            dense_output: false,
            method: Scheme::Rk45(Rk45::new(rtol, 1e-3 * rtol)),
            ..Options::classical(T_END)
        };
        let general = || {
            let run = dynamics(&model, &start, &options, |_| Flow::Continue).expect("runs well");
            let responses = run.accelerations(&model).expect("regular all along");
            (run, responses)
        };
        let found = medians(
            repeat,
            &mut [
                &mut || timed(|| integrate::<Chain>(&y, T_END, GRID, tolerances)).0,
                &mut || timed(|| integrate::<Straight>(&y, T_END, GRID, tolerances)).0,
                &mut || timed(general).0,
            ],
        );
        let took = general().0.statistics;
        json!({
            "rtol": rtol,
            "chain": by_hand::<Chain>(&y, tolerances, found[0]),
            "straight": by_hand::<Straight>(&y, tolerances, found[1]),
            "kempe": {
                "seconds": found[2],
                "ns_per_evaluation": found[2] * 1e9 / took.evaluations as f64,
                "steps": took.steps,
                "evaluations": took.evaluations,
            },
            "kempe_over_chain": found[2] / found[0],
            "kempe_over_straight": found[2] / found[1],
        })
    };
    Value::Array([1e-3, 1e-6, 1e-9].map(at).to_vec())
}

fn by_hand<E: Equations>(y: &[f64; N_Y], tolerances: (f64, f64), seconds: f64) -> Value {
    let (kept, effort) = integrate::<E>(y, T_END, GRID, tolerances);
    let Effort { steps, rejected, evaluations } = effort;
    json!({
        "seconds": seconds,
        "ns_per_evaluation": seconds * 1e9 / evaluations as f64,
        "steps": steps,
        "rejected": rejected,
        "evaluations": evaluations,
        "error_rad": error(&kept),
        "gap_m": gap(&kept),
    })
}

/// Largest error of the rocker angle over the first second.
fn error(kept: &Recorded) -> f64 {
    let text = include_str!("../../../tests/reference/four_bar.json");
    let reference: Value = serde_json::from_str(text).expect("sound JSON");
    let angles = reference["first_second"]["rocker_angle"].as_array().expect("a list");
    let pairs = angles.iter().zip(&kept.y);
    pairs.map(|(a, y)| (a.as_f64().expect("a number") - y[8]).abs()).fold(0.0, f64::max)
}

/// Largest opening of a joint.
fn gap(kept: &Recorded) -> f64 {
    let end = |y: &[f64; N_Y], k: usize, side: f64| {
        let (s, c) = y[3 * k + 2].sin_cos();
        (y[3 * k] + side * HALF[k] * c, y[3 * k + 1] + side * HALF[k] * s)
    };
    let joints = |y: &[f64; N_Y]| {
        let ends = [0, 1, 2].map(|k| (end(y, k, -1.0), end(y, k, 1.0)));
        let pairs = [
            ((0.0, 0.0), ends[0].0),
            (ends[0].1, ends[1].0),
            (ends[1].1, ends[2].0),
            ((D, 0.0), ends[2].1),
        ];
        pairs.map(|((x, y), (u, v))| (x - u).hypot(y - v)).into_iter().fold(0.0, f64::max)
    };
    kept.y.iter().map(joints).fold(0.0, f64::max)
}
