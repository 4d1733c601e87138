//! Configurations of meshed wheels and of bodies on massless rods, against algebra.

use crate::mechanisms::{asked, column, model, start};
use kempe::analyses::assemble::Request;
use kempe::analyses::configurations::{configurations, Configurations};
use kempe::model::Model;
use std::f64::consts::TAU;

fn all(m: &Model, set: &[(&str, &str)]) -> Configurations {
    let request = Request { set: asked(m, "set", set), ..Request::default() };
    configurations(m, &request, 100, &|| false).expect("positions")
}

/// The values of a coordinate in all configurations.
fn values(m: &Model, found: &Configurations, body: &str, c: usize) -> Vec<f64> {
    found.states.iter().map(|(state, _)| state.q[column(m, body, c)]).collect()
}

/// Whether the same angles are in both lists, whole turns aside.
#[track_caller]
fn same_angles(found: &[f64], exact: &[f64]) {
    assert_eq!(found.len(), exact.len(), "{found:?} {exact:?}");
    for angle in exact {
        let off = |x: &f64| ((x - angle) / TAU - ((x - angle) / TAU).round()).abs();
        assert!(found.iter().any(|x| off(x) < 1e-9), "{angle} is not among {found:?}");
    }
}

/// The intersections of two circles.
fn circles([ax, ay]: [f64; 2], r: f64, [bx, by]: [f64; 2], s: f64) -> Vec<[f64; 2]> {
    let (dx, dy) = (bx - ax, by - ay);
    let d = dx.hypot(dy);
    let along = (d * d + r * r - s * s) / (2.0 * d);
    let square = r * r - along * along;
    let foot = [ax + along * dx / d, ay + along * dy / d];
    let sides = if square < 0.0 { vec![] } else { vec![square.sqrt(), -square.sqrt()] };
    sides.iter().map(|h| [foot[0] - h * dy / d, foot[1] + h * dx / d]).collect()
}

/// Two wheels on ground, j to the right of i.
fn wheels(joint: &str, radii: [f64; 2], apart: f64) -> String {
    let [r_i, r_j] = radii;
    format!(
        "[bodies.ground]\npoints = {{ O = [0, 0], P = [{apart}, 0] }}\n\
         [bodies.first]\nmass = 1\ninertia = 1\npoints = {{ O = [0, 0], A = [{r_i}, 0] }}\n\
         [bodies.second]\nmass = 1\ninertia = 1\npoints = {{ P = [0, 0], B = [{r_j}, 0] }}\n\
         [joints]\nO = {{ type = 'revolute', i = 'ground.O', j = 'first.O' }}\n\
         P = {{ type = 'revolute', i = 'ground.P', j = 'second.P' }}\n\
         G = {{ {joint}, i = 'first.O', j = 'second.P', radii = [{r_i}, {r_j}] }}\n"
    )
}

/// While the held wheel turns m times, the other turns by m times the ratio: all of these are positions.
#[test]
fn meshes_of_two_wheels() {
    let alpha = 0.7;
    for (radii, of_second, of_first) in
        [([1.0, 2.0], 2, 1), ([0.2, 0.3], 3, 2), ([1.0, 1.0], 1, 1), ([0.5, 2.0], 4, 1)]
    {
        let [r_i, r_j] = radii;
        for (joint, sense, apart) in [
            ("type = 'gear'", -1.0, r_i + r_j),
            ("type = 'gear', internal = true", 1.0, r_j - r_i),
            ("type = 'belt'", 1.0, 4.0),
            ("type = 'belt', crossed = true", -1.0, 4.0),
        ] {
            if apart == 0.0 {
                continue;
            }
            let m = model(&wheels(joint, radii, apart));
            let held = [
                ("first", "second", r_i / r_j, of_second),
                ("second", "first", r_j / r_i, of_first),
            ];
            for (held, other, ratio, count) in held {
                let found = all(&m, &[(&format!("{held}.angle"), &format!("{alpha}"))]);
                let turned = |k: i32| sense * ratio * (alpha + TAU * f64::from(k));
                let exact: Vec<f64> = (0..count).map(turned).collect();
                same_angles(&values(&m, &found, other, 2), &exact);
                assert!(found.complete, "{joint} {radii:?} {held}");
            }
        }
    }
}

/// Wheels with an irrational ratio mesh at more angles than are listed.
#[test]
fn more_meshes_than_the_limit() {
    let m = model(&wheels("type = 'gear'", [1.0, 2.0_f64.sqrt()], 1.0 + 2.0_f64.sqrt()));
    let found = all(&m, &[("first.angle", "0.7")]);
    assert!(found.states.len() == 100 && !found.complete);
}

/// A geared five-bar: two bars join pins of both wheels. Each mesh has its own dyad.
#[test]
fn a_geared_five_bar() {
    for (radii, bars) in [([0.5, 1.0], [2.0, 2.2]), ([0.6, 0.9], [1.4, 1.3])] {
        let [r_i, r_j] = radii;
        let text = wheels("type = 'gear'", radii, r_i + r_j);
        let text = text.replace(
            "[joints]",
            &format!(
                "[bodies.left]\ntype = 'bar'\nmass = 1\nlength = {}\nends = ['A', 'C']\n\
                 [bodies.right]\ntype = 'bar'\nmass = 1\nlength = {}\nends = ['B', 'C']\n[joints]\n\
                 A = {{ type = 'revolute', i = 'first.A', j = 'left.A' }}\n\
                 B = {{ type = 'revolute', i = 'second.B', j = 'right.B' }}\n\
                 C = {{ type = 'revolute', i = 'left.C', j = 'right.C' }}",
                bars[0], bars[1]
            ),
        );
        let m = model(&text);
        let alpha: f64 = 2.1;
        let meshes = if r_i == 0.5 { 2 } else { 3 };
        let mut exact = Vec::new();
        for k in 0..meshes {
            let second = -r_i / r_j * (alpha + TAU * f64::from(k));
            let a = [r_i * alpha.cos(), r_i * alpha.sin()];
            let b = [r_i + r_j + r_j * second.cos(), r_j * second.sin()];
            for [x, y] in circles(a, bars[0], b, bars[1]) {
                exact.push((y - a[1]).atan2(x - a[0]));
            }
        }
        assert!(exact.len() >= 4);
        let found = all(&m, &[("first.angle", &format!("{alpha}"))]);
        same_angles(&values(&m, &found, "left", 2), &exact);
        assert!(found.complete);
    }
}

/// A coupling 1:2 counts the turns of the rocker of a four-bar; a dyad closes at any of them.
#[test]
fn a_coupling_counts_whole_turns() {
    let m = model(
        "[bodies.ground]\npoints = { A = [0, 0], D = [3, 0], E = [6, 0] }\n\
         [bodies.crank]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A', 'B']\n\
         [bodies.coupler]\ntype = 'bar'\nmass = 1\nlength = 3\nends = ['B', 'C']\n\
         [bodies.rocker]\ntype = 'bar'\nmass = 1\nlength = 2.5\nends = ['D', 'C']\n\
         [bodies.wheel]\nmass = 1\ninertia = 1\npoints = { E = [0, 0] }\n\
         [joints]\nA = { type = 'revolute', i = 'ground.A', j = 'crank.A' }\n\
         B = { type = 'revolute', i = 'crank.B', j = 'coupler.B' }\n\
         C = { type = 'revolute', i = 'coupler.C', j = 'rocker.C' }\n\
         D = { type = 'revolute', i = 'ground.D', j = 'rocker.D' }\n\
         E = { type = 'revolute', i = 'ground.E', j = 'wheel.E' }\n\
         K = { type = 'coupling', terms = { 'D.angle' = 1, 'E.angle' = -2 } }\n",
    );
    let found = all(&m, &[("crank.angle", "1")]);
    let b = [1.0_f64.cos(), 1.0_f64.sin()];
    let rockers = circles(b, 3.0, [3.0, 0.0], 2.5).into_iter().map(|[x, y]| y.atan2(x - 3.0));
    let exact: Vec<f64> = rockers.flat_map(|angle| [0.5 * angle, 0.5 * (angle + TAU)]).collect();
    same_angles(&values(&m, &found, "wheel", 2), &exact);
}

const RODS: &str = "[bodies.ground]\npoints = { A = [0, 0], B = [3, 0.4] }\n";

/// A point mass on two rods is where their circles meet.
#[test]
fn a_point_mass_on_two_rods() {
    let m = model(&format!(
        "{RODS}[bodies.bob]\ntype = 'point_mass'\nmass = 1\n\
         [joints]\nR = {{ type = 'distance', i = 'ground.A', j = 'bob.P', length = 2 }}\n\
         S = {{ type = 'distance', i = 'bob.P', j = 'ground.B', length = 2.5 }}\n"
    ));
    let exact = circles([0.0, 0.0], 2.0, [3.0, 0.4], 2.5);
    let (state, report) = start(&m, &[], &[]);
    assert!((state.q[0] - exact[0][0]).hypot(state.q[1] - exact[0][1]) < 1e-12, "{:?}", state.q);
    assert!(report.modes[0].left && report.alternatives == Some(1));
    let (state, report) = start(&m, &[], &[("bob.y", "-1")]);
    assert!((state.q[0] - exact[1][0]).hypot(state.q[1] - exact[1][1]) < 1e-12, "{:?}", state.q);
    assert!(!report.modes[0].left);
    let found = all(&m, &[]);
    assert!(found.complete && found.states.len() == 2);
    for ([x, y], (state, _)) in exact.iter().zip(&found.states) {
        assert!((state.q[0] - x).hypot(state.q[1] - y) < 1e-12);
    }
}

/// A body of given angle on two rods at two of its points: the circles are moved by these points.
#[test]
fn a_body_on_two_rods() {
    let m = model(&format!(
        "{RODS}[bodies.plate]\nmass = 1\ninertia = 1\npoints = {{ C = [-0.5, 0.1], D = [0.6, 0] }}\n\
         [joints]\nR = {{ type = 'distance', i = 'ground.A', j = 'plate.C', length = 2 }}\n\
         S = {{ type = 'distance', i = 'ground.B', j = 'plate.D', length = 2.5 }}\n"
    ));
    let angle = 0.3_f64;
    let (sin, cos) = angle.sin_cos();
    let c = [0.5 * cos + 0.1 * sin, 0.5 * sin - 0.1 * cos];
    let d = [3.0 - 0.6 * cos, 0.4 - 0.6 * sin];
    let found = all(&m, &[("plate.angle", "0.3")]);
    assert!(found.complete && found.states.len() == 2);
    for [x, y] in circles(c, 2.0, d, 2.5) {
        let off = |q: &[f64]| (q[0] - x).hypot(q[1] - y);
        assert!(found.states.iter().any(|(state, _)| off(&state.q) < 1e-12));
    }
    let sides: Vec<bool> = found.states.iter().map(|(_, report)| report.modes[0].left).collect();
    assert_eq!(sides, [true, false]);
    // without an angle one is assumed, and it closes
    let (state, report) = start(&m, &[], &[]);
    assert!(report.degrees_of_freedom == 1 && state.q[2] == 0.0);
}

/// A rod to a bar on a pin, and to a block on a slide: both closures, and no others.
#[test]
fn a_rod_closes_a_dyad() {
    let m = model(&format!(
        "{RODS}[bodies.bar]\ntype = 'bar'\nmass = 1\nlength = 2\nends = ['A', 'C']\n\
         [joints]\nA = {{ type = 'revolute', i = 'ground.A', j = 'bar.A' }}\n\
         S = {{ type = 'distance', i = 'ground.B', j = 'bar.C', length = 2.5 }}\n"
    ));
    let found = all(&m, &[]);
    let exact: Vec<f64> =
        circles([0.0, 0.0], 2.0, [3.0, 0.4], 2.5).iter().map(|[x, y]| y.atan2(*x)).collect();
    same_angles(&values(&m, &found, "bar", 2), &exact);
    assert!(found.complete);
    let m = model(&format!(
        "{RODS}[bodies.block]\nmass = 1\ninertia = 1\npoints = {{ C = [0, 0] }}\n\
         [joints]\nT = {{ type = 'translational', i = 'ground.A', j = 'block.C' }}\n\
         S = {{ type = 'distance', i = 'ground.B', j = 'block.C', length = 2.5 }}\n"
    ));
    let found = all(&m, &[]);
    let half = (2.5_f64 * 2.5 - 0.16).sqrt();
    let x = values(&m, &found, "block", 0);
    assert!(found.complete && x.len() == 2);
    assert!((x[0] - 3.0 - half).abs() < 1e-12 && (x[1] - 3.0 + half).abs() < 1e-12, "{x:?}");
}
