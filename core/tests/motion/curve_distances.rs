//! Bounds of the distance of a moving point from a closed curve contain the distance, beside hollows and between two
//! branches too.

use crate::mechanisms::model;
use kempe::elements::{Clearance, Rim, Side, Way};
use kempe::math::Local;
use kempe::model::Model;

/// Numbers between 0 and 1 (SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    }
}

fn distance(rim: &Rim, side: Side, p: Local) -> f64 {
    let rest = Way { by: Local::zero(), error: 0.0, within: 0.0 };
    rim.apart(p, side, (rest, f64::INFINITY)).distance
}

/// A cam with this curve, and a contact of the origin with it.
fn cam(polar: &str, size: f64) -> Model {
    model(&format!(
        r#"
[bodies.ground]
points = {{ O = [0, 0] }}
[bodies.cam]
mass = 1
inertia = 1
points = {{ O = [0, 0] }}
curves = {{ rim = {{ polar = "{size}*({polar})" }} }}
[joints.shaft]
type = "revolute"
i = "ground.O"
j = "cam.O"
[forces.touch]
type = "contact"
i = "ground.O"
curve = "cam.rim"
stiffness = 1
"#
    ))
}

/// Compares the bounds along a way with distances at its points. Returns whether other branches matter.
fn compare((rim, side): (&Rim, Side), size: f64, p: Local, by: Local) -> Option<bool> {
    let long = by.norm();
    let way = Way { by, error: 0.0, within: long };
    let found = rim.apart(p, side, (way, f64::INFINITY));
    let exact = distance(rim, side, p);
    assert!((found.distance - exact).abs() <= 1e-12 * size + found.error);
    if !found.bend.is_finite() || exact <= 0.0 && found.other.is_finite() {
        return None;
    }
    for step in -8..=8 {
        let part = f64::from(step) / 8.0;
        let there = distance(rim, side, p + by.scale(part));
        let along = exact + part * found.away.dot(by);
        let bent = 0.5 * found.bend * (part * long).powi(2) + 1e-9 * size;
        let text = format!("size {size}, {p:?}, by {by:?}, part {part}: {there} {along} {found:?}");
        assert!(there <= along + bent, "{text}");
        assert!(there >= (along - bent).min(found.other - 1e-9 * size), "{text}");
    }
    Some(found.other.is_finite())
}

#[test]
fn the_bounds_contain_the_distance() {
    let mut random = Random(7);
    let (mut sharp, mut beside) = (0, 0);
    for polar in ["1 + 0.6*cos(2*u)", "1 + 0.85*cos(3*u)", "1 + 0.3*cos(5*u)"] {
        for size in [1e-3, 1.0, 1e3] {
            let m = cam(polar, size);
            let all = m.forces[0].element.clearances();
            let Clearance::Curve { curve, side, .. } = all[0] else { panic!("a curve") };
            for _ in 0..4_000 {
                let (angle, far) = (6.3 * random.next(), size * (0.1 + 2.0 * random.next()));
                let p = Local::new(far * angle.cos(), far * angle.sin());
                let (angle, long) = (6.3 * random.next(), size * 0.3 * random.next().powi(4));
                let by = Local::new(long * angle.cos(), long * angle.sin());
                match compare((curve, side), size, p, by) {
                    Some(true) => beside += 1,
                    Some(false) => sharp += 1,
                    None => {}
                }
            }
        }
    }
    assert!(sharp > 5_000 && beside > 100, "{sharp} {beside}");
}
