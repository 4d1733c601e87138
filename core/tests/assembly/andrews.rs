//! Andrews' squeezing mechanism: seven bodies, three loops, from one angle and rough guesses.

use crate::mechanisms::{largest, model, residual, start, worst};
use serde_json::Value;
use std::fmt::Write;

fn reference() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/reference/andrews.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn text(data: &Value) -> String {
    let p = &data["parameters_SI"];
    let points = |table: Vec<(String, Vec<f64>)>| {
        let each: Vec<String> = table.iter().map(|(n, s)| format!("{n} = {s:?}")).collect();
        format!("points = {{ {} }}\n", each.join(", "))
    };
    let ground = ["A", "B", "C", "O"].map(|n| (n.to_string(), numbers(&p[n])));
    let mut text = format!("[bodies.ground]\n{}", points(ground.to_vec()));
    let (m, j) = (numbers(&p["m"]), numbers(&p["J"]));
    for k in 0..7 {
        let name = format!("K{}", k + 1);
        let local = data["local_points_from_mass_centre"][&name].as_object().unwrap();
        let local = local.iter().map(|(n, s)| (n.clone(), numbers(s))).collect();
        writeln!(
            text,
            "[bodies.{name}]\nmass = {:?}\ninertia = {:?}\n{}",
            m[k],
            j[k],
            points(local)
        )
        .unwrap();
    }
    for (k, joint) in data["joints"].as_array().unwrap().iter().enumerate() {
        let (i, j) = joint.as_str().unwrap().split_once(' ').unwrap();
        writeln!(text, "[joints.J{k}]\ntype = \"revolute\"\ni = \"{i}\"\nj = \"{j}\"").unwrap();
    }
    text
}

#[test]
fn from_the_angle_of_k1_and_rough_guesses() {
    let data = reference();
    let m = model(&text(&data));
    let q0 = numbers(&data["q0_cartesian"]);
    let set = format!("{:?}", q0[2]);
    // rough: 10° off, this way and that
    let guess: Vec<(String, String)> = (2..=7)
        .map(|k| {
            let off = if k % 2 == 0 { 0.17 } else { -0.17 };
            (format!("K{k}.angle"), format!("{:.2}", q0[3 * k - 1] + off))
        })
        .collect();
    let guess: Vec<(&str, &str)> = guess.iter().map(|(k, x)| (k.as_str(), x.as_str())).collect();
    let (state, report) = start(&m, &[("K1.angle", &set)], &guess);
    assert_eq!(report.degrees_of_freedom, 1);
    assert!(worst(&state.q, &q0) < 1e-10, "{:.2e}", worst(&state.q, &q0));
    assert!(largest(&residual(&m, &state)) < 1e-13);
}
