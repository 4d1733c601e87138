//! The flagship's two closures, with and without guesses.

use crate::mechanisms::{
    close, four_bar, largest, model, refused, request, residual, start, FOUR_BAR,
};
use kempe::analyses::assemble::assemble;
use kempe::analyses::State;

const SET: [(&str, &str); 1] = [("crank.angle", "70*deg")];

#[test]
fn without_a_guess_it_takes_one_and_says_so() {
    let m = model(FOUR_BAR);
    let (state, report) = start(&m, &SET, &[]);
    assert!(largest(&residual(&m, &state)) < 1e-11);
    assert_eq!((report.modes.len(), report.alternatives), (1, Some(1)));
    let mode = &report.modes[0];
    assert_eq!(
        (mode.bodies.clone(), mode.joint.as_str()),
        (vec!["coupler".into(), "rocker".into()], "C")
    );
    assert_eq!(mode.anchors, ["B", "D"]);
    let c = c_of(&state);
    let (b, d) =
        ([10.0 * 70_f64.to_radians().cos(), 10.0 * 70_f64.to_radians().sin()], [20.0, 0.0]);
    let cross = (d[0] - b[0]) * (c[1] - b[1]) - (d[1] - b[1]) * (c[0] - b[0]);
    assert_eq!(mode.left, cross > 0.0);
}

/// Joint C from the coupler.
fn c_of(state: &State) -> [f64; 2] {
    let (s, c) = state.q[5].sin_cos();
    [state.q[3] + 13.0 * c, state.q[4] + 13.0 * s]
}

#[test]
fn guesses_choose_the_closure() {
    let m = model(FOUR_BAR);
    let upper = [("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")];
    // the mirror image of C about the line B-D
    let lower = [("coupler.angle", "-68*deg"), ("rocker.angle", "80*deg")];
    let (up, up_report) = start(&m, &SET, &upper);
    let (down, down_report) = start(&m, &SET, &lower);
    assert!(c_of(&up)[1] > 0.0 && c_of(&down)[1] < 0.0, "{:?} {:?}", c_of(&up), c_of(&down));
    assert_ne!(up_report.modes[0].left, down_report.modes[0].left);
    for state in [&up, &down] {
        assert!(largest(&residual(&m, state)) < 1e-11);
        close("crank.angle", state.q[2], 70_f64.to_radians(), 1e-14);
    }
    // both closures are mirror images about B-D
    let [b, d] =
        [[10.0 * 70_f64.to_radians().cos(), 10.0 * 70_f64.to_radians().sin()], [20.0, 0.0]];
    let far = |c: [f64; 2], p: [f64; 2]| (c[0] - p[0]).hypot(c[1] - p[1]);
    for c in [c_of(&up), c_of(&down)] {
        close("coupler", far(c, b), 26.0, 1e-11);
        close("rocker", far(c, d), 18.0, 1e-11);
    }
}

#[test]
fn a_partial_guess_is_enough() {
    let m = model(FOUR_BAR);
    for (guess, up) in [
        (("coupler.angle", "0"), true),
        (("coupler.angle", "-60*deg"), false),
        (("rocker.angle", "230*deg"), true),
        (("rocker.angle", "100*deg"), false),
    ] {
        let (state, _) = start(&m, &SET, &[guess]);
        assert_eq!(c_of(&state)[1] > 0.0, up, "{guess:?}");
    }
}

#[test]
fn without_anything_set_it_stands_somewhere() {
    let m = model(FOUR_BAR);
    let (state, report) = start(&m, &[], &[]);
    assert!(largest(&residual(&m, &state)) < 1e-11);
    assert_eq!(report.degrees_of_freedom, 1);
    let (state, _) = start(&m, &[], &[("crank.angle", "70*deg"), ("coupler.angle", "14*deg")]);
    close("a guess is approached", state.q[2], 70_f64.to_radians(), 0.2);
}

#[test]
fn an_assembled_state_is_returned_bit_for_bit() {
    let (m, state) = four_bar();
    let mut moving = state.clone();
    let (with_rate, _) = start(&m, &[("crank.angle", "70*deg"), ("crank.omega", "3")], &[]);
    moving.v.clone_from(&with_rate.v);
    for given in [state, with_rate] {
        let mut ask = request(&m, &[], &[]);
        ask.state = Some(given.clone());
        let (again, _) = assemble(&m, &ask).unwrap();
        assert_eq!(
            again.q.iter().map(|q| q.to_bits()).collect::<Vec<_>>(),
            given.q.iter().map(|q| q.to_bits()).collect::<Vec<_>>()
        );
        assert_eq!(
            again.v.iter().map(|v| v.to_bits()).collect::<Vec<_>>(),
            given.v.iter().map(|v| v.to_bits()).collect::<Vec<_>>()
        );
    }
}

#[test]
fn the_loop_that_cannot_close_is_named_with_what_is_missing() {
    // |B - D| at 70° is 18.99 m; 26 + 18 reach that, 0.31 m less than needed do not
    let b = [10.0 * 70_f64.to_radians().cos(), 10.0 * 70_f64.to_radians().sin()];
    let distance = (20.0 - b[0]).hypot(b[1]);
    let short = FOUR_BAR
        .replace("L2 = 26", "L2 = 8")
        .replace("L3 = 18", &format!("L3 = {:?}", distance - 8.0 - 0.31));
    let failure = refused(&model(&short), &SET);
    assert_eq!(
        failure.message,
        "the loop A-B-C-D cannot close: with crank.angle = 70° the links are short by 0.310 m at joint C"
    );
    close("gap", failure.gap, 0.31, 1e-9);
    assert_eq!(failure.name, "C");
    assert!(
        failure.hint.contains("coupler") && failure.hint.contains("rocker"),
        "{}",
        failure.hint
    );
}

#[test]
fn a_link_too_long_is_named_as_well() {
    let b = [10.0 * 70_f64.to_radians().cos(), 10.0 * 70_f64.to_radians().sin()];
    let distance = (20.0 - b[0]).hypot(b[1]);
    let long = FOUR_BAR.replace("L2 = 26", &format!("L2 = {:?}", 18.0 + distance + 0.25));
    let failure = refused(&model(&long), &SET);
    assert!(
        failure.message.contains("one link is too long for the other by 0.250 m at joint C"),
        "{}",
        failure.message
    );
}

#[test]
fn bodies_drawn_where_they_stand() {
    let drawn = FOUR_BAR
        .replace(
            "length = \"L2\"\nends = [\"B\", \"C\"]",
            "through = { B = [3.4, 9.4], C = [28.6, 15.8] }",
        )
        .replace(
            "length = \"L3\"\nends = [\"C\", \"D\"]",
            "through = { C = [28.6, 15.8], D = [20, 0] }",
        );
    assert!(!drawn.contains("\"L2\"") && !drawn.contains("\"L3\""));
    let m = model(&drawn);
    let (state, _) = start(&m, &SET, &[]);
    assert!(largest(&residual(&m, &state)) < 1e-11);
    let length = (25.2_f64).hypot(6.4);
    close("coupler", 2.0 * m.bodies[2].point("C").unwrap().x, length, 1e-13);
    close("C", state.q[3] + 0.5 * length * state.q[5].cos(), 28.6, 0.1);
    let mirrored = drawn.replace("[28.6, 15.8]", "[14, -14.5]");
    let m = model(&mirrored);
    let (state, _) = start(&m, &SET, &[]);
    let length = (14.0_f64 - 3.4).hypot(14.5 + 9.4);
    close("C", state.q[4] + 0.5 * length * state.q[5].sin(), -14.5, 0.2);
}
