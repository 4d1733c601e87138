//! Steps end at the breaks of curves: where a condition in x(u), y(u) or r(u) changes.

use super::{methods, options, run};
use crate::mechanisms::{model, start};
use kempe::analyses::dynamics::{dynamics, Options, Run, Scheme};
use kempe::analyses::State;
use kempe::integrate::{Dop853, Flow, Radau};
use kempe::model::Model;

const CAM: &str = include_str!("../../../../examples/cam_roller.toml");
const SPEED: f64 = 60.0;

/// Where the dwells begin and end, the contact lies straight above the shaft: u = 90° + speed t.
fn breaks() -> [f64; 4] {
    [100.0, 140.0, 240.0, 360.0].map(|u: f64| (u - 90.0).to_radians() / SPEED)
}

fn nearest(run: &Run, t: f64) -> f64 {
    run.trajectory.t.iter().map(|at| (at - t).abs()).fold(f64::INFINITY, f64::min)
}

#[test]
fn every_method_steps_to_the_breaks_of_a_cam() {
    let m = model(CAM);
    let (state, _) = start(&m, &[], &[]);
    for method in methods(1e-8, 1e-4) {
        let what = format!("{method:?}");
        let run = run("cam", &m, &state, &options(method, 0.09));
        for t in breaks() {
            // a method that reports at a spacing of its own steps near the break
            assert!(nearest(&run, t) < 1e-9, "{what}: {:e} s at {t}", nearest(&run, t));
        }
    }
}

/// The largest error of the energy balance over the outputs, J.
fn balance(m: &Model, run: &Run) -> f64 {
    let all = run.energies(m).expect("energies");
    // kinetic + potential + dissipated - work of drivers - work of forces
    let sums = all.chunks(5).map(|e| e[0] + e[1] + e[2] - e[3] - e[4]);
    let sums: Vec<f64> = sums.collect();
    sums.iter().fold(0.0, |most: f64, sum| most.max((sum - sums[0]).abs()))
}

#[test]
fn the_energy_balance_of_a_cam_with_dwells() {
    let m = model(CAM);
    let (state, _) = start(&m, &[], &[]);
    let mut given = Options::new(0.1);
    given.output_step = Some(5e-4);
    let run = dynamics(&m, &state, &given, |_| Flow::Continue).expect("a run");
    assert!(balance(&m, &run) < 1e-7, "{:e} J", balance(&m, &run));
}

/// A bead of 1 kg on a wire that is straight, then an arc of a circle: r = 1 m about (0, 1). It starts on the straight
/// part with the speed 1 m/s, and nothing else acts. Along the wire its speed stays.
#[test]
fn a_bead_enters_an_arc_at_constant_speed() {
    let wire = "[bodies.ground]\ncurves = { wire = { x = \"if(u < 0, u, sin(u))\", y = \"if(u < 0, 0, 1 - cos(u))\", range = [-1, 1.5] } }\n\
         [bodies.bead]\ntype = \"point_mass\"\nmass = 1\nat = [-0.5, 0]\n\
         [joints.slide]\ntype = \"point_on_curve\"\ni = \"bead.P\"\ncurve = \"ground.wire\"\n";
    let m = model(wire);
    let (state, _) = start(&m, &[("bead.x", "-0.5"), ("bead.vx", "1")], &[]);
    let run = run("bead", &m, &state, &options(Scheme::Dop853(Dop853::new(1e-10, 1e-13)), 1.5));
    assert!(nearest(&run, 0.5) < 1e-11, "{:e}", nearest(&run, 0.5));
    let n = m.layout.n_q;
    let last = &run.trajectory.q[run.trajectory.q.len() - n..];
    assert!((last[0] - 1.0_f64.sin()).abs() < 1e-9 && (last[1] - 1.0 + 1.0_f64.cos()).abs() < 1e-9);
    let accelerations = run.accelerations(&m).expect("accelerations");
    for (k, t) in run.trajectory.t.iter().enumerate().filter(|(_, t)| (**t - 0.5).abs() > 1e-6) {
        let a = accelerations.a[n * k].hypot(accelerations.a[n * k + 1]);
        let expected = if *t < 0.5 { 0.0 } else { 1.0 };
        assert!((a - expected).abs() < 1e-7, "v²/r at {t}: {a}");
    }
}

/// A bead of 1 kg starts at x = 1 with 1 m/s on a wire that is level except for a bump 20 mm high and 50 mm long.
fn wire_with_a_bump(y: &str, table: &str) -> (Model, State) {
    let m = model(&format!(
        "gravity = [0, -9.81]\n{table}[bodies.ground]\ncurves = {{ wire = {{ x = \"u\", y = \"{y}\", range = [-1, 6] }} }}\n\
         [bodies.bead]\ntype = \"point_mass\"\nmass = 1\n\
         [joints.slide]\ntype = \"point_on_curve\"\ni = \"bead.P\"\ncurve = \"ground.wire\"\n"
    ));
    let (state, _) = start(&m, &[("bead.x", "1"), ("bead.vx", "1")], &[]);
    (m, state)
}

/// The time for the bump y(s) of length b, by energy: ∫ √(1 + y′²) / √(1 - 2 g y) dx.
fn time_of_bump(y: impl Fn(f64) -> [f64; 2], b: f64) -> f64 {
    let n = 20_000;
    let at = |k: usize| {
        let [y, slope] = y(b * (k as f64 + 0.5) / n as f64);
        (1.0 + slope * slope).sqrt() / (1.0 - 2.0 * 9.81 * y).sqrt()
    };
    (0..n).map(at).sum::<f64>() * b / n as f64
}

/// The bump is a thousandth of the first long step.
#[test]
fn a_short_bump_of_motion_laws_in_u_is_not_stepped_over() {
    let rise = |s: f64| {
        let s = s.clamp(0.0, 1.0);
        [s * s * s * (10.0 + s * (6.0 * s - 15.0)), 30.0 * s * s * (1.0 - s) * (1.0 - s)]
    };
    let bump = |x: f64| {
        let [[up, steep], [down, slope]] = [rise(x / 0.02), rise((x - 0.03) / 0.02)];
        [0.02 * (up - down), steep - slope]
    };
    let expected = 3.0 - time_of_bump(bump, 0.05) + 0.05;
    let laws = [
        "0.02*(step5(u, 2, 0, 2.02, 1) - step5(u, 2.03, 0, 2.05, 1))",
        "0.02*(poly345((u - 2)/0.02) - poly345((u - 2.03)/0.02))",
    ];
    for law in laws {
        let (m, state) = wire_with_a_bump(law, "");
        // constant steps of Radau find no solution for a step across the break at these tolerances
        let constant =
            |method: &Scheme| matches!(method, Scheme::Radau(of) if of.control.step.is_some());
        for method in methods(1e-8, 1e-3).into_iter().filter(|method| !constant(method)) {
            let rough = matches!(method, Scheme::GeneralizedAlpha(_));
            let what = format!("{method:?}");
            let run = run("bead", &m, &state, &options(method, 2.0));
            let last = run.trajectory.q[run.trajectory.q.len() - m.layout.n_q];
            let allowed = if rough { 6e-3 } else { 5e-5 };
            assert!((last - expected).abs() < allowed, "{what}: {last} for {expected}");
            assert!(nearest(&run, 1.0) < 1e-8, "{what}: {:e}", nearest(&run, 1.0));
        }
    }
}

const TABLE: &str = "[tables.bump]\nx = [-1, 2, 2.02, 2.03, 2.05, 6]\ny = [0, 0, 1, 1, 0, 0]\ninterpolation = \"monotone\"\n";

/// A trial step beyond the end of the table has no tangent there, and is shortened.
#[test]
fn a_table_that_ends_shortens_steps_only() {
    let (m, state) = wire_with_a_bump("0.02*bump(u)", TABLE);
    let n = m.layout.n_q;
    for k in 0..12 {
        let t_end = 1.1 + 0.02 * f64::from(k);
        let run = run("bead", &m, &state, &Options::new(t_end));
        let last = run.trajectory.q[run.trajectory.q.len() - n];
        assert!((last - (t_end + 1.0 - 0.028_472_8)).abs() < 1e-6, "{last} at {t_end}");
    }
    for method in [Scheme::Dop853(Dop853::new(1e-8, 1e-11)), Scheme::Radau(Radau::new(1e-8, 1e-11))]
    {
        let what = format!("{method:?}");
        let given = options(method, 19.0);
        let failure = dynamics(&m, &state, &given, |_| Flow::Continue).expect_err("the table ends");
        let q = &failure.run.trajectory.q;
        let last = q[q.len() - n];
        assert!(last > 5.9 && last < 6.001, "{what}: {last}");
    }
}
