//! Runs with events: listed, stopping, releasing drivers, and acting.

use crate::mechanisms::{column, four_bar, model, run, start, worst, FOUR_BAR};
use kempe::analyses::dynamics::{Change, Options, Prepared, Reason};
use kempe::analyses::{EventOption, State};
use kempe::integrate::{Direction, Flow};
use kempe::model::Model;

/// Times at which the rocker of the flagship passes 270° after release from rest, s, from an independent program.
const THROUGH: [f64; 4] =
    [0.077841704204374, 0.235129538323398, 0.380960319608237, 0.532666729571221];

fn driven(release: &str) -> Model {
    let driver = format!(
        "[drivers.motor]\ntype = 'coordinate_driver'\ncoordinate = 'crank.angle'\nvalue = '70*deg + t'\n{release}\n"
    );
    model(&FOUR_BAR.replacen("[start]", &format!("{driver}\n[start]"), 1))
}

/// At its start.
fn begun(model: &Model) -> State {
    start(model, &[], &[("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")]).0
}

#[test]
fn events_are_listed_and_in_order() {
    let (m, start) = four_bar();
    let hit = EventOption::new("hit", "rocker.angle - 270*deg");
    let up = EventOption { direction: Direction::Rising, ..EventOption::new("up", &hit.condition) };
    let force = EventOption::new("force", "C.force > 2000");
    let options = Options { events: vec![hit, up, force], ..Options::new(0.6) };
    let found = run(&m, &start, &options);
    assert!(found.reached && found.phases.len() == 1);
    assert!(worst(&found.events[0].states.t, &THROUGH) < 1e-10, "{:?}", found.events[0].states.t);
    let all = &found.events[0].states.t;
    let rising = &found.events[1].states.t;
    assert!(rising[..] == [all[0], all[2]] || rising[..] == [all[1], all[3]], "{rising:?}");
    assert!(!found.events[2].states.t.is_empty());
}

#[test]
fn a_run_stops_at_an_event() {
    let (m, start) = four_bar();
    let options = Options { stop: Some("rocker.angle > 270*deg".to_string()), ..Options::new(0.6) };
    let found = run(&m, &start, &options);
    assert_eq!((found.reached, found.stopped_by.as_deref()), (false, Some("stop")));
    let (n, rocker) = (m.layout.n_q, column(&m, "rocker", 2));
    let last = found.trajectory.q.rchunks(n).next().expect("a row");
    assert!((last[rocker] - 270_f64.to_radians()).abs() < 1e-13);
    assert_eq!(found.trajectory.t.last(), found.events[0].states.t.last());
    assert!((found.trajectory.t.last().unwrap() - THROUGH[0]).abs() < 1e-10);
}

#[test]
fn a_driver_is_released_by_its_condition_and_by_an_option() {
    let m = driven("release = 'crank.angle > 100*deg'");
    let start = begun(&m);
    let found = run(&m, &start, &Options::new(1.0));
    let t = 30_f64.to_radians();
    assert!((found.events[0].states.t[0] - t).abs() < 1e-12);
    assert_eq!(found.events[0].name, "motor.release");
    assert_eq!(found.settings[1].released, ["motor"]);
    let (before, after) = (found.states_of(0), found.states_of(1));
    let n = m.layout.n_q;
    let last = |rows: &[f64]| rows[rows.len() - n..].to_vec();
    assert!(worst(&last(before.q), &after.q[..n]) < 1e-12);
    assert!(worst(&last(before.v), &after.v[..n]) < 1e-12);
    let released = Options { release: vec!["motor".to_string()], ..Options::new(0.2) };
    let free = run(&m, &start, &released);
    let crank = column(&m, "crank", 2);
    let end = free.trajectory.q.rchunks(n).next().expect("a row")[crank];
    assert!((end - 70_f64.to_radians() - 0.2).abs() > 1e-3, "the crank is free");
}

#[test]
fn an_action_changes_parameters_and_states() {
    let (m, start) = four_bar();
    let acts = EventOption { acts: true, ..EventOption::new("hit", "rocker.angle > 270*deg") };
    let options = Options { events: vec![acts], ..Options::new(0.2) };
    let prepared = Prepared::new(&m);
    let mut seen = Vec::new();
    let mut act = |name: &str, state: &State, _: &_| {
        seen.push((name.to_string(), state.t));
        let back = State { v: state.v.iter().map(|v| -v).collect(), ..state.clone() };
        Some(Change { parameters: vec![("k".to_string(), 2e6)], state: Some(back) })
    };
    let found = prepared
        .dynamics_with(&start, &options, |_| Flow::Continue, &mut act)
        .unwrap_or_else(|failure| panic!("{}", failure.reason));
    assert_eq!(found.settings[1].parameters, [("k".to_string(), 2e6)]);
    let n = m.layout.n_q;
    let (before, after) = (found.states_of(0), found.states_of(1));
    let reversed: Vec<f64> = before.v[before.v.len() - n..].iter().map(|v| -v).collect();
    assert!(worst(&reversed, &after.v[..n]) < 1e-12);
    assert_eq!(before.t.last(), after.t.first());
    assert_eq!(seen[0], ("hit".to_string(), after.t[0]));

    let mut open = |_: &str, state: &State, _: &_| {
        let mut v = state.v.clone();
        v[0] += 1.0;
        Some(Change { state: Some(State { v, ..state.clone() }), ..Change::default() })
    };
    let failure = prepared
        .dynamics_with(&start, &options, |_| Flow::Continue, &mut open)
        .expect_err("the joint opens");
    assert!(matches!(failure.reason, Reason::Start { .. }), "{}", failure.reason);
    assert!(!failure.run.trajectory.t.is_empty());
}

/// A block that a damper brakes: v = v₀ exp(-c t/m), and the damper takes ½ m v₀² - ½ m v².
const BRAKED: &str = r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.block]
mass = 2
inertia = 1
points = { P = [0, 0] }
[joints.guide]
type = "translational"
i = "ground.O"
j = "block.P"
[forces.brake]
type = "spring_damper"
i = "ground.O"
j = "block.P"
stiffness = 0
damping = 3
[forces.other]
type = "torsion_spring"
i = "ground"
j = "block"
damping = 0.4
stiffness = 0
"#;

#[test]
fn an_event_where_an_element_has_dissipated_an_energy() {
    let m = model(BRAKED);
    let (start, _) = start(&m, &[("block.x", "1"), ("block.vx", "4")], &[]);
    let lost = |t: f64| 16.0 * (1.0 - (-3.0 * t).exp());
    let (first, second) = (lost(0.1), lost(0.55));
    let condition =
        |name: &str, level: f64| EventOption::new(name, format!("brake.dissipated > {level:.17}"));
    // the action ends a phase: the sum goes on in the next one
    let acts = EventOption { acts: true, ..condition("first", first) };
    let events = vec![acts, condition("second", second), condition("never", 16.1)];
    let options = Options { events, ..Options::new(1.0) };
    let prepared = Prepared::new(&m);
    let mut act = |_: &str, _: &State, _: &_| Some(Change::default());
    let found = prepared
        .dynamics_with(&start, &options, |_| Flow::Continue, &mut act)
        .unwrap_or_else(|failure| panic!("{}", failure.reason));
    assert_eq!(found.phases.len(), 2);
    for (event, t) in found.events.iter().zip([0.1, 0.55]) {
        assert_eq!(event.states.t.len(), 1, "{}", event.name);
        assert!((event.states.t[0] - t).abs() < 1e-9, "{}: {}", event.name, event.states.t[0]);
    }
    assert!(found.events[2].states.t.is_empty());
}

/// The pin of a wheel carries the radial force of its teeth, F/cos α in all; a condition sees it too.
#[test]
fn a_condition_on_a_pin_of_teeth_with_a_pressure_angle() {
    let m = model(
        r#"
[bodies.ground]
points = { A = [0, 0], B = [0.35, 0] }
[bodies.one]
mass = 3
inertia = 0.02
points = { A = [0, 0] }
[bodies.two]
mass = 5
inertia = 0.16
points = { B = [0, 0] }
[joints.A]
type = "revolute"
i = "ground.A"
j = "one.A"
[joints.B]
type = "revolute"
i = "ground.B"
j = "two.B"
[joints.teeth]
type = "gear"
i = "one.A"
j = "two.B"
radii = [0.1, 0.25]
pressure_angle = 0.35
[forces.motor]
type = "torque"
j = "one"
torque = "-4*t"
"#,
    );
    let (start, _) = start(&m, &[], &[]);
    // T - J₁ α = F r₁ with α = T/(J₁ + J₂ (r₁/r₂)²)
    let per_torque = (1.0 - 0.02 / (0.02 + 0.16 * 0.16)) / 0.1 / 0.35_f64.cos();
    let options =
        Options { events: vec![EventOption::new("load", "B.force > 8")], ..Options::new(1.0) };
    let found = run(&m, &start, &options);
    assert_eq!(found.events[0].states.t.len(), 1);
    let t = 8.0 / (4.0 * per_torque);
    assert!((found.events[0].states.t[0] - t).abs() < 1e-9, "{} {t}", found.events[0].states.t[0]);
}
