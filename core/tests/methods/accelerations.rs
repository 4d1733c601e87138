//! Accelerations and multipliers at given states: four at once, one by one, near singular positions, and none.

use crate::mechanisms::{four_bar, model, start, worst, PENDULUM};
use kempe::analyses::dynamics::{Accelerations, Prepared, Reason, States};
use kempe::analyses::State;
use kempe::equations::{Gains, Workspace};
use kempe::integrate::Flow;
use kempe::model::Model;

/// Times, q and v of so many states, each turned a little further.
fn turned(state: &State, count: usize) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let of = |k: usize| state.q.iter().map(move |q| q + 1e-3 * k as f64);
    let t = (0..count).map(|k| 0.1 * k as f64).collect();
    (t, (0..count).flat_map(of).collect(), state.v.repeat(count))
}

fn all(m: &Model, (t, q, v): &(Vec<f64>, Vec<f64>, Vec<f64>)) -> Result<Accelerations, Reason> {
    let states = States { t, q, v, z: &[] };
    let found = Prepared::new(m).accelerations(states, false, |_| Flow::Continue);
    found.map_err(|failure| failure.reason)
}

#[test]
fn four_at_once_are_the_same_as_each_by_itself() {
    let (m, state) = four_bar();
    for count in [1, 3, 16, 23] {
        let (t, q, v) = turned(&state, count);
        let found = all(&m, &(t.clone(), q.clone(), v.clone())).unwrap();
        assert_eq!((found.a.len(), found.lam.len()), (9 * count, 8 * count));
        let mut workspace = Workspace::new(&m);
        for k in 0..count {
            let (q, v) = (&q[9 * k..][..9], &v[9 * k..][..9]);
            workspace.accelerate(&m, t[k], [q, v, &[]], Gains::default()).unwrap();
            assert!(worst(&found.a[9 * k..][..9], workspace.a()) < 1e-12);
            assert!(worst(&found.lam[8 * k..][..8], workspace.lam()) < 1e-8); // of 1e5 N
        }
    }
}

#[test]
fn the_first_state_without_any_is_named() {
    let law = "[forces.s]\ntype = \"torsion_spring\"\ni = \"ground\"\nj = \"rod\"\nstiffness = \"sqrt(1.05 - t)\"\n";
    let m = model(&format!("{PENDULUM}{law}"));
    let (state, _) = start(&m, &[("rod.angle", "0.5")], &[]);
    let states = turned(&state, 20);
    let Err(Reason::Integration { t, message, .. }) = all(&m, &states) else { panic!("defined") };
    assert!(t == states.0[11] && message.contains("infinite or undefined"), "{message}");
}

/// A massless bar that hangs from a pendulum.
const HUNG: &str = "[bodies.tail]\ntype = \"bar\"\nmass = 0\nlength = 1\nends = [\"P\", \"Q\"]\n\
                    [joints.P]\ntype = \"revolute\"\ni = \"rod.P\"\nj = \"tail.P\"\n";

#[test]
fn a_massless_body_without_a_determined_motion_is_named() {
    let m = model(&format!("{PENDULUM}{HUNG}"));
    let (state, _) = start(&m, &[("rod.angle", "0.1"), ("tail.angle", "0.3")], &[]);
    for count in [1, 20] {
        let Err(Reason::Singular { name, message, .. }) = all(&m, &turned(&state, count)) else {
            panic!("determined")
        };
        assert!(name == "tail" && message.contains("no inertia resists tail.angle"), "{message}");
    }
    // a rod to ground determines its motion
    let rod = "[joints.d]\ntype = \"distance\"\ni = \"ground.O\"\nj = \"tail.Q\"\nlength = 1.5\n";
    let m = model(&format!("{PENDULUM}{HUNG}{rod}"));
    let (state, _) = start(&m, &[("rod.angle", "0.1")], &[("tail.angle", "2.5")]);
    let found = all(&m, &(vec![0.0], state.q.clone(), state.v.clone())).expect("determined");
    // as if it were rigidly fixed to the pendulum
    let alpha = -1.5 * 9.81 * 0.1_f64.cos();
    assert!(worst(&[found.a[2], found.a[5]], &[alpha, alpha]) < 1e-9, "{:?}", found.a);
}

#[test]
fn twins_have_no_unique_multipliers() {
    let twins =
        format!("{PENDULUM}[joints.pin2]\ntype = \"revolute\"\ni = \"ground.O\"\nj = \"rod.O\"\n");
    let (m, state) = (model(&twins), State { t: 0.0, q: vec![0.0; 3], v: vec![0.0; 3], z: vec![] });
    for count in [1, 20] {
        let Err(Reason::Singular { name, .. }) = all(&m, &turned(&state, count)) else {
            panic!("unique")
        };
        assert!(name.starts_with("pin"), "{name}");
    }
}

#[test]
fn who_watches_may_stop() {
    let (m, state) = four_bar();
    let (t, q, v) = turned(&state, 40);
    let watch = |t: f64| if t > 1.0 { Flow::Stop } else { Flow::Continue };
    let found = Prepared::new(&m)
        .accelerations(States { t: &t, q: &q, v: &v, z: &[] }, false, watch)
        .unwrap();
    assert_eq!(found.a.len(), 9 * 12);
}
