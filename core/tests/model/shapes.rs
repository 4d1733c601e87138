//! Bodies from shapes: exact derivatives by parameters, lanes, and the typed builder.

use kempe::math::{Dual, Real};
use kempe::model::Model;
use kempe::{ModelBuilder, Value};

fn written(radius: &str) -> ModelBuilder {
    let mut m = ModelBuilder::new("wheel");
    m.parameter("R", 0.3).parameter("h", 0.1);
    let corner = |x: &str, y: &str| Value::List(vec![Value::from(x), Value::from(y)]);
    let corners = vec![corner("0", "0"), corner("R", "0"), corner("R", "h"), corner("0", "2*h")];
    let steel = [("density", Value::from(7850.0)), ("thickness", Value::from("h/10"))];
    let disc = [("radius", Value::from(radius))];
    let ring = [("inner", Value::from("h")), ("outer", Value::from("R"))];
    let rod = [("length", Value::from("R")), ("mass", Value::from("5*R"))];
    let with = |own: &[(&'static str, Value)]| [own, &steel[..]].concat();
    m.body("b")
        .shape("disc", with(&disc))
        .shape("ring", [with(&ring), vec![("at", corner("R", "h"))]].concat())
        .shape(
            "polygon",
            [with(&[("points", Value::List(corners))]), vec![("angle", "h".into())]].concat(),
        )
        .shape("rod", rod)
        .outline(Value::Table(vec![("path".to_string(), Value::from("M 0 0 h 1"))]));
    m
}

/// Numbers of the body: mass, mass centre, inertia.
fn numbers<S: Real>(model: &Model<S>) -> [S; 4] {
    let body = &model.bodies[1];
    [body.mass, body.center.x, body.center.y, body.inertia]
}

#[test]
fn derivatives_by_parameters_are_those_of_differences() {
    let model = written("R").build().unwrap();
    let at = |r: f64, h: f64| numbers(&Model::new(&model.blueprint, &[r, h]));
    for k in 0..2 {
        let seed = |j: usize, x: f64| match j == k {
            true => Dual::<3>::variable(x, 0),
            false => Dual::constant(x),
        };
        let exact = numbers(&Model::new(&model.blueprint, &[seed(0, 0.3), seed(1, 0.1)]));
        let step = 1e-6;
        let moved = |sign: f64| match k {
            0 => at(0.3 + sign * step, 0.1),
            _ => at(0.3, 0.1 + sign * step),
        };
        for ((exact, more), less) in exact.iter().zip(moved(1.0)).zip(moved(-1.0)) {
            let difference = (more - less) / (2.0 * step);
            assert!((exact.slope[0] - difference).abs() < 1e-7 * (1.0 + difference.abs()));
        }
    }
}

#[test]
fn a_shape_of_the_builder_is_that_of_a_file() {
    let model = written("R").build().unwrap();
    assert_eq!(model.bodies[1].shapes.len(), 4);
    assert_eq!(model.bodies[1].drawn().len(), 1); // the outline, not the shapes
    let problems = written("0*R").build().unwrap_err();
    assert!(problems.to_string().contains("shape 1 (disc): 0 m; must be > 0"), "{problems}");
    let mut m = ModelBuilder::new("faulty");
    m.body("b").shape("disk", [("radius", Value::from(1.0))]);
    assert!(m.build().is_err());
}
