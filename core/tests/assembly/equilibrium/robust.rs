//! Starts and mechanisms that make the search difficult.

use super::{found, rest};
use crate::mechanisms::{close, column, model, start, Random};
use kempe::analyses::equilibrium::{Options, Reason};
use std::f64::consts::PI;

/// Links that hang from a pin, from random starts: they all hang down, and the modified Newton steps leave every saddle.
#[test]
fn a_chain_hangs_down_from_any_start() {
    let n = 6;
    let mut text = String::from("gravity = [0, -9.81]\n[bodies.ground]\npoints = { A = [0, 0] }\n");
    for k in 0..n {
        let i = if k == 0 { "ground.A".to_string() } else { format!("l{}.Q", k - 1) };
        text += &format!(
            "[bodies.l{k}]\ntype = 'bar'\nmass = 1\nlength = 0.3\nends = ['P', 'Q']\n\
             [joints.j{k}]\ntype = 'revolute'\ni = '{i}'\nj = 'l{k}.P'\n"
        );
    }
    let m = model(&text);
    let mut random = Random::new(5);
    for trial in 0..20 {
        // the first start is nearly upright, the others arbitrary
        let angle = |x: f64| if trial == 0 { 0.5 * PI + 1e-3 * x } else { PI * x };
        let set: Vec<(String, String)> =
            (0..n).map(|k| (format!("l{k}.angle"), angle(random.next()).to_string())).collect();
        let set: Vec<(&str, &str)> = set.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
        let (state, _) = start(&m, &set, &[]);
        let found = rest(&m, &state);
        for k in 0..n {
            let angle = found.state.q[column(&m, &format!("l{k}"), 2)];
            close("down", angle.sin(), -1.0, 1e-13);
        }
        assert!(found.stable, "{trial}: {:?}", found.eigenvalues);
    }
}

/// A symmetric start leads Newton's method to the upper, unstable position; it is left along the descent.
#[test]
fn a_symmetric_start_does_not_end_on_a_saddle() {
    let text = "gravity = [0, -10]\n[bodies.ground]\npoints = { O = [0, 0], S = [0, 3] }\n\
                [bodies.rod]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['O', 'P']\n\
                [joints.O]\ntype = 'translational'\ni = 'ground.O'\nj = 'block.O'\naxes = ['90*deg', 0]\n\
                [bodies.block]\nmass = 1\ninertia = 1\npoints = { O = [0, 0] }\n\
                [joints.P]\ntype = 'revolute'\ni = 'block.O'\nj = 'rod.O'\n\
                [forces.spring]\ntype = 'spring_damper'\ni = 'ground.S'\nj = 'block.O'\nstiffness = 50\nfree_length = 1\n";
    let m = model(text);
    let (state, _) = start(&m, &[("block.y", "1"), ("rod.angle", "90*deg")], &[]);
    let found = rest(&m, &state);
    close("height", found.state.q[column(&m, "block", 1)], 2.0 - 20.0 / 50.0, 1e-12);
    close("down", found.state.q[column(&m, "rod", 2)].sin(), -1.0, 1e-13);
    assert!(found.stable);
}

/// Springs that only pull, from all sides: their stiffness jumps where they become slack.
#[test]
fn a_net_of_cables_is_a_minimum() {
    let mut text = String::from("gravity = [0, -9.81]\n[bodies.ground]\npoints = { ");
    for k in 0..5 {
        let angle = 0.2 + 2.0 * PI * f64::from(k) / 5.0;
        text += &format!("A{k} = [{}, {}], ", 3.0 * angle.cos(), 3.0 * angle.sin());
    }
    text += "Z = [0, 0] }\n[bodies.a]\ntype = 'point_mass'\nmass = 3\nat = [0.5, 0]\n\
             [bodies.b]\ntype = 'point_mass'\nmass = 1\nat = [-0.5, 0.2]\n";
    let mut cables = Vec::new();
    for k in 0..5_u8 {
        let angle = 0.2 + 2.0 * PI * f64::from(k) / 5.0;
        let body = if k % 2 == 0 { "a" } else { "b" };
        let free = 2.0 + 0.3 * f64::from(k);
        cables.push((3.0 * angle.cos(), 3.0 * angle.sin(), usize::from(k % 2), free));
        text += &format!(
            "[forces.c{k}]\ntype = 'spring_damper'\ni = 'ground.A{k}'\nj = '{body}.P'\nstiffness = 40\n\
             free_length = {free}\nonly = 'tension'\n"
        );
    }
    text += "[forces.ab]\ntype = 'spring_damper'\ni = 'a.P'\nj = 'b.P'\nstiffness = 30\nfree_length = 0.8\nonly = 'tension'\n";
    let potential = |q: &[f64]| {
        let pull = |k: f64, dx: f64, dy: f64, free: f64| {
            let stretch = (dx.hypot(dy) - free).max(0.0);
            0.5 * k * stretch * stretch
        };
        let all =
            cables.iter().map(|(x, y, b, free)| pull(40.0, q[2 * b] - x, q[2 * b + 1] - y, *free));
        9.81 * (3.0 * q[1] + q[3]) + all.sum::<f64>() + pull(30.0, q[2] - q[0], q[3] - q[1], 0.8)
    };
    let m = model(&text);
    let mut random = Random::new(8);
    for trial in 0..20 {
        let at: Vec<String> = random.many(4).iter().map(|x| (2.0 * x).to_string()).collect();
        let set = [("a.x", at[0].as_str()), ("a.y", &at[1]), ("b.x", &at[2]), ("b.y", &at[3])];
        let (state, _) = start(&m, &set, &[]);
        let found = rest(&m, &state);
        let least = potential(&found.state.q);
        assert!(found.stable, "{trial}");
        for _ in 0..200 {
            let near: Vec<f64> = found.state.q.iter().map(|q| q + 1e-3 * random.next()).collect();
            assert!(potential(&near) >= least - 1e-12, "{trial}: a lower position is beside it");
        }
    }
}

/// A rocker pressed into its dead point by its weight rests at a singular position.
#[test]
fn a_singular_rest_position_is_reported() {
    let text = include_str!("../../../../examples/garage_door.toml");
    let m = model(text);
    let (state, _) =
        start(&m, &[("arm.angle", "20*deg")], &[("door.angle", "0"), ("roller.x", "5")]);
    let reason = found(&m, &state, &Options::new()).expect_err("a singular position");
    assert!(matches!(reason, Reason::Singular { .. }), "{reason}");
    assert!(reason.to_string().contains("singular position"), "{reason}");
}
