//! Limits of motion and full turns, against closed forms.

use crate::mechanisms::{four_bar_of, model, motor, request, slider_crank, start, Random};
use kempe::analyses::assemble::{assemble, Request};
use kempe::analyses::limits::{limits, Limits};
use kempe::integrate::Flow;
use kempe::model::Model;
use std::f64::consts::TAU;

/// The limits from the position with this value of the driver.
fn found(m: &Model, value: f64, hints: &[(&str, &str)]) -> Limits {
    let request = Request { t: value, ..request(m, &[], hints) };
    let (state, _) = assemble(m, &request).unwrap_or_else(|failure| panic!("{failure}"));
    limits(m, &state, |_| Flow::Continue).unwrap_or_else(|failure| panic!("{}", failure.reason))
}

/// The angles of a crank on its side 0 … π at which coupler and rocker are in line: stretched out, and folded.
fn in_line([g, a, b, c]: [f64; 4]) -> [Option<f64>; 2] {
    [b + c, b - c].map(|reach| {
        let cosine = (g * g + a * a - reach * reach) / (2.0 * g * a);
        (cosine.abs() < 1.0).then(|| cosine.acos())
    })
}

/// The first and last angle of a crank, from a position with the angle θ in 0 … π; None if it turns fully.
fn range_of_crank(links: [f64; 4]) -> Option<[f64; 2]> {
    match in_line(links) {
        [None, None] => None,
        [Some(out), None] => Some([-out, out]),
        [None, Some(folded)] => Some([folded, TAU - folded]),
        [Some(out), Some(folded)] => Some([folded, out]),
    }
}

/// Angle of the crank inside of the range, and angles of coupler and rocker there.
fn posed([g, a, b, c]: [f64; 4], angle: f64) -> Option<[f64; 2]> {
    let (x, y) = (g - a * angle.cos(), -a * angle.sin());
    let d = x.hypot(y);
    let cosine = (d * d + b * b - c * c) / (2.0 * d * b);
    (cosine.abs() < 0.999).then(|| {
        let coupler = y.atan2(x) + cosine.acos();
        let (cx, cy) = (a * angle.cos() + b * coupler.cos(), a * angle.sin() + b * coupler.sin());
        [coupler, cy.atan2(cx - g)]
    })
}

fn check_crank(links: [f64; 4], angle: f64) {
    let Some([coupler, rocker]) = posed(links, angle) else { return };
    let m = four_bar_of(links, &motor("crank.angle", "t"));
    let hints = [("coupler.angle", format!("{coupler}")), ("rocker.angle", format!("{rocker}"))];
    let hints: Vec<(&str, &str)> = hints.iter().map(|(k, v)| (*k, v.as_str())).collect();
    let found = found(&m, angle, &hints);
    match range_of_crank(links) {
        None => {
            assert!(
                found.lower.is_none() && found.upper.is_none(),
                "{links:?}: {:?}",
                found.reasons
            );
            assert!(found.turns.is_some() && found.reasons[0].contains("turns fully"));
        }
        Some([low, high]) => {
            let (lower, upper) = (found.lower.expect("lower"), found.upper.expect("upper"));
            assert!((lower.value - low).abs() <= 1e-9, "{links:?}: {} {low}", lower.value);
            assert!((upper.value - high).abs() <= 1e-9, "{links:?}: {} {high}", upper.value);
            for bound in [lower, upper] {
                assert!(
                    bound.reason.contains("dead point, coupler and rocker in line"),
                    "{}",
                    bound.reason
                );
                assert!(bound.reason.starts_with("crank cannot pass "), "{}", bound.reason);
            }
        }
    }
}

/// No link of a linkage that is not Grashof's turns fully.
#[test]
fn the_dead_points_of_linkages_that_are_not_grashofs() {
    let mut random = Random::new(16);
    let mut checked = 0;
    while checked < 20 {
        let links: [f64; 4] = std::array::from_fn(|_| 2.5 + 1.5 * random.next());
        let mut sorted = links;
        sorted.sort_by(f64::total_cmp);
        let [s, p, q, l] = sorted;
        if s + l < p + q + 0.02 || l > s + p + q - 0.1 {
            continue;
        }
        let Some([low, high]) = range_of_crank(links) else { panic!("{links:?} turns") };
        check_crank(links, low + (high - low) * (0.45 + 0.25 * random.next()));
        checked += 1;
    }
}

#[test]
fn random_linkages_turn_fully_or_have_their_dead_points() {
    let mut random = Random::new(7);
    let (mut turning, mut checked) = (0, 0);
    while checked < 60 {
        let links: [f64; 4] = std::array::from_fn(|_| 2.5 + 1.5 * random.next());
        let mut sorted = links;
        sorted.sort_by(f64::total_cmp);
        let [s, p, q, l] = sorted;
        if l > s + p + q - 0.1 || (s + l - p - q).abs() < 0.05 {
            continue;
        }
        let [low, high] = range_of_crank(links).unwrap_or([0.0, TAU]);
        turning += usize::from(range_of_crank(links).is_none());
        check_crank(links, low + (high - low) * (0.45 + 0.25 * random.next()));
        checked += 1;
    }
    assert!((5..40).contains(&turning), "{turning}");
}

/// The piston of a slider-crank: crank and rod in line, at both ends.
#[test]
fn the_stroke_of_a_piston() {
    let text = slider_crank([0.1, 0.3, 0.0, 0.0], ["1"; 2], "mass = 2\ninertia = 1");
    let driven = |coordinate| model(&(text.clone() + &motor(coordinate, "t")));
    let m = driven("piston.x");
    let limits = found(&m, 0.33, &[("crank.angle", "1")]);
    let ends = [limits.lower.expect("lower"), limits.upper.expect("upper")];
    assert!((ends[0].value - 0.2).abs() < 1e-9 && (ends[1].value - 0.4).abs() < 1e-9);
    assert!(ends.iter().all(|end| end.reason.contains("crank and rod in line")), "{ends:?}");
    assert_eq!(ends[1].reason, "piston.x cannot pass 0.4 m: dead point, crank and rod in line");
    assert!(limits.path.windows(2).all(|pair| pair[0].0 < pair[1].0));
    let m = driven("crank.angle");
    let limits = found(&m, 1.0, &[("piston.x", "0.33")]);
    assert_eq!(limits.turns, Some(1));
}

/// A crank that is too long for its rod, beside a slide off its shaft: the rod is at right angles to the slide.
#[test]
fn a_rod_at_right_angles_to_its_slide() {
    let (r, l, off): (f64, f64, f64) = (0.3, 0.2, 0.05);
    let text = slider_crank([r, l, off, 0.0], ["1"; 2], "mass = 2\ninertia = 1");
    let m = model(&(text + &motor("crank.angle", "t")));
    let limits = found(&m, 0.1, &[("piston.x", "0.5")]);
    let exact = [((off - l) / r).asin(), ((off + l) / r).asin()];
    for (end, exact) in
        [limits.lower.expect("lower"), limits.upper.expect("upper")].iter().zip(exact)
    {
        assert!((end.value - exact).abs() < 1e-9, "{} {exact}", end.value);
        assert!(end.reason.ends_with("dead point, rod at right angles to S"), "{}", end.reason);
    }
}

/// A geared five-bar linkage with the ratio -2 returns after one turn of the slow crank and two of the fast one.
#[test]
fn a_linkage_that_returns_after_two_turns() {
    for (driven, turns) in [("slow", 1), ("fast", 2)] {
        let m = model(&format!(
            "[bodies.ground]\npoints = {{ A = [0, 0], E = [0.3, 0] }}\n\
             [bodies.slow]\ntype = 'bar'\nmass = 1\nlength = 0.08\nends = ['A', 'B']\n\
             [bodies.left]\ntype = 'bar'\nmass = 1\nlength = 0.4\nends = ['B', 'C']\n\
             [bodies.right]\ntype = 'bar'\nmass = 1\nlength = 0.4\nends = ['C', 'D']\n\
             [bodies.fast]\ntype = 'bar'\nmass = 1\nlength = 0.06\nends = ['E', 'D']\n\
             [joints]\nA = {{ type = 'revolute', i = 'ground.A', j = 'slow.A' }}\n\
             B = {{ type = 'revolute', i = 'slow.B', j = 'left.B' }}\n\
             C = {{ type = 'revolute', i = 'left.C', j = 'right.C' }}\n\
             D = {{ type = 'revolute', i = 'right.D', j = 'fast.D' }}\n\
             E = {{ type = 'revolute', i = 'ground.E', j = 'fast.E' }}\n\
             G = {{ type = 'gear', i = 'slow.A', j = 'fast.E', radii = [0.2, 0.1] }}\n\
             [drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = '{driven}.angle'\nvalue = 't'\n"
        ));
        let limits = found(&m, 0.3, &[("left.angle", "1"), ("right.angle", "-1")]);
        assert_eq!(limits.turns, Some(turns), "{:?}", limits.reasons);
        assert!(limits.lower.is_none() && limits.upper.is_none());
    }
}

/// A slider on a line without an end.
#[test]
fn a_slider_without_a_limit() {
    let m = model(
        "[bodies.ground]\npoints = { O = [0, 0] }\n[bodies.block]\nmass = 1\ninertia = 1\npoints = { P = [0, 0] }\n\
         [joints.S]\ntype = 'translational'\ni = 'ground.O'\nj = 'block.P'\naxes = [0.4, 0]\n\
         [drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = 'S.displacement'\nvalue = 't'\n",
    );
    let (state, _) = start(&m, &[], &[]);
    let limits = limits(&m, &state, |_| Flow::Continue).expect("limits");
    assert!(limits.lower.is_none() && limits.upper.is_none() && limits.turns.is_none());
    assert_eq!(limits.reasons, ["S.displacement has no limit within 100 m"]);
}

/// A contact that runs to the end of its curve.
#[test]
fn the_end_of_a_curve_is_a_limit() {
    let m = model(
        "[bodies.ground]\npoints = { O = [0, 0] }\ncurves = { floor = { x = 'u', y = 'u^2', range = [-1, 2] } }\n\
         [bodies.block]\ntype = 'point_mass'\nmass = 1\n\
         [joints.S]\ntype = 'point_on_curve'\ni = 'block.P'\ncurve = 'ground.floor'\n\
         [drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = 'block.x'\nvalue = 't'\n",
    );
    let limits = found(&m, 0.5, &[]);
    let (lower, upper) = (limits.lower.expect("lower"), limits.upper.expect("upper"));
    assert!(
        (lower.value + 1.0).abs() < 1e-8 && (upper.value - 2.0).abs() < 1e-8,
        "{lower:?} {upper:?}"
    );
    assert!(upper.reason.ends_with("S is at the end of its curve"), "{}", upper.reason);
}
