//! Friction without a stated velocity: it sticks and slips, against closed forms.

use crate::mechanisms::methods::last;
use crate::mechanisms::{close, linkage, model, motor, pinned, start, GRAVITY, PENDULUM};
use kempe::analyses::dynamics::{dynamics, Auto, Options, Run, Scheme};
use kempe::analyses::State;
use kempe::integrate::{Dop853, Flow, Radau};
use kempe::model::Model;

const G: f64 = 9.81;
/// Error of the energy balance between steps, J.
const BETWEEN: f64 = 1e-6;

/// Runs by an explicit, an implicit and the automatic method, with 101 outputs.
fn each(m: &Model, state: &State, t_end: f64, mut look: impl FnMut(&str, &Run)) {
    for method in [
        Scheme::Dop853(Dop853::new(1e-11, 1e-13)),
        Scheme::Radau(Radau::new(1e-10, 1e-12)),
        Scheme::Auto(Auto::default()),
    ] {
        let name = format!("{method:?}");
        let options = Options { method, output_step: Some(t_end / 100.0), ..Options::new(t_end) };
        let outcome = dynamics(m, state, &options, |_| Flow::Continue);
        let run = outcome.unwrap_or_else(|failure| panic!("{name}: {}", failure.reason));
        look(&name, &run);
    }
}

/// The times of an event.
fn times<'r>(run: &'r Run, name: &str) -> &'r [f64] {
    let found = run.events.iter().find(|event| event.name == name);
    found.map_or(&[], |event| &event.states.t)
}

/// Dissipated energy, with the energy balance checked.
fn lost(m: &Model, run: &Run, tolerance: f64) -> f64 {
    let energies = run.energies(m).expect("energies");
    let sum = |row: &[f64]| row[0] + row[1] + row[2] - row[3] - row[4];
    for row in energies.chunks_exact(5) {
        close("energy balance", sum(row), sum(&energies[..5]), tolerance.max(BETWEEN));
    }
    close("energy balance at the end", sum(last(&energies, 5)), sum(&energies[..5]), tolerance);
    last(&energies, 5)[2]
}

/// A block of 2 kg on a slide with this angle, under a force along the slide and this load across.
fn block(angle: &str, along: &str, down: f64, fields: &str) -> Model {
    model(&format!(
        r#"
gravity = [0, -9.81]
[bodies.ground]
points = {{ O = [0, 0] }}
[bodies.block]
mass = 2
inertia = 0.1
points = {{ P = [0, 0] }}
[joints.slide]
type = "translational"
i = "ground.O"
j = "block.P"
axes = ["{angle}", 0]
[forces.pull]
type = "generalized_force"
coordinate = "slide.displacement"
value = "{along}"
[forces.weight]
type = "force"
j = "block.P"
force = [0, -{down}]
[forces.rub]
type = "friction"
joint = "slide"
{fields}
"#
    ))
}

#[test]
fn a_block_slips_where_the_force_exceeds_the_static_friction() {
    let m = block("0", "20*t", 0.0, "static = 0.5\nkinetic = 0.3");
    let (state, _) = start(&m, &[("slide.displacement", "0.1"), ("slide.rate", "0")], &[]);
    let (slip, end): (f64, f64) = (0.5 * 2.0 * G / 20.0, 1.0);
    // m a = 20 t - μ m g from the slip on
    let (s, kinetic) = (end - slip, 0.3 * G);
    let excess = 10.0 * slip - kinetic;
    let x = 0.1 + excess * s * s / 2.0 + 10.0 * s.powi(3) / 6.0;
    let v = excess * s + 5.0 * s * s;
    each(&m, &state, end, |name, run| {
        assert!(times(run, "rub.stick").is_empty(), "{name}: {:?}", times(run, "rub.stick"));
        let found = times(run, "rub.slip");
        assert_eq!(found.len(), 1, "{name}: {found:?}");
        close(name, found[0], slip, 1e-10);
        close(name, last(&run.trajectory.q, 3)[0], x, 1e-8);
        close(name, last(&run.trajectory.v, 3)[0], v, 1e-8);
        // it did not move before
        let rows = run.trajectory.t.iter().zip(run.trajectory.q.chunks_exact(3));
        for (_, q) in rows.filter(|(t, _)| **t < slip) {
            assert!((q[0] - 0.1).abs() < 1e-13, "{name}: {}", q[0]);
        }
        close(name, lost(&m, run, 1e-7), 0.3 * 2.0 * G * (x - 0.1), 1e-6);
    });
}

#[test]
fn a_block_inside_the_friction_angle_stays() {
    for load in [1.0, 10.0, 1000.0] {
        let down = (load - 1.0) * 2.0 * G;
        let m = block("20*deg", "0", down, "kinetic = 0.3\nstatic = 0.37");
        let (state, _) = start(&m, &[("slide.displacement", "0.5"), ("slide.rate", "0")], &[]);
        let first = state.q.clone();
        each(&m, &state, 10.0, |name, run| {
            for q in run.trajectory.q.chunks_exact(3) {
                let moved = (q[0] - first[0]).hypot(q[1] - first[1]);
                assert!(moved < 1e-12, "{name} load {load}: {moved}");
            }
            assert!(times(run, "rub.slip").is_empty(), "{name}");
        });
        // tan 20° = 0.364: outside of the angle it slides from the start
        let m = block("20*deg", "0", down, "kinetic = 0.3\nstatic = 0.35");
        each(&m, &state, 1.0, |name, run| {
            let (sin, cos) = 20.0f64.to_radians().sin_cos();
            let way = load * G * (sin - 0.3 * cos) / 2.0;
            let q = last(&run.trajectory.q, 3);
            close(name, (q[0] - first[0]).hypot(q[1] - first[1]), way, 1e-7 * way);
            assert!(q[1] < first[1], "{name}: downwards");
        });
    }
}

/// A block of 2 kg on a belt of 0.1 m/s, held by a spring of 50 N/m.
const BELT: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.belt]
mass = 5
inertia = 1
points = { O = [0, 0] }
[bodies.block]
mass = 2
inertia = 0.1
points = { P = [0, 0] }
[joints.bed]
type = "translational"
i = "ground.O"
j = "belt.O"
[joints.top]
type = "translational"
i = "belt.O"
j = "block.P"
[drivers.pulley]
type = "coordinate_driver"
coordinate = "belt.x"
value = "0.1*t"
[forces.spring]
type = "generalized_force"
coordinate = "block.x"
value = "-50*block.x"
[forces.rub]
type = "friction"
joint = "top"
static = 0.4
kinetic = 0.25
"#;

#[test]
fn stick_slip_on_a_belt() {
    let m = model(BELT);
    let (state, _) = start(&m, &[("block.x", "0"), ("block.vx", "0.1")], &[]);
    let (w, speed) = (5.0f64, 0.1);
    let (at_slip, middle) = (0.4 * 2.0 * G / 50.0, 0.25 * 2.0 * G / 50.0);
    let reach: f64 = at_slip - middle;
    let (slips, sticks) =
        (2.0 / w * (std::f64::consts::PI - (reach * w / speed).atan()), 2.0 * reach / speed);
    let amplitude = reach.hypot(speed / w);
    each(&m, &state, 8.0, |name, run| {
        let (slip, stick) = (times(run, "rub.slip"), times(run, "rub.stick"));
        assert!(slip.len() >= 3 && stick.len() >= 3, "{name}: {slip:?} {stick:?}");
        close(name, slip[0], at_slip / speed, 1e-9);
        for (k, (slip, stick)) in slip.iter().zip(stick).enumerate() {
            let from = at_slip / speed + k as f64 * (slips + sticks);
            close(name, *slip, from, 1e-7);
            close(name, *stick, from + slips, 1e-7);
        }
        // the largest and least positions of all steps, between the events
        let dense = run.dense.as_ref();
        assert!(dense.is_some(), "{name}");
        let x: Vec<f64> = run.trajectory.q.chunks_exact(6).map(|q| q[3]).collect();
        let most = x.iter().copied().fold(f64::MIN, f64::max);
        assert!(most <= middle + amplitude + 1e-7, "{name}: {most}");
        for event in &run.events {
            let expected = if event.name == "rub.slip" { at_slip } else { middle - reach };
            for q in event.states.q.chunks_exact(6) {
                close(name, q[3], expected, 1e-7);
            }
        }
        lost(&m, run, 1e-7);
    });
}

#[test]
fn a_pendulum_under_constant_load_loses_torque_times_angle() {
    // a bar of 1 m and 1 kg; the torque of friction is 0.4 N·m
    let m = model(&format!(
        "{PENDULUM}[forces.rub]\ntype = 'friction'\njoint = 'pin'\nkinetic = 0.5\nradius = 0.04\nload = 20\n"
    ));
    let (state, _) = start(&m, &[("rod.angle", "0"), ("rod.omega", "0")], &[]);
    // turning points: the potential falls by 0.4 × angle
    let height = |angle: f64| 0.5 * G * angle.sin();
    let (mut angle, mut way, mut turns) = (0.0f64, 0.0, 0);
    let down = -std::f64::consts::FRAC_PI_2;
    while 0.5 * G * (angle.cos()).abs() > 0.4 {
        let sense = (down - angle).signum();
        let left = |other: f64| height(angle) - height(other) - 0.4 * (other - angle).abs();
        // between the lowest position and the opposite height
        let (mut near, mut far) = (down, down + sense * std::f64::consts::FRAC_PI_2);
        for _ in 0..200 {
            let middle = 0.5 * (near + far);
            if left(middle) > 0.0 {
                near = middle;
            } else {
                far = middle;
            }
        }
        way += (near - angle).abs();
        (angle, turns) = (near, turns + 1);
    }
    assert!(turns > 3, "{turns}");
    each(&m, &state, 15.0, |name, run| {
        let accuracy = if name.starts_with("Auto") { 1e-5 } else { 1e-8 };
        close(name, last(&run.trajectory.q, 3)[2], angle, accuracy);
        assert_eq!(times(run, "rub.stick").len(), 1, "{name}: {:?}", times(run, "rub.stick"));
        assert!(last(&run.trajectory.v, 3)[2].abs() < 1e-12, "{name}");
        close(name, lost(&m, run, 10.0 * accuracy), 0.4 * way, accuracy);
    });
}

/// A four-bar linkage with friction in three pins, driven by a torque that grows and falls.
fn rubbing_linkage() -> Model {
    let rubbing = ["A", "B", "D"].map(|pin| {
        format!(
            "[forces.at_{pin}]\ntype = 'friction'\njoint = '{pin}'\nkinetic = 0.3\nstatic = 0.4\nradius = 0.02\n"
        )
    });
    model(&format!(
        "{GRAVITY}{}[forces.motor]\ntype = 'torque'\nj = 'crank'\ntorque = '0.6 + 0.6*sin(4*t)'\n{}",
        linkage([0.4, 0.1, 0.4, 0.3], [0.5, 1.0, 1.0]),
        rubbing.concat()
    ))
}

#[test]
fn pins_of_a_linkage_rub_together() {
    let m = rubbing_linkage();
    let set = [("crank.angle", "70*deg"), ("crank.omega", "0")];
    let (state, _) = start(&m, &set, &[("coupler.angle", "0.4"), ("rocker.angle", "1.94")]);
    // tests/truth/test_friction_in_pins.py has the equation of one freedom that gives this angle; the rocker reverses 14 times
    each(&m, &state, 3.0, |name, run| {
        let accuracy = if name.starts_with("Auto") { 1e-4 } else { 1e-6 };
        close(name, last(&run.trajectory.q, 9)[2], 22.190_009, accuracy);
        assert!(lost(&m, run, 1e-6) > 0.0, "{name}");
    });
}

/// A pin that a driver turns to and fro under a load of its own.
#[test]
fn friction_of_a_driven_pin_turns_with_its_speed() {
    let m = model(
        &(pinned("arm", "mass = 1\ninertia = 0.1\npoints = { O = [0, 0] }")
            + &motor("arm.angle", "0.5*sin(4*t)")
            + "[forces.rub]\ntype = 'friction'\njoint = 'pin'\nkinetic = 0.25\nradius = 0.04\nload = 20\n"),
    );
    let (state, _) = start(&m, &[], &[]);
    // in 2π s the arm turns 8 times 1 rad, against 0.2 N·m
    each(&m, &state, 2.0 * std::f64::consts::PI, |name, run| {
        close(name, lost(&m, run, 1e-6), 0.25 * 20.0 * 0.04 * 8.0, 1e-6);
        assert!(times(run, "rub.stick").is_empty(), "{name}");
    });
}
