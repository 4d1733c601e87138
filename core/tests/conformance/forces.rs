//! Forces: action and reaction, power, scalars.

use crate::mechanisms::{close, worst, Random};
use crate::samples::{forces, later, motion, random};
use kempe::elements::forces::PointForce;
use kempe::elements::{BodyId, ForceElement, Frame, Held, Mode, Nature, Situation};
use kempe::math::{Dual, Lanes, Lift, Motion, Real, Vec2, Wrench};

fn each(mut check: impl FnMut(&ForceElement, [f64; 6], [f64; 6])) {
    let mut numbers = Random::new(2);
    for sample in forces() {
        for _ in 0..10 {
            check(&sample, random(&mut numbers), random(&mut numbers));
        }
    }
}

/// Motions of two bodies; states and reactions have fixed values.
struct Two<S>([Motion<S>; 2], [S; 1], Wrench<S>);

fn at<S: Real>(i: [S; 6], j: [S; 6]) -> Two<S> {
    let [x, y, torque] = [3.0, -4.0, 0.5].map(S::constant);
    let reaction = Wrench { force: Vec2::new(x, y), torque };
    Two([motion(i), motion(j)], [S::constant(0.6)], reaction)
}

impl<S: Real> Two<S> {
    fn situation(&self, f: &ForceElement<S>) -> Situation<'_, S> {
        assert_eq!(f.bodies().len(), 2, "{}", f.kind());
        let (motions, bodies) = (&self.0, &[BodyId(0), BodyId(1)]);
        Situation {
            motions,
            bodies,
            z: &self.1,
            reaction: self.2,
            t: S::constant(0.7),
            held: Held::default(),
            mode: Mode::Open,
            multiplier: S::zero(),
        }
    }
}

/// The wrenches on body i and body j of each part.
fn actions<S: Real>(f: &ForceElement<S>, at: &Two<S>) -> Vec<[Wrench<S>; 2]> {
    let mut out = vec![Wrench::zero(); 2 * f.parts().len()];
    f.action(&at.situation(f), &mut |part: usize, body: usize, w| out[2 * part + body] = w);
    out.chunks_exact(2).map(|two| [two[0], two[1]]).collect()
}

fn flat<S: Real>(actions: &[[Wrench<S>; 2]]) -> Vec<S> {
    let all = actions.iter().flatten();
    all.flat_map(|w| [w.force.x, w.force.y, w.torque]).collect()
}

#[test]
fn forces_and_moments_cancel() {
    each(|f, i, j| {
        for [on_i, on_j] in actions(f, &at(i, j)) {
            let sum = on_i.force + on_j.force;
            close(f.kind(), sum.norm(), 0.0, 1e-13);
            let moment = |w: Wrench, s: [f64; 6]| w.torque + s[0] * w.force.y - s[1] * w.force.x;
            close(f.kind(), moment(on_i, i) + moment(on_j, j), 0.0, 1e-13);
        }
    });
}

/// Whether a part has no force, as that of a slack cord.
fn slack(w: Wrench) -> bool {
    w.force == Vec2::zero() && w.torque == 0.0
}

#[test]
fn conservative_parts_live_on_the_potential_and_dissipative_ones_lose() {
    let h = 1e-5;
    each(|f, i, j| {
        let here = at(i, j);
        let mut conservative = 0.0;
        for (part, [on_i, on_j]) in f.parts().iter().zip(actions(f, &here)) {
            let power = on_i.power(here.0[0].twist) + on_j.power(here.0[1].twist);
            match part.nature {
                Nature::Conservative => conservative += power,
                Nature::Dissipative if slack(on_i) => {}
                Nature::Dissipative => assert!(power < 0.0, "{} {power}", part.name),
                Nature::Applied | Nature::Exchanged => {}
            }
        }
        let potential = |h: f64| f.potential(&at(later(i, h), later(j, h)).situation(f));
        let rate = (potential(h) - potential(-h)) / (2.0 * h);
        close(f.kind(), conservative, -rate, 1e-7);
    });
}

#[test]
fn a_rigid_motion_of_both_bodies_turns_the_forces() {
    let (sin, cos) = 0.8_f64.sin_cos();
    let turn = |x: f64, y: f64| (cos * x - sin * y, sin * x + cos * y);
    each(|f, i, j| {
        let global = |f: &PointForce| f.frame == Frame::Global;
        if f.kind() == "lag" || matches!(f, ForceElement::PointForce(f) if global(f)) {
            return; // its force has a direction in the global frame
        }
        let moved = |s: [f64; 6]| {
            let ((x, y), (vx, vy)) = (turn(s[0], s[1]), turn(s[3], s[4]));
            [x + 0.9, y - 1.7, s[2] + 0.8, vx, vy, s[5]]
        };
        let mut there = at(moved(i), moved(j));
        // the reaction of a joint turns with its bodies
        let (x, y) = turn(there.2.force.x, there.2.force.y);
        there.2.force = Vec2::new(x, y);
        for (a, b) in actions(f, &at(i, j)).iter().zip(actions(f, &there)) {
            for (a, b) in a.iter().zip(b) {
                let (x, y) = turn(a.force.x, a.force.y);
                assert!(worst(&[x, y, a.torque], &[b.force.x, b.force.y, b.torque]) < 1e-13);
            }
        }
    });
}

#[test]
fn lanes_are_scalars_side_by_side() {
    let mut numbers = Random::new(4);
    for f in forces() {
        let states: [[[f64; 6]; 2]; 4] =
            std::array::from_fn(|_| [random(&mut numbers), random(&mut numbers)]);
        let lanes = |end: usize| -> [Lanes; 6] {
            std::array::from_fn(|k| Lanes::new(std::array::from_fn(|lane| states[lane][end][k])))
        };
        let wide = f.map(&mut |x| Lanes::constant(*x));
        let there = at(lanes(0), lanes(1));
        let (many, potential) =
            (flat(&actions(&wide, &there)), wide.potential(&there.situation(&wide)));
        for (lane, [i, j]) in states.iter().enumerate() {
            let here = at(*i, *j);
            for (many, one) in many.iter().zip(flat(&actions(&f, &here))) {
                assert_eq!(many.to_array()[lane].to_bits(), one.to_bits(), "{}", f.kind());
            }
            assert_eq!(
                potential.to_array()[lane].to_bits(),
                f.potential(&here.situation(&f)).to_bits()
            );
        }
    }
}

#[test]
fn duals_over_a_parameter_are_differences() {
    let h = 1e-6;
    each(|f, i, j| {
        let mut count = 0;
        f.map(&mut |_| count += 1);
        for parameter in 0..count {
            let moved = |h: f64| {
                let mut k = 0;
                let shifted = f.map(&mut |x| {
                    k += 1;
                    if k - 1 == parameter {
                        x + h
                    } else {
                        *x
                    }
                });
                flat(&actions(&shifted, &at(i, j)))
            };
            let mut k = 0;
            let dual = f.map(&mut |x| {
                k += 1;
                if k - 1 == parameter {
                    Dual::<3>::variable(*x, 0)
                } else {
                    Dual::lift(*x)
                }
            });
            let over = |s: [f64; 6]| s.map(Dual::<3>::lift);
            let derived = flat(&actions(&dual, &at(over(i), over(j))));
            for ((up, down), d) in moved(h).iter().zip(moved(-h)).zip(derived) {
                close(f.kind(), d.slope[0], (up - down) / (2.0 * h), 1e-7);
            }
        }
    });
}
