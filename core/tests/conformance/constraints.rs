//! Joints and drivers: derivatives, invariance, scalars.

use crate::mechanisms::{close, worst, Random};
use crate::samples::{constraints, later, motion, of_end, random};
use kempe::elements::{Constraint, Rows};
use kempe::expression::{Expression, Tape};
use kempe::math::{Dual, Jet, Lanes, Lift, Motion, Pose, Real, Rotation, Vec2};

const TIME: f64 = 0.7;

/// Each sample with random states of its two bodies, several times.
fn each(mut check: impl FnMut(&Constraint, [f64; 6], [f64; 6])) {
    let mut numbers = Random::new(1);
    for sample in constraints() {
        for _ in 0..10 {
            let (i, j) = (random(&mut numbers), random(&mut numbers));
            check(&sample, of_end(sample.ends()[0], i), of_end(sample.ends()[1], j));
        }
    }
}

fn phi<S: Real>(c: &Constraint<S>, i: [S; 6], j: [S; 6], t: S) -> Vec<S> {
    let mut out = vec![S::zero(); c.equations().len()];
    c.residual(&motion(i).pose, &motion(j).pose, t, &mut out);
    out
}

fn jacobian<S: Real>(c: &Constraint<S>, i: [S; 6], j: [S; 6], t: S) -> Vec<[S; 6]> {
    let mut out = vec![[S::zero(); 6]; c.equations().len()];
    c.jacobian(&motion(i).pose, &motion(j).pose, t, &mut out);
    out
}

/// Φ, Φ̇, γ.
fn terms<S: Real>(c: &Constraint<S>, i: [S; 6], j: [S; 6], t: S) -> [Vec<S>; 3] {
    let m = c.equations().len();
    let mut out = [0, 1, 2].map(|_| vec![S::zero(); m]);
    let [residual, rate, gamma] = &mut out;
    c.velocity_terms(&motion(i), &motion(j), t, Rows { residual, rate, gamma });
    out
}

#[test]
fn the_jacobian_is_that_of_dual_numbers() {
    each(|c, i, j| {
        type D = Dual<6>;
        let lift = |x: f64| D::lift(x);
        let seeded = |s: [f64; 6], first: usize| -> [D; 6] {
            std::array::from_fn(|k| if k < 3 { D::variable(s[k], first + k) } else { lift(s[k]) })
        };
        let derived = phi(&c.lift::<D>(), seeded(i, 0), seeded(j, 3), lift(TIME));
        for (row, derived) in jacobian(c, i, j, TIME).iter().zip(derived) {
            assert!(worst(row, &derived.slope) < 1e-13, "{}", c.kind());
        }
    });
}

#[test]
fn the_jacobian_is_that_of_differences() {
    let h = 1e-6;
    each(|c, i, j| {
        let rows = jacobian(c, i, j, TIME);
        for column in 0..6 {
            let moved = |h: f64| {
                let (mut i, mut j) = (i, j);
                if column < 3 {
                    i[column] += h;
                } else {
                    j[column - 3] += h;
                }
                phi(c, i, j, TIME)
            };
            for (k, (up, down)) in moved(h).iter().zip(moved(-h)).enumerate() {
                close(c.kind(), rows[k][column], (up - down) / (2.0 * h), 1e-8);
            }
        }
    });
}

#[test]
fn rate_and_gamma_are_those_of_a_jet() {
    each(|c, i, j| {
        let jet = |s: [f64; 6]| -> [Jet; 6] {
            std::array::from_fn(|k| match k {
                0..=2 => Jet::new(s[k], s[k + 3], 0.0),
                _ => Jet::lift(s[k]),
            })
        };
        let derived = phi(&c.lift::<Jet>(), jet(i), jet(j), Jet::new(TIME, 1.0, 0.0));
        let [residual, rate, gamma] = terms(c, i, j, TIME);
        let part = |f: fn(&Jet) -> f64| derived.iter().map(f).collect::<Vec<_>>();
        assert!(worst(&residual, &part(|p| p.value)) < 1e-13, "{}", c.kind());
        assert!(worst(&rate, &part(|p| p.rate)) < 1e-13, "{}", c.kind());
        assert!(worst(&gamma, &part(|p| -p.second)) < 1e-12, "{}", c.kind());
    });
}

#[test]
fn rate_and_gamma_are_differences_along_a_motion() {
    let h = 1e-4;
    each(|c, i, j| {
        let at = |h: f64| phi(c, later(i, h), later(j, h), TIME + h);
        let (before, here, after) = (at(-h), at(0.0), at(h));
        let [residual, rate, gamma] = terms(c, i, j, TIME);
        assert!(worst(&residual, &here) < 1e-13);
        for k in 0..here.len() {
            close(c.kind(), rate[k], (after[k] - before[k]) / (2.0 * h), 1e-6);
            close(c.kind(), -gamma[k], (after[k] - 2.0 * here[k] + before[k]) / (h * h), 1e-5);
        }
    });
}

/// A joint may know its bodies only by where they stand to each other. Its residual may turn with
/// the frame that it is written in, but its length may not change, nor its zero.
#[test]
fn a_rigid_motion_of_both_bodies_changes_nothing() {
    each(|c, i, j| {
        let turn = |s: [f64; 6]| -> Pose {
            let r = Vec2::new(0.9, -1.7) + turned(Vec2::new(s[0], s[1]));
            Pose::new(r.x, r.y, s[2] + TURN)
        };
        let mut moved = vec![0.0; c.equations().len()];
        c.residual(&turn(i), &turn(j), TIME, &mut moved);
        let length = |phi: &[f64]| phi.iter().map(|x| x * x).sum::<f64>().sqrt();
        close(c.kind(), length(&moved), length(&phi(c, i, j, TIME)), 1e-13);
    });
}

const TURN: f64 = 0.8;

fn turned(v: Vec2) -> Vec2 {
    Rotation::new(TURN) * kempe::math::Local::new(v.x, v.y)
}

/// Forces and moments of a constraint on its bodies cancel: Φ_qᵀ λ does no work in a rigid motion.
#[test]
fn action_is_reaction() {
    each(|c, i, j| {
        for row in jacobian(c, i, j, TIME) {
            close(c.kind(), row[0] + row[3], 0.0, 1e-14);
            close(c.kind(), row[1] + row[4], 0.0, 1e-14);
            let moment = |s: [f64; 6], f: &[f64]| s[0] * f[1] - s[1] * f[0] + f[2];
            // of a joint whose rows turn with it the length is kept instead, see above
            let sum = moment(i, &row[..3]) + moment(j, &row[3..]);
            let along = if c.pins() { pin_turn(c, i, j, &row) } else { 0.0 };
            close(c.kind(), sum, along, 1e-13);
        }
    });
}

/// Rows of a pin that does not close turn with the gap: a couple that is zero where Φ = 0.
fn pin_turn(c: &Constraint, i: [f64; 6], j: [f64; 6], row: &[f64; 6]) -> f64 {
    let gap = phi(c, i, j, TIME);
    row[3] * -gap[1] + row[4] * gap[0]
}

#[test]
fn lanes_are_scalars_side_by_side() {
    let mut numbers = Random::new(3);
    for c in constraints() {
        let states: [[[f64; 6]; 2]; 4] =
            std::array::from_fn(|_| [0, 1].map(|end| of_end(c.ends()[end], random(&mut numbers))));
        let lanes = |end: usize| -> [Lanes; 6] {
            std::array::from_fn(|k| Lanes::new(std::array::from_fn(|lane| states[lane][end][k])))
        };
        let wide = c.map(&mut |x| Lanes::constant(*x));
        let time = Lanes::constant(TIME);
        let many = terms(&wide, lanes(0), lanes(1), time);
        let rows = jacobian(&wide, lanes(0), lanes(1), time);
        for (lane, [i, j]) in states.iter().enumerate() {
            let one = terms(&c, *i, *j, TIME);
            for (many, one) in many.iter().zip(&one) {
                for (many, one) in many.iter().zip(one) {
                    assert_eq!(many.to_array()[lane].to_bits(), one.to_bits(), "{}", c.kind());
                }
            }
            for (many, one) in rows.iter().zip(jacobian(&c, *i, *j, TIME)) {
                for (many, one) in many.iter().zip(one) {
                    assert_eq!(many.to_array()[lane].to_bits(), one.to_bits(), "{}", c.kind());
                }
            }
        }
    }
}

#[test]
fn duals_over_a_parameter_are_differences() {
    let h = 1e-6;
    each(|c, i, j| {
        let mut count = 0;
        c.map(&mut |_| count += 1);
        for parameter in 0..count {
            let moved = |h: f64| {
                let mut k = 0;
                let shifted = c.map(&mut |x| {
                    k += 1;
                    if k - 1 == parameter {
                        x + h
                    } else {
                        *x
                    }
                });
                terms(&shifted, i, j, TIME)
            };
            let mut k = 0;
            let dual = c.map(&mut |x| {
                k += 1;
                if k - 1 == parameter {
                    Dual::<1>::variable(*x, 0)
                } else {
                    Dual::lift(*x)
                }
            });
            let over = |s: [f64; 6]| s.map(Dual::<1>::lift);
            let derived = terms(&dual, over(i), over(j), Dual::lift(TIME));
            let (up, down) = (moved(h), moved(-h));
            for part in 0..3 {
                for (k, d) in derived[part].iter().enumerate() {
                    let difference = (up[part][k] - down[part][k]) / (2.0 * h);
                    close(c.kind(), d.slope[0], difference, 1e-7);
                }
            }
        }
    });
}

#[test]
fn formulas_become_the_numbers_they_say() {
    struct Parameters(Vec<f64>);
    impl kempe::expression::Values<f64> for Parameters {
        fn parameter(&self, k: usize) -> f64 {
            self.0[k]
        }
        fn time(&self) -> f64 {
            f64::NAN
        }
        fn variable(&self, _: usize) -> f64 {
            f64::NAN
        }
    }
    each(|c, i, j| {
        let mut values = Vec::new();
        c.map(&mut |x| values.push(2.0 * x));
        let names: Vec<String> = (0..values.len()).map(|k| format!("p{k}")).collect();
        let mut k = 0;
        let formulas: Constraint<Tape> = c.map(&mut |_| {
            k += 1;
            Expression::parse(&format!("p{}/2", k - 1)).unwrap().compile(names.as_slice()).unwrap()
        });
        let values = Parameters(values);
        let numbers = formulas.map(&mut |tape| tape.evaluate(&values));
        assert_eq!(terms(&numbers, i, j, TIME), terms(c, i, j, TIME));
        assert_eq!(numbers.ends(), c.ends());
    });
}

#[test]
fn joints_have_names_units_and_frames() {
    use kempe::elements::Side;
    each(|c, i, j| {
        let equations = c.equations();
        assert!(!equations.is_empty() && equations.len() <= kempe::elements::MOST_EQUATIONS);
        for e in &equations {
            assert!(!e.name.is_empty() && ["m", "rad"].contains(&e.unit), "{e:?}");
        }
        if c.pins() {
            let at = |side, s: [f64; 6]| {
                let motion: Motion = motion(s);
                motion.pose.point(c.attachment(side).s)
            };
            let gap = at(Side::J, j) - at(Side::I, i);
            let phi = phi(c, i, j, TIME);
            close("a pin closes its points", gap.norm(), phi[0].hypot(phi[1]), 1e-13);
        }
    });
}
