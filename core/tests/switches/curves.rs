//! Steps end at the breaks of curves: where a condition in x(u), y(u) or r(u) changes.

use crate::mechanisms::{model, start};
use crate::{methods, options, run};
use kempe::analyses::dynamics::{dynamics, Options, Run};
use kempe::integrate::{Dop853, Flow};
use kempe::model::Model;

const CAM: &str = include_str!("../../../examples/cam_roller.toml");
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
    let run = run(
        "bead",
        &m,
        &state,
        &options(kempe::analyses::dynamics::Scheme::Dop853(Dop853::new(1e-10, 1e-13)), 1.5),
    );
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
