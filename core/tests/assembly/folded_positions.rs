//! Configurations of mechanisms some positions of which have a freedom: they are left out, and the others are found.

use crate::mechanisms::{asked, column, four_bar_of, model};
use kempe::analyses::assemble::Request;
use kempe::analyses::configurations::{configurations, Configurations, Failure};
use kempe::mobility;
use kempe::model::Model;

fn found(m: &Model, set: &[(&str, &str)], limit: usize) -> Result<Configurations, Failure> {
    let request = Request { set: asked(m, "set", set), ..Request::default() };
    configurations(m, &request, limit, &|| false)
}

/// The place of the point of a bar at half its length from its centre.
fn end(m: &Model, q: &[f64], bar: &str, half: f64) -> [f64; 2] {
    let at = column(m, bar, 0);
    let (sin, cos) = q[at + 2].sin_cos();
    [q[at] + half * cos, q[at + 1] + half * sin]
}

/// Whether two lists of numbers agree in any order.
#[track_caller]
fn agree<const N: usize>(found: &[[f64; N]], exact: &[[f64; N]], most: f64) {
    assert_eq!(found.len(), exact.len(), "{found:?} {exact:?}");
    for one in exact {
        let near = |other: &&[f64; N]| other.iter().zip(one).all(|(a, b)| (a - b).abs() < most);
        assert_eq!(found.iter().filter(near).count(), 1, "{one:?} in {found:?}");
    }
}

/// Ground and crank are equal, and so are coupler and rocker. The crank brings B close to D.
#[test]
fn a_four_bar_beside_its_free_position() {
    let m = four_bar_of([1, 1, 2, 2], "");
    for angle in [0.5_f64, 1e-6, 1e-9, -1e-10] {
        let found = found(&m, &[("crank.angle", &format!("{angle:e}"))], 100);
        let found = found.unwrap_or_else(|failure| panic!("{angle}: {failure:?}"));
        assert!(found.complete && found.left_out == 0, "{angle}");
        // C lies on the bisector of the crank angle
        let (sin, cos) = (0.5 * angle).sin_cos();
        let exact = [1.0, -1.0].map(|side| {
            let far = cos + side * (4.0 - sin * sin).sqrt();
            [far * cos, far * sin]
        });
        let places: Vec<_> =
            found.states.iter().map(|(s, _)| end(&m, &s.q, "rocker", 1.0)).collect();
        // a rounding error of a length turns the bars by its ratio to the distance of their pins
        agree(&places, &exact, 1e-14 + 1e-15 / angle.abs());
    }
    // B lies on D, and both bars turn about it
    let refused = found(&m, &[("crank.angle", "0")], 100);
    assert!(matches!(refused, Err(Failure::Free { degrees_of_freedom: 1 })), "{refused:?}");
}

/// The configurations of an example. None has a freedom, and others are left out.
#[track_caller]
fn without_freedom(m: &Model) -> Configurations {
    let found = found(m, &[], 100).unwrap_or_else(|failure| panic!("{failure:?}"));
    assert!(!found.complete && found.left_out > 0, "{} left out", found.left_out);
    for (state, _) in &found.states {
        assert_eq!(mobility(m, state.t, &state.q).degrees_of_freedom, 0);
    }
    found
}

/// If both arms of the linkage coincide, the kite is folded, and two of its sides turn about one pin.
#[test]
fn a_linkage_with_a_folded_kite() {
    let m = model(include_str!("../../../examples/peaucellier.toml"));
    let (arm, side, p) = (0.28_f64, 0.14, 0.18);
    // P is at (p, 0) at the start; Q is inverse to P, or lies on it
    let x = (arm * arm - side * side + p * p) / (2.0 * p);
    let y = (arm * arm - x * x).sqrt();
    let inverse = (arm * arm - side * side) / p;
    let exact = [[y, inverse, 0.0], [y, p, 0.0], [-y, inverse, 0.0], [-y, p, 0.0]];
    let all = without_freedom(&m);
    let places = all.states.iter().map(|(s, _)| {
        let [_, y] = end(&m, &s.q, "arm_a", 0.5 * arm);
        let [qx, qy] = end(&m, &s.q, "side_aq", 0.5 * side);
        [y, qx, qy]
    });
    agree(&places.collect::<Vec<_>>(), &exact, 1e-9);
    // positions that are left out do not count
    for limit in [1, 4] {
        let found = found(&m, &[], limit).unwrap_or_else(|failure| panic!("{failure:?}"));
        assert!(found.states.len() == limit && !found.complete, "{limit}");
    }
}

#[test]
fn a_lift_with_folded_stages() {
    let m = model(include_str!("../../../examples/scissor_lift.toml"));
    let all = without_freedom(&m);
    // the lift as it is used: the links of all stages have the same angle, and the platform is upright
    let used = |q: &[f64]| {
        let angle = |body: &str| q[column(&m, body, 2)];
        let alike = |body: &&str| (angle(body) - 0.174_843_843_431_292).abs() < 1e-9;
        ["a1", "a2", "a3"].iter().all(alike) && angle("platform").cos() > 0.0
    };
    assert_eq!(all.states.iter().filter(|(s, _)| used(&s.q)).count(), 1);
}
