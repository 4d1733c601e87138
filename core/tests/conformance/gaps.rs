//! Gaps of contacts at places where the nearest point of the curve is known.

use crate::mechanisms::{close, Random};
use crate::samples::{formula, on, phi, Participants};
use crate::touching::resting;
use kempe::elements::forces::Resting;
use kempe::elements::{At, BodyId, Constraint, Curve, CurveOn, Rim, Side};
use kempe::math::{Lanes, Local, Pose, Real};

/// A contact of (x, y) with the right side of a curve.
fn contact(curve: &Curve, x: f64, y: f64) -> Constraint {
    let curve = Rim::new(CurveOn { body: BodyId(2), curve: curve.clone() });
    Constraint::Resting(Resting { i: on(1, x, y), curve, radius: 0.0, side: Side::Right })
}

/// The distance of (x, y) from a curve, positive on its right side.
fn gap(curve: &Curve, x: f64, y: f64) -> f64 {
    let rest = Participants { bodies: vec![[0.0; 6]; 2], own: Vec::new() };
    phi(&contact(curve, x, y), &rest, 0.0)[0]
}

/// The place of the curve, or of the normal at its end, that is nearest to (x, y).
fn place(curve: &Curve, x: f64, y: f64) -> [f64; 2] {
    let at = At { bodies: &[Pose::identity(); 2], own: &[], t: 0.0 };
    let found = contact(curve, x, y).contact(&at).unwrap();
    [found.x, found.y]
}

/// Behind a line, its own distance is larger than those of the normals at its ends, unless an end is nearer.
#[test]
fn behind_a_line() {
    let line = Curve::Line { from: Local::new(3.0, 0.0), to: Local::new(-3.0, 0.0) };
    for (x, y, expected) in [
        (0.5, 0.25, 0.25),
        (0.5, -0.25, -0.25),
        (-1.0, -1.9, -1.9),
        (2.5, -0.6, -0.5),
        (-2.5, -0.6, -0.5),
        (3.5, -0.6, 0.5),
        (3.3, 0.4, 0.5),
    ] {
        close("gap", gap(&line, x, y), expected, 1e-15);
    }
}

/// Behind the ends of an open curve, the normals there bound the body; before them, the corners do.
#[test]
fn beyond_the_ends_of_an_open_curve() {
    let line = Curve::Line { from: Local::new(0.0, 0.0), to: Local::new(1.0, 0.0) };
    for curve in [line, formula(["u", "0*u"], [0.0, 1.0], false, &[])] {
        for (x, y, expected) in [
            (1.3, 0.1, [1.0, 0.1]),
            (-0.3, 0.1, [0.0, 0.1]),
            (1.3, -0.4, [1.0, 0.0]),
            (-0.3, -0.4, [0.0, 0.0]),
            (0.3, -0.4, [0.3, 0.0]),
        ] {
            let found = place(&curve, x, y);
            close("gap", gap(&curve, x, y), (x - expected[0]).hypot(y - expected[1]), 1e-15);
            close("x", found[0], expected[0], 1e-15);
            close("y", found[1], expected[1], 1e-15);
        }
    }
}

/// A place outside a convex curve, on a normal, is as far from it as from the foot of the normal. The other branch of
/// this ellipse has points that are nearer than the ends of the chord on which the foot lies.
#[test]
fn beside_a_thin_ellipse() {
    let (height, phase) = (1e-3, std::f64::consts::TAU / 512.0 / 4.0);
    let text = |of: &str| format!("{of}(u + {phase})");
    let (x, y) = (text("cos"), format!("a*{}", text("sin")));
    let ellipse = formula([&x, &y], [0.0, std::f64::consts::TAU], true, &[height]);
    let mut numbers = Random::new(5);
    for _ in 0..200 {
        let (u, distance) = (1.57 + numbers.next(), 1e-3 * (1.5 + numbers.next()));
        let (c, normal) = (ellipse.point(u), -ellipse.derivatives(u)[1].perp());
        let away = distance / normal.norm();
        let found = gap(&ellipse, c.x + away * normal.x, c.y + away * normal.y);
        close("gap", found, distance, 1e-12);
    }
}

/// The centre of a circle is as far from all its points, up to rounding errors.
#[test]
fn at_a_centre_of_curvature() {
    let xy = ["a + 0.7*cos(u)", "b + 0.7*sin(u)"];
    let mut numbers = Random::new(7);
    for _ in 0..200 {
        let [a, b] = [numbers.next(), numbers.next()];
        let circle = formula(xy, [0.0, std::f64::consts::TAU], true, &[a, b]);
        close("gap", gap(&circle, a, b), -0.7, 1e-12);
    }
}

/// Designs of another size have their own curves.
#[test]
fn designs_in_lanes_are_designs_by_themselves() {
    const SIZES: [f64; 4] = [1.0, 1.1, 0.7, 1.9];
    let mut numbers = Random::new(6);
    for sample in resting() {
        let at = Participants::random(&sample, &mut numbers);
        let wide = sample.map(&mut |x| Lanes::new(SIZES.map(|size| size * x)));
        let many = phi(&wide, &at.map(Lanes::constant), Lanes::zero())[0];
        for (lane, size) in SIZES.into_iter().enumerate() {
            let one = phi(&sample.map(&mut |x| size * x), &at, 0.0)[0];
            assert_eq!(many.to_array()[lane].to_bits(), one.to_bits(), "size {size}");
        }
    }
}
