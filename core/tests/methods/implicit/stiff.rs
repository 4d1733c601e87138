//! Stiff mechanisms, where explicit methods need a million steps, and the automatic choice.

use crate::mechanisms::{asked, every, model, pinned, run, start, with, worst, FOUR_BAR};
use kempe::analyses::assemble::{assemble, Request};
use kempe::analyses::dynamics::{Auto, Options, Scheme, Stabilization};
use kempe::analyses::State;
use kempe::integrate::{AlphaParameters, Dop853, GeneralizedAlpha, Radau, Rk45, StepControl};
use kempe::model::Model;
use kempe::stabilize::Projection;

fn options(t_end: f64, scheme: Scheme) -> Options {
    Options {
        method: scheme,
        stabilization: Stabilization::Projection(Projection::default()),
        ..Options::classical(t_end)
    }
}

/// The flagship with another damper.
fn damped(c: f64) -> (Model, State) {
    let m = with(FOUR_BAR, &[("c", c)]);
    let guess = [("coupler.angle", "14*deg"), ("rocker.angle", "240*deg")];
    let request = Request {
        set: asked(&m, "set", &[("crank.angle", "70*deg")]),
        guess: asked(&m, "guess", &guess),
        ..Request::default()
    };
    let (state, _) = assemble(&m, &request).unwrap_or_else(|f| panic!("{f}"));
    (m, state)
}

/// c = 1e9 N m s/rad: the damping rate is about 5e5 1/s, so that an explicit method whose stability
/// ends near 3/h takes more than a million steps over 15 s. The motion is that of a massless linkage
/// pulled by the spring through the damper: over 2.5e5 s of time constant next to nothing happens.
#[test]
fn a_stiff_damper_takes_few_steps() {
    let (m, state) = damped(1e9);
    let exact =
        run(&m, &state, &every(0.1, options(15.0, Scheme::Radau(Radau::new(1e-11, 1e-14)))));
    for (told, scheme, steps, error) in [
        ("radau", Scheme::Radau(Radau::new(1e-6, 1e-9)), 200, 1e-7),
        (
            "alpha",
            Scheme::GeneralizedAlpha(GeneralizedAlpha::new(
                AlphaParameters::chung_hulbert(0.8),
                1e-4,
                1e-7,
            )),
            400,
            1e-4,
        ),
    ] {
        let found = run(&m, &state, &every(0.1, options(15.0, scheme)));
        assert!(found.statistics.steps < steps, "{told}: {:?}", found.statistics);
        let off = worst(&found.trajectory.q, &exact.trajectory.q);
        assert!(off < error, "{told}: {off:.1e}");
    }
    // number of steps of an explicit method, from the time that a thousand steps cover
    let explicit = options(
        15.0,
        Scheme::Rk45(Rk45 {
            control: StepControl { max_steps: Some(1000), ..StepControl::new(1e-6, 1e-9) },
        }),
    );
    let failure = kempe::analyses::dynamics::dynamics(&m, &state, &explicit, |_| {
        kempe::integrate::Flow::Continue
    });
    let reached =
        *failure.expect_err("a thousand steps do not suffice").run.trajectory.t.last().unwrap();
    assert!(1000.0 * 15.0 / reached > 1e6, "{reached}");
}

fn chosen(m: &Model, state: &State, t_end: f64) -> (&'static str, String, usize) {
    let run = run(m, state, &options(t_end, Scheme::Auto(Auto::default())));
    let choice = run.choice.expect("a choice was made");
    (choice.method, choice.why, run.statistics.steps)
}

#[test]
fn what_is_not_stiff_stays_explicit() {
    let (m, state) = damped(1e4);
    let (method, why, _) = chosen(&m, &state, 15.0);
    assert_eq!(method, "dop853", "{why}");
    assert!(why.starts_with("not stiff: |lambda| h = "), "{why}");
}

/// An implicit method has no advantage for the undamped vibration of a stiff spring, which it must follow too.
#[test]
fn a_stiff_spring_that_vibrates_stays_explicit() {
    let m = model(
        &(pinned("wheel", "mass = 1\ninertia = 1\npoints = { O = [0, 0] }")
            + "[forces.spring]\ntype = 'torsion_spring'\ni = 'ground'\nj = 'wheel'\nstiffness = 1e8\n"),
    );
    let (state, _) = start(&m, &[("wheel.angle", "0.1")], &[]);
    let (method, why, _) = chosen(&m, &state, 0.2);
    assert_eq!(method, "dop853", "{why}");
    assert!(why.contains("an undamped motion with a rate of 1.00e4"), "{why}");
}

#[test]
fn stiff_dampers_are_seen_and_radau_goes_on() {
    for c in [1e7, 1e9] {
        let (m, state) = damped(c);
        let (method, why, steps) = chosen(&m, &state, 15.0);
        assert_eq!(method, "radau", "{why}");
        assert!(why.starts_with("stiff from t = 0.0") && why.contains("a damped motion"), "{why}");
        assert!(steps < 300, "{steps}");
    }
}

/// Two bodies with a stiff spring-damper between them, which falls and swings as one.
#[test]
fn a_stiff_connection_of_bodies_is_seen() {
    let m = model(
        r#"
gravity = [0, -9.81]
[bodies.ground]
points = { O = [0, 0] }
[bodies.upper]
type = "bar"
mass = 1
length = 1
ends = ["O", "P"]
[bodies.weight]
mass = 2
inertia = 0.1
points = { C = [0, 0] }
[joints.pin]
type = "revolute"
i = "ground.O"
j = "upper.O"
[joints.slot]
type = "translational"
i = "upper.P"
j = "weight.C"
[forces.mount]
type = "spring_damper"
i = "ground.O"
j = "weight.C"
stiffness = 1e6
damping = 1e6
free_length = 1
"#,
    );
    let (state, _) = start(&m, &[("upper.angle", "0"), ("weight.x", "1.0")], &[]);
    let (method, why, steps) = chosen(&m, &state, 5.0);
    assert_eq!(method, "radau", "{why}");
    let auto = run(&m, &state, &every(0.05, options(5.0, Scheme::Auto(Auto::default()))));
    let tight =
        run(&m, &state, &every(0.05, options(5.0, Scheme::Radau(Radau::new(1e-10, 1e-13)))));
    assert!(worst(&auto.trajectory.q, &tight.trajectory.q) < 1e-5);
    // an explicit method would need 5 s times 5e5 1/s over 6.1
    assert!(steps < 5000, "{steps}");
}

/// The interpolant of a run that changed its method: of one degree, continuous, through the outputs.
#[test]
fn dense_output_of_both_methods_is_one() {
    let (m, state) = damped(1e7);
    let run = run(&m, &state, &options(15.0, Scheme::Auto(Auto::default())));
    let dense = run.dense.expect("it was kept");
    let (n, degree) = (2 * m.layout.n_q + 3, dense.degree);
    assert_eq!((degree, dense.t.len()), (9, run.statistics.steps + 1));
    for k in 0..run.statistics.steps - 1 {
        let h = dense.t[k + 1] - dense.t[k];
        for i in 0..2 * m.layout.n_q {
            let c = &dense.c[(k * n + i) * degree..][..degree];
            let end = dense.y[k * n + i] + h * c.iter().sum::<f64>();
            assert!((end - dense.y[(k + 1) * n + i]).abs() < 1e-9, "step {k}, component {i}");
        }
    }
}

#[test]
fn dop853_at_the_same_tolerance_agrees_where_it_can() {
    let (m, state) = damped(1e6);
    let explicit =
        run(&m, &state, &every(0.05, options(2.0, Scheme::Dop853(Dop853::new(1e-11, 1e-13)))));
    let implicit =
        run(&m, &state, &every(0.05, options(2.0, Scheme::Radau(Radau::new(1e-9, 1e-12)))));
    assert!(worst(&implicit.trajectory.q, &explicit.trajectory.q) < 1e-10);
    let [lam, truth] = [&implicit, &explicit].map(|run| run.accelerations(&m).unwrap().lam);
    assert!(worst(&lam, &truth) < 1e-3); // of 1e5 N
}

/// The stiffness is predicted at the start: DOP853 follows the fast motion only while it decays.
#[test]
fn a_stiff_start_is_foretold() {
    for (c, steps) in [(1e7, 95), (1e8, 50), (1e9, 50)] {
        let (m, state) = damped(c);
        let (method, why, taken) = chosen(&m, &state, 15.0);
        assert!(why.ends_with("s (predicted at the start)"), "{why}");
        assert!(method == "radau" && taken < steps, "{taken} steps");
    }
}

/// If the fast motion has decayed before the start, Radau begins.
#[test]
fn radau_begins_where_the_fast_motion_has_died_out() {
    let (m, state) = damped(1e7);
    let first = run(&m, &state, &options(1.0, Scheme::Auto(Auto::default())));
    let n = m.layout.n_q;
    let last = |table: &[f64]| table[table.len() - n..].to_vec();
    let (q, v) = (last(&first.trajectory.q), last(&first.trajectory.v));
    let later = State { t: 1.0, q, v, z: Vec::new() };
    let (method, why, steps) = chosen(&m, &later, 15.0);
    assert!(method == "radau" && steps < 70, "{steps} steps");
    let told = "stiff from the start: a damped motion with a rate of 4.74e3 1/s would need 108";
    assert!(why.starts_with(told), "{why}");
    // backward in time damped motions grow
    let auto = run(&m, &later, &options(0.99, Scheme::Auto(Auto::default())));
    assert_eq!(auto.choice.expect("a choice was made").method, "dop853");
}

/// For few steps a change of the method does not pay.
#[test]
fn a_stiff_model_that_is_soon_done_stays_explicit() {
    let (m, state) = damped(1e7);
    let (method, why, _) = chosen(&m, &state, 1e-3);
    assert_eq!(method, "dop853");
    assert!(why.starts_with("not stiff: at the start the fastest motion is damped"), "{why}");
}

const LATE: &str = r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.hub]
mass = 1
inertia = 1
points = { O = [0, 0] }
[bodies.rim]
mass = 1
inertia = 1
points = { O = [0, 0] }
[joints.pin]
type = "revolute"
i = "ground.O"
j = "hub.O"
[joints.bearing]
type = "revolute"
i = "hub.O"
j = "rim.O"
[drivers.motor]
type = "coordinate_driver"
coordinate = "hub.angle"
value = "0.01*t^4*sin(50*t)"
[forces.clutch]
type = "torsion_spring"
i = "hub"
j = "rim"
damping = 300
"#;

/// At rest the model is stiff; once its drive is fast, accuracy holds Radau to steps that DOP853 has longer.
#[test]
fn what_moves_later_makes_the_choice_anew() {
    let m = model(LATE);
    let (state, _) = start(&m, &[("rim.angle", "0")], &[]);
    let (method, why, _) = chosen(&m, &state, 6.0);
    assert_eq!(method, "dop853", "{why}");
    assert!(why.starts_with("hardly stiff: radau was tried at t = 0.0000 s"), "{why}");
}
