//! The translational joint: its residual, assembly of slider-cranks, and its reaction.

use crate::mechanisms::{model, start, SLIDER_CRANK};
use kempe::elements::joints::Translational;
use kempe::elements::{At, BodyId, Joint, PointOn};
use kempe::math::{Local, Pose};

fn joint() -> Translational {
    let on = |body, x, y| PointOn { body: BodyId(body), s: Local::new(x, y) };
    Translational { i: on(1, 0.2, -0.3), j: on(2, 0.5, 0.1), axes: [0.4, -1.1] }
}

#[test]
fn the_residual_is_the_distance_from_the_line_and_the_angle() {
    let ground = Pose::identity();
    let e = Translational { axes: [0.5, 0.0], ..joint() };
    let e = Translational { i: PointOn { s: Local::new(1.0, 2.0), ..e.i }, ..e };
    let e = Translational { j: PointOn { s: Local::zero(), ..e.j }, ..e };
    let (sin, cos) = 0.5_f64.sin_cos();
    // 3 m along the slide and 0.25 m to its left, turned by 0.1 rad
    let j = Pose::new(1.0 + 3.0 * cos - 0.25 * sin, 2.0 + 3.0 * sin + 0.25 * cos, 0.6);
    let mut phi = [f64::NAN; 2];
    Translational::residual(&e, &At { bodies: &[ground, j], own: &[], t: 0.0 }, &mut phi);
    assert!((phi[0] - 0.25).abs() < 1e-14 && (phi[1] - 0.1).abs() < 1e-14, "{phi:?}");
}

#[test]
fn a_slider_crank_goes_together_without_a_guess() {
    let m = model(SLIDER_CRANK);
    for degrees in [0, 30, 60, 90, 135, 180, 200, 270, 330] {
        let angle = f64::from(degrees).to_radians();
        let (state, _) = start(&m, &[("crank.angle", &format!("{degrees}*deg"))], &[]);
        let expected = 0.1 * angle.cos() + (0.09 - (0.1 * angle.sin()).powi(2)).sqrt();
        assert!((state.q[6] - expected).abs() < 1e-12, "{degrees}°: {} {expected}", state.q[6]);
        assert!(state.q[7].abs() < 1e-12 && state.q[8].abs() < 1e-12);
    }
}

#[test]
fn the_guess_of_the_slider_decides_on_which_side_it_is() {
    let m = model(SLIDER_CRANK);
    for (guess, sign) in [("0.3", 1.0), ("-0.3", -1.0)] {
        let (state, _) = start(&m, &[("crank.angle", "90*deg")], &[("piston.x", guess)]);
        assert!((state.q[6] - sign * 0.08_f64.sqrt()).abs() < 1e-12, "{guess}: {}", state.q[6]);
    }
}

#[test]
fn the_slider_may_be_set_instead_of_the_crank() {
    let m = model(SLIDER_CRANK);
    let (state, _) = start(&m, &[("piston.x", "0.35")], &[]);
    assert!((state.q[6] - 0.35).abs() < 1e-12);
    let crank = (0.1_f64.powi(2) + 0.35_f64.powi(2) - 0.3_f64.powi(2)) / (2.0 * 0.1 * 0.35);
    assert!((state.q[2].cos() - crank).abs() < 1e-12);
}

#[test]
fn a_guide_that_is_turned_and_written_the_other_way_round_goes_together() {
    let turned = SLIDER_CRANK.replace(
        "i = \"ground.S\"\nj = \"piston.B\"",
        "i = \"piston.B\"\nj = \"ground.S\"\naxes = [\"30*deg\", \"75*deg\"]",
    );
    let m = model(&turned);
    let (state, _) = start(&m, &[("crank.angle", "75*deg")], &[]);
    // the slide points along 75° in ground, along 30° in the slider
    let along = state.q[6] * 75_f64.to_radians().cos() + state.q[7] * 75_f64.to_radians().sin();
    assert!((along.abs() - 0.4).abs() < 1e-9 || (along.abs() - 0.2).abs() < 1e-9, "{along}");
    assert!((state.q[8] - 45_f64.to_radians()).abs() < 1e-12);
}

#[test]
fn an_oscillating_guide_goes_together_without_a_guess() {
    // the guide is pinned to ground, the block to the crank: no line is known beforehand
    let text = SLIDER_CRANK
        .replace("points = { O = [0, 0], S = [0, 0] }", "points = { O = [0, 0], C = [0.25, 0.02] }")
        .replace("i = \"rod.B\"\nj = \"piston.B\"", "i = \"ground.C\"\nj = \"piston.B\"")
        .replace(
            "type = \"translational\"\ni = \"ground.S\"\nj = \"piston.B\"",
            "type = \"translational\"\ni = \"rod.A\"\nj = \"piston.B\"",
        );
    let m = model(&text);
    let (state, _) = start(&m, &[("crank.angle", "60*deg")], &[]);
    let (a, c) = ((0.05, 0.1 * 60_f64.to_radians().sin()), (0.25_f64, 0.02_f64));
    let line = (c.1 - a.1).atan2(c.0 - a.0);
    assert!((state.q[5] - line).sin().abs() < 1e-9, "{} {line}", state.q[5]);
}
