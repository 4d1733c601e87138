//! Switches that depend on the time alone.

use super::{methods, options, run, wheel, INERTIA};
use crate::mechanisms::{close, count, Random};
use kempe::analyses::dynamics::{Prepared, Scheme};
use kempe::integrate::{Flow, Rk4};

/// A law and its impulse up to 10 s.
struct Pulse {
    law: String,
    impulse: f64,
}

/// A random law that is constant between its switches.
fn constant_pulse(random: &mut Random) -> Pulse {
    let mut number = |low: f64, high: f64| {
        let x: f64 = low + 0.5 * (high - low) * (random.next() + 1.0);
        (1e4 * x).round() / 1e4
    };
    let (height, a) = (number(-20.0, 20.0), number(0.5, 8.0));
    let b = a + number(0.0001, 1.5);
    let on = b - a;
    let w = number(0.5, 7.0);
    let level = number(-0.9, 0.9);
    let form = number(0.0, 8.0) as usize;
    let (law, impulse) = match form {
        0 => (format!("if(t < {a}, 0, if(t < {b}, {height}, 0))"), height * on),
        1 => (format!("{height}*(step(t - {a}) - step(t - {b}))"), height * on),
        2 => (format!("{height}*if(t >= {a}, 1, 0)*if(t <= {b}, 1, 0)"), height * on),
        3 => (format!("{height}*sign({a} - t)"), height * (a - (10.0 - a))),
        4 => {
            // the sum of floor(w t) over 10 s
            let last = (10.0 * w).floor();
            let below: f64 = (0..last as usize).map(|n| n as f64 / w).sum();
            (format!("{height}*floor({w}*t)"), height * (below + last * (10.0 - last / w)))
        }
        5 => {
            // a square wave: on in the first half of each period
            let period = 2.0 / w;
            let whole = (10.0 / period).floor();
            let on = whole / w + (10.0 - whole * period).min(1.0 / w);
            (format!("{height}*if({w}*t - 2*floor({w}*t/2) < 1, 1, 0)"), height * on)
        }
        6 => {
            // sin(w t) > level between asin(level) and pi - asin(level)
            let (pi, low) = (std::f64::consts::PI, level.asin());
            let within = |k: f64, x: f64| ((x + 2.0 * pi * k) / w).clamp(0.0, 10.0);
            let on =
                (-1..60).map(f64::from).map(|k| within(k, pi - low) - within(k, low)).sum::<f64>();
            (format!("if(sin({w}*t) > {level}, {height}, 0)"), height * on)
        }
        _ => {
            let middle = 0.5 * (a + b);
            (format!("if(abs(t - {middle}) < {on}/2, {height}, 0)"), height * on)
        }
    };
    Pulse { law, impulse }
}

/// A random law that is smooth between its switches, with its exact impulse and the time in which it changes.
fn smooth_pulse(random: &mut Random) -> (Pulse, f64) {
    let mut number = |low: f64, high: f64| {
        let x: f64 = low + 0.5 * (high - low) * (random.next() + 1.0);
        (1e4 * x).round() / 1e4
    };
    let (height, a) = (number(1.0, 20.0), number(0.5, 8.0));
    let b = a + number(0.05, 1.5);
    let on = b - a;
    let form = number(0.0, 4.0) as usize;
    let part = format!("(t - {a})/{on}");
    let (shape, mean) = match form {
        0 => (format!("sin(pi*{part})"), 2.0 / std::f64::consts::PI),
        1 => (format!("4*{part}*(1 - {part})"), 2.0 / 3.0),
        2 => (format!("exp(-{part})"), 1.0 - (-1.0_f64).exp()),
        _ => {
            // max and min clamp a ramp
            let law = format!("{height}*max(0, min(1, {part}))");
            return (Pulse { law, impulse: height * (0.5 * on + 10.0 - b) }, on);
        }
    };
    let law = format!("if(t < {a}, 0, if(t < {b}, {height}*{shape}, 0))");
    (Pulse { law, impulse: height * mean * on }, on)
}

#[test]
fn constant_pulses_have_their_impulse_by_every_method() {
    let mut random = Random::new(11);
    for _ in 0..count(60, 500) {
        let Pulse { law, impulse } = constant_pulse(&mut random);
        let (model, state) = wheel(&law);
        for method in methods(1e-6, 0.173) {
            let found = run(&law, &model, &state, &options(method.clone(), 10.0));
            let speeds = found.trajectory.v.chunks(3).map(|v| v[2].abs()).fold(0.0, f64::max);
            let speed = found.trajectory.v[found.trajectory.v.len() - 1];
            let scale = (INERTIA * speeds).max(impulse.abs());
            let what = format!("{law} by {method:?}");
            close(&what, INERTIA * speed, impulse, 1e-9 * scale);
        }
    }
}

#[test]
fn smooth_pulses_have_their_impulse_within_the_tolerance() {
    let mut random = Random::new(12);
    for _ in 0..count(10, 500) {
        let (Pulse { law, impulse }, on) = smooth_pulse(&mut random);
        let (model, state) = wheel(&law);
        for method in methods(1e-6, 0.002) {
            let control = method.control();
            let rtol = match (&method, control.step) {
                // of order 2: the trapezoidal rule misses (h/on)² of a parabola
                (Scheme::GeneralizedAlpha(_), Some(h)) => 0.15 * (h / on).powi(2),
                (_, Some(_)) => 1e-5,
                (_, None) => control.rtol,
            };
            let found = run(&law, &model, &state, &options(method.clone(), 10.0));
            let speed = found.trajectory.v[found.trajectory.v.len() - 1];
            let what = format!("{law} by {method:?}");
            close(&what, INERTIA * speed, impulse, 10.0 * rtol * impulse.abs());
        }
    }
}

/// A rise by a motion law after rest, and the same fall: the impulse is the height times the time between them.
#[test]
fn a_short_pulse_of_motion_laws_after_a_long_rest_is_found_by_every_method() {
    let step5 = "step5(t, 5.013, 0, 5.063, 1) - step5(t, 5.163, 0, 5.213, 1)".to_string();
    let laws =
        ["cycloidal", "harmonic", "poly345", "poly4567", "modified_sine", "modified_trapezoid"];
    let pulses = laws.map(|law| format!("{law}((t - 5.013)/0.05) - {law}((t - 5.163)/0.05)"));
    for pulse in pulses.into_iter().chain([step5]) {
        let law = format!("20*({pulse})");
        let (model, state) = wheel(&law);
        for method in methods(1e-6, 0.002) {
            let found = run(&law, &model, &state, &options(method.clone(), 10.0));
            for end in [5.013, 5.063, 5.163, 5.213] {
                let nearest = found.trajectory.t.iter().map(|t| (t - end).abs());
                let nearest = nearest.fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-14 * 10.0, "{law} by {method:?}: {nearest:e} s at {end}");
            }
            let rtol = if method.control().step.is_some() { 1e-5 } else { method.control().rtol };
            let speed = found.trajectory.v[found.trajectory.v.len() - 1];
            let what = format!("{law} by {method:?}");
            close(&what, INERTIA * speed, 20.0 * 0.15, 10.0 * rtol * 3.0);
        }
    }
}

/// Where a motion law depends on the state, steps do not end at its ends: the law is C² there.
#[test]
fn smooth_laws_of_the_state_cost_no_switches() {
    let (model, _) = wheel("step5(wheel.angle, 0, 0, 1, 1) + cycloidal(t)");
    let smooth: Vec<[bool; 3]> =
        model.switches.iter().map(|switch| [switch.time, switch.state, switch.smooth]).collect();
    assert_eq!(smooth, [[false, true, true], [true, false, true]]);
    let (model, state) = wheel("step5(wheel.angle, 0.001, 1, 0.002, 1.5)");
    let with = run("by angle", &model, &state, &options(methods(1e-8, 0.1)[0].clone(), 2.0));
    let speed = with.trajectory.v[with.trajectory.v.len() - 1];
    let energy = 0.001 + 0.5 * (1.0 + 1.5) * 0.001;
    let angle = with.trajectory.q[with.trajectory.q.len() - 1];
    close("energy", 0.5 * INERTIA * speed * speed, energy + 1.5 * (angle - 0.002), 1e-7);
}

/// The pulse of 0.2 s that every method stepped over.
#[test]
fn a_step_ends_at_each_switch() {
    let (model, state) = wheel("if(t<5, 0, if(t<5.2, 20, 0))");
    for method in methods(1e-6, 0.3) {
        let found = run("pulse", &model, &state, &options(method.clone(), 10.0));
        let t = &found.trajectory.t;
        assert!(t.contains(&5.0) && t.contains(&5.2), "{method:?}: {t:?}");
        assert!(t.windows(2).all(|w| w[0] < w[1]), "{method:?}");
        let torque = found.trajectory.states();
        let after = Prepared::new(&model).accelerations(torque, false, |_| Flow::Continue);
        let after = after.expect("regular");
        for (t, a) in t.iter().zip(after.a.chunks(3)) {
            // the value at a switch is that of the law there: the new one, for <
            let expected = if (5.0..5.2).contains(t) { 20.0 / INERTIA } else { 0.0 };
            assert_eq!(a[2], expected, "{method:?} at {t}");
        }
    }
}

/// A step of RK4 that does not divide the times of the switches goes on from each switch.
#[test]
fn constant_steps_begin_again_at_a_switch() {
    let (model, state) = wheel("if(t < 1, 2, -4)");
    let found = run("two values", &model, &state, &options(Scheme::Rk4(Rk4::new(0.3)), 2.0));
    let times = [0.0, 0.3, 0.6, 0.9, 1.0, 1.3, 1.6, 1.9, 2.0];
    let off = crate::mechanisms::worst(&found.trajectory.t, &times);
    assert!(off < 1e-15, "{:?}", found.trajectory.t);
    let speeds: Vec<f64> = found.trajectory.v.chunks(3).map(|v| v[2]).collect();
    let exact = times.map(|t: f64| if t < 1.0 { t } else { 1.0 - 2.0 * (t - 1.0) });
    assert!(crate::mechanisms::worst(&speeds, &exact) < 1e-14);
}

/// Backward in time the law has its values before a switch.
#[test]
fn a_run_backward_passes_the_same_switches() {
    let (model, mut state) = wheel("if(t<5, 0, if(t<5.2, 20, 0))");
    state.t = 10.0;
    state.v[2] = 20.0 * 0.2 / INERTIA;
    for method in methods(1e-6, 0.3) {
        let found = run("pulse", &model, &state, &options(method.clone(), 0.0));
        let speed = found.trajectory.v[found.trajectory.v.len() - 1];
        assert!(speed.abs() < 1e-12, "{method:?}: {speed:e}");
        assert!(found.trajectory.t.contains(&5.2));
    }
}

/// A model without switches has the same steps as one without this facility: none is scanned or shortened.
#[test]
fn a_switch_outside_the_run_changes_no_step() {
    let runs = ["3*sin(2*t)", "if(t < 20, 3*sin(2*t), 1)"].map(|law| {
        let (model, state) = wheel(law);
        methods(1e-6, 0.1)
            .into_iter()
            .map(|method| run(law, &model, &state, &options(method, 5.0)).trajectory)
            .collect::<Vec<_>>()
    });
    assert_eq!(runs[0], runs[1]);
}
