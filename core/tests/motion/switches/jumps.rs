//! Drivers and joint laws that jump are refused; continuous ones are followed.

use super::{methods, options, run};
use crate::mechanisms::{self, close, count, Random};
use kempe::analyses::dynamics::{dynamics, Options, Reason};
use kempe::analyses::State;
use kempe::integrate::Flow;
use kempe::model::Model;

/// Two bars; the upper one follows a law, and the lower one turns freely.
fn driven(law: &str) -> (Model, State) {
    let text = mechanisms::DOUBLE_PENDULUM.replace("0.3*sin(5*t) - pi/2", law);
    assert!(text.contains(law));
    let model = mechanisms::model(&text);
    let (state, _) = mechanisms::start(&model, &[], &[]);
    (model, state)
}

fn refused(law: &str) -> Reason {
    let (model, state) = driven(law);
    match dynamics(&model, &state, &Options::new(3.0), |_| Flow::Continue) {
        Ok(_) => panic!("{law} jumps"),
        Err(failure) => {
            let run = &failure.run;
            if matches!(failure.reason, Reason::Law { .. }) {
                assert!(run.trajectory.t.is_empty(), "{law}: before the run");
            } else {
                assert!(!run.trajectory.t.is_empty(), "{law}: results up to the jump");
            }
            failure.reason
        }
    }
}

fn number(random: &mut Random, low: f64, high: f64) -> f64 {
    let x = low + 0.5 * (high - low) * (random.next() + 1.0);
    (1e4 * x).round() / 1e4
}

#[test]
fn laws_that_jump_in_time_are_refused_before_the_run() {
    let mut random = Random::new(21);
    for _ in 0..count(60, 200) {
        let (a, by) = (number(&mut random, 0.1, 2.9), number(&mut random, 1e-4, 2.0));
        let w = number(&mut random, 0.5, 5.0);
        let form = number(&mut random, 0.0, 8.0) as usize;
        let (law, of) = match form {
            0 => (format!("if(t < {a}, 0, {by})"), "law"),
            1 => (format!("{by}*step(t - {a})"), "law"),
            2 => (format!("0.2*t + {by}*sign(t - {a})"), "law"),
            3 => (format!("0.1*floor(t/{a})"), "law"),
            4 => (format!("if(t < {a}, 0, {by}*(t - {a}))"), "rate"),
            5 => (format!("{by}*abs(t - {a})"), "rate"),
            6 => (format!("{by}*min(t, {a})"), "rate"),
            _ => (format!("max(0, {by}*(sin({w}*t) - sin({w}*{a})))"), "rate"),
        };
        // the sine has to pass its value at a, and with a slope
        if form == 7 && (w * a).cos().abs() < 1e-2 {
            continue;
        }
        match refused(&law) {
            Reason::Law { name, message, hint, .. } => {
                assert_eq!(name, "motor");
                let says =
                    if of == "law" { "the law of driver motor" } else { "the rate of the law" };
                assert!(message.starts_with(says), "{law}: {message}");
                assert!(hint.contains("equal rates"), "{hint}");
            }
            other => panic!("{law}: {other}"),
        }
    }
}

/// A law that is continuous with its rate may switch its acceleration. The upper bar follows it exactly.
#[test]
fn laws_whose_acceleration_alone_jumps_are_followed() {
    let mut random = Random::new(22);
    for _ in 0..count(10, 200) {
        let (a, by) = (number(&mut random, 0.1, 1.4), number(&mut random, -2.0, 2.0));
        let law = match number(&mut random, 0.0, 3.0) as usize {
            0 => format!("if(t < {a}, 0, {by}*(t - {a})^2)"),
            1 => format!("{by}*(t - {a})*abs(t - {a})"),
            _ => format!("{by}*max(0, t - {a})^2"),
        };
        let (model, state) = driven(&law);
        for method in methods(1e-6, 0.01) {
            let what = format!("{law} by {method:?}");
            let found = run(&what, &model, &state, &options(method, 1.5));
            let trajectory = found.trajectory;
            assert!(trajectory.t.iter().any(|t| (t - a).abs() < 1e-12), "{what}");
            let angle = trajectory.q[trajectory.q.len() - 4];
            let s = 1.5 - a;
            let exact = by * s * s;
            close(&what, angle, exact, 1e-8 * (1.0 + exact.abs()));
        }
    }
}

#[test]
fn a_law_of_the_state_that_jumps_is_refused_when_the_jump_is_reached() {
    // the lower bar falls through -60°; the upper one would have to jump
    for (law, says) in [
        ("-pi/2 + 0.1*step(lower.angle + 1)", "the law of driver motor jumps"),
        ("-pi/2 + 0.1*max(0, lower.angle + 1)", "the rate of the law of driver motor jumps"),
    ] {
        let (model, mut state) = driven(law);
        let turned = mechanisms::column(&model, "lower", 2);
        let request = mechanisms::request(&model, &[("lower.angle", "-3")], &[]);
        if let Ok((start, _)) = kempe::analyses::assemble::assemble(&model, &request) {
            state = start;
        }
        assert!(state.q[turned] < -1.0, "{:?}", state.q);
        for method in methods(1e-6, 0.01) {
            let outcome = dynamics(&model, &state, &options(method, 3.0), |_| Flow::Continue);
            match outcome.map_err(|failure| failure.reason) {
                Err(Reason::Integration { message, hint, .. }) => {
                    assert!(message.starts_with(says), "{law}: {message}");
                    assert!(hint.contains("equal rates"));
                }
                Err(other) => panic!("{law}: {other}"),
                Ok(_) => panic!("{law} jumps"),
            }
        }
    }
}
