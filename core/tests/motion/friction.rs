//! Friction in joints with a stated velocity: motions by every method against scalar equations from which the reaction
//! is eliminated by hand.

use crate::mechanisms::methods::{ends, integrated, last};
use crate::mechanisms::{close, faults, model, pinned, start, worst, GRAVITY};
use kempe::analyses::dynamics::{dynamics, Options, Run, Scheme};
use kempe::analyses::State;
use kempe::equations::{Gains, Workspace};
use kempe::integrate::{Dop853, Flow, Radau, Rk45};
use kempe::model::Model;

const G: f64 = 9.81;

/// A body of 1.5 kg, 0.4 m from its pin.
fn pendulum(friction: &str) -> Model {
    let bob = pinned("bob", "mass = 1.5\ninertia = 0.02\npoints = { O = [-0.4, 0] }");
    model(&format!("{GRAVITY}{bob}[forces.rub]\ntype = 'friction'\njoint = 'pin'\n{friction}\n"))
}

/// The root of f(x) = x, where f contracts.
fn fixed(f: impl Fn(f64) -> f64) -> f64 {
    let mut x = 0.0;
    for _ in 0..400 {
        let next = f(x);
        if next == x {
            break;
        }
        x = next;
    }
    x
}

/// Energy that a run loses by friction, with the energy balance checked.
fn lost(model: &Model, run: &Run, tolerance: f64) -> f64 {
    let energies = run.energies(model).expect("energies");
    let (first, end) = (&energies[..5], last(&energies, 5));
    // kinetic + potential + dissipated - work of drivers - work of forces
    let sum = |row: &[f64]| row[0] + row[1] + row[2] - row[3] - row[4];
    close("energy balance", sum(end), sum(first), tolerance);
    end[2]
}

#[test]
fn a_pin_is_loaded_by_its_own_reaction() {
    let fields = "kinetic = 0.3\nstatic = 0.5\nstribeck = 0.05\nviscous = 0.7\nradius = 0.08\nvelocity = 0.02";
    let m = pendulum(fields);
    let (state, _) = start(&m, &[("bob.angle", "0.5"), ("bob.omega", "2")], &[]);
    // J φ̈ = -m g l cos φ - r (|F| μ(v) tanh(v/v₀) + c v), v = r φ̇, where |F| depends on φ̈
    let alpha = |[phi, omega]: [f64; 2]| {
        let (mass, length, inertia, radius) = (1.5, 0.4, 0.02 + 1.5 * 0.16, 0.08);
        let (s, c) = phi.sin_cos();
        let speed = radius * omega;
        let mu = 0.3 + 0.2 * (-(speed / 0.05f64).powi(2)).exp();
        fixed(|alpha| {
            let ax = -length * (s * alpha + c * omega * omega);
            let ay = length * (c * alpha - s * omega * omega);
            let load = mass * ax.hypot(ay + G);
            let force = load * mu * (speed / 0.02).tanh() + 0.7 * speed;
            (-mass * G * length * c - radius * force) / inertia
        })
    };
    let truth = integrated([0.5, 2.0], 1.5, |y| [y[1], alpha(y)]);
    let free = integrated([0.5, 2.0], 1.5, |y| [y[1], -1.5 * G * 0.4 * y[0].cos() / 0.26]);
    assert!((truth[0] - free[0]).abs() > 0.1, "friction matters");
    ends(&m, &state, 1.5, |name, run, accuracy| {
        let end = [last(&run.trajectory.q, 3)[2], last(&run.trajectory.v, 3)[2]];
        assert!(worst(&end, &truth) < 10.0 * accuracy, "{name}: {end:?} {truth:?}");
        assert!(lost(&m, run, 30.0 * accuracy) > 0.5, "{name}");
    });
}

#[test]
fn load_dependent_friction_to_1e_8() {
    let m = pendulum("kinetic = 0.3\nviscous = 0.7\nradius = 0.08\nvelocity = 0.05");
    let (state, _) = start(&m, &[("bob.angle", "0.5"), ("bob.omega", "2")], &[]);
    let rate = |[phi, omega]: [f64; 2]| {
        let (mass, length, inertia, radius) = (1.5, 0.4, 0.26, 0.08);
        let (s, c) = phi.sin_cos();
        let speed: f64 = radius * omega;
        let alpha = fixed(|alpha| {
            let ax = -length * (s * alpha + c * omega * omega);
            let ay = length * (c * alpha - s * omega * omega);
            let force = 0.3 * mass * ax.hypot(ay + G) * (speed / 0.05).tanh() + 0.7 * speed;
            (-mass * G * length * c - radius * force) / inertia
        });
        [omega, alpha]
    };
    let truth = integrated([0.5, 2.0], 1.5, rate);
    for (method, name) in [
        (Scheme::Dop853(Dop853::new(1e-12, 1e-14)), "DOP853"),
        (Scheme::Rk45(Rk45::new(1e-12, 1e-14)), "RK45"),
        (Scheme::Radau(Radau::new(1e-11, 1e-13)), "Radau"),
    ] {
        let options = Options { method, ..Options::new(1.5) };
        let run = dynamics(&m, &state, &options, |_| Flow::Continue).expect(name);
        let end = [last(&run.trajectory.q, 3)[2], last(&run.trajectory.v, 3)[2]];
        assert!(worst(&end, &truth) < 1e-8, "{name}: {end:?} {truth:?}");
    }
}

#[test]
fn a_constant_load_takes_torque_times_angle() {
    // μ r N = 0.3 N·m; tanh(v/v₀) is near 1 except on a small part of the way
    let m = pendulum("kinetic = 0.3\nradius = 0.05\nload = 20\nvelocity = 1e-4");
    let (state, _) = start(&m, &[("bob.angle", "0"), ("bob.omega", "0")], &[]);
    ends(&m, &state, 1.5, |name, run, accuracy| {
        let turns = &run.trajectory.q.chunks_exact(3).map(|q| q[2]).collect::<Vec<_>>();
        let way: f64 = turns.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
        let dissipated = lost(&m, run, 1e3 * accuracy);
        assert!(way > 1.5 && (dissipated / (0.3 * way) - 1.0).abs() < 0.01, "{name}: {dissipated}");
    });
}

#[test]
fn a_long_guide_is_loaded_by_its_torque() {
    // a block on a level slide, its mass centre at (0.1, 0.3) from the point of the slide, on a spring
    let m = model(
        r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.block]
mass = 2
inertia = 0.05
points = { P = [-0.1, -0.3] }
[joints.slide]
type = "translational"
i = "ground.O"
j = "block.P"
[forces.spring]
type = "generalized_force"
coordinate = "slide.displacement"
value = "-50*slide.displacement"
[forces.rub]
type = "friction"
joint = "slide"
kinetic = 0.12
guide = 0.25
velocity = 0.05
"#,
    );
    let (state, _) = start(&m, &[("block.x", "0.9"), ("block.vx", "0.4")], &[]);
    // F = m g; the torque about the point of the slide balances weight and inertia at the mass centre
    let rate = |[x, v]: [f64; 2]| {
        let a = fixed(|a| {
            let torque: f64 = 0.1 * 2.0 * G - 0.3 * 2.0 * a;
            let load = (2.0 * G).max(2.0 * torque.abs() / 0.25);
            (-50.0 * x - load * 0.12 * (v / 0.05f64).tanh()) / 2.0
        });
        [v, a]
    };
    let truth = integrated([0.8, 0.4], 1.1, rate);
    ends(&m, &state, 1.1, |name, run, accuracy| {
        let end = [last(&run.trajectory.q, 3)[0] - 0.1, last(&run.trajectory.v, 3)[0]];
        assert!(worst(&end, &truth) < 100.0 * accuracy, "{name}: {end:?} {truth:?}");
        assert!(lost(&m, run, 1e3 * accuracy) > 0.5, "{name}");
    });
}

/// A bead in a slot of an arm that a driver turns at 3 rad/s; the slot is at 0.2 m beside the pin, at an angle of 30°.
const TURNING: &str = r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.arm]
mass = 1
inertia = 0.1
points = { O = [0, 0], S = [0.1, -0.2] }
[bodies.bead]
mass = 0.5
inertia = 0.001
points = { C = [0, 0] }
[joints.pin]
type = "revolute"
i = "ground.O"
j = "arm.O"
[joints.slot]
type = "JOINT"
i = "arm.S"
j = "bead.C"
AXIS
[drivers.motor]
type = "coordinate_driver"
coordinate = "arm.angle"
value = "3*t"
[forces.rub]
type = "friction"
joint = "slot"
kinetic = 0.4
viscous = 0.2
velocity = 0.1
"#;

#[test]
fn friction_in_a_slot_that_turns() {
    // In the frame of the arm, with u along the slot and n to its left: P = S + r u, |P″ - …| along u:
    // m (r̈ - ω² (r + S·u)) = -f; the slot presses with N = m (2 ω ṙ - ω² S·n)
    let (mass, w, angle) = (0.5, 3.0, 30.0f64.to_radians());
    let (along, across) =
        (0.1 * angle.cos() - 0.2 * angle.sin(), -0.1 * angle.sin() - 0.2 * angle.cos());
    let truth = integrated([0.3, -1.0], 0.8, |[r, v]| {
        let load = mass * (2.0 * w * v - w * w * across);
        let force = load.abs() * 0.4 * (v / 0.1f64).tanh() + 0.2 * v;
        [v, w * w * (r + along) - force / mass]
    });
    for (joint, axis) in
        [("pin_in_slot", "axis = '30*deg'"), ("translational", "axes = ['30*deg', 0]")]
    {
        let m = model(&TURNING.replace("JOINT", joint).replace("AXIS", axis));
        let set = [("slot.displacement", "0.3"), ("slot.rate", "-1")];
        let bead = [("bead.angle", "0"), ("bead.omega", "0")];
        let set = if joint == "pin_in_slot" { [set, bead].concat() } else { set.to_vec() };
        let (state, _) = start(&m, &set, &[]);
        ends(&m, &state, 0.8, |name, run, accuracy| {
            // back into the frame of the arm
            let (q, v) = (last(&run.trajectory.q, 6), last(&run.trajectory.v, 6));
            let (sin, cos) = (q[2] + angle).sin_cos();
            let r = q[3] * cos + q[4] * sin - along;
            let rate = v[3] * cos + v[4] * sin - 3.0 * (q[3] * sin - q[4] * cos);
            let error = worst(&[r, rate], &truth);
            assert!(error < 20.0 * accuracy, "{joint} {name}: {r} {rate} {truth:?}");
            let dissipated = lost(&m, run, 100.0 * accuracy);
            assert!(dissipated > 0.05, "{name}: {dissipated}");
        });
    }
}

/// A uniform rod of 1 m that leans with tan θ = 2, its lower end on a line; it leans to the left and slides to the right.
fn rod(mu: f64) -> (Model, State) {
    let m = model(&format!(
        r#"
gravity = [0, -9.81]
[bodies.ground]
points = {{ O = [0, 0] }}
[bodies.rod]
type = "bar"
mass = 1
length = 1
ends = ["P", "Q"]
[joints.line]
type = "pin_in_slot"
i = "ground.O"
j = "rod.P"
[forces.rub]
type = "friction"
joint = "line"
kinetic = {mu}
velocity = 1e-3
"#
    ));
    let set =
        [("rod.angle", "pi - atan(2)"), ("rod.omega", "0"), ("rod.P.x", "0"), ("rod.P.vx", "1")];
    let (state, _) = start(&m, &set, &[]);
    (m, state)
}

#[test]
fn painleve_rod() {
    // with half length l and J = m l²/3, the acceleration of the end along the normal is
    // -g + (N/m) (1 + 3 cos² θ - 3 μ sin θ cos θ): zero for N = m g / (…), which has no solution from μ = 4/3 on
    for mu in [0.1, 0.7, 1.3, 1.333] {
        let (m, state) = rod(mu);
        let mut workspace = Workspace::new(&m);
        let [q, v] = [&state.q[..], &state.v];
        workspace.accelerate(&m, 0.0, [q, v, &[]], Gains::default()).expect("solved");
        let normal = 9.81 / (1.6 - 1.2 * mu);
        close("N", workspace.lam()[0].abs(), normal, 1e-9 * normal);
    }
    for mu in [1.334, 1.4, 2.0, 10.0] {
        let (m, state) = rod(mu);
        let failure = dynamics(&m, &state, &Options::new(0.1), |_| Flow::Continue).unwrap_err();
        let message = failure.reason.to_string();
        for part in ["friction paradox (Painlevé)", "line", "t = 0.0", "rod x", "reduce"] {
            assert!(message.contains(part), "{message}");
        }
    }
}

#[test]
fn a_rod_that_is_dragged_has_no_paradox() {
    // to the other side friction lifts no load: 1 + 3 cos² θ + 3 μ sin θ cos θ
    for mu in [0.5, 1.4, 10.0, 1e3] {
        let (m, mut state) = rod(mu);
        state.v[0] = -1.0;
        let mut workspace = Workspace::new(&m);
        let [q, v] = [&state.q[..], &state.v];
        workspace.accelerate(&m, 0.0, [q, v, &[]], Gains::default()).expect("solved");
        let normal = 9.81 / (1.6 + 1.2 * mu);
        close("N", workspace.lam()[0].abs(), normal, 1e-9 * normal);
    }
}

#[test]
fn friction_without_velocity_has_the_sign_of_the_speed() {
    for (omega, sign) in [("2", 1.0), ("-2", -1.0), ("0", 0.0)] {
        let m = pendulum("kinetic = 0.3\nradius = 0.05\nload = 20");
        let (state, _) = start(&m, &[("bob.angle", "pi/2"), ("bob.omega", omega)], &[]);
        let mut workspace = Workspace::new(&m);
        let [q, v] = [&state.q[..], &state.v];
        workspace.accelerate(&m, 0.0, [q, v, &[]], Gains::default()).expect("solved");
        close("φ̈", workspace.a()[2], -0.3 * sign / 0.26, 1e-12);
    }
}

#[test]
fn impossible_fields_are_refused() {
    let text = |fields: &str| {
        format!(
            "[bodies.ground]\npoints = {{ O = [0, 0] }}\n[bodies.b]\nmass = 1\ninertia = 1\n\
             points = {{ O = [0, 0] }}\n[joints.pin]\ntype = 'revolute'\ni = 'ground.O'\nj = 'b.O'\n\
             [bodies.c]\nmass = 1\ninertia = 1\npoints = {{ O = [0, 0] }}\n\
             [joints.slide]\ntype = 'translational'\ni = 'ground.O'\nj = 'c.O'\n\
             [joints.stay]\ntype = 'weld'\ni = 'b.O'\nj = 'c.O'\n\
             [forces.rub]\ntype = 'friction'\n{fields}\n"
        )
    };
    for (fields, parts) in [
        ("joint = 'pin'\nkinetic = 0.3", ["radius", "pin"]),
        ("joint = 'slide'\nkinetic = 0.3\nradius = 0.1", ["radius", "revolute"]),
        ("joint = 'pin'\nkinetic = 0.3\nradius = 0.1\nguide = 1", ["guide", "translational"]),
        ("joint = 'stay'\nkinetic = 0.3", ["weld", "revolute, translational, pin_in_slot"]),
        ("joint = 'pim'\nkinetic = 0.3\nradius = 0.1", ["unknown joint 'pim'", "'pin'"]),
        ("joint = 'slide'\nkinetic = 0.3\nstatic = 0.2", ["static", "kinetic"]),
        ("joint = 'slide'\nkinetic = -0.3", ["kinetic", "negative"]),
        ("joint = 'slide'\nkinetic = 0.3\nvelocity = 0", ["velocity", "positive"]),
        ("joint = 'slide'\nkinetic = 0.3\nload = -1", ["load", "negative"]),
    ] {
        let found = faults(&text(fields));
        assert!(parts.iter().all(|part| found.contains(part)), "{fields}: {found}");
    }
}

/// Two pins on one axis, with friction in the first.
const TWICE: &str = r#"
gravity = [0, -9.81]
redundancy = "allow"
[bodies.ground]
points = { O = [0, 0] }
[bodies.rod]
type = "bar"
mass = 1
length = 1
ends = ["O", "P"]
[joints.front]
type = "revolute"
i = "ground.O"
j = "rod.O"
[joints.back]
type = "revolute"
i = "ground.O"
j = "rod.O"
[forces.rub]
type = "friction"
joint = "front"
kinetic = 0.3
radius = 0.05
"#;

#[test]
fn friction_on_a_reaction_that_is_not_unique_is_refused() {
    for fields in ["", "velocity = 0.01"] {
        let m = model(&format!("{TWICE}\n{fields}"));
        let (state, _) = start(&m, &[("rod.angle", "0.3"), ("rod.omega", "1")], &[]);
        let failure = dynamics(&m, &state, &Options::new(0.1), |_| Flow::Continue).unwrap_err();
        let kempe::analyses::dynamics::Reason::Redundant { name, message, hint, .. } =
            failure.reason
        else {
            panic!("{}", failure.reason)
        };
        assert_eq!(name, "front");
        assert!(["rub", "front", "back"].iter().all(|part| message.contains(part)), "{message}");
        assert!(hint.contains("load"));
        // with a load of its own it runs
        let m = model(&format!("{TWICE}\nload = 20\n{fields}"));
        assert!(dynamics(&m, &state, &Options::new(0.1), |_| Flow::Continue).is_ok());
    }
}
