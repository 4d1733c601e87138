//! `set` and `guess` of quantities of points and elements.

use crate::mechanisms::{
    asked, close, largest, model, rate, request, residual, start, FOUR_BAR, PENDULUM, SLIDER_CRANK,
};
use kempe::analyses::assemble::{assemble, targets, Target};
use kempe::equations::kinematics::Motions;
use kempe::model::Model;

fn point(m: &Model, q: &[f64], body: &str, name: &str) -> [f64; 2] {
    let id = m.body(body).unwrap();
    let at = Motions::at_rest(&m.layout, q)[id.0].pose.point(*m.bodies[id.0].point(name).unwrap());
    [at.x, at.y]
}

#[test]
fn the_angle_of_a_joint_with_its_rate_and_whole_turns() {
    let m = model(PENDULUM);
    for angle in [0.5, -2.0, 7.0, 20.0] {
        let text = format!("{angle:?}");
        let (state, report) = start(&m, &[("pin.angle", &text), ("pin.omega", "3")], &[]);
        close("angle", state.q[2], angle, 1e-12);
        close("omega", state.v[2], 3.0, 1e-12);
        assert_eq!(report.degrees_of_freedom, 1);
        assert!(largest(&residual(&m, &state)) < 1e-12 && largest(&rate(&m, &state)) < 1e-12);
        let (state, _) = start(&m, &[], &[("pin.angle", &text), ("pin.omega", "3")]);
        close("guessed angle", state.q[2], angle, 1e-9);
        close("guessed omega", state.v[2], 3.0, 1e-9);
    }
}

#[test]
fn points_of_bodies() {
    let m = model(PENDULUM);
    let (state, _) = start(&m, &[("rod.P.x", "0.6"), ("rod.P.vx", "0.4")], &[("rod.angle", "1")]);
    close("angle", state.q[2], 0.6_f64.acos(), 1e-12);
    // x = cos(angle): vx = -0.8 omega
    close("omega", state.v[2], -0.5, 1e-12);
    let (state, _) = start(&m, &[("rod.P.x", "0.6")], &[("rod.P.y", "-0.7")]);
    close("the guess chooses", state.q[2], -(0.6_f64.acos()), 1e-12);
}

#[test]
fn the_displacement_of_a_slide_and_the_length_of_a_spring() {
    let text = SLIDER_CRANK.to_string()
        + "\n[forces.spring]\ntype = \"spring_damper\"\ni = \"ground.S\"\nj = \"piston.B\"\nstiffness = 1\nfree_length = 0.3\n";
    let m = model(&text);
    let slide = m.constraints.iter().find(|c| {
        !c.element.measured().is_empty() && c.element.measured()[0].names[0] == "displacement"
    });
    let slide = format!("{}.displacement", slide.unwrap().name);
    for (key, up) in [(slide.as_str(), "0.5"), (slide.as_str(), "-0.5"), ("spring.length", "0.5")] {
        let (state, _) = start(&m, &[(key, "0.35")], &[("crank.angle", up)]);
        let crank = point(&m, &state.q, "crank", "A");
        let piston = point(&m, &state.q, "piston", "B");
        close(key, piston[0], 0.35, 1e-12);
        // crank 0.1, rod 0.3: cosine of the angle at O
        let cos: f64 = (0.35 * 0.35 + 0.01 - 0.09) / (2.0 * 0.1 * 0.35);
        close("crank", crank[0], 0.1 * cos, 1e-12);
        assert_eq!(crank[1] > 0.0, up == "0.5", "the guess chooses the side");
    }
}

#[test]
fn a_guess_of_the_angle_of_a_joint_chooses_the_closure() {
    let m = model(FOUR_BAR);
    let set = [("crank.angle", "70*deg")];
    let (first, _) = start(&m, &set, &[("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")]);
    let (other, _) = start(&m, &set, &[("coupler.angle", "-70*deg"), ("rocker.angle", "120*deg")]);
    assert!((first.q[8] - other.q[8]).abs() > 0.5, "two closures");
    for wanted in [&first, &other] {
        let near = format!("{:?}", wanted.q[5] - wanted.q[2] + 0.15);
        let (state, _) = start(&m, &set, &[("B.angle", &near)]);
        let angle = |q: &[f64]| (q[5] - q[2]).rem_euclid(std::f64::consts::TAU);
        close("coupler against crank", angle(&state.q), angle(&wanted.q), 1e-9);
        let exact = format!("{:?}", wanted.q[5] - wanted.q[2]);
        let (state, _) = start(&m, &[("B.angle", &exact)], &[("rocker.angle", "4")]);
        close("set", state.q[5] - state.q[2], wanted.q[5] - wanted.q[2], 1e-12);
    }
}

#[test]
fn rates_of_quantities_of_a_loop() {
    let m = model(FOUR_BAR);
    let guess = [("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")];
    let (driven, _) = start(&m, &[("crank.angle", "70*deg"), ("crank.omega", "1")], &guess);
    let relative = driven.v[5] - driven.v[2];
    let (state, _) = start(
        &m,
        &[("crank.angle", "70*deg"), ("B.omega", &format!("{:?}", 2.0 * relative))],
        &guess,
    );
    close("crank", state.v[2], 2.0, 1e-11);
}

#[test]
fn what_cannot_be_set_is_named() {
    let m = model(FOUR_BAR);
    for (key, parts) in [
        ("C.force", ["'C.force' is a result", "angle, omega"]),
        ("C.alpha", ["'C.alpha' is an acceleration", "angle, omega"]),
        ("C.angel", ["'angel' is not a position quantity or rate of 'C'", "'angle'"]),
        (
            "crank.B.angle",
            ["'angle' is not a position quantity or rate of 'crank.B'", "x, vx, y, vy"],
        ),
        ("crank.B.ax", ["'crank.B.ax' is an acceleration", "x, vx, y, vy"]),
        ("ground.A.x", ["'ground.A.x' does not move", "moving body"]),
        ("K.angle", ["unknown body 'K'", ""]),
        ("spring.torque", ["'spring.torque' is a result", "angle, omega"]),
    ] {
        for section in ["set", "guess"] {
            let found = targets(&m, section, &[(key.to_string(), "1".into())]).expect_err(key);
            let text = found[0].to_string();
            assert!(parts.iter().all(|part| text.contains(part)), "{key}: {text}");
        }
    }
    let found = targets(&m, "set", &[("C.angle".to_string(), "2 m".into())]).unwrap_err();
    assert!(found[0].to_string().contains("must be in rad"), "{}", found[0]);
    assert!(matches!(asked(&m, "set", &[("C.angle", "1")])[0], Target::Quantity(_)));
}

#[test]
fn a_state_is_followed_to_a_guess() {
    let m = model(PENDULUM);
    let (state, _) = start(&m, &[("pin.angle", "0.4")], &[]);
    let mut again = request(&m, &[], &[("rod.P.y", "0.8")]);
    again.state = Some(state);
    let (moved, _) = assemble(&m, &again).unwrap();
    close("angle", moved.q[2], 0.8_f64.asin(), 1e-9);
}
