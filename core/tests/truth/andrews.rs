//! Andrews' squeezing mechanism against a reference of 30 digits; the accepted error of
//! the benchmark is 1e-8 on the angles.

use crate::mechanisms::{close, model, run, start, tolerances, worst};
use crate::{number, numbers, reference};
use kempe::analyses::dynamics::Options;
use kempe::analyses::State;
use kempe::model::Model;

const SQUEEZER: &str = include_str!("../../../examples/squeezer.toml");

/// Assembled from the angle of K1 and guesses of one digit, as the example does.
fn squeezer() -> (Model, State) {
    let m = model(SQUEEZER);
    let q0 = numbers(&reference("andrews")["q0_cartesian"]);
    let guess: Vec<(String, String)> =
        (2..8).map(|k| (format!("K{k}.angle"), format!("{:.1}", q0[3 * k - 1]))).collect();
    let guess: Vec<(&str, &str)> = guess.iter().map(|(k, x)| (k.as_str(), x.as_str())).collect();
    let (state, _) = start(&m, &[("K1.angle", &format!("{:?}", q0[2]))], &guess);
    assert!(worst(&state.q, &q0) < 1e-12, "{:.2e}", worst(&state.q, &q0));
    (m, state)
}

#[test]
fn angles_after_three_hundredths_of_a_second() {
    let truth = reference("andrews")["angles_at_0.03"].clone();
    let (m, state) = squeezer();
    let run = run(&m, &state, &tolerances(0.03, 1e-11, 1e-12));
    let q = &run.trajectory.q[run.trajectory.q.len() - 21..];
    let of = |name: &str| number(&truth[name]);
    let expected = [
        of("beta"),
        of("beta") + of("Theta"),
        of("gamma"),
        of("Phi") + of("delta"),
        of("delta"),
        of("Omega") + of("epsilon"),
        of("epsilon"),
    ];
    for (k, expected) in expected.into_iter().enumerate() {
        close(&format!("angle of K{}", k + 1), q[3 * k + 2], expected, 1e-10);
    }
}

/// Fast and undamped: no case for an implicit method.
#[test]
fn the_automatic_choice_is_explicit() {
    let (m, state) = squeezer();
    let choice = run(&m, &state, &Options::new(0.03)).choice.expect("a choice was made");
    assert_eq!(choice.method, "dop853", "{}", choice.why);
}
