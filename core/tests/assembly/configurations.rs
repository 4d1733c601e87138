//! All positions in which a mechanism closes, against algebra.

use crate::mechanisms::{asked, column, four_bar_of, model, slider_crank, Random};
use kempe::analyses::assemble::Request;
use kempe::analyses::configurations::{configurations, Configurations, Failure};
use kempe::model::Model;

fn all(m: &Model, set: &[(&str, &str)]) -> Result<Configurations, Failure> {
    let request = Request { set: asked(m, "set", set), ..Request::default() };
    configurations(m, &request, 100, &|| false)
}

const JOINTS: &str = "[joints]\nA = { type = 'revolute', i = 'ground.A', j = 'crank.A' }\n\
     B = { type = 'revolute', i = 'crank.B', j = 'coupler.B' }\n\
     C = { type = 'revolute', i = 'coupler.C', j = 'rocker.C' }\n\
     D = { type = 'revolute', i = 'ground.D', j = 'rocker.D' }\n";

/// The intersections of two circles.
fn circles([ax, ay]: [f64; 2], r: f64, [bx, by]: [f64; 2], s: f64) -> Vec<[f64; 2]> {
    let (dx, dy) = (bx - ax, by - ay);
    let d = dx.hypot(dy);
    let a = (d * d + r * r - s * s) / (2.0 * d);
    let square = r * r - a * a;
    if square < 0.0 {
        return Vec::new();
    }
    let h = square.sqrt();
    let foot = [ax + a * dx / d, ay + a * dy / d];
    [h, -h].map(|h| [foot[0] - h * dy / d, foot[1] + h * dx / d]).to_vec()
}

/// The place of a point (x, y) of a body in its frame.
fn point(m: &Model, q: &[f64], body: &str, [x, y]: [f64; 2]) -> [f64; 2] {
    let at = column(m, body, 0);
    let (sin, cos) = q[at + 2].sin_cos();
    [q[at] + x * cos - y * sin, q[at + 1] + x * sin + y * cos]
}

/// Whether two lists of points agree in any order.
#[track_caller]
fn agree(mut found: Vec<Vec<f64>>, exact: Vec<Vec<f64>>, what: &str) {
    assert_eq!(found.len(), exact.len(), "{what}: {found:?} {exact:?}");
    for point in exact {
        let off = |other: &Vec<f64>| {
            other.iter().zip(&point).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
        };
        let at = found.iter().position(|other| off(other) < 1e-9);
        found.remove(at.unwrap_or_else(|| panic!("{what}: {point:?} is not among {found:?}")));
    }
}

#[test]
fn random_four_bars() {
    let mut random = Random::new(3);
    let mut counts = [0; 3];
    for case in 0..50 {
        let [g, a, b, c]: [f64; 4] = std::array::from_fn(|_| 2.5 + 1.5 * random.next());
        let angle = 3.0 * random.next();
        let m = four_bar_of([g, a, b, c], "");
        let at = [a * angle.cos(), a * angle.sin()];
        let exact: Vec<_> = circles(at, b, [g, 0.0], c).iter().map(|p| p.to_vec()).collect();
        counts[exact.len()] += 1;
        match all(&m, &[("crank.angle", &format!("{angle}"))]) {
            Ok(found) => {
                assert!(found.complete);
                let places = found
                    .states
                    .iter()
                    .map(|(s, _)| point(&m, &s.q, "rocker", [0.5 * c, 0.0]).to_vec());
                agree(places.collect(), exact, &format!("{case}"));
            }
            Err(Failure::Assembly(_)) => assert!(exact.is_empty(), "{case}"),
            Err(other) => panic!("{case}: {other:?}"),
        }
    }
    assert!(counts[0] > 0 && counts[2] > 20, "{counts:?}");
}

#[test]
fn random_slider_cranks() {
    let mut random = Random::new(5);
    for case in 0..50 {
        let [r, l, off] =
            [0.6 + 0.3 * random.next(), 1.0 + 0.3 * random.next(), 0.4 * random.next()];
        let (angle, axis) = (3.0 * random.next(), random.next());
        let piston = "mass = 2\ninertia = 1";
        let m = model(&slider_crank([r, l, off, axis], ["1"; 2], piston));
        // the pin on the line through P, at the distance l from the end of the crank
        let u = [axis.cos(), axis.sin()];
        let d = [r * angle.cos(), r * angle.sin() - off];
        let (along, across) = (d[0] * u[0] + d[1] * u[1], d[0] * u[1] - d[1] * u[0]);
        let square = l * l - across * across;
        let half = square.abs().sqrt();
        let exact: Vec<Vec<f64>> = if square < 0.0 {
            Vec::new()
        } else {
            [along + half, along - half].map(|s| vec![s * u[0], off + s * u[1]]).to_vec()
        };
        match all(&m, &[("crank.angle", &format!("{angle}"))]) {
            Ok(found) => {
                assert!(found.complete, "{case}");
                let places = found
                    .states
                    .iter()
                    .map(|(s, _)| point(&m, &s.q, "piston", [0.0, 0.0]).to_vec());
                agree(places.collect(), exact, &format!("{case}"));
            }
            Err(Failure::Assembly(_)) => assert!(exact.is_empty(), "{case}"),
            Err(other) => panic!("{case}: {other:?}"),
        }
    }
}

/// A four-bar A B C D whose rocker carries a point E of a second dyad E F G.
#[test]
fn random_watt_six_bars() {
    let mut random = Random::new(8);
    let mut most = 0;
    for case in 0..50 {
        let [g, a, b, c] = [4.0, 1.2 + 0.3 * random.next(), 3.5, 2.5 + 0.3 * random.next()];
        let e = [1.5 + 0.5 * random.next(), 0.8 + 0.5 * random.next()];
        let [f, h, gx] =
            [2.0 + 0.6 * random.next(), 2.0 + 0.6 * random.next(), 6.5 + random.next()];
        let angle = 3.0 * random.next();
        let m = model(&format!(
            "[bodies.ground]\npoints = {{ A = [0, 0], D = [{g}, 0], G = [{gx}, 0] }}\n\
             [bodies.crank]\ntype = 'bar'\nmass = 1\nlength = {a}\nends = ['A', 'B']\n\
             [bodies.coupler]\ntype = 'bar'\nmass = 1\nlength = {b}\nends = ['B', 'C']\n\
             [bodies.rocker]\nmass = 1\ninertia = 1\npoints = {{ D = [0, 0], C = [{c}, 0], E = [{}, {}] }}\n\
             [bodies.link]\ntype = 'bar'\nmass = 1\nlength = {f}\nends = ['E', 'F']\n\
             [bodies.output]\ntype = 'bar'\nmass = 1\nlength = {h}\nends = ['G', 'F']\n{JOINTS}\
             E = {{ type = 'revolute', i = 'rocker.E', j = 'link.E' }}\n\
             F = {{ type = 'revolute', i = 'link.F', j = 'output.F' }}\n\
             G = {{ type = 'revolute', i = 'ground.G', j = 'output.G' }}\n",
            e[0], e[1]
        ));
        let mut exact = Vec::new();
        for [cx, cy] in circles([a * angle.cos(), a * angle.sin()], b, [g, 0.0], c) {
            let (cos, sin) = ((cx - g) / c, cy / c);
            let place = [g + e[0] * cos - e[1] * sin, e[0] * sin + e[1] * cos];
            exact.extend(circles(place, f, [gx, 0.0], h).iter().map(|p| vec![cx, cy, p[0], p[1]]));
        }
        most = most.max(exact.len());
        match all(&m, &[("crank.angle", &format!("{angle}"))]) {
            Ok(found) => {
                assert!(found.complete);
                let places = found.states.iter().map(|(s, _)| {
                    let [c, f] = [
                        point(&m, &s.q, "rocker", [c, 0.0]),
                        point(&m, &s.q, "output", [0.5 * h, 0.0]),
                    ];
                    [c, f].concat()
                });
                agree(places.collect(), exact, &format!("{case}"));
            }
            Err(Failure::Assembly(_)) => assert!(exact.is_empty(), "{case}"),
            Err(other) => panic!("{case}: {other:?}"),
        }
    }
    assert_eq!(most, 4);
}

/// A platform on three bars between fixed pins: a structure that no dyad closes.
fn platform(pins: [[f64; 2]; 3], corners: [[f64; 2]; 3], bars: [f64; 3]) -> Model {
    let mut text = "[bodies.ground]\npoints = { ".to_string();
    for (k, [x, y]) in pins.iter().enumerate() {
        text += &format!("A{k} = [{x}, {y}], ");
    }
    text += "}\n[bodies.platform]\nmass = 1\ninertia = 1\npoints = { ";
    for (k, [x, y]) in corners.iter().enumerate() {
        text += &format!("B{k} = [{x}, {y}], ");
    }
    text += "}\n";
    for (k, length) in bars.iter().enumerate() {
        text += &format!(
            "[bodies.bar{k}]\ntype = 'bar'\nmass = 1\nlength = {length}\nends = ['A', 'B']\n\
             [joints.A{k}]\ntype = 'revolute'\ni = 'ground.A{k}'\nj = 'bar{k}.A'\n\
             [joints.B{k}]\ntype = 'revolute'\ni = 'bar{k}.B'\nj = 'platform.B{k}'\n"
        );
    }
    model(&text.replace(", }", " }"))
}

/// The platforms by a search along the motion of the four-bar that remains without the third bar.
fn platforms(pins: [[f64; 2]; 3], corners: [[f64; 2]; 3], bars: [f64; 3]) -> Vec<Vec<f64>> {
    let side = (corners[1][0] - corners[0][0]).hypot(corners[1][1] - corners[0][1]);
    let own = (corners[1][1] - corners[0][1]).atan2(corners[1][0] - corners[0][0]);
    let pose = |theta: f64, way: usize| -> Option<([f64; 3], f64)> {
        let b0 = [pins[0][0] + bars[0] * theta.cos(), pins[0][1] + bars[0] * theta.sin()];
        let b1 = *circles(b0, side, pins[1], bars[1]).get(way)?;
        let angle = (b1[1] - b0[1]).atan2(b1[0] - b0[0]) - own;
        let (sin, cos) = angle.sin_cos();
        let at = |[x, y]: [f64; 2]| [x * cos - y * sin, x * sin + y * cos];
        let first = at(corners[0]);
        let origin = [b0[0] - first[0], b0[1] - first[1]];
        let third = at(corners[2]);
        let gap =
            (origin[0] + third[0] - pins[2][0]).hypot(origin[1] + third[1] - pins[2][1]) - bars[2];
        Some(([origin[0], origin[1], angle], gap))
    };
    let n = 40_000;
    let step = std::f64::consts::TAU / f64::from(n);
    let mut found = Vec::new();
    for way in 0..2 {
        for k in 0..n {
            let (mut low, mut high) = (f64::from(k) * step, f64::from(k + 1) * step);
            let (Some((_, a)), Some((_, b))) = (pose(low, way), pose(high, way)) else { continue };
            if a * b > 0.0 {
                continue;
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                match pose(middle, way) {
                    Some((_, gap)) if gap * a > 0.0 => low = middle,
                    _ => high = middle,
                }
            }
            if let Some(([x, y, angle], _)) = pose(low, way) {
                found.push(vec![x, y, angle.cos(), angle.sin()]);
            }
        }
    }
    found
}

/// The platforms that are found, as those of the search.
fn found_platforms(m: &Model) -> Vec<Vec<f64>> {
    let found = all(m, &[]).unwrap_or_else(|failure| panic!("{failure:?}"));
    assert!(!found.complete);
    let at = column(m, "platform", 0);
    let place = |q: &[f64]| vec![q[at], q[at + 1], q[at + 2].cos(), q[at + 2].sin()];
    found.states.iter().map(|(state, _)| place(&state.q)).collect()
}

/// A triangle on three bars with six positions (Innocenti and Parenti-Castelli, Mech. Mach. Theory 33 (1998) 2-9; at most
/// six are possible: Hunt, J. Mech. Trans. Autom. 105 (1983) 705).
const PINS: [[f64; 2]; 3] = [[0.0, 0.0], [15.91, 0.0], [0.0, 10.0]];
const BARS: [f64; 3] = [14.98, 15.38, 12.0];

fn corners() -> [[f64; 2]; 3] {
    let (sin, cos) = 0.8822_f64.sin_cos();
    [[0.0, 0.0], [17.04, 0.0], [20.84 * cos, 20.84 * sin]]
}

#[test]
fn the_six_positions_of_a_platform_on_three_bars() {
    let exact = platforms(PINS, corners(), BARS);
    assert_eq!(exact.len(), 6);
    agree(found_platforms(&platform(PINS, corners(), BARS)), exact, "six");
}

#[test]
fn random_platforms_on_three_bars() {
    let mut random = Random::new(21);
    let mut counts = [0; 7];
    for case in 0..25 {
        let mut near = |[x, y]: [f64; 2]| [x + 2.0 * random.next(), y + 2.0 * random.next()];
        let (pins, corners) = (PINS.map(&mut near), corners().map(&mut near));
        let bars: [f64; 3] = std::array::from_fn(|k| BARS[k] + 2.0 * random.next());
        let exact = platforms(pins, corners, bars);
        counts[exact.len()] += 1;
        if !exact.is_empty() {
            agree(found_platforms(&platform(pins, corners, bars)), exact, &format!("{case}"));
        }
    }
    assert!(counts[4] > 5 && counts[6] > 5, "{counts:?}");
}

#[test]
fn freedoms_that_are_left_are_refused_and_a_limit_is_kept() {
    let m = four_bar_of([4.0, 1.0, 3.5, 2.5], "");
    assert!(matches!(all(&m, &[]), Err(Failure::Free { degrees_of_freedom: 1 })));
    let request = Request { set: asked(&m, "set", &[("crank.angle", "1")]), ..Request::default() };
    let found = configurations(&m, &request, 1, &|| false).expect("one");
    assert!(found.states.len() == 1 && !found.complete);
    // a relative angle is solved by Newton's method, and both closures are found
    let found = all(&m, &[("B.angle", "1")]).expect("positions");
    assert!(found.states.len() >= 2, "{}", found.states.len());
}

/// Bars on ground pins; the last one is the crank of a four-bar linkage.
const COUPLED: &str =
    "[bodies.ground]\npoints = { A = [0, 0], B = [1, 0], C = [2, 0], D = [6, 0] }\n\
     [bodies.a]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A', 'P']\n\
     [bodies.b]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['B', 'P']\n\
     [bodies.crank]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['C', 'E']\n\
     [bodies.coupler]\ntype = 'bar'\nmass = 1\nlength = 3.5\nends = ['E', 'F']\n\
     [bodies.rocker]\ntype = 'bar'\nmass = 1\nlength = 2.5\nends = ['D', 'F']\n\
     [joints]\nA = { type = 'revolute', i = 'ground.A', j = 'a.A' }\n\
     B = { type = 'revolute', i = 'ground.B', j = 'b.B' }\n\
     C = { type = 'revolute', i = 'ground.C', j = 'crank.C' }\n\
     E = { type = 'revolute', i = 'crank.E', j = 'coupler.E' }\n\
     F = { type = 'revolute', i = 'coupler.F', j = 'rocker.F' }\n\
     D = { type = 'revolute', i = 'ground.D', j = 'rocker.D' }\n\
     first = { type = 'coupling', terms = { 'a.angle' = 1, 'b.angle' = -2 } }\n";

#[test]
fn couplings_of_given_angles_leave_the_list_complete() {
    let second = "second = { type = 'coupling', terms = { 'b.angle' = 3, 'crank.angle' = -1 }, value = 0.4 }\n";
    let m = model(&format!("{COUPLED}{second}"));
    let found = all(&m, &[("a.angle", "1")]).expect("positions");
    assert!(found.complete && found.states.len() == 2, "both closures of the four-bar linkage");
    let crank = m.layout.bodies[3].first + 2;
    for (state, _) in &found.states {
        assert!((state.q[crank] - 1.1).abs() < 1e-12, "3 * 1 / 2 - 0.4");
    }
    // the whole turns of the rocker are not known
    let other = "second = { type = 'coupling', terms = { 'b.angle' = 3, 'rocker.angle' = -1 } }\n";
    let found = all(&model(&format!("{COUPLED}{other}")), &[("crank.angle", "1")]);
    assert!(!found.expect("positions").complete);
}
