//! Joints and drivers: derivatives, invariance, scalars, and what they declare about themselves. Every
//! row is compared by itself.

use crate::mechanisms::{close, count, worst, Random};
use crate::samples::{constraints, motion, phi, terms, Participants};
use kempe::elements::{Constraint, Fixes, QuantityKind};
use kempe::expression::{Expression, Tape};
use kempe::math::{Dual, Jet, Lanes, Lift, Real, Rotation, Vec2};

const TIME: f64 = 0.7;

/// Each sample with 200 random states of its participants.
fn each(check: impl FnMut(&Constraint, &Participants)) {
    each_in(200, 200, check);
}

/// The same with the first ones of another number of states.
fn each_in(states: u64, checked: usize, mut check: impl FnMut(&Constraint, &Participants)) {
    let mut numbers = Random::new(1);
    for sample in constraints() {
        let at: Vec<_> = (0..states).map(|_| Participants::random(&sample, &mut numbers)).collect();
        at.iter().take(checked).for_each(|at| check(&sample, at));
    }
}

/// Asserts |a - b| <= tolerance, relative where |a| > 1: a joint may be near a place without derivatives.
#[track_caller]
fn near(what: &str, a: f64, b: f64, tolerance: f64) {
    close(what, a, b, tolerance * a.abs().max(1.0));
}

/// Number of coordinates of all participants.
fn width(c: &Constraint) -> usize {
    3 * c.bodies().len() + c.own()
}

#[test]
fn the_jacobian_is_that_of_dual_numbers() {
    each(|c, at| {
        let (_, columns) = terms(c, at, TIME);
        let m = c.equations().len();
        for coordinate in 0..width(c) {
            type D = Dual<3>;
            let mut seeded = at.map(D::lift);
            let bodies = seeded.bodies.len();
            let seed = match seeded.bodies.get_mut(coordinate / 3) {
                Some(body) => &mut body[coordinate % 3],
                None => &mut seeded.own[coordinate - 3 * bodies][0],
            };
            *seed = D::variable(seed.value, 0);
            let derived = phi(&c.lift::<D>(), &seeded, D::lift(TIME));
            let participant = (coordinate / 3).min(bodies);
            let column = coordinate - 3 * participant;
            for (row, derived) in derived.iter().enumerate() {
                let stated = columns[participant * m + row][column];
                close(c.kind(), stated, derived.slope[0], 1e-13);
            }
        }
    });
}

#[test]
fn the_jacobian_is_that_of_differences() {
    let h = 1e-5;
    each(|c, at| {
        let (_, columns) = terms(c, at, TIME);
        let m = c.equations().len();
        for coordinate in 0..width(c) {
            // of fourth order
            let [far_up, up, down, far_down] =
                [2.0 * h, h, -h, -2.0 * h].map(|h| phi(c, &at.moved(coordinate, h), TIME));
            let participant = (coordinate / 3).min(at.bodies.len());
            let column = coordinate - 3 * participant;
            for row in 0..m {
                let stated = columns[participant * m + row][column];
                let sum = 8.0 * (up[row] - down[row]) - (far_up[row] - far_down[row]);
                near(c.kind(), stated, sum / (12.0 * h), 1e-8);
            }
        }
    });
}

#[test]
fn rate_and_gamma_are_those_of_a_jet() {
    each(|c, at| {
        let jets = Participants {
            bodies: at
                .bodies
                .iter()
                .map(|s| -> [Jet; 6] {
                    std::array::from_fn(|k| match k {
                        0..=2 => Jet::new(s[k], s[k + 3], 0.0),
                        _ => Jet::lift(s[k]),
                    })
                })
                .collect(),
            own: at.own.iter().map(|[u, v]| [Jet::new(*u, *v, 0.0), Jet::lift(*v)]).collect(),
        };
        let derived = phi(&c.lift::<Jet>(), &jets, Jet::new(TIME, 1.0, 0.0));
        let ([residual, rate, gamma], _) = terms(c, at, TIME);
        let part = |f: fn(&Jet) -> f64| derived.iter().map(f).collect::<Vec<_>>();
        assert!(worst(&residual, &part(|p| p.value)) < 1e-13, "{}", c.kind());
        assert!(worst(&rate, &part(|p| p.rate)) < 1e-13, "{}", c.kind());
        assert!(worst(&gamma, &part(|p| -p.second)) < 1e-12, "{}", c.kind());
    });
}

#[test]
fn rate_and_gamma_are_differences_along_a_motion() {
    let h = 1e-4;
    each(|c, at| {
        // of fourth order
        let [far_before, before, here, after, far_after] =
            [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| phi(c, &at.later(k * h), TIME + k * h));
        let ([residual, rate, gamma], _) = terms(c, at, TIME);
        assert!(worst(&residual, &here) < 1e-13);
        for k in 0..here.len() {
            let first =
                (8.0 * (after[k] - before[k]) - (far_after[k] - far_before[k])) / (12.0 * h);
            let second =
                16.0 * (after[k] + before[k]) - (far_after[k] + far_before[k]) - 30.0 * here[k];
            near(c.kind(), rate[k], first, 1e-6);
            near(c.kind(), -gamma[k], second / (12.0 * h * h), 1e-5);
        }
    });
}

const TURN: f64 = 0.8;

fn turned(v: Vec2) -> Vec2 {
    Rotation::new(TURN) * kempe::math::Local::new(v.x, v.y)
}

/// The whole mechanism, ground included, turned and moved.
fn carried(at: &Participants) -> Participants {
    let body = |s: &[f64; 6]| {
        let r = Vec2::new(0.9, -1.7) + turned(Vec2::new(s[0], s[1]));
        let v = turned(Vec2::new(s[3], s[4]));
        [r.x, r.y, s[2] + TURN, v.x, v.y, s[5]]
    };
    Participants { bodies: at.bodies.iter().map(body).collect(), own: at.own.clone() }
}

/// The rows after a common rigid motion where the first two are the components of a global vector.
fn as_a_vector(rows: &[f64]) -> Option<Vec<f64>> {
    let [x, y, others @ ..] = rows else { return None };
    let v = turned(Vec2::new(*x, *y));
    Some([&[v.x, v.y], others].concat())
}

/// Whether the first two rows of a joint are the components of a global vector.
fn is_global_vector(c: &Constraint, at: &Participants) -> bool {
    let (here, there) = (phi(c, at, TIME), phi(c, &carried(at), TIME));
    as_a_vector(&here).is_some_and(|expected| worst(&there, &expected) < 1e-13)
}

/// A joint depends on its bodies only by their relative positions. Each row stays the same in a common rigid
/// motion; the two rows of a global vector turn with it.
#[test]
fn a_rigid_motion_of_all_bodies_changes_no_row() {
    each(|c, at| {
        assert!(!c.constant_columns() || is_global_vector(c, at), "{}", c.kind());
        if !is_global_vector(c, at) {
            let (here, there) = (phi(c, at, TIME), phi(c, &carried(at), TIME));
            assert!(worst(&there, &here) < 1e-13, "{}: {there:?} {here:?}", c.kind());
        }
    });
}

/// Forces and moments of each row on all bodies cancel: Φ_qᵀ λ does no work in a rigid motion. The rows
/// of a global vector turn with the bodies: their moment is that of the gap.
#[test]
fn action_is_reaction() {
    each(|c, at| {
        let ([residual, ..], columns) = terms(c, at, TIME);
        let m = c.equations().len();
        for row in 0..m {
            let (mut force, mut moment) = ([0.0; 2], 0.0);
            for (s, rows) in at.bodies.iter().zip(columns.chunks_exact(m)) {
                let [x, y, angle] = rows[row];
                force = [force[0] + x, force[1] + y];
                moment += s[0] * y - s[1] * x + angle;
            }
            close(c.kind(), force[0], 0.0, 1e-14);
            close(c.kind(), force[1], 0.0, 1e-14);
            let expected = match (is_global_vector(c, at), row) {
                (true, 0) => -residual[1],
                (true, 1) => residual[0],
                _ => 0.0,
            };
            close(c.kind(), moment, expected, 1e-13);
        }
    });
}

/// The declarations that the evaluation of pins and condensed joints relies on.
#[test]
fn constant_columns_are_minus_and_plus_one() {
    each(|c, at| {
        let two = (c.bodies().len(), c.own(), c.equations().len()) == (2, 0, 2);
        assert!(c.condenses() || !two, "{}", c.kind());
        if !c.constant_columns() {
            return;
        }
        assert!(two, "{}", c.kind());
        let (_, columns) = terms(c, at, TIME);
        for (participant, sign) in [(0, -1.0), (1, 1.0)] {
            for row in 0..2 {
                let [x, y, _] = columns[2 * participant + row];
                let expected = [[sign, 0.0], [0.0, sign]][row];
                assert_eq!([x, y], expected, "{}", c.kind());
            }
        }
    });
}

/// The last row, after body j was turned by the angle that makes a linear row zero.
fn turned_to_zero(c: &Constraint, at: &Participants) -> f64 {
    let (_, columns) = terms(c, at, TIME);
    let m = c.equations().len();
    let last = |at: &Participants| phi(c, at, TIME)[m - 1];
    let (pose, s) = (motion(at.bodies[1]).pose, c.attachment(1).s);
    let [x, y, slope] = columns[2 * m - 1];
    // the joint point stays where it is
    let arm = pose.global(s).perp();
    let mut turned = at.moved(5, -last(at) / (slope - x * arm.x - y * arm.y));
    let moved = pose.point(s) - motion(turned.bodies[1]).pose.point(s);
    turned.bodies[1][0] += moved.x;
    turned.bodies[1][1] += moved.y;
    last(&turned)
}

/// The geometry that a joint declares for assembly holds exactly where its residual is zero.
#[test]
fn joints_fix_what_they_declare() {
    each(|c, at| {
        let residual = phi(c, at, TIME);
        let frame = |k: usize| {
            let (pose, own) = (motion(at.bodies[k]).pose, c.attachment(k));
            (pose.point(own.s), pose.angle + own.axis)
        };
        let mut rows = Vec::new();
        for fixed in c.fixes() {
            let [(p_i, axis_i), (p_j, axis_j)] = [frame(0), frame(1)];
            let gap = p_j - p_i;
            match fixed {
                Fixes::Points => rows.extend([gap.norm()]),
                Fixes::Line => rows.push(Rotation::new(axis_i).inverse(gap).y.abs()),
                Fixes::Beside(distance) => {
                    rows.push((Rotation::new(axis_i).inverse(gap).y - distance).abs());
                }
                Fixes::Turn => {
                    rows.push(residual[residual.len() - 1].abs());
                    assert!(turned_to_zero(c, at).abs() < 1e-12, "{}", c.kind());
                }
                Fixes::Contact => rows.push(residual[0].hypot(residual[1])),
                Fixes::Direction => rows.push((axis_j - axis_i).abs()),
                Fixes::Distance(length) => {
                    let excess = (gap.dot(gap) - length * length) / (2.0 * length);
                    rows.push(excess.abs());
                }
                Fixes::Coordinate(of, value) => {
                    let pose = motion(at.bodies[1]).pose;
                    let coordinate = [pose.r.x, pose.r.y, pose.angle][of.coordinate.column()];
                    rows.push((coordinate - value).abs());
                }
            }
        }
        if !rows.is_empty() {
            let mut left = residual.iter();
            let mut next = || *left.next().expect("a row");
            let stated: Vec<f64> = c
                .fixes()
                .iter()
                .map(|fixed| match fixed {
                    Fixes::Points | Fixes::Contact => next().hypot(next()),
                    _ => next().abs(),
                })
                .collect();
            assert!(left.next().is_none(), "{}: rows that are not declared", c.kind());
            assert!(worst(&rows, &stated) < 1e-13, "{}: {rows:?} {stated:?}", c.kind());
        }
    });
}

#[test]
fn lanes_are_scalars_side_by_side() {
    let mut numbers = Random::new(3);
    for c in constraints() {
        let states: [Participants; 4] =
            std::array::from_fn(|_| Participants::random(&c, &mut numbers));
        let lane = |f: &dyn Fn(&Participants) -> f64| -> Lanes {
            Lanes::new(std::array::from_fn(|lane| f(&states[lane])))
        };
        let wide_state = Participants {
            bodies: (0..c.bodies().len())
                .map(|b| std::array::from_fn(|k| lane(&|s| s.bodies[b][k])))
                .collect(),
            own: (0..c.own()).map(|u| std::array::from_fn(|k| lane(&|s| s.own[u][k]))).collect(),
        };
        let wide = c.map(&mut |x| Lanes::constant(*x));
        let (many, rows) = terms(&wide, &wide_state, Lanes::constant(TIME));
        for (lane, state) in states.iter().enumerate() {
            let (one, one_rows) = terms(&c, state, TIME);
            let many = many.iter().flatten().chain(rows.iter().flatten());
            let one = one.iter().flatten().chain(one_rows.iter().flatten());
            for (many, one) in many.zip(one) {
                assert_eq!(many.to_array()[lane].to_bits(), one.to_bits(), "{}", c.kind());
            }
        }
    }
}

#[test]
fn duals_over_a_parameter_are_differences() {
    each_in(count(20, 200), count(5, 200) as usize, |c, at| {
        let mut parameters = 0;
        c.map(&mut |_| parameters += 1);
        for parameter in 0..parameters {
            let moved = |h: f64| {
                let mut k = 0..;
                let shifted = c.map(&mut |x| if k.next() == Some(parameter) { x + h } else { *x });
                terms(&shifted, at, TIME).0
            };
            let mut k = 0;
            let dual = c.map(&mut |x| {
                k += 1;
                if k - 1 == parameter {
                    Dual::<3>::variable(*x, 0)
                } else {
                    Dual::lift(*x)
                }
            });
            let (derived, _) = terms(&dual, &at.map(Dual::<3>::lift), Dual::lift(TIME));
            // a step that suits a function near a singular place crosses the jump of another
            let steps = [1e-4, 1e-5, 1e-6, 1e-7].map(|h| {
                let [far_down, down, up, far_up] = [-2.0, -1.0, 1.0, 2.0].map(|k| moved(k * h));
                (h, far_down, down, up, far_up)
            });
            for part in 0..3 {
                for (k, d) in derived[part].iter().enumerate() {
                    let slopes = steps.each_ref().map(|(h, far_down, down, up, far_up)| {
                        let (near_by, far) =
                            (up[part][k] - down[part][k], far_up[part][k] - far_down[part][k]);
                        (8.0 * near_by - far) / (12.0 * h)
                    });
                    let slope = d.slope[0];
                    let best = slopes
                        .into_iter()
                        .min_by(|a, b| (a - slope).abs().total_cmp(&(b - slope).abs()));
                    near(c.kind(), slope, best.unwrap(), 1e-7);
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
    each(|c, at| {
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
        assert_eq!(terms(&numbers, at, TIME), terms(c, at, TIME));
        assert_eq!(numbers.bodies(), c.bodies());
    });
}

#[test]
fn joints_have_names_and_units() {
    for c in constraints() {
        let equations = c.equations();
        assert!(!equations.is_empty(), "{}", c.kind());
        for (k, e) in equations.iter().enumerate() {
            assert!(!e.name.is_empty() && QuantityKind::OF_EQUATIONS.contains(&e.kind), "{e:?}");
            assert!(equations[..k].iter().all(|other| other.name != e.name), "{e:?}");
        }
    }
}
