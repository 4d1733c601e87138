//! Pendulums against elliptic integrals.

use crate::mechanisms::{close, every, pinned, run, start, tolerances, with, GRAVITY};
use crate::{number, reference};
use kempe::analyses::dynamics::Run;
use kempe::analyses::State;
use kempe::model::Model;

const ROD: &str = r#"
gravity = [0, -9.81]
[parameters]
L = 1
g = 9.81
[bodies.ground]
points = { O = [0, 0] }
[bodies.rod]
type = "bar"
mass = 2.5
length = "L"
ends = ["O", "P"]
[joints.pin]
type = "revolute"
i = "ground.O"
j = "rod.O"
"#;

/// A body with the motion of a point mass on a massless rod of 1 m (Huygens): with its mass centre
/// at d = 1/2 m from the pin, (J + m d²) / (m d) = 1 m. Its frame is where the point mass would be.
fn bob() -> Model {
    let fields = "mass = 1\ninertia = 0.25\ncenter = [0.5, 0]\npoints = { O = [1, 0] }";
    with(&format!("{GRAVITY}{}", pinned("bob", fields)), &[])
}

fn released(m: &Model, degrees: f64) -> State {
    start(m, &[("rod.angle", &format!("({degrees} - 90)*deg"))], &[]).0
}

/// Time between two passages through the lowest point in the same direction.
fn period(run: &Run) -> f64 {
    let angle = |k: usize| run.trajectory.q[3 * k + 2] + std::f64::consts::FRAC_PI_2;
    let mut downward = Vec::new();
    for k in 1..run.trajectory.t.len() {
        if angle(k - 1) > 0.0 && angle(k) <= 0.0 {
            // three Newton steps on the cubic Hermite polynomial between the two reports
            let (t0, t1) = (run.trajectory.t[k - 1], run.trajectory.t[k]);
            let h = t1 - t0;
            let (a, b) = (angle(k - 1), angle(k));
            let (da, db) = (run.trajectory.v[3 * k - 1] * h, run.trajectory.v[3 * k + 2] * h);
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..60 {
                let s: f64 = 0.5 * (low + high);
                let p = a + s
                    * (da + s * (3.0 * (b - a) - 2.0 * da - db + s * (da + db - 2.0 * (b - a))));
                if p > 0.0 {
                    low = s;
                } else {
                    high = s;
                }
            }
            downward.push(t0 + 0.5 * (low + high) * h);
        }
    }
    assert_eq!(downward.len(), 2, "two passages: {downward:?}");
    downward[1] - downward[0]
}

#[test]
fn periods_of_the_uniform_rod() {
    let truth = reference("pendulum");
    let table = truth["large_amplitude_period_s_of_uniform_rod_L1_by_amplitude_deg"].clone();
    let m = with(ROD, &[]);
    for (degrees, expected) in table.as_object().unwrap() {
        let (degrees, expected): (f64, f64) = (degrees.parse().unwrap(), number(expected));
        let options = every(5e-4, tolerances(1.5 * expected, 1e-10, 1e-13));
        let run = run(&m, &released(&m, degrees), &options);
        // near the top the period is sensitive: dT/T grows like the error over (180° - amplitude)
        close(&format!("{degrees}°"), period(&run), expected, 2e-8 * expected);
    }
}

#[test]
fn the_point_pendulum_of_the_benchmark() {
    let truth = reference("pendulum");
    let m = bob();
    let (mut state, _) = start(&m, &[("bob.angle", "0")], &[]);
    assert_eq!(state.q[0], -1.0);
    for t in ["0.5", "1", "2", "5", "9.99", "10"] {
        let run = run(&m, &state, &tolerances(t.parse().unwrap(), 1e-10, 1e-12));
        let last = 3 * (run.trajectory.t.len() - 1);
        state.t = t.parse().unwrap();
        state.q = run.trajectory.q[last..].to_vec();
        state.v = run.trajectory.v[last..].to_vec();
        let point = &truth["point"][t];
        close("x", state.q[0], number(&point["x"]), 1e-6);
        close("y", state.q[1], number(&point["y"]), 1e-6);
    }
}

#[test]
fn reaction_of_a_rod_released_from_horizontal() {
    let m = with(ROD, &[]);
    let weight = 2.5 * 9.81;
    let run = run(&m, &released(&m, 90.0), &every(0.01, tolerances(0.45, 1e-10, 1e-13)));
    let lam = run.accelerations(&m).unwrap().lam;
    for k in 0..run.trajectory.t.len() {
        let angle = run.trajectory.q[3 * k + 2]; // from 0 down to -π/2
        let below = -angle;
        // λ is the force on ground; on the rod it is opposite
        let (fx, fy) = (-lam[2 * k], -lam[2 * k + 1]);
        // towards the pivot the rod's axis points along (-cos, -sin) of its angle
        let along = -(fx * angle.cos() + fy * angle.sin());
        let across = -fx * angle.sin() + fy * angle.cos();
        close("along", along / weight, 2.5 * below.sin(), 1e-8);
        close("across", across / weight, 0.25 * below.cos(), 1e-8);
    }
    assert!(run.trajectory.q.last().unwrap() < &-1.3);
}

/// The benchmark's own model: a mass that a massless rod keeps at a distance.
const ON_A_ROD: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.bob]
mass = 1
inertia = 1
points = { P = [0, 0] }
[joints.rod]
type = "distance"
i = "ground.O"
j = "bob.P"
length = 1
"#;

#[test]
fn the_point_pendulum_on_a_rod_of_given_length() {
    let truth = reference("pendulum");
    let m = with(ON_A_ROD, &[]);
    for t in ["1", "10", "20"] {
        let (state, _) = start(&m, &[("bob.y", "0"), ("bob.angle", "0.3")], &[("bob.x", "-1")]);
        assert_eq!(state.q[..2], [-1.0, 0.0]);
        let run = run(&m, &state, &tolerances(t.parse().unwrap(), 1e-12, 1e-14));
        let last = run.trajectory.t.len() - 1;
        let q = &run.trajectory.q[3 * last..];
        let point = &truth["point"][t];
        close("x", q[0], number(&point["x"]), 1e-8);
        close("y", q[1], number(&point["y"]), 1e-8);
        assert_eq!(q[2], 0.3);
        // the rod pulls with m (v² - gᵀ r) at r = 1: (3/2) of twice the height that was lost
        let pull = run.accelerations(&m).unwrap().lam[last];
        close("tension", pull, 3.0 * 9.81 * -q[1], 1e-6);
    }
}
