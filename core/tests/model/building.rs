//! From text to numbers.

use crate::mechanisms::{close, model, with};
use kempe::model::Model;

const BAR: &str = r#"
gravity = [0, "-g"]
[parameters]
L = "2*half"
half = "250 mm"
g = 9.81
rho = 8
[bodies.bar]
type = "bar"
mass = "rho*L"
length = "L"
ends = ["A", "B"]
points = { M = ["L/4", 0.1], N = ["10 mm", "-L"] }
"#;

#[test]
fn formulas_units_and_parameters_of_parameters() {
    let m = model(BAR);
    let bar = &m.bodies[1];
    close("mass", bar.mass, 4.0, 1e-15);
    close("inertia", bar.inertia, 4.0 * 0.25 / 12.0, 1e-15);
    close("g", m.gravity.y, -9.81, 0.0);
    let at = |name: &str| {
        let s = bar.point(name).unwrap();
        [s.x, s.y]
    };
    assert_eq!(at("A"), [-0.25, 0.0]);
    assert_eq!(at("B"), [0.25, 0.0]);
    assert_eq!(at("M"), [0.125, 0.1]);
    assert_eq!(at("N"), [0.01, -0.5]);
}

#[test]
fn overrides_reach_what_refers_to_them() {
    let m = with(BAR, &[("half", 1.0), ("g", 1.6)]);
    close("mass", m.bodies[1].mass, 16.0, 1e-15);
    close("inertia", m.bodies[1].inertia, 16.0 * 4.0 / 12.0, 1e-14);
    close("g", m.gravity.y, -1.6, 0.0);
    assert_eq!(m.bodies[1].point("N").unwrap().y, -2.0);
    let m = with(BAR, &[("L", 3.0)]);
    close("mass", m.bodies[1].mass, 24.0, 1e-15);
}

#[test]
fn an_unknown_override_is_refused_with_a_suggestion() {
    let (case, _) =
        kempe::case::read(&format!("kempe = 1\n{BAR}"), kempe::case::Format::Toml).unwrap();
    let problems =
        kempe::model::build(&case.definition, &[("hlaf".to_string(), 1.0.into())]).unwrap_err();
    assert!(problems[0].to_string().contains("'half'"), "{}", problems[0]);
}

#[test]
fn a_bar_drawn_through_two_points() {
    let m = model(
        r#"
[bodies.link]
type = "bar"
mass = 3
through = { P = [1, 1], Q = [4, 5], R = [1, 5] }
"#,
    );
    let link = &m.bodies[1];
    close("inertia", link.inertia, 3.0 * 25.0 / 12.0, 1e-13);
    let [x, y, angle] = link.drawn.unwrap();
    assert_eq!([x, y], [2.5, 3.0]);
    close("angle", angle, 4.0_f64.atan2(3.0), 1e-15);
    let pose = kempe::math::Pose::new(x, y, angle);
    for (name, at) in [("P", [1.0, 1.0]), ("Q", [4.0, 5.0]), ("R", [1.0, 5.0])] {
        let p = pose.point(*link.point(name).unwrap());
        close(name, p.x, at[0], 1e-14);
        close(name, p.y, at[1], 1e-14);
    }
}

#[test]
fn names_with_spaces() {
    let m = model(
        r#"
[bodies."left crank"]
mass = 1
inertia = 1
points = { "big end" = [1, 0] }
[bodies.ground]
points = { O = [0, 0] }
[joints."main pin"]
type = "revolute"
i = "ground.O"
j = "left crank.big end"
[forces.s]
type = "torsion_spring"
i = "ground"
j = "left crank"
stiffness = "2 + `left crank.angle`^2"
"#,
    );
    assert!(m.body("left crank").is_some() && m.constraint("main pin").is_some());
    assert!(m.forces[0].law.is_some());
}

#[test]
fn a_model_over_lanes_is_many_models() {
    use kempe::math::Lanes;
    let m = model(BAR);
    let half = [0.25, 0.5, 1.0, 2.0];
    // the parameters in order are L half g rho
    let parameters = [half.map(|h| 2.0 * h), half, [9.81; 4], [8.0; 4]].map(Lanes::new);
    let wide: Model<Lanes> = Model::new(&m.blueprint, &parameters);
    for (lane, h) in half.into_iter().enumerate() {
        let one = with(BAR, &[("half", h)]);
        assert_eq!(
            wide.bodies[1].inertia.to_array()[lane].to_bits(),
            one.bodies[1].inertia.to_bits()
        );
        let (a, b) = (wide.bodies[1].point("N").unwrap(), one.bodies[1].point("N").unwrap());
        assert_eq!(a.y.to_array()[lane].to_bits(), b.y.to_bits());
    }
}
