//! Reported states solved several at a time are those solved one at a time.

use crate::mechanisms::{four_bar, model, start, SLIDER_CRANK};
use kempe::analyses::dynamics::{
    dynamics, Accelerations, Options, Run, Scheme, Stabilization, Trajectory,
};
use kempe::analyses::State;
use kempe::integrate::{Flow, Rk4};
use kempe::model::Model;

fn run(m: &Model, s: &State, options: &Options, h: f64) -> Run {
    let options = Options { output_step: Some(h), ..options.clone() };
    dynamics(m, s, &options, |_| Flow::Continue).unwrap()
}

/// Largest relative difference of all numbers at the times of `few`, each `ratio`-th of `many`.
fn difference(m: &Model, many: &Run, few: &Run, ratio: usize) -> f64 {
    let rows = few.trajectory.t.len();
    let tables = |run: &Run| {
        let Accelerations { a, lam, .. } = run.accelerations(m).unwrap();
        let Trajectory { q, v, works, .. } = run.trajectory.clone();
        [q, v, works, a, lam]
    };
    let mut worst: f64 = 0.0;
    for (many, few) in tables(many).iter().zip(&tables(few)) {
        let width = few.len() / rows;
        let largest = few.iter().fold(1e-9, |most: f64, x| most.max(x.abs()));
        for row in 0..rows {
            let of = |table: &Vec<f64>, row: usize| table[row * width..(row + 1) * width].to_vec();
            for (a, b) in of(many, row * ratio).iter().zip(of(few, row)) {
                assert!(a.is_finite());
                worst = worst.max((a - b).abs() / largest);
            }
        }
    }
    worst
}

/// Of 10 states each is solved by itself; of 90 most in fours, and the last ones with lanes left over.
fn agree(m: &Model, s: &State, options: &Options) {
    let many = run(m, s, options, options.t_end.abs() / 90.0);
    let few = run(m, s, options, options.t_end.abs() / 10.0);
    assert_eq!((many.trajectory.t.len(), few.trajectory.t.len()), (91, 11));
    let worst = difference(m, &many, &few, 9);
    assert!(worst < 1e-9, "{worst:.1e}");
}

/// A driven angle and a damper that depends on time; the frame of the crank is put off its mass centre.
const FORCES: &str = r#"
[drivers.motor]
type = "coordinate_driver"
coordinate = "crank.angle"
value = "0.3 + 8*t + 0.2*sin(30*t)"
[forces.gas]
type = "spring_damper"
i = "ground.S"
j = "piston.B"
stiffness = 50
damping = "3 + sin(40*t)"
free_length = 0.2
"#;

/// Two windows of the N-four-bar, which passes a position where all bars lie on one line.
const WINDOWS: &str = r#"
gravity = [0, -9.81]
[bodies.ground]
points = { A0 = [0, 0], A1 = [1, 0], A2 = [2, 0] }
[bodies.crank0]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.crank1]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.crank2]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.coupler1]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.coupler2]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[joints]
A0 = { type = "revolute", i = "ground.A0", j = "crank0.A" }
A1 = { type = "revolute", i = "ground.A1", j = "crank1.A" }
A2 = { type = "revolute", i = "ground.A2", j = "crank2.A" }
B0 = { type = "revolute", i = "crank0.B", j = "coupler1.A" }
B1 = { type = "revolute", i = "coupler1.B", j = "crank1.B" }
C1 = { type = "revolute", i = "crank1.B", j = "coupler2.A" }
B2 = { type = "revolute", i = "coupler2.B", j = "crank2.B" }
"#;

fn driven() -> (Model, State) {
    let bar = "type = \"bar\"\nmass = 1\nlength = 0.1\nends = [\"O\", \"A\"]";
    let plate =
        "mass = 1\ninertia = 1e-3\ncenter = [0.03, 0.01]\npoints = { O = [0, 0], A = [0.1, 0] }";
    let m = model(&format!("{}{FORCES}", SLIDER_CRANK.replace(bar, plate)));
    let guess = [("crank.angle", "0.3"), ("rod.angle", "-0.1"), ("piston.x", "0.4")];
    let (state, _) = start(&m, &[], &guess);
    (m, state)
}

#[test]
fn the_flagship_by_any_way() {
    let (m, s) = four_bar();
    agree(&m, &s, &Options::new(0.2));
    agree(&m, &s, &Options::classical(0.2));
    agree(&m, &s, &Options { stabilization: Stabilization::None, ..Options::new(0.2) });
    agree(&m, &s, &Options { method: Scheme::Rk4(Rk4::new(2e-3)), ..Options::new(0.2) });
}

#[test]
fn laws_of_time_see_the_time_of_their_lane() {
    let (m, s) = driven();
    agree(&m, &s, &Options::new(1.0));
}

#[test]
fn a_state_near_a_singular_position_is_solved_by_itself() {
    let m = model(WINDOWS);
    let quarter = "90*deg";
    let cranks = ["crank0", "crank1", "crank2"].map(|crank| format!("{crank}.angle"));
    let mut guess: Vec<(&str, &str)> = cranks.iter().map(|crank| (&**crank, quarter)).collect();
    guess.extend([("coupler1.angle", "0"), ("coupler2.angle", "0")]);
    let (state, _) = start(&m, &[("crank0.omega", "-1")], &guess[1..]);
    agree(&m, &state, &Options::new(1.5));
}

#[test]
fn backward_in_time() {
    let (m, s) = four_bar();
    agree(&m, &s, &Options { t_end: -0.3, ..Options::new(0.3) });
}

#[test]
fn stopped_where_the_caller_stops() {
    let (m, s) = four_bar();
    let options = Options { output_step: Some(1e-3), ..Options::new(1.0) };
    let watch = |t: f64| if t >= 0.0305 { Flow::Stop } else { Flow::Continue };
    let stopped = dynamics(&m, &s, &options, watch).unwrap();
    // all that was seen before is there, though it is not a whole number of fours
    let last = *stopped.trajectory.t.last().unwrap();
    assert!(!stopped.reached && last >= 0.0305, "{last}");
    let whole = dynamics(&m, &s, &options, |_| Flow::Continue).unwrap();
    let n = stopped.trajectory.q.len();
    assert_eq!(n, 9 * stopped.trajectory.t.len());
    let pairs = stopped.trajectory.q.iter().zip(&whole.trajectory.q[..n]);
    assert!(pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) < 1e-10);
}
