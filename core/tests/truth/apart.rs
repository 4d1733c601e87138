//! Runs that Baumgarte's stabilization does not keep together end with an error, not as a result.

use crate::mechanisms::{
    every, four_bar, largest, residual, run, tolerances, with as parameters, FOUR_BAR,
};
use kempe::analyses::dynamics::{dynamics, Failure, Options, Reason, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::equations::Gains;
use kempe::integrate::{Flow, Rk4};

/// A hundredth of the largest distance of a point from its frame, that of D on ground.
const MOST: f64 = 0.2;

fn with(options: Options, alpha: f64, beta: f64) -> Options {
    Options { stabilization: Stabilization::Baumgarte(Gains { alpha, beta }), ..options }
}

/// The limit in a message, m.
fn limit(message: &str) -> Option<f64> {
    message.split("more than ").nth(1)?.strip_suffix(" m")?.parse().ok()
}

fn failed(options: &Options) -> (Failure, f64) {
    let (m, start) = four_bar();
    let failure = *dynamics(&m, &start, options, |_| Flow::Continue).expect_err("it opens");
    let Reason::Integration { t, message, hint } = &failure.reason else {
        panic!("{}", failure.reason)
    };
    let t = *t;
    assert!(message.starts_with(&format!("the joints come apart at t = {t:.6} s: ")), "{message}");
    assert!(message.contains(" is open by "), "{message}");
    assert_eq!(limit(message), Some(0.2), "{message}");
    assert!(["A.", "B.", "C.", "D."].iter().any(|name| message.contains(name)), "{message}");
    assert!(["projection", "tolerance", "gains"].iter().all(|word| hint.contains(word)), "{hint}");
    // the earlier states are kept, with gaps below the limit
    let n = m.layout.n_q;
    for (t, q) in failure.run.trajectory.t.iter().zip(failure.run.trajectory.q.chunks_exact(n)) {
        let state = State { t: *t, q: q.to_vec(), v: Vec::new(), z: Vec::new() };
        assert!(largest(&residual(&m, &state)) <= MOST);
    }
    (failure, t)
}

#[test]
fn gains_too_small_for_the_tolerance() {
    let loose = tolerances(15.0, 1e-3, 1e-6);
    let (failure, at) = failed(&with(loose.clone(), 0.01, 0.01));
    let (t, steps) = (&failure.run.trajectory.t, failure.run.statistics.steps);
    assert!(t.len() > 10 && t[t.len() - 1] < at && at < 15.0, "{at}");
    let (failure, within) = failed(&every(0.01, with(loose.clone(), 0.01, 0.01)));
    let last = *failure.run.trajectory.t.last().expect("states before");
    assert!(last < within && within - last < 0.2, "{last} {within}");
    // with hardly a report, within the next four steps
    let (rarely, later) = failed(&every(14.0, with(loose, 0.01, 0.01)));
    let more = rarely.run.statistics.steps - steps;
    assert!(later >= at && more < 4, "{at} {later}: {more} steps");
}

/// β h = 5 is beyond the stability of RK4: seen at the end of a step, long before the first report.
#[test]
fn gains_too_great_for_the_step() {
    let options = Options { method: Scheme::Rk4(Rk4::new(0.005)), ..tolerances(15.0, 1e-3, 1e-6) };
    let (failure, at) = failed(&every(5.0, with(options, 1.0, 1000.0)));
    assert_eq!(failure.run.trajectory.t, [0.0]);
    assert!(at < 5.0, "{at}");
}

#[test]
fn a_start_that_is_open() {
    let (m, mut start) = four_bar();
    start.q[0] += 0.5;
    let options = with(Options::classical(1.0), 10.0, 200.0);
    let failure = dynamics(&m, &start, &options, |_| Flow::Continue).expect_err("it is open");
    let Reason::Start { t, name, message, .. } = &failure.reason else { panic!("{failure:?}") };
    assert!(*t == 0.0 && (name == "A" || name == "B"), "{name}");
    assert!(message.contains(&format!("joint {name} is open by 5.000e-1 m;")), "{message}");
    assert!(failure.run.trajectory.t.is_empty());
}

/// Runs with the documented drift, and well stabilized runs, are not disturbed.
#[test]
fn others_go_on() {
    let (m, start) = four_bar();
    let loose = tolerances(15.0, 1e-3, 1e-6);
    let drifts = Options { stabilization: Stabilization::None, ..loose.clone() };
    assert!(
        run(&m, &start, &drifts).reached && run(&m, &start, &with(loose.clone(), 0.0, 0.0)).reached
    );
    for (alpha, beta) in [(10.0, 200.0), (1.0, 20.0), (20.0, 20.0), (200.0, 200.0)] {
        assert!(run(&m, &start, &with(loose.clone(), alpha, beta)).reached);
    }
}

/// Without stabilization drift is expected, but not joints farther apart than the mechanism is large.
#[test]
fn without_stabilization_they_drift_so_far_and_no_further() {
    let (_, start) = four_bar();
    let free = parameters(FOUR_BAR, &[("k", 0.0), ("c", 0.0)]);
    let loose = tolerances(300.0, 1e-2, 1e-5);
    let drifts = Options { stabilization: Stabilization::None, ..loose };
    let outcome = dynamics(&free, &start, &drifts, |_| Flow::Continue).map(|run| run.reached);
    let reason = outcome.expect_err("it opens").reason.to_string();
    assert_eq!(limit(&reason), Some(20.0), "{reason}");
}
