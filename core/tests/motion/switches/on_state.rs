//! Switches that depend on the state.

use super::{methods, options, order, run, wheel, INERTIA};
use crate::mechanisms::{self, close, count, Random};
use kempe::analyses::dynamics::{dynamics, Options, Reason, Run, Scheme};
use kempe::analyses::State;
use kempe::integrate::{Dop853, Flow, Radau, Rk4, Rk45};
use kempe::model::Model;

/// The last angle and speed of a wheel.
fn end(run: &Run) -> [f64; 2] {
    let trajectory = &run.trajectory;
    [trajectory.q[trajectory.q.len() - 1], trajectory.v[trajectory.v.len() - 1]]
}

/// One second of a wheel at angle 0 with a speed.
fn turning(law: &str, speed: f64) -> (Model, State) {
    let (model, mut state) = wheel(law);
    state.v[2] = speed;
    (model, state)
}

/// Torque in bands of the angle: the speed after each band follows from the energy, and the times from the speeds.
#[test]
fn bands_of_the_angle_are_passed_as_energy_demands() {
    let mut random = Random::new(31);
    let mut number = |low: f64, high: f64| low + 0.5 * (high - low) * (random.next() + 1.0);
    for case in 0..count(25, 200) {
        let (speed, angle) = (number(2.0, 6.0), number(0.2, 1.0));
        let (width, torque) = (number(0.05, 0.8), number(-1.0, 6.0));
        let beyond = angle + width;
        let forms = [
            format!("if(wheel.angle < {angle}, 0, if(wheel.angle < {beyond}, {torque}, 0))"),
            format!("{torque}*(step(wheel.angle - {angle}) - step(wheel.angle - {beyond}))"),
            format!(
                "if(abs(wheel.angle - {}) < {}, {torque}, 0)",
                angle + 0.5 * width,
                0.5 * width
            ),
            format!("{torque}/2*(sign(wheel.angle - {angle}) - sign(wheel.angle - {beyond}))"),
        ];
        let law = &forms[case as usize % forms.len()];
        let after = (speed * speed + 2.0 * torque / INERTIA * width).sqrt();
        let (before, within) = (angle / speed, 2.0 * width / (speed + after));
        let t_end = 1.0 + before + within;
        let exact = [beyond + after * (t_end - before - within), after];
        let (model, state) = turning(law, speed);
        for method in methods(1e-8, 0.0123) {
            let what = format!("{law} at {speed} by {method:?}");
            // generalized-α at its own tolerance
            let tolerance = if method.control().rtol > 1e-4 { 1e-5 } else { 1e-9 };
            let found = run(&what, &model, &state, &options(method, t_end));
            for (found, exact) in end(&found).into_iter().zip(exact) {
                close(&what, found, exact, tolerance * (1.0 + exact.abs()));
            }
            let near = |t: f64| found.trajectory.t.iter().any(|x| (x - t).abs() < 1e-6);
            assert!(near(before) && near(before + within), "{what}");
        }
    }
}

/// A band that is passed within one step: the law sees nothing at both ends.
#[test]
fn both_crossings_within_a_step_are_located() {
    let mut random = Random::new(32);
    for _ in 0..count(25, 200) {
        let at = 0.2 + 0.3 * (random.next() + 1.0);
        // a step of 1 s at 1 rad/s passes a band of more than a tenth of a step
        let width = 0.1 + 0.07 * (random.next() + 1.0);
        let law = format!("if(wheel.angle < {at}, 0, if(wheel.angle < {}, 3, 0))", at + width);
        let after = (1.0 + 2.0 * 3.0 / INERTIA * width).sqrt();
        let t = at + 2.0 * width / (1.0 + after);
        let exact = at + width + after * (5.0 - t);
        let (model, state) = turning(&law, 1.0);
        for method in methods(1e-6, 1.0) {
            let what = format!("{law} by {method:?}");
            let tolerance = if method.control().rtol > 1e-4 { 1e-3 } else { 1e-9 };
            let found = run(&what, &model, &state, &options(method, 5.0));
            close(&what, end(&found)[0], exact, tolerance);
        }
    }
}

/// A speed that rises and falls through a bound within one step of RK4: the bound is neither at its ends.
#[test]
fn a_summit_above_a_bound_is_seen_between_the_samples() {
    // ω = 4 t (1 - t) exceeds 0.99 for 0.1 s, within a step of 1 s; a torque of 1 acts then on z = ∫
    let law = "2*(4 - 8*t) + if(wheel.omega > 0.99, -0.001, 0)";
    let (model, state) = wheel(law);
    let found = run(law, &model, &state, &options(Scheme::Rk4(Rk4::new(1.0)), 1.0));
    let inside = found.trajectory.t.iter().filter(|t| (0.44..0.56).contains(*t)).count();
    assert_eq!(inside, 2, "{:?}", found.trajectory.t);
    assert!((end(&found)[1] + 0.001 / INERTIA * 0.1).abs() < 1e-6, "{:?}", end(&found));
}

/// Bang-bang restoring torque: parabolas in the phase plane, with a period of 4 √(2 J φ₀ / T).
#[test]
fn a_relay_swings_with_its_period() {
    let (model, mut state) = wheel("-3*sign(wheel.angle)");
    let start = 0.7_f64;
    state.q[2] = start;
    let period = 4.0 * (2.0 * INERTIA * start / 3.0).sqrt();
    for method in methods(1e-8, 0.01) {
        let what = format!("{method:?}");
        let tolerance = if method.control().rtol > 1e-4 { 2e-3 } else { 1e-7 };
        let found = run(&what, &model, &state, &options(method, 5.0 * period));
        let [angle, speed] = end(&found);
        close(&what, angle, start, tolerance);
        close(&what, speed, 0.0, 10.0 * tolerance);
        // each crossing costs a few steps
        assert!(found.statistics.steps < 4000, "{what}: {}", found.statistics.steps);
    }
}

/// Random laws against the same equation, integrated here piece by piece with exact times of the switches.
#[test]
fn random_laws_of_angle_and_speed_agree_with_a_reference() {
    let mut random = Random::new(33);
    let mut number = |low: f64, high: f64| {
        let x: f64 = low + 0.5 * (high - low) * (random.next() + 1.0);
        (1e3 * x).round() / 1e3
    };
    for case in 0..count(16, 200) {
        let (k, c) = (number(1.0, 20.0), number(0.0, 0.5));
        let (a, b) = (number(-0.5, 0.5), number(-1.0, 1.0));
        let law = match case % 4 {
            0 => format!("-{k}*wheel.angle - {c}*wheel.omega + if(wheel.angle > {a}, {b}, 0)"),
            1 => format!("-{k}*max(wheel.angle, {a}) - {c}*wheel.omega*abs(wheel.omega)"),
            2 => format!("-{k}*wheel.angle + if(wheel.omega < {b}, {c}, -{c})"),
            _ => format!("-{k}*wheel.angle + 0.3*floor(3*wheel.angle) - {c}*wheel.omega"),
        };
        let force = |piece: f64, x: f64, v: f64| match case % 4 {
            0 => -k * x - c * v + if piece > 0.0 { b } else { 0.0 },
            1 => -k * if piece.abs() > 1.5 { x } else { a } - c * v * v * piece.signum(),
            2 => -k * x + if piece < 0.0 { c } else { -c },
            _ => -k * x + 0.3 * piece - c * v,
        };
        // the piece at a state; case 1 has two switches: the sign is that of v, the size 2 where x > a
        let piece = |x: f64, v: f64| match case % 4 {
            0 => (x - a).signum(),
            1 => v.signum() * if x > a { 2.0 } else { 1.0 },
            2 => (v - b).signum(),
            _ => (3.0 * x).floor(),
        };
        let exact = reference(1.0, 3.0, force, piece);
        let (model, mut state) = wheel(&law);
        state.q[2] = 1.0;
        for method in [
            Scheme::Rk45(Rk45::new(1e-9, 1e-12)),
            Scheme::Dop853(Dop853::new(1e-9, 1e-12)),
            Scheme::Radau(Radau::new(1e-9, 1e-12)),
            Scheme::Rk4(Rk4::new(2e-3)),
        ] {
            let what = format!("{law} by {method:?}");
            let found = dynamics(&model, &state, &options(method, 3.0), |_| Flow::Continue);
            match (exact, found) {
                (Ok(exact), Ok(found)) => {
                    let pairs = end(&found).into_iter().zip(exact);
                    pairs.for_each(|(found, exact)| close(&what, found, exact, 1e-6));
                }
                (Err(slides_at), Err(failure)) => match failure.reason {
                    Reason::Integration { t, .. } => close(&what, t, slides_at, 1e-6),
                    other => panic!("{what}: {other}"),
                },
                (Ok(_), Err(failure)) => panic!("{what}: {}", failure.reason),
                (Err(slides_at), Ok(_)) => panic!("{what} slides at {slides_at}"),
            }
        }
    }
}

/// φ and ω after `t_end` from rest at `x`: steps of RK4, each halved down to the switch where the piece changes. If the
/// motion slides along a switch, the error is the time.
fn reference(
    mut x: f64,
    t_end: f64,
    force: impl Fn(f64, f64, f64) -> f64,
    piece: impl Fn(f64, f64) -> f64,
) -> Result<[f64; 2], f64> {
    let step = |held: f64, [x, v]: [f64; 2], h: f64| {
        let f = |[x, v]: [f64; 2]| [v, force(held, x, v) / INERTIA];
        let go = |k: [f64; 2], h: f64| [x + h * k[0], v + h * k[1]];
        let k1 = f([x, v]);
        let k2 = f(go(k1, 0.5 * h));
        let k3 = f(go(k2, 0.5 * h));
        let k4 = f(go(k3, h));
        let sum = |i: usize| h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        [x + sum(0), v + sum(1)]
    };
    let (mut v, mut t, mut quick) = (0.0, 0.0, 0);
    let full = 1e-3;
    // from rest, the motion falls toward zero
    let first = step(piece(x, -1e-9), [x, v], 1e-9);
    let mut held = piece(first[0], first[1]);
    while t < t_end - 1e-12 {
        let mut h = f64::min(full, t_end - t);
        let end = step(held, [x, v], h);
        let mut new = held;
        if piece(end[0], end[1]) != held {
            let (mut low, mut high) = (0.0, h);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let at = step(held, [x, v], middle);
                *(if piece(at[0], at[1]) == held { &mut low } else { &mut high }) = middle;
            }
            h = high;
            let past = step(held, [x, v], h);
            new = piece(past[0], past[1]);
            quick = if h < 1e-9 { quick + 1 } else { 0 };
            if quick > 10 {
                return Err(t);
            }
        }
        [x, v] = step(held, [x, v], h);
        t += h;
        held = new;
    }
    Ok([x, v])
}

/// Dry friction as sign(ω) brings the wheel to rest, where the law has no answer.
#[test]
fn a_motion_that_slides_along_a_switch_is_refused_by_name() {
    let (model, state) = turning("-2*sign(wheel.omega)", 1.0);
    for method in methods(1e-6, 0.01) {
        let what = format!("{method:?}");
        let failure = dynamics(&model, &state, &options(method, 3.0), |_| Flow::Continue);
        let failure = failure.expect_err(&what);
        match failure.reason {
            Reason::Integration { t, message, hint } => {
                close(&what, t, INERTIA * 1.0 / 2.0, 1e-4);
                assert!(message.contains("a law of drive switches back and forth"), "{message}");
                assert!(hint.contains("tanh"), "{hint}");
            }
            other => panic!("{what}: {other}"),
        }
    }
}

/// The motion returns to the switch for a third of a step of DOP853, which begins there. The generalized-α method has
/// errors of 4e-4 rad/s at its own tolerance, and the speed changes by 0.08 rad/s in a second.
#[test]
fn a_short_slide_along_a_switch_is_refused() {
    let (model, mut state) = wheel("-1.216*wheel.angle + if(wheel.omega < -0.777, 0.206, -0.206)");
    state.q[2] = 1.0;
    for method in methods(1e-9, 0.002) {
        let what = format!("{method:?}");
        let tolerance = if method.control().rtol > 1e-4 { 1e-2 } else { 1e-6 };
        let failure = dynamics(&model, &state, &options(method, 3.0), |_| Flow::Continue);
        match failure.expect_err(&what).reason {
            Reason::Integration { t, .. } => close(&what, t, 1.994469328, tolerance),
            other => panic!("{what}: {other}"),
        }
    }
}

/// |ω| ω and max(0, x) are continuous: a run does not fail where it rests at their switch.
#[test]
fn continuous_laws_come_to_rest_at_their_switch() {
    for law in [
        "-2*wheel.omega*abs(wheel.omega) - 3*wheel.omega - 40*wheel.angle",
        "-30*max(0, wheel.angle) - 30*min(0, wheel.angle) - 5*wheel.omega",
        "-50*abs(wheel.angle)*sign(wheel.angle) - 9*wheel.omega",
    ] {
        let (model, state) = turning(law, 1.0);
        for method in methods(1e-6, 0.01) {
            let what = format!("{law} by {method:?}");
            let rough = method.control().rtol > 1e-4;
            let found = run(&what, &model, &state, &options(method, 40.0));
            assert!(end(&found)[0].abs() < if rough { 1e-3 } else { 1e-6 }, "{what}");
            assert!(found.statistics.steps < 20_000, "{what}: {}", found.statistics.steps);
        }
    }
}

/// A power of a clamped length has no value below zero: Hertz' contact, written with `if`.
#[test]
fn a_law_without_a_value_beyond_its_switch_is_no_failure() {
    let law = "if(wheel.angle > 0, -100*wheel.angle^1.5, 0)";
    let (model, mut state) = turning(law, 1.0);
    state.q[2] = -0.2;
    for method in methods(1e-8, 1e-3) {
        let what = format!("{method:?}");
        let rough = method.control().rtol > 1e-4;
        let found = run(&what, &model, &state, &options(method, 1.5));
        // it leaves with the speed with which it came
        close(&what, end(&found)[1], -1.0, if rough { 1e-2 } else { 1e-6 });
    }
}

/// A start on a boundary takes the side to which the motion goes.
#[test]
fn a_start_on_a_boundary_takes_the_side_of_the_motion() {
    for (speed, torque) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 2.0), (0.0, -2.0)] {
        let law = format!("{torque} + if(wheel.angle > 0, 1, -1)");
        let (model, state) = turning(&law, speed);
        let sum = if speed + torque > 0.0 { torque + 1.0 } else { torque - 1.0 };
        let found = run(&law, &model, &state, &options(Scheme::Rk4(Rk4::new(0.05)), 0.3));
        close(&law, end(&found)[1], speed + sum / INERTIA * 0.3, 1e-12);
    }
}

/// Stage values beyond a switch must not see the new piece: without held pieces a jump is an error of first order.
#[test]
fn constant_steps_keep_their_order_across_a_switch() {
    let law = "-20*wheel.angle + if(wheel.angle > 0.3, -30*(wheel.angle - 0.3) - 8, 0)";
    let (model, state) = turning(law, 3.0);
    let at = |h: f64| {
        let found = run(law, &model, &state, &options(Scheme::Rk4(Rk4::new(h)), 2.0));
        end(&found)[0]
    };
    let exact = {
        let method = Scheme::Dop853(Dop853::new(1e-13, 1e-15));
        end(&run(law, &model, &state, &options(method, 2.0)))[0]
    };
    let order = order(|h| at(h) - exact);
    assert!(order > 3.0, "{order}");
}

/// The default method and options, as users take them.
#[test]
fn the_default_method_takes_few_more_steps() {
    let smooth = "-20*wheel.angle - 0.1*wheel.omega";
    let switched = format!("{smooth} + if(wheel.angle > 0.3, -5, 0)");
    let steps = [smooth, &switched].map(|law| {
        let (model, state) = turning(law, 3.0);
        run(law, &model, &state, &Options::new(10.0)).statistics.steps
    });
    assert!(steps[1] < 3 * steps[0] + 200, "{steps:?}");
}

#[test]
fn mechanisms_with_several_identical_conditions_switch_them_together() {
    let text = "[bodies.ground]\npoints = { O = [0, 0] }\n[bodies.wheel]\nmass = 1\ninertia = 2\n\
                points = { O = [0, 0] }\n[joints.pin]\ntype = 'revolute'\ni = 'ground.O'\nj = 'wheel.O'\n\
                [forces.a]\ntype = 'torque'\nj = 'wheel'\ntorque = 'if(wheel.angle > 0.5, 1, 0)'\n\
                [forces.b]\ntype = 'torque'\nj = 'wheel'\ntorque = '3*step(wheel.angle - 0.5)'\n";
    let model = mechanisms::model(text);
    let state = State { t: 0.0, q: vec![0.0; 3], v: vec![0.0, 0.0, 1.0], z: Vec::new() };
    for method in methods(1e-8, 0.01) {
        let what = format!("{method:?}");
        let found = run(&what, &model, &state, &options(method, 1.0));
        close(&what, end(&found)[1], 1.0 + 4.0 / 2.0 * 0.5, 1e-9);
    }
}
