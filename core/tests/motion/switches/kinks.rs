//! Knots of tables and the ends of `harmonic`: runs step to them exactly.

use super::{methods, options, run, wheel_with, INERTIA};
use crate::mechanisms::{self, close, count, Random};
use kempe::analyses::dynamics::{dynamics, Reason, Run, Scheme};
use kempe::analyses::State;
use kempe::integrate::{Flow, Rk4};
use kempe::model::Model;

/// A table of a case.
fn table(name: &str, x: &[f64], y: &[f64], rest: &str) -> String {
    format!("[tables.{name}]\nx = {x:?}\ny = {y:?}\n{rest}\n")
}

/// The last angle and speed of a wheel.
fn end(run: &Run) -> [f64; 2] {
    let trajectory = &run.trajectory;
    [trajectory.q[trajectory.q.len() - 1], trajectory.v[trajectory.v.len() - 1]]
}

/// The area under straight lines through points.
fn area(x: &[f64], y: &[f64]) -> f64 {
    x.windows(2).zip(y.windows(2)).map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1])).sum()
}

/// Random points, on a grid of 1e-4.
fn points(random: &mut Random, n: usize, [low, high]: [f64; 2], height: f64) -> [Vec<f64>; 2] {
    let mut number = |low: f64, high: f64| {
        let x = low + 0.5 * (high - low) * (random.next() + 1.0);
        (1e4 * x).round() / 1e4
    };
    let mut x: Vec<f64> = (0..n).map(|_| number(low, high)).collect();
    x.sort_by(f64::total_cmp);
    x.dedup_by(|b, a| *b - *a < 1e-3);
    let y = x.iter().map(|_| number(0.1 * height, height)).collect();
    [x, y]
}

/// The accuracy of a state by a method: generalized-α has order 2, and a tolerance of 1e-3 in adaptive runs.
fn accuracy(method: &Scheme) -> f64 {
    match method {
        Scheme::GeneralizedAlpha(_) if method.control().step.is_none() => 2e-3,
        Scheme::GeneralizedAlpha(_) => 1e-4,
        _ => 1e-8,
    }
}

#[test]
fn linear_tables_of_time_have_their_impulse() {
    let mut random = Random::new(41);
    for case in 0..count(10, 100) {
        let [x, mut y] = points(&mut random, 9, [0.2, 4.5], 10.0);
        let periodic = case % 2 == 1;
        let (first, last) = (x[0], x[x.len() - 1]);
        let (rest, t_end, impulse) = if periodic {
            *y.last_mut().expect("points") = y[0];
            // from 0 over three periods
            ("periodic = true", 3.0 * (last - first), 3.0 * area(&x, &y))
        } else {
            let ends = y[0] * first + y[y.len() - 1] * (5.0 - last);
            ("outside = \"hold\"", 5.0, area(&x, &y) + ends)
        };
        let given = table("pulse", &x, &y, &format!("interpolation = \"linear\"\n{rest}"));
        let (model, state) = wheel_with("pulse(t)", &given);
        for method in methods(1e-6, 0.0317) {
            let what = format!("{given} by {method:?}");
            let found = run(&what, &model, &state, &options(method.clone(), t_end));
            let tolerance = if accuracy(&method) > 1e-8 { 2e-3 } else { 1e-10 };
            close(&what, INERTIA * end(&found)[1], impulse, tolerance * impulse);
            let missing = x[1..x.len() - 1].iter().find(|x| !found.trajectory.t.contains(x));
            assert!(missing.is_none(), "{what}: no step ends at {missing:?}");
        }
    }
}

/// Work on the wheel by a torque that a table gives along the angle.
#[test]
fn linear_tables_of_the_angle_do_their_work() {
    let mut random = Random::new(42);
    for _ in 0..count(6, 100) {
        let [x, y] = points(&mut random, 7, [0.1, 2.0], 8.0);
        let given = table("along", &x, &y, "interpolation = \"linear\"\noutside = \"hold\"");
        let (model, mut state) = wheel_with("along(wheel.angle)", &given);
        state.v[2] = 2.0;
        for method in methods(1e-9, 1e-3) {
            let what = format!("{given} by {method:?}");
            let found = run(&what, &model, &state, &options(method.clone(), 1.2));
            let [angle, speed] = end(&found);
            let last = x.len() - 1;
            assert!(angle > x[last], "{what}: {angle}");
            let work = area(&x, &y) + y[0] * x[0] + y[last] * (angle - x[last]);
            let exact = (4.0 + 2.0 * work / INERTIA).sqrt();
            close(&what, speed, exact, accuracy(&method));
            let angles: Vec<f64> = found.trajectory.q.chunks(3).map(|q| q[2]).collect();
            for knot in &x {
                let near = angles.iter().any(|angle| (angle - knot).abs() < accuracy(&method));
                assert!(near, "{what}: no step ends at {knot}");
            }
        }
    }
}

#[test]
fn harmonic_rises_end_their_steps() {
    let (start, length, height) = (0.7, 0.45, 6.0);
    let law = format!("{height}*harmonic((t - {start})/{length})");
    let (model, state) = wheel_with(&law, "");
    let impulse = height * (0.5 * length + 2.0 - start - length);
    for method in methods(1e-8, 0.01) {
        let what = format!("{method:?}");
        let found = run(&what, &model, &state, &options(method.clone(), 2.0));
        let tolerance = if accuracy(&method) > 1e-8 { 1e-3 } else { 1e-7 };
        close(&what, INERTIA * end(&found)[1], impulse, tolerance * impulse);
        for t in [start, start + length] {
            let near = found.trajectory.t.iter().any(|x| (x - t).abs() < 1e-14);
            assert!(near, "{what}: no step ends at {t}");
        }
    }
    let law = format!("{height}*harmonic((wheel.angle - {start})/{length})");
    let (model, mut state) = wheel_with(&law, "");
    state.v[2] = 2.0;
    for method in methods(1e-9, 1e-3) {
        let what = format!("{law} by {method:?}");
        let found = run(&what, &model, &state, &options(method.clone(), 1.0));
        let [angle, speed] = end(&found);
        let work = height * (0.5 * length + angle - start - length);
        close(&what, speed, (4.0 + 2.0 * work / INERTIA).sqrt(), accuracy(&method));
        for knot in [start, start + length] {
            let near =
                found.trajectory.q.chunks(3).any(|q| (q[2] - knot).abs() < accuracy(&method));
            assert!(near, "{what}: no step ends at {knot}");
        }
    }
}

/// Two bars; the upper one follows a law that reads a table.
fn driven(law: &str, given: &str) -> (Model, State) {
    let text = mechanisms::DOUBLE_PENDULUM.replace("0.3*sin(5*t) - pi/2", law) + given;
    let model = mechanisms::model(&text);
    let (state, _) = mechanisms::start(&model, &[], &[]);
    (model, state)
}

/// The acceleration of a monotone table and of a harmonic rise jumps, which a driver may do.
#[test]
fn drivers_follow_laws_whose_acceleration_jumps_at_knots() {
    let rest = "interpolation = \"monotone\"\noutside = \"linear\"";
    let given = table("lift", &[0.0, 0.31, 0.6, 1.1], &[0.0, 0.4, 0.5, 1.2], rest);
    for (law, knots, last) in
        [("lift(t)", vec![0.31, 0.6], 1.2), ("0.8*harmonic((t - 0.25)/0.5)", vec![0.25, 0.75], 0.8)]
    {
        let (model, state) = driven(law, if law.contains("lift") { &given } else { "" });
        for method in methods(1e-6, 0.01) {
            let what = format!("{law} by {method:?}");
            let found = run(&what, &model, &state, &options(method, 1.1));
            let trajectory = found.trajectory;
            for knot in &knots {
                let near = trajectory.t.iter().any(|t| (t - knot).abs() < 1e-14);
                assert!(near, "{what}: no step ends at {knot}");
            }
            close(&what, trajectory.q[trajectory.q.len() - 4], last, 1e-8);
        }
    }
}

/// Behind the end of a held table the rate of a driver jumps to zero.
#[test]
fn drivers_whose_table_ends_with_a_slope_are_refused_by_name() {
    let given = table("ramp", &[0.0, 1.0, 2.0], &[0.0, 0.5, 2.0], "outside = \"hold\"");
    let (model, state) = driven("ramp(t)", &given);
    match dynamics(&model, &state, &options(Scheme::Rk4(Rk4::new(0.01)), 3.0), |_| Flow::Continue) {
        Err(failure) => match failure.reason {
            Reason::Law { name, message, t, .. } => {
                assert_eq!((name.as_str(), t), ("motor", 2.0));
                assert!(
                    message.starts_with("the rate of the law of driver motor jumps"),
                    "{message}"
                );
                assert!(message.contains("to 0.000000"), "{message}");
            }
            other => panic!("{other}"),
        },
        Ok(_) => panic!("the rate jumps"),
    }
    // the lower bar falls from 2 rad below 0 and passes -1
    let given = table("ramp", &[-9.0, -3.0, -1.0], &[0.0, 0.1, 0.5], "outside = \"hold\"");
    let (model, mut state) = driven("-pi/2 + 0.1*ramp(lower.angle)", &given);
    let request = mechanisms::request(&model, &[("lower.angle", "-3")], &[]);
    if let Ok((start, _)) = kempe::analyses::assemble::assemble(&model, &request) {
        state = start;
    }
    assert!(state.q[mechanisms::column(&model, "lower", 2)] < -1.0, "{:?}", state.q);
    for method in methods(1e-6, 0.01) {
        let outcome = dynamics(&model, &state, &options(method, 3.0), |_| Flow::Continue);
        match outcome.map_err(|failure| failure.reason) {
            Err(Reason::Integration { message, .. }) => {
                assert!(
                    message.starts_with("the rate of the law of driver motor jumps"),
                    "{message}"
                );
            }
            Err(other) => panic!("{other}"),
            Ok(_) => panic!("the rate jumps"),
        }
    }
}

/// A table of a table, and a table that a fast oscillation reads: all knots are found before the run.
#[test]
fn knots_of_any_argument_of_time_are_found() {
    let saw = table(
        "saw",
        &[0.0, 0.3, 0.5, 1.0],
        &[0.0, 2.0, 1.0, 0.0],
        "interpolation = \"linear\"\nperiodic = true",
    );
    let clip =
        table("clip", &[0.5, 1.5], &[-1.0, 1.0], "interpolation = \"linear\"\noutside = \"hold\"");
    let (model, state) = wheel_with("clip(saw(t))", &format!("{saw}{clip}"));
    let found = run("clip", &model, &state, &options(Scheme::Rk4(Rk4::new(10.0)), 2.0));
    // saw is 0.5 and 1.5 at 0.075, 0.225, 0.4 and 0.75
    let times: Vec<f64> = [0.075, 0.225, 0.3, 0.4, 0.5, 0.75, 1.0].into_iter().collect();
    let both: Vec<f64> = times
        .iter()
        .chain(&times[..6])
        .enumerate()
        .map(|(k, t)| if k < 7 { *t } else { 1.0 + t })
        .collect();
    for t in &both {
        let near = found.trajectory.t.iter().any(|x| (x - t).abs() < 1e-12);
        assert!(near, "{t}: {:?}", found.trajectory.t);
    }
    assert_eq!(found.trajectory.t.len(), both.len() + 2, "{:?}", found.trajectory.t);
    let band = table(
        "band",
        &[0.4999, 0.5001],
        &[0.0, 1.0],
        "interpolation = \"linear\"\noutside = \"hold\"",
    );
    let (model, state) = wheel_with("band(sin(900*t))", &band);
    let found = run("band", &model, &state, &options(Scheme::Rk4(Rk4::new(10.0)), 1.0));
    // two knots at each of two flanks of each period; the last period ends behind its rise
    let expected = [0.4999_f64, 0.5001].iter().flat_map(|level| {
        let rise = level.asin();
        (0..150).flat_map(move |k| {
            [rise, std::f64::consts::PI - rise].map(|x| x + std::f64::consts::TAU * f64::from(k))
        })
    });
    let expected = expected.filter(|x| *x < 900.0).count();
    assert_eq!(found.trajectory.t.len(), expected + 2);
}
