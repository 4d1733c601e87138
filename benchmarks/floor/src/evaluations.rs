//! The right-hand side alone: nanoseconds for q̈ and λ at a state.
//!
//! Each call takes its state from a recorded run and depends on the previous result, as in a stage of an
//! integrator. Independent calls would overlap in the processor.

use crate::turns::medians;
use cpu_time::ThreadTime;
use kempe::analyses::State;
use kempe::equations::{Gains, Workspace};
use kempe::model::Model;
use kempe_floor::chain::Chain;
use kempe_floor::dormand_prince::integrate;
use kempe_floor::linkage::{Equations, BAUMGARTE, N_Q, N_Y};
use kempe_floor::straight::Straight;
use serde_json::{json, Value};
use std::hint::black_box;

#[path = "../../../core/benches/mechanisms/mod.rs"]
mod mechanisms;
pub use mechanisms::{assembled, FLAGSHIP};

/// Calls between two readings of the clock, for three bodies.
const CALLS: usize = 5_000;
const GAINS: Gains = Gains { alpha: 10.0, beta: 200.0 };
/// Too small to change any number, but creates a dependency on the previous result.
const NOTHING: f64 = 1e-200;

/// States of the flagship during its motion.
fn states(start: &State) -> Vec<[f64; N_Y]> {
    let y = [start.q.as_slice(), &start.v].concat().try_into().expect("three bodies");
    integrate::<Chain>(&y, 2.0, 0.01, (1e-6, 1e-9)).0.y
}

/// Nanoseconds per call of `solve`, which computes an acceleration from a state.
fn time<S: AsRef<[f64]>>(states: &[S], calls: usize, mut solve: impl FnMut(&S, f64) -> f64) -> f64 {
    let clock = ThreadTime::now();
    let mut before = 0.0;
    for state in states.iter().cycle().take(calls) {
        before = solve(black_box(state), before);
    }
    black_box(before);
    clock.elapsed().as_secs_f64() * 1e9 / calls as f64
}

#[inline(never)]
fn by_hand<E: Equations>(state: &[f64; N_Y], before: f64) -> f64 {
    let mut y = *state;
    y[2] += NOTHING * before;
    let found = black_box(E::solve(&y, BAUMGARTE));
    found.a[2]
}

/// The same with kempe.
fn general<S: AsRef<[f64]>>(model: &Model, states: &[S], calls: usize) -> f64 {
    let n = model.layout.n_q;
    let mut workspace = Workspace::new(model);
    let mut y = vec![0.0; 2 * n];
    time(states, calls, |state, before| {
        y.copy_from_slice(state.as_ref());
        y[2] += NOTHING * before;
        let outcome = workspace.accelerate(model, 0.0, [&y[..n], &y[n..], &[]], GAINS);
        outcome.expect("the positions are regular");
        black_box(workspace.lam());
        black_box(workspace.a())[2]
    })
}

/// Floor and kempe on the flagship, and kempe on another linkage with frames at and off the mass centres.
pub fn measure(repeat: usize) -> Value {
    let (flagship, start) = assembled(FLAGSHIP);
    let states = states(&start);
    let (other, at) = assembled(mechanisms::OTHER);
    let at = [[at.q, at.v].concat()];
    let (centred, from) = assembled(&mechanisms::centred());
    let from = [[from.q, from.v].concat()];
    let found = medians(
        repeat,
        &mut [
            &mut || time(&states, CALLS, by_hand::<Chain>),
            &mut || time(&states, CALLS, by_hand::<Straight>),
            &mut || general(&flagship, &states, CALLS),
            &mut || general(&other, &at, CALLS),
            &mut || general(&centred, &from, CALLS),
        ],
    );
    let [chain, straight, kempe, other, centred] = found[..] else { unreachable!("five programs") };
    json!({
        "chain_ns": chain,
        "straight_ns": straight,
        "kempe_ns": kempe,
        "other_ns": other,
        "centred_ns": centred,
        "kempe_over_chain": kempe / chain,
        "kempe_over_straight": kempe / straight,
        "other_over_kempe": other / kempe,
        "centred_over_kempe": centred / kempe,
    })
}

/// kempe on N parallelograms in a row: nanoseconds per evaluation and window.
pub fn windows(repeat: usize) -> Value {
    const SIZES: [usize; 4] = [10, 100, 1000, 4000];
    let chains = SIZES.map(|n| {
        let (model, start) = mechanisms::chain(n);
        (model, [[start.q, start.v].concat()], n)
    });
    let mut each: Vec<_> = chains
        .iter()
        .map(|(model, state, n)| move || general(model, state, 10 * CALLS / n) / *n as f64)
        .collect();
    let mut programs: Vec<_> = each.iter_mut().map(|f| f as &mut dyn FnMut() -> f64).collect();
    let found = medians(repeat.min(9), &mut programs);
    let pairs = SIZES.iter().zip(&found).map(|(n, ns)| (n.to_string(), json!(ns)));
    Value::Object(pairs.collect())
}

const _: () = assert!(N_Y == 2 * N_Q);
