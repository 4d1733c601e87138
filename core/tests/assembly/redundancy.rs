//! Constraints that repeat each other, and positions where they only seem to.

use crate::mechanisms::{close, largest, model, refused, request, residual, start};
use kempe::analyses::assemble::{assemble, Fault};
use kempe::analyses::mobility;

const TWIN: &str = r#"
[joints.D2]
type = "revolute"
i = "ground.D"
j = "rocker.D"
"#;

/// Cranks of 1 m on pins 2 m apart, coupled by one bar.
fn parallelogram(third: bool) -> String {
    let mut text =
        String::from("[bodies.ground]\npoints = { P0 = [0, 0], P1 = [2, 0], P2 = [1, 0] }\n");
    let mut joints = String::new();
    for k in 0..if third { 3 } else { 2 } {
        text += &format!(
            "[bodies.crank{k}]\ntype = \"bar\"\nmass = 1\nlength = 1\nends = [\"A\", \"B\"]\n"
        );
        joints += &format!(
            "[joints.A{k}]\ntype = \"revolute\"\ni = \"ground.P{k}\"\nj = \"crank{k}.A\"\n"
        );
        joints += &format!(
            "[joints.B{k}]\ntype = \"revolute\"\ni = \"crank{k}.B\"\nj = \"coupler.Q{k}\"\n"
        );
    }
    text += "[bodies.coupler]\nmass = 2\ninertia = 1\npoints = { Q0 = [-1, 0], Q1 = [1, 0], Q2 = [0, 0] }\n";
    text + &joints
}

#[test]
fn twin_joints_are_named() {
    let m = model(
        &(crate::mechanisms::FOUR_BAR
            .replace("[forces.spring]", &format!("{TWIN}\n[forces.spring]"))),
    );
    let failure = refused(&m, &[("crank.angle", "70*deg")]);
    assert_eq!(failure.fault, Fault::Redundant);
    assert_eq!(failure.message, "joint D2 repeats joint D: both fix point rocker.D to ground");
    assert_eq!(failure.hint, "remove one, or pass redundancy='allow'");
    assert_eq!(failure.name, "D2");
}

#[test]
fn allowed_twins_assemble_with_velocities() {
    let m = model(
        &(crate::mechanisms::FOUR_BAR
            .replace("[forces.spring]", &format!("{TWIN}\n[forces.spring]"))),
    );
    let plain = model(crate::mechanisms::FOUR_BAR);
    let ask = [("crank.angle", "70*deg"), ("crank.omega", "2")];
    let guess = [("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")];
    let allowed = m.allowing_redundancy();
    let (state, report) = assemble(&allowed, &request(&allowed, &ask, &guess)).unwrap();
    let (expected, _) = start(&plain, &ask, &guess);
    assert_eq!(report.degrees_of_freedom, 1);
    for k in 0..9 {
        close("q", state.q[k], expected.q[k], 1e-10);
        close("v", state.v[k], expected.v[k], 1e-8);
    }
}

#[test]
fn a_third_parallel_crank_is_redundant_everywhere() {
    let m = model(&parallelogram(true));
    for angle in ["0.7", "2.5"] {
        let failure = refused_parallel(&m, angle);
        assert_eq!(failure.fault, Fault::Redundant);
        assert!(failure.message.contains("depend on each other"), "{}", failure.message);
        let (state, report) = assemble(&m.allowing_redundancy(), &ask(&m, angle)).unwrap();
        assert_eq!(report.degrees_of_freedom, 1);
        assert!(largest(&residual(&m, &state)) < 1e-11);
        let found = mobility(&m, 0.0, &state.q);
        assert_eq!((found.redundant.len(), found.singular.len(), found.rank), (1, 0, 11));
        assert_eq!(found.redundant[0], [0, 1, 2, 3, 4, 5], "all joints take part");
    }
}

fn ask(m: &kempe::model::Model, angle: &str) -> kempe::analyses::assemble::Request {
    let guess: Vec<(String, &str)> =
        (1..m.bodies.len() - 2).map(|k| (format!("crank{k}.angle"), angle)).collect();
    let mut guess: Vec<(&str, &str)> = guess.iter().map(|(k, x)| (k.as_str(), *x)).collect();
    guess.push(("coupler.angle", "0"));
    request(m, &[("crank0.angle", angle)], &guess)
}

fn refused_parallel(
    m: &kempe::model::Model,
    angle: &str,
) -> Box<kempe::analyses::assemble::Failure> {
    assemble(m, &ask(m, angle)).expect_err("redundant")
}

#[test]
fn a_flat_parallelogram_is_singular_but_not_redundant() {
    let m = model(&parallelogram(false));
    let (state, report) = assemble(&m, &ask(&m, "0")).unwrap();
    close("flat", state.q[2], 0.0, 1e-14);
    close("flat", state.q[1], 0.0, 1e-12);
    assert!(
        report.warnings.iter().any(|w| w.contains("singular position")),
        "{:?}",
        report.warnings
    );
    let found = mobility(&m, 0.0, &state.q);
    assert!(found.redundant.is_empty() && found.singular == [[0, 1, 2, 3]], "{found:?}");
    assert_eq!(found.rank, 7);
    let (_, report) = assemble(&m, &ask(&m, "0.4")).unwrap();
    assert!(report.warnings.is_empty() && report.degrees_of_freedom == 1);
}

#[test]
fn a_flat_parallelogram_with_a_third_crank_is_both() {
    let m = model(&parallelogram(true));
    let (state, _) = assemble(&m.allowing_redundancy(), &ask(&m, "0")).unwrap();
    let found = mobility(&m, 0.0, &state.q);
    assert_eq!(found.rank, 10, "{found:?}");
    assert!(!found.redundant.is_empty() && !found.singular.is_empty(), "{found:?}");
}

#[test]
fn a_driver_that_repeats_a_driver() {
    let text = r#"
[bodies.slider]
mass = 1
inertia = 1
[drivers.one]
type = "coordinate_driver"
coordinate = "slider.x"
value = "t"
[drivers.two]
type = "coordinate_driver"
coordinate = "slider.x"
value = "t"
"#;
    let failure = refused(&model(text), &[]);
    assert_eq!(failure.message, "driver two repeats driver one");
}
