//! Passes near change points keep their branch, or end with an error.

use crate::mechanisms::{column, count, four_bar_of, motor, Random};
use kempe::analyses::kinematics::{kinematics, Point};
use kempe::analyses::State;
use kempe::integrate::Flow;
use kempe::model::Model;
use std::f64::consts::TAU;

/// Angles of coupler and rocker on a side of the line from B to D; None where the linkage does not close.
fn pose([g, a, b, c]: [f64; 4], angle: f64, side: f64) -> Option<[f64; 2]> {
    let (x, y) = (g - a * angle.cos(), -a * angle.sin());
    let d = x.hypot(y);
    let cosine = (d * d + b * b - c * c) / (2.0 * d * b);
    (cosine.abs() <= 1.0).then(|| {
        let coupler = y.atan2(x) + side * cosine.acos();
        let at = [a * angle.cos() + b * coupler.cos(), a * angle.sin() + b * coupler.sin()];
        [coupler, at[1].atan2(at[0] - g)]
    })
}

fn state(m: &Model, links: [f64; 4], angle: f64, side: f64) -> Option<State> {
    let [coupler, rocker] = pose(links, angle, side)?;
    let [g, a, b, c] = links;
    let mut q = vec![0.0; m.layout.n_q];
    let places = [
        ("crank", [0.5 * a * angle.cos(), 0.5 * a * angle.sin(), angle]),
        (
            "coupler",
            [
                a * angle.cos() + 0.5 * b * coupler.cos(),
                a * angle.sin() + 0.5 * b * coupler.sin(),
                coupler,
            ],
        ),
        ("rocker", [g + 0.5 * c * rocker.cos(), 0.5 * c * rocker.sin(), rocker]),
    ];
    for (body, pose) in places {
        q[column(m, body, 0)..][..3].copy_from_slice(&pose);
    }
    Some(State { t: angle, v: vec![0.0; q.len()], q, z: vec![] })
}

/// Lengths near a parallelogram, a kite or a deltoid, by `off`, so that the crank still turns fully; the branch is then
/// regular everywhere, and its side of the line from B to D never changes.
fn near_change(random: &mut Random, kind: usize, off: f64) -> [f64; 4] {
    let [short, long] = [1.0 + 0.3 * random.next(), 2.5 + 0.8 * random.next()];
    // s + l < p + q: the crank is the shortest, or ground is
    match kind {
        0 => [long, short, long + off, short + 2.0 * off],
        1 => [long, short, short + 2.0 * off, long + off],
        _ => [short, long, short + 2.0 * off, long + off],
    }
}

/// Passes of crank angles at which all links are nearly in line: two or more in each turn; 10 000 in the full sample.
#[test]
fn no_pass_near_a_change_point_flips_silently() {
    let mut random = Random::new(4);
    let lengths = "[parameters]\ng = 3\na = 1\nb = 3\nc = 1\n".to_string();
    let base = four_bar_of(["'g'", "'a'", "'b'", "'c'"], &(lengths + &motor("crank.angle", "t")));
    let all = count(2000, 10_000) as usize;
    let (mut passes, mut failed) = (0, 0);
    while passes < all {
        let kind = passes / 2 % 3;
        let off = 10.0_f64.powf(-4.5 + 3.5 * random.next());
        let links = near_change(&mut random, kind, off);
        let values: Vec<_> =
            ["g", "a", "b", "c"].iter().map(|n| n.to_string()).zip(links).collect();
        let m = base.with_values(&values).expect("lengths");
        let side = random.next().signum();
        let first = 1.0 + random.next();
        let Some(start) = state(&m, links, first, side) else { continue };
        // a turn passes 0 and π, at one of which or both the links are nearly in line
        passes += 2;
        let times: Vec<f64> = (0..=24).map(|k| first + TAU * f64::from(k) / 24.0).collect();
        let motion = match kinematics(&m, &start, &times, |_| Flow::Continue) {
            Ok(motion) => motion,
            Err(failure) => {
                failed += 1;
                failure.motion
            }
        };
        let [coupler, rocker] = ["coupler", "rocker"].map(|body| column(&m, body, 2));
        for Point { t, q, .. } in motion.at_outputs() {
            let exact = pose(links, *t, side).expect("it closes");
            let found = [coupler, rocker].map(|at| q[at]);
            for (found, exact) in found.iter().zip(exact) {
                let off_by = (found - exact) - TAU * ((found - exact) / TAU).round();
                assert!(off_by.abs() < 1e-6, "{links:?} {off:e} at {t}: {found} {exact}");
            }
        }
    }
    println!("{passes} passes, {failed} turns ended with an error");
    assert!(failed < all / 200, "{failed}");
}
