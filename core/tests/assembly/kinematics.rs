//! Driven mechanisms without integration, against closed forms.

use crate::mechanisms::{column, four_bar_of, model, motor, slider_crank, start};
use kempe::analyses::kinematics::{kinematics, recorded, Failure, Limit, Motion, Reason};
use kempe::integrate::Flow;
use kempe::model::Model;
use std::f64::consts::{PI, TAU};

fn through(m: &Model, hints: &[(&str, &str)], times: &[f64]) -> Result<Motion, Box<Failure>> {
    let (state, _) = start(m, &[], hints);
    kinematics(m, &state, times, |_| Flow::Continue)
}

/// n + 1 times from 0 to `end`.
fn even(n: usize, end: f64) -> Vec<f64> {
    (0..=n).map(|k| end * k as f64 / n as f64).collect()
}

fn limit_of(outcome: Result<Motion, Box<Failure>>) -> (Limit, Motion) {
    let failure = *outcome.expect_err("a limit");
    match failure.reason {
        Reason::Limit(limit) => (*limit, failure.motion),
        other => panic!("{other}"),
    }
}

#[test]
fn a_slider_crank_over_a_turn() {
    let (r, l) = (0.1, 0.3);
    let text = slider_crank([r, l, 0.0, 0.0], ["1"; 2], "mass = 2\ninertia = 1");
    let m = model(&(text + &motor("crank.angle", "0.4 + 3*t + t^2")));
    let times = even(50, 2.0);
    let hints = [("piston.x", "0.35")];
    let motion = through(&m, &hints, &times).expect("a motion");
    assert!(motion.reached && motion.at_outputs().map(|point| point.t).eq(times.iter().copied()));
    let x = column(&m, "piston", 0);
    for (point, t) in motion.at_outputs().zip(&times) {
        let (angle, rate) = (0.4 + 3.0 * t + t * t, 3.0 + 2.0 * t);
        let (sin, cos) = angle.sin_cos();
        let root = (l * l - r * r * sin * sin).sqrt();
        let exact = [r * cos + root, -rate * (r * sin + r * r * sin * cos / root)];
        let found = [point.q[x], point.v[x]];
        for (found, exact) in found.iter().zip(exact) {
            assert!((found - exact).abs() < 1e-12, "t = {t}: {found} {exact}");
        }
    }
    // the work of the motor is the change of the kinetic energy of all bodies, without gravity
    let trajectory = recorded(&m, &start(&m, &[], &hints).0, &motion, false).trajectory;
    let energy = kempe::analyses::dynamics::Prepared::new(&m)
        .energies(trajectory.states(), &trajectory.works)
        .expect("energies");
    for row in energy.chunks(5) {
        assert!((row[0] - energy[0] - row[3]).abs() < 1e-9 * row[0], "{row:?}");
    }
}

/// A crank-rocker, driven at its rocker: the rocker stops where crank and coupler are in line.
#[test]
fn the_limits_of_a_rocker() {
    let [g, a, b, c] = [4.0, 1.0, 3.5, 2.5_f64];
    for (way, reach) in [(1.0, b - a), (-1.0, a + b)] {
        let m = four_bar_of([g, a, b, c], &motor("rocker.angle", &format!("2 + {way}*t")));
        let (limit, motion) = limit_of(through(
            &m,
            &[("crank.angle", "1"), ("coupler.angle", "0.3")],
            &even(100, 3.0),
        ));
        // the law of cosines in the triangle with the sides g, c and the distance of A and C
        let exact = PI - ((g * g + c * c - reach * reach) / (2.0 * g * c)).acos();
        assert!((2.0 + way * limit.t - exact).abs() < 1e-9, "{} {exact}", 2.0 + way * limit.t);
        assert_eq!(limit.driver, "motor");
        let mut line = limit.in_line.expect("crank and coupler in line");
        line.sort();
        assert_eq!(line, ["coupler", "crank"]);
        let last = motion.at_outputs().last().map_or(0.0, |point| point.t);
        assert!(last <= limit.t && limit.t - last < 0.04, "{last}");
    }
}

/// The crank of a double rocker does not turn fully.
#[test]
fn the_limit_of_a_crank_is_named() {
    let [g, a, b, c] = [4.0, 3.0, 2.0, 2.5_f64];
    let m = four_bar_of([g, a, b, c], &motor("crank.angle", "0.5 + t"));
    let hints = [("coupler.angle", "0.5"), ("rocker.angle", "1.5")];
    let (limit, _) = limit_of(through(&m, &hints, &even(40, TAU)));
    let exact = ((g * g + a * a - (b + c) * (b + c)) / (2.0 * g * a)).acos();
    assert!((0.5 + limit.t - exact).abs() < 1e-9);
    let reason = Reason::Limit(Box::new(limit)).to_string();
    assert!(reason.starts_with("crank cannot pass ") && reason.contains("dead point"), "{reason}");
    assert!(reason.contains("coupler and rocker in line"), "{reason}");
    assert!(reason.contains(&format!("{:.4}", exact.to_degrees())[..7]), "{reason}");
}

/// A parallelogram passes its change points, also with outputs exactly there, and does not fold.
#[test]
fn a_parallelogram_passes_its_change_points() {
    let m = four_bar_of([3.0, 1.0, 3.0, 1.0], &motor("crank.angle", "t + pi/2"));
    for n in [8, 36, 37, 1000] {
        let times = even(n, 4.0 * PI);
        let hints = [("coupler.angle", "0"), ("rocker.angle", "pi/2")];
        let motion = through(&m, &hints, &times).unwrap_or_else(|f| panic!("{n}: {}", f.reason));
        let rocker = column(&m, "rocker", 2);
        for (point, t) in motion.at_outputs().zip(&times) {
            let (angle, rate) = (point.q[rocker], point.v[rocker]);
            assert!((angle - t - PI / 2.0).abs() < 1e-7, "{n}: {t} {angle}");
            assert!((rate - 1.0).abs() < 1e-5, "{n}: {t} {rate}");
        }
    }
}

#[test]
fn a_freedom_without_a_driver_is_refused() {
    let text = "[bodies.ground]\npoints = { O = [0, 0] }\n[bodies.rod]\ntype = 'bar'\nmass = 1\nlength = 1\n\
                ends = ['O', 'P']\n[joints.O]\ntype = 'revolute'\ni = 'ground.O'\nj = 'rod.O'\n";
    let failure = through(&model(text), &[], &[0.0, 1.0]).expect_err("a free pendulum");
    let text = failure.reason.to_string();
    assert!(text.contains("leave 1 degree of freedom"), "{text}");
}

/// 360 positions, velocities and accelerations of a six-bar linkage over a turn.
#[test]
#[ignore = "a measurement: cargo test --release -p kempe --test assembly kinematics -- --ignored --nocapture"]
fn the_time_of_a_six_bar() {
    let text = include_str!("../../../examples/six_bar.toml");
    let m = model(text.split("[start").next().expect("the mechanism"));
    let hints = [("coupler.angle", "40 deg"), ("plate.angle", "80 deg"), ("link.angle", "20 deg")];
    let (state, _) = start(&m, &[], &hints);
    let times = even(359, 1.0);
    let measure = |_| {
        let began = std::time::Instant::now();
        let motion = kinematics(&m, &state, &times, |_| Flow::Continue).expect("a motion");
        assert_eq!(motion.outputs.len(), 360);
        began.elapsed().as_secs_f64() * 1e3
    };
    let best = (0..2000).map(measure).fold(f64::INFINITY, f64::min);
    println!("360 positions of a six-bar linkage: {best:.3} ms");
}

/// A limit over time is the length of a driven rod, or the time where a law drives no quantity.
#[test]
fn the_limit_of_a_joint_with_a_law() {
    let text = slider_crank([1.0, 3.0, 0.0, 0.0], ["1"; 2], "mass = 2\ninertia = 1");
    let distance =
        "[joints.pull]\ntype = 'distance'\ni = 'ground.O'\nj = 'piston.B'\nlength = '3 + t/2'\n";
    let sum = "[joints.pull]\ntype = 'coupling'\nterms = { 'piston.x' = 1 }\nvalue = '3 + t/2'\n";
    for (joint, value, written) in [(distance, 4.0, "4 m"), (sum, 2.0, "2 s")] {
        let m = model(&(text.clone() + joint));
        let (limit, _) = limit_of(through(&m, &[("crank.angle", "1")], &even(10, 3.0)));
        assert!((limit.t - 2.0).abs() < 1e-9 && (limit.value - value).abs() < 1e-9, "{limit:?}");
        let told = format!("pull cannot pass {written}: dead point");
        assert!(limit.to_string().starts_with(&told), "{limit}");
    }
}
