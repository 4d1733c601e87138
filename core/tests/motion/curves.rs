//! Joints on curves against closed forms: cams with flat, roller and pointed followers, and a bead on a parabola.

use crate::mechanisms::{column, every, model, refused, run, start, tolerances, with, worst};
use kempe::elements::Curve;
use kempe::equations::kinematics::Motions;
use kempe::equations::reactions::{self, Frame};
use kempe::math::Local;
use kempe::model::Model;

const G: f64 = 9.81;
const SPEED: f64 = 7.0;

/// A cam that turns about the origin, with a follower of 0.8 kg on the y axis.
fn cam(curve: &str, joint: &str) -> Model {
    model(&format!(
        r#"
gravity = [0, -9.81]
[bodies.ground]
points = {{ O = [0, 0] }}
[bodies.cam]
mass = 2
inertia = 0.01
points = {{ O = [0, 0] }}
curves = {{ rim = {curve} }}
[bodies.follower]
mass = 0.8
inertia = 0.02
points = {{ P = [0, 0], S = [0, 0.2] }}
[joints.shaft]
type = "revolute"
i = "ground.O"
j = "cam.O"
[joints.guide]
type = "translational"
i = "ground.O"
j = "follower.S"
axes = ["90*deg", "90*deg"]
[joints.contact]
i = "follower.P"
curve = "cam.rim"
{joint}
[drivers.motor]
type = "coordinate_driver"
coordinate = "cam.angle"
value = "0.4 + {SPEED}*t"
"#
    ))
}

/// y, ẏ, ÿ of the follower, the normal force, and the effort of the motor.
type Closed = dyn Fn(f64) -> [f64; 5];

/// Compares a run of one turn with the closed form.
fn check(m: &Model, closed: &Closed, tolerance: f64) {
    let (state, report) = start(m, &[], &[("follower.y", "0.15")]);
    assert_eq!(report.degrees_of_freedom, 0);
    let done = run(m, &state, &every(0.013, kempe_options()));
    let found = done.accelerations(m).unwrap();
    let (n, rows) = (m.layout.n_q, m.layout.n_rows);
    let (y, u) = (column(m, "follower", 1), m.layout.constraints[2].own.first);
    let (contact, motor) =
        (m.layout.constraints[2].rows.clone(), m.layout.constraints[3].rows.start);
    for (k, t) in done.trajectory.t.iter().enumerate() {
        let [q, v, a] =
            [&done.trajectory.q, &done.trajectory.v, &found.a].map(|x| &x[k * n..][..n]);
        let lam = &found.lam[k * rows..][..rows];
        let truth = closed(0.4 + SPEED * t);
        let motions = Motions::at(&m.layout, q, v);
        let body = m.body("cam").unwrap();
        let of = |frame| {
            reactions::reaction(m, 2, body, frame, &motions, *t, &lam[contact.clone()]).unwrap()
        };
        let force = of(Frame::Global);
        assert!(force.torque.abs() < 1e-11, "the reaction acts at the contact: {}", force.torque);
        let mut normal = [force.force.norm()];
        if !m.constraints[2].element.result_quantities().is_empty() {
            reactions::results(m, 2, &motions, *t, &lam[contact.clone()], &mut normal);
        }
        let all = [q[y], v[y], a[y], normal[0], -lam[motor]];
        for (name, (found, truth)) in
            ["y", "vy", "ay", "normal", "effort"].iter().zip(all.into_iter().zip(truth))
        {
            let error = (found - truth).abs() / (1.0 + truth.abs());
            assert!(error < tolerance, "{name} at {t}: {found} {truth} {error:.1e}");
        }
        assert!(q[u].is_finite());
    }
}

fn kempe_options() -> kempe::analyses::dynamics::Options {
    kempe::analyses::dynamics::Options {
        dense_output: false,
        ..kempe::analyses::dynamics::Options::new(std::f64::consts::TAU / SPEED)
    }
}

const R: f64 = 0.05;
const E: f64 = 0.02;

/// Flat follower of an eccentric circle: y = R + e sin φ; the contact is at x = e cos φ.
#[test]
fn an_eccentric_cam_with_a_flat_follower() {
    let closed = |phi: f64| {
        let y = R + E * phi.sin();
        let (vy, ay) = (E * SPEED * phi.cos(), -E * SPEED * SPEED * phi.sin());
        let normal = 0.8 * (ay + G);
        [y, vy, ay, normal, normal * E * phi.cos()]
    };
    check(&cam("{ circle = [0.02, 0, 0.05] }", "type = \"flat_on_curve\""), &closed, 1e-11);
    // the normal of the face may point into the cam or out of it
    let turned = "type = \"flat_on_curve\"\naxis = \"180*deg\"";
    check(&cam("{ circle = [0.02, 0, 0.05] }", turned), &closed, 1e-11);
    // the same circle as a formula, clockwise, and as a polar curve about the shaft
    let clockwise = "{ x = \"0.02 + 0.05*cos(u)\", y = \"-0.05*sin(u)\", range = [0, \"2*pi\"], periodic = true }";
    check(&cam(clockwise, "type = \"flat_on_curve\""), &closed, 1e-11);
    let polar = "{ polar = \"0.02*cos(u) + (0.05^2 - (0.02*sin(u))^2)^0.5\" }";
    check(&cam(polar, "type = \"flat_on_curve\""), &closed, 1e-11);
}

/// Roller follower in line with the shaft: y = e sin φ + √((R + r)² - e² cos² φ).
#[test]
fn an_eccentric_cam_with_a_roller_follower() {
    let closed = |phi: f64| {
        let l = R + 0.01;
        let (sin, cos) = phi.sin_cos();
        let root = (l * l - (E * cos).powi(2)).sqrt();
        let y = E * sin + root;
        let slope = E * E * sin * cos / root;
        let vy = SPEED * (E * cos + slope);
        let second = E * E * (cos * cos - sin * sin) / root - slope * slope / root;
        let ay = SPEED * SPEED * (-E * sin + second);
        // the normal from the centre of the circle to the centre of the roller
        let (nx, ny) = (-E * cos / l, root / l);
        let normal = 0.8 * (ay + G) / ny;
        [y, vy, ay, normal, normal * (E * cos * ny - E * sin * nx)]
    };
    let joint = "type = \"roller_on_curve\"\nradius = 0.01";
    check(&cam("{ circle = [0.02, 0, 0.05] }", joint), &closed, 1e-11);
    let clockwise = "{ x = \"0.02 + 0.05*cos(u)\", y = \"-0.05*sin(u)\", range = [0, \"2*pi\"], periodic = true }";
    check(&cam(clockwise, &format!("{joint}\nside = \"left\"")), &closed, 1e-11);
}

/// Lift of a cam with cycloidal rise, dwell, cycloidal return and dwell over the angle u, with its derivatives.
fn lift(u: f64) -> [f64; 3] {
    let (h, beta, tau) = (0.015, 1.5, std::f64::consts::TAU);
    let u = u.rem_euclid(tau);
    let rise = |s: f64, sign: f64| {
        let (sin, cos) = (tau * s).sin_cos();
        [h * (s - sin / tau), sign * h / beta * (1.0 - cos), h * tau / (beta * beta) * sin]
    };
    match u {
        u if u < beta => rise(u / beta, 1.0),
        u if u < 2.5 => [h, 0.0, 0.0],
        u if u < 2.5 + beta => rise(1.0 - (u - 2.5) / beta, -1.0),
        _ => [0.0; 3],
    }
}

/// The same as formulas of u in [0, 2π]: s and ds/du.
fn lift_text() -> [String; 2] {
    let rise = |s: &str| format!("0.015*({s} - sin(2*pi*{s})/(2*pi))");
    let slope = |s: &str| format!("0.01*(1 - cos(2*pi*{s}))");
    let (up, down) = ("(u/1.5)", "(1 - (u - 2.5)/1.5)");
    let parts = |a: String, top: &str, b: String| {
        format!("if(u < 1.5, {a}, if(u < 2.5, {top}, if(u < 4, {b}, 0)))")
    };
    [parts(rise(up), "0.015", rise(down)), parts(slope(up), "0", format!("-{}", slope(down)))]
}

/// y = r₀ + s, and the pitch curve has the normal (ρ, -s′)/w, w² = ρ² + s′². u falls as the cam turns: u = π/2 - φ.
fn dwell(phi: f64) -> [f64; 5] {
    let [s, ds, dds] = lift(std::f64::consts::FRAC_PI_2 - phi);
    let rho = 0.06 + s;
    let ay = SPEED * SPEED * dds;
    let along = 0.8 * (ay + G);
    let normal = along * (rho * rho + ds * ds).sqrt() / rho;
    // power: effort φ̇ = force ẏ
    [rho, -SPEED * ds, ay, normal, -along * ds]
}

#[test]
fn a_cycloidal_dwell_cam_with_a_point_and_with_a_roller() {
    let [s, ds] = lift_text();
    let pitch = format!("{{ polar = \"0.06 + {s}\" }}");
    check(&cam(&pitch, "type = \"point_on_curve\""), &dwell, 1e-10);
    // the rim of the cam is the curve at the distance of the radius inside of the pitch curve
    let (rho, w) = (format!("(0.06 + {s})"), format!("hypot(0.06 + {s}, {ds})"));
    let (along, across) = (format!("({rho}*(1 - 0.01/{w}))"), format!("(0.01*({ds})/{w})"));
    let rim = format!(
        "{{ x = \"{along}*cos(u) - {across}*sin(u)\", y = \"{along}*sin(u) + {across}*cos(u)\", \
         range = [0, \"2*pi\"], periodic = true }}"
    );
    check(&cam(&rim, "type = \"roller_on_curve\"\nradius = 0.01"), &dwell, 1e-10);
}

/// Points on the pitch curve: the error is that of the spline, not of the joint.
#[test]
fn a_dwell_cam_through_points() {
    let points: Vec<String> = (0..720)
        .map(|k| {
            let u = f64::from(k).to_radians() / 2.0;
            let rho = 0.06 + lift(u)[0];
            format!("[{:?}, {:?}]", rho * u.cos(), rho * u.sin())
        })
        .collect();
    let curve = format!("{{ points = [{}], periodic = true }}", points.join(", "));
    let m = cam(&curve, "type = \"point_on_curve\"");
    let (state, _) = start(&m, &[], &[("follower.y", "0.15")]);
    let done = run(&m, &state, &every(0.013, kempe_options()));
    let y = column(&m, "follower", 1);
    for (q, t) in done.trajectory.q.chunks(m.layout.n_q).zip(&done.trajectory.t) {
        let truth = dwell(0.4 + SPEED * t)[0];
        assert!((q[y] - truth).abs() < 1e-8, "{} {truth}", q[y]);
    }
}

/// (1 + 4b²x²) ẍ + 4b²x ẋ² + 2bgx = 0, the energy, and the normal force m (g + 2b ẋ²)/√(1 + 4b²x²).
#[test]
fn a_bead_on_a_parabola() {
    let m = model(
        r#"
gravity = [0, -9.81]
[bodies.ground]
curves = { wire = { x = "u", y = "1.5*u^2", range = [-2, 2] } }
[bodies.bead]
type = "point_mass"
mass = 0.7
[joints.wire]
type = "point_on_curve"
i = "bead.P"
curve = "ground.wire"
"#,
    );
    let (b, x0) = (1.5, 0.9);
    let (state, report) = start(&m, &[("bead.x", "0.9")], &[]);
    assert_eq!((m.layout.n_q, m.layout.n_rows, report.degrees_of_freedom), (3, 2, 1));
    assert!(worst(&state.q, &[x0, b * x0 * x0, x0]) < 1e-12, "{:?}", state.q);
    let done = run(&m, &state, &every(0.02, tolerances_of(2.0)));
    let found = done.accelerations(&m).unwrap();
    let mut crossed = false;
    for k in 0..done.trajectory.t.len() {
        let [q, v, a] =
            [&done.trajectory.q, &done.trajectory.v, &found.a].map(|x| &x[3 * k..][..3]);
        let lam = &found.lam[2 * k..][..2];
        let (x, rate) = (q[0], v[0]);
        let stretch = 1.0 + (2.0 * b * x).powi(2);
        let energy = 0.5 * stretch * rate * rate + G * b * x * x;
        assert!((energy / (G * b * x0 * x0) - 1.0).abs() < 1e-10, "{energy}");
        let acceleration = -(4.0 * b * b * x * rate * rate + 2.0 * b * G * x) / stretch;
        assert!((a[0] - acceleration).abs() < 1e-10 * (1.0 + acceleration.abs()), "{}", a[0]);
        let normal = 0.7 * (G + 2.0 * b * rate * rate) / stretch.sqrt();
        // the force on the bead is -λ, upwards
        assert!((lam[0].hypot(lam[1]) - normal).abs() < 1e-10 * normal, "{lam:?} {normal}");
        assert!(lam[1] < 0.0);
        crossed |= x < 0.0;
    }
    assert!(crossed);
}

fn tolerances_of(t_end: f64) -> kempe::analyses::dynamics::Options {
    let projected = kempe::analyses::dynamics::Options::new(t_end);
    kempe::analyses::dynamics::Options {
        method: tolerances(t_end, 1e-12, 1e-14).method,
        dense_output: false,
        ..projected
    }
}

/// An oscillating follower finds the cam without a guess, and the guess of u chooses the contact.
#[test]
fn cams_go_together_without_a_guess() {
    let text = |joint: &str| {
        format!(
            r#"
[bodies.ground]
points = {{ O = [0, 0], Q = [0.1, 0] }}
[bodies.cam]
mass = 2
inertia = 0.01
points = {{ O = [0, 0] }}
curves = {{ rim = {{ circle = [0.02, 0, 0.05] }} }}
[bodies.arm]
mass = 0.8
inertia = 0.02
points = {{ Q = [0, 0], P = [0.1, 0] }}
[joints.shaft]
type = "revolute"
i = "ground.O"
j = "cam.O"
[joints.pivot]
type = "revolute"
i = "ground.Q"
j = "arm.Q"
[joints.contact]
i = "arm.P"
curve = "cam.rim"
{joint}
"#
        )
    };
    for joint in ["type = \"roller_on_curve\"\nradius = 0.01", "type = \"point_on_curve\""] {
        let reach = if joint.contains("roller") { 0.06 } else { 0.05 };
        let m = model(&text(joint));
        for degrees in [0, 40, 90, 170, 260, 330] {
            let angle = f64::from(degrees).to_radians();
            let (state, _) = start(&m, &[("cam.angle", &format!("{degrees}*deg"))], &[]);
            let arm = state.q[column(&m, "arm", 2)];
            let apart = (0.1 + 0.1 * arm.cos() - 0.02 * angle.cos())
                .hypot(0.1 * arm.sin() - 0.02 * angle.sin());
            assert!((apart - reach).abs() < 1e-12, "{apart} {reach}");
        }
    }
    let flat = model(&text("type = \"flat_on_curve\""));
    let (state, _) = start(&flat, &[("cam.angle", "0.3")], &[]);
    let arm = state.q[column(&flat, "arm", 2)];
    let centre = [0.02 * 0.3_f64.cos(), 0.02 * 0.3_f64.sin()];
    let distance = (centre[0] - 0.1) * -arm.sin() + centre[1] * arm.cos();
    assert!((distance.abs() - 0.05).abs() < 1e-12, "{distance}");
}

#[test]
fn the_guess_of_u_chooses_the_contact() {
    let m = cam("{ circle = [0.02, 0, 0.05] }", "type = \"point_on_curve\"");
    let u = m.layout.constraints[2].own.first;
    let (above, _) = start(&m, &[], &[("follower.y", "0.15")]);
    let (below, _) = start(&m, &[], &[("follower.y", "0.001"), ("contact.u", "250*deg")]);
    let y = column(&m, "follower", 1);
    assert!(above.q[y] > 0.03 && below.q[y] < -0.03, "{} {}", above.q[y], below.q[y]);
    assert!((below.q[u] - 250_f64.to_radians()).abs() < 1.0, "{}", below.q[u]);
}

/// The contact of a run that leaves its curve, and of an assembly.
#[test]
fn the_end_of_an_open_curve_is_an_error() {
    let slide = |range: &str| {
        model(&format!(
            "gravity = [0, -9.81]\n[bodies.ground]\ncurves = {{ slope = {{ x = 'u', y = '-u', range = {range} }} }}\n\
             [bodies.bead]\ntype = 'point_mass'\nmass = 1\n[joints.wire]\ntype = 'point_on_curve'\ni = 'bead.P'\n\
             curve = 'ground.slope'\n"
        ))
    };
    let m = slide("[0, 1]");
    let (state, _) = start(&m, &[("bead.x", "0.1")], &[]);
    let failed = kempe::analyses::dynamics::dynamics(
        &m,
        &state,
        &kempe::analyses::dynamics::Options::new(5.0),
        |_| kempe::integrate::Flow::Continue,
    )
    .unwrap_err();
    let message = failed.reason.to_string();
    assert!(
        message.contains("wire leaves its curve") && message.contains("0.000000 to 1.000000"),
        "{message}"
    );
    let message = refused(&m, &[("bead.x", "1.5")]).to_string();
    assert!(message.contains("wire") && message.contains("u = 1.5"), "{message}");
}

/// A step that began in a dwell is as long as the error allows, also where projection would correct any error: the
/// contact must not end turns away.
#[test]
fn no_step_loses_the_contact_after_a_dwell() {
    for speed in [60.0, 100.0, 120.0, 150.0] {
        let text = include_str!("../../../examples/cam_roller.toml");
        let m = with(text, &[("speed", speed)]);
        let (state, _) = start(&m, &[], &[("follower.y", "0.05")]);
        let u = m.layout.constraints[2].own.first;
        let t_end = 3.0 * std::f64::consts::TAU / speed;
        let options = kempe::analyses::dynamics::Options { t_end, ..kempe_options() };
        let done = run(&m, &state, &every(t_end / 300.0, options));
        for (q, t) in done.trajectory.q.chunks(m.layout.n_q).zip(&done.trajectory.t) {
            let turned = q[u] - state.q[u] - speed * t;
            assert!(turned.abs() < 0.5, "{speed} rad/s, t = {t}: {turned}");
        }
    }
}

/// The distance of the farthest point from the origin, by which assembly chooses where it looks for a contact.
#[test]
fn the_reach_of_a_curve() {
    let line = Curve::Line { from: Local::new(-0.6, 0.8), to: Local::new(0.9, 1.2) };
    assert_eq!(line.reach(), 1.5);
    let back = Curve::Line { from: Local::new(0.9, 1.2), to: Local::new(-0.6, 0.8) };
    assert_eq!(back.reach(), 1.5);
}
