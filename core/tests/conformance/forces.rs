//! Forces: action and reaction, power, scalars.

use crate::mechanisms::{close, worst, Random};
use crate::samples::{forces, later, motion, random};
use kempe::elements::{Acting, Action, BodyId, ForceElement, Nature, Part, Situation};
use kempe::math::{Dual, Lanes, Lift, Real, Wrench};

fn each(mut check: impl FnMut(&ForceElement, [f64; 6], [f64; 6])) {
    let mut numbers = Random::new(2);
    for sample in forces() {
        for _ in 0..10 {
            check(&sample, random(&mut numbers), random(&mut numbers));
        }
    }
}

fn at<S: Real>(i: [S; 6], j: [S; 6]) -> Situation<S> {
    Situation { i: motion(i), j: motion(j), t: S::constant(0.7) }
}

/// Collects the actions of all parts.
struct Collect<'a, S>(&'a mut Vec<Action<S>>);

impl<S: Real> Acting<S> for Collect<'_, S> {
    fn take<const P: usize>(self, _: [BodyId; 2], _: &[Part; P], actions: &[Action<S>; P]) {
        self.0.extend(actions);
    }
}

fn actions<S: Real>(f: &ForceElement<S>, at: &Situation<S>) -> Vec<Action<S>> {
    let (mut out, [i, j]) = (Vec::new(), f.ends());
    let mut motions = vec![at.i; 1 + i.0.max(j.0)];
    motions[j.0] = at.j;
    f.action(&motions, at.t, Collect(&mut out));
    assert_eq!(out.len(), f.parts().len());
    out
}

fn flat<S: Real>(actions: &[Action<S>]) -> Vec<S> {
    let wrench = |w: &Wrench<S>| [w.force.x, w.force.y, w.torque];
    actions.iter().flat_map(|a| [wrench(&a.on_i), wrench(&a.on_j)].concat()).collect()
}

#[test]
fn forces_and_moments_cancel() {
    each(|f, i, j| {
        for a in actions(f, &at(i, j)) {
            let sum = a.on_i.force + a.on_j.force;
            close(f.kind(), sum.norm(), 0.0, 1e-13);
            let moment = |w: Wrench, s: [f64; 6]| w.torque + s[0] * w.force.y - s[1] * w.force.x;
            close(f.kind(), moment(a.on_i, i) + moment(a.on_j, j), 0.0, 1e-13);
        }
    });
}

#[test]
fn conservative_parts_live_on_the_potential_and_dissipative_ones_lose() {
    let h = 1e-5;
    each(|f, i, j| {
        let here = at(i, j);
        let mut conservative = 0.0;
        for (part, a) in f.parts().iter().zip(actions(f, &here)) {
            let power = a.on_i.power(here.i.twist) + a.on_j.power(here.j.twist);
            match part.nature {
                Nature::Conservative => conservative += power,
                Nature::Dissipative => assert!(power < 0.0, "{} {power}", part.name),
                Nature::Applied => {}
            }
        }
        let potential = |h: f64| f.potential(&at(later(i, h), later(j, h)));
        let rate = (potential(h) - potential(-h)) / (2.0 * h);
        close(f.kind(), conservative, -rate, 1e-7);
    });
}

#[test]
fn a_rigid_motion_of_both_bodies_turns_the_forces() {
    let (sin, cos) = 0.8_f64.sin_cos();
    let turn = |x: f64, y: f64| (cos * x - sin * y, sin * x + cos * y);
    each(|f, i, j| {
        let moved = |s: [f64; 6]| {
            let ((x, y), (vx, vy)) = (turn(s[0], s[1]), turn(s[3], s[4]));
            [x + 0.9, y - 1.7, s[2] + 0.8, vx, vy, s[5]]
        };
        for (a, b) in actions(f, &at(i, j)).iter().zip(actions(f, &at(moved(i), moved(j)))) {
            for (a, b) in [(a.on_i, b.on_i), (a.on_j, b.on_j)] {
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
        let (many, potential) = (flat(&actions(&wide, &there)), wide.potential(&there));
        for (lane, [i, j]) in states.iter().enumerate() {
            let here = at(*i, *j);
            for (many, one) in many.iter().zip(flat(&actions(&f, &here))) {
                assert_eq!(many.to_array()[lane].to_bits(), one.to_bits(), "{}", f.kind());
            }
            assert_eq!(potential.to_array()[lane].to_bits(), f.potential(&here).to_bits());
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
                    Dual::<1>::variable(*x, 0)
                } else {
                    Dual::lift(*x)
                }
            });
            let over = |s: [f64; 6]| s.map(Dual::<1>::lift);
            let derived = flat(&actions(&dual, &at(over(i), over(j))));
            for ((up, down), d) in moved(h).iter().zip(moved(-h)).zip(derived) {
                close(f.kind(), d.slope[0], (up - down) / (2.0 * h), 1e-7);
            }
        }
    });
}
