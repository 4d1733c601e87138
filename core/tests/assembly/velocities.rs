//! Consistent velocities.

use crate::mechanisms::{close, largest, model, rate, refused, request, start, FOUR_BAR};
use kempe::analyses::assemble::{assemble, Fault};
use kempe::equations::{energy, kinematics};

const GUESS: [(&str, &str); 2] = [("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")];

#[test]
fn a_rate_that_is_set_moves_all() {
    let m = model(FOUR_BAR);
    let (state, _) = start(&m, &[("crank.angle", "70*deg"), ("crank.omega", "2.5")], &GUESS);
    assert!(largest(&rate(&m, &state)) < 1e-11);
    // closed form of the loop: coupler and rocker rates from the crank's
    let (a2, a3, w1) = (state.q[5], state.q[8], 2.5);
    let a1 = 70_f64.to_radians();
    // 10 e(a1) + 26 e(a2) + 18 e(a3) = const
    let w2 = -10.0 * w1 * (a1 - a3).sin() / (26.0 * (a2 - a3).sin());
    let w3 = -10.0 * w1 * (a1 - a2).sin() / (18.0 * (a3 - a2).sin());
    close("crank", state.v[2], w1, 1e-13);
    close("coupler", state.v[5], w2, 1e-12);
    close("rocker", state.v[8], w3, 1e-12);
}

#[test]
fn any_rate_may_be_set() {
    let m = model(FOUR_BAR);
    let (crank, _) = start(&m, &[("crank.angle", "70*deg"), ("crank.omega", "1")], &GUESS);
    for (key, column) in [("rocker.omega", 8), ("coupler.vx", 3), ("rocker.vy", 7)] {
        let value = format!("{:?}", 3.0 * crank.v[column]);
        let (state, _) = start(&m, &[("crank.angle", "70*deg"), (key, &value)], &GUESS);
        close(key, state.v[2], 3.0, 1e-11);
    }
}

#[test]
fn rates_that_contradict_are_refused() {
    let m = model(FOUR_BAR);
    let failure =
        refused(&m, &[("crank.angle", "70*deg"), ("crank.omega", "1"), ("rocker.omega", "5")]);
    assert_eq!(failure.fault, Fault::Rates);
    assert!(
        failure.message.contains("crank.omega = 1 rad/s")
            && failure.message.contains("rocker.omega = 5 rad/s"),
        "{}",
        failure.message
    );
}

#[test]
fn rates_that_agree_are_accepted() {
    let m = model(FOUR_BAR);
    let (state, _) = start(&m, &[("crank.angle", "70*deg"), ("crank.omega", "1")], &GUESS);
    let omega = format!("{:?}", state.v[8]);
    let ask = [("crank.angle", "70*deg"), ("crank.omega", "1"), ("rocker.omega", omega.as_str())];
    let (again, _) = start(&m, &ask, &GUESS);
    for k in 0..9 {
        close("v", again.v[k], state.v[k], 1e-8);
    }
}

/// Of all consistent velocities the one nearest to the guess, by kinetic energy of the difference:
/// no other consistent one is nearer.
#[test]
fn guessed_rates_give_the_nearest_motion() {
    let m = model(FOUR_BAR);
    let guess = [GUESS[0], GUESS[1], ("crank.omega", "2"), ("rocker.omega", "-3")];
    let ask = request(&m, &[("crank.angle", "70*deg")], &guess);
    let (state, _) = assemble(&m, &ask).unwrap();
    assert!(largest(&rate(&m, &state)) < 1e-11);
    let (unit, _) = start(&m, &[("crank.angle", "70*deg"), ("crank.omega", "1")], &GUESS);
    let distance = |scale: f64| {
        let mut v: Vec<f64> = state.v.iter().zip(&unit.v).map(|(v, u)| v + scale * u).collect();
        v[2] -= 2.0;
        v[8] += 3.0;
        let motions = kinematics::Motions::at(&m.layout, &state.q, &v);
        energy::kinetic(&m, &motions)
    };
    assert!(distance(0.0) < distance(0.01) && distance(0.0) < distance(-0.01));
}
