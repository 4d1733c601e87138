//! All positions of mechanisms with slides and slots, against the roots of their closure equations. The list is proven to
//! be complete for each of them.

use crate::mechanisms::{asked, column, count, model, Random};
use kempe::analyses::assemble::Request;
use kempe::analyses::configurations::configurations;
use kempe::model::Model;
use std::f64::consts::TAU;

/// The roots of a function with period 2π, by bisection.
fn roots(f: impl Fn(f64) -> f64) -> Vec<f64> {
    let n = 2000;
    let at = |k: usize| k as f64 * TAU / n as f64 + 1e-4;
    let bracket = |k: usize| {
        let (mut low, mut high) = (at(k), at(k + 1));
        if f(low) * f(high) > 0.0 {
            return None;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if f(low) * f(middle) <= 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(0.5 * (low + high))
    };
    (0..n).filter_map(bracket).collect()
}

/// The values of a coordinate in all configurations. Their list must be complete.
fn values(text: &str, set: &[(&str, &str)], (body, part): (&str, usize)) -> Vec<f64> {
    let m: Model = model(text);
    let request = Request { set: asked(&m, "set", set), ..Request::default() };
    match configurations(&m, &request, 100, &|| false) {
        Ok(found) => {
            assert!(found.complete, "{text}");
            found.states.iter().map(|(state, _)| state.q[column(&m, body, part)]).collect()
        }
        Err(_) => Vec::new(),
    }
}

/// Compares angles, in any order and with any whole turns.
#[track_caller]
fn agree(mut found: Vec<f64>, exact: &[f64], what: &str) {
    assert_eq!(found.len(), exact.len(), "{what}: {found:?} {exact:?}");
    for angle in exact {
        let off = |x: &f64| ((x - angle) / TAU - ((x - angle) / TAU).round()).abs() * TAU;
        let at = found.iter().position(|x| off(x) < 1e-8);
        found.remove(at.unwrap_or_else(|| panic!("{what}: {angle} is not among {found:?}")));
    }
}

const CRANK: &str = "[bodies.crank]\nmass = 1\ninertia = 1\npoints = { O = [0, 0], P = [R, 0] }\n\
    [joints.O]\ntype = 'revolute'\ni = 'ground.O'\nj = 'crank.O'\n";

/// A crank whose pin moves along a slot of a lever, with a block in the slot and without one. The slot has the distance
/// e from the pivot of the lever, and another direction than its x axis.
#[test]
fn a_pin_in_the_slot_of_a_lever() {
    let mut random = Random::new(5);
    let mut counts = [0; 3];
    let cases = count(16, 40);
    for case in 0..cases {
        let [r, x, y, e, axis]: [f64; 5] = std::array::from_fn(|_| random.next());
        let (r, angle) = (0.3 + r.abs(), 3.0 * random.next());
        let ground = format!("[bodies.ground]\npoints = {{ O = [0, 0], D = [{x}, {y}] }}\n");
        let lever = format!(
            "[bodies.lever]\nmass = 1\ninertia = 1\npoints = {{ D = [0.1, 0.2], S = [0.1, {}] }}\n\
             [joints.D]\ntype = 'revolute'\ni = 'ground.D'\nj = 'lever.D'\n",
            0.2 + e / axis.cos()
        );
        let block = format!(
            "[bodies.block]\nmass = 1\ninertia = 1\npoints = {{ P = [0.3, -0.2] }}\n\
             [joints.P]\ntype = 'revolute'\ni = 'crank.P'\nj = 'block.P'\n\
             [joints.S]\ntype = 'translational'\ni = 'lever.S'\nj = 'block.P'\naxes = [{axis}, 0.7]\n"
        );
        let slot = format!(
            "[joints.S]\ntype = 'pin_in_slot'\ni = 'lever.S'\nj = 'crank.P'\naxis = {axis}\n"
        );
        let (px, py) = (r * angle.cos() - x, r * angle.sin() - y);
        // the pin has the distance e from the line through the pivot along the slot
        let exact = roots(|lever| (lever + axis).cos() * py - (lever + axis).sin() * px - e);
        counts[exact.len()] += 1;
        for (what, joint) in [("block", &block), ("slot", &slot)] {
            let text = ground.clone() + &CRANK.replace('R', &r.to_string()) + &lever + joint;
            let set = [("crank.angle", &*angle.to_string())];
            agree(values(&text, &set, ("lever", 2)), &exact, &format!("{what} {case}"));
        }
    }
    assert!(counts[0] > 1 && counts[2] > cases / 2, "{counts:?}");
}

/// The end of a rod moves along a slot of ground.
#[test]
fn a_rod_in_a_slot_of_ground() {
    let mut random = Random::new(6);
    let mut counts = [0; 3];
    for case in 0..40 {
        let [r, l, y, axis]: [f64; 4] = std::array::from_fn(|_| random.next());
        let (r, l, angle) = (0.3 + r.abs(), 0.3 + l.abs(), 3.0 * random.next());
        let text = format!("[bodies.ground]\npoints = {{ O = [0, 0], S = [0.4, {y}] }}\n")
            + &CRANK.replace('R', &r.to_string())
            + &format!(
                "[bodies.rod]\nmass = 1\ninertia = 1\npoints = {{ P = [0, 0], E = [0, {l}] }}\n\
                 [joints.P]\ntype = 'revolute'\ni = 'crank.P'\nj = 'rod.P'\n\
                 [joints.S]\ntype = 'pin_in_slot'\ni = 'ground.S'\nj = 'rod.E'\naxis = {axis}\n"
            );
        let exact = roots(|rod| {
            let (ex, ey) = (r * angle.cos() - l * rod.sin(), r * angle.sin() + l * rod.cos());
            axis.cos() * (ey - y) - axis.sin() * (ex - 0.4)
        });
        counts[exact.len()] += 1;
        let set = [("crank.angle", &*angle.to_string())];
        agree(values(&text, &set, ("rod", 2)), &exact, &format!("case {case}"));
    }
    assert!(counts[0] > 3 && counts[2] > 15, "{counts:?}");
}

/// A yoke on a slide, with a block on the pin of the crank and without one.
#[test]
fn a_yoke() {
    let yoke = "[bodies.yoke]\nmass = 1\ninertia = 1\npoints = { G = [0, 0], S = [0.5, 0] }\n\
        [joints.G]\ntype = 'translational'\ni = 'ground.O'\nj = 'yoke.G'\naxes = [0, 0]\n";
    let block = "[bodies.block]\nmass = 1\ninertia = 1\npoints = { P = [0, 0] }\n\
        [joints.P]\ntype = 'revolute'\ni = 'crank.P'\nj = 'block.P'\n\
        [joints.S]\ntype = 'translational'\ni = 'yoke.S'\nj = 'block.P'\naxes = [1.2, 0.3]\n";
    let slot = "[joints.S]\ntype = 'pin_in_slot'\ni = 'yoke.S'\nj = 'crank.P'\naxis = 1.2\n";
    for joint in [block, slot] {
        let ground = "[bodies.ground]\npoints = { O = [0, 0] }\n";
        let text = ground.to_string() + &CRANK.replace('R', "0.4") + yoke + joint;
        for angle in [-2.0, 0.3, 1.7_f64] {
            let set = [("crank.angle", &*angle.to_string())];
            let found = values(&text, &set, ("yoke", 0));
            // the pin lies on the line through S with the slope tan 1.2
            let exact = 0.4 * angle.cos() - 0.4 * angle.sin() / 1.2_f64.tan() - 0.5;
            assert_eq!(found.len(), 1);
            assert!((found[0] - exact).abs() < 1e-9, "{found:?} {exact}");
        }
    }
}

/// Two blocks on rails with a pin between them, and a disc between two others (Oldham).
#[test]
fn two_slides() {
    let rails = "[bodies.ground]\npoints = { A = [0, 0.3], B = [1, 0] }\n\
        [bodies.a]\nmass = 1\ninertia = 1\npoints = { S = [0, 0], P = [0.2, 0.1] }\n\
        [bodies.b]\nmass = 1\ninertia = 1\npoints = { S = [0, 0], P = [0, -0.3] }\n\
        [joints.A]\ntype = 'translational'\ni = 'ground.A'\nj = 'a.S'\naxes = [0.2, 0]\n\
        [joints.B]\ntype = 'translational'\ni = 'ground.B'\nj = 'b.S'\naxes = [1.4, 0]\n\
        [joints.P]\ntype = 'revolute'\ni = 'a.P'\nj = 'b.P'\n";
    let found = values(rails, &[], ("a", 0));
    let (along, up) = ((0.2_f64.cos(), 0.2_f64.sin()), (1.4_f64.cos(), 1.4_f64.sin()));
    let turned = |(c, s): (f64, f64), x: f64, y: f64| (c * x - s * y, s * x + c * y);
    let (ax, ay) = turned(along, 0.2, 0.1);
    let (bx, by) = turned(up, 0.0, -0.3);
    // A + u along + a = B + v up + b
    let (dx, dy) = (1.0 + bx - ax, by - 0.3 - ay);
    let u = (dx * up.1 - dy * up.0) / (along.0 * up.1 - along.1 * up.0);
    assert_eq!(found.len(), 1);
    assert!((found[0] - u * along.0).abs() < 1e-9, "{found:?}");
    let oldham = "[bodies.ground]\npoints = { O = [0, 0], D = [0.1, 0.2] }\n".to_string()
        + &CRANK.replace('R', "0.4")
        + "[bodies.disc]\nmass = 1\ninertia = 1\npoints = { S = [0, 0] }\n\
           [bodies.output]\nmass = 1\ninertia = 1\npoints = { D = [0, 0] }\n\
           [joints.S]\ntype = 'translational'\ni = 'crank.O'\nj = 'disc.S'\naxes = [0, 0]\n\
           [joints.T]\ntype = 'translational'\ni = 'disc.S'\nj = 'output.D'\naxes = [1.5, 0.4]\n\
           [joints.D]\ntype = 'revolute'\ni = 'ground.D'\nj = 'output.D'\n";
    let found = values(&oldham, &[("crank.angle", "0.8")], ("output", 2));
    agree(found, &[0.8 + 1.5 - 0.4], "Oldham");
}

/// A bar whose points move along two lines, at a known angle (trammel).
#[test]
fn two_slots_at_a_known_angle() {
    let text = "[bodies.ground]\npoints = { A = [0, 0], B = [0.3, -0.1] }\n\
        [bodies.bar]\nmass = 1\ninertia = 1\npoints = { P = [0, 0], Q = [1, 0.2] }\n\
        [joints.A]\ntype = 'pin_in_slot'\ni = 'ground.A'\nj = 'bar.P'\naxis = 0.3\n\
        [joints.B]\ntype = 'pin_in_slot'\ni = 'ground.B'\nj = 'bar.Q'\naxis = 1.8\n";
    let found = values(text, &[("bar.angle", "0.6")], ("bar", 0));
    let (qx, qy) = (0.6_f64.cos() - 0.2 * 0.6_f64.sin(), 0.6_f64.sin() + 0.2 * 0.6_f64.cos());
    // (x, y) = u (cos 0.3, sin 0.3), and its end lies on the other line
    let beside = |x: f64, y: f64| 1.8_f64.cos() * (y + 0.1) - 1.8_f64.sin() * (x - 0.3);
    let (at_zero, at_one) = (beside(qx, qy), beside(qx + 0.3_f64.cos(), qy + 0.3_f64.sin()));
    let u = -at_zero / (at_one - at_zero);
    assert_eq!(found.len(), 1);
    assert!((found[0] - u * 0.3_f64.cos()).abs() < 1e-9, "{found:?}");
}
