//! The translational spring-damper where its points meet, and its energy.

use crate::mechanisms::{close, every, model, run, start, tolerances};
use crate::samples::{motion, on};
use kempe::elements::forces::SpringDamper;
use kempe::elements::{BodyId, Element, Force, ForceElement, Held, Mode, Only, PointOn, Situation};
use kempe::math::{Dual, Lift, Local, Motion, Real, Wrench};

fn spring(free_length: f64) -> SpringDamper {
    let at = |body| PointOn { body: BodyId(body), s: Local::zero() };
    let (i, j) = (at(0), at(1));
    let (stiffness, damping) = (50.0, 3.0);
    SpringDamper { i, j, stiffness, damping, free_length, preload: 0.0, only: None }
}

/// Both points in one place except for `x`, j moving away with (2, -1) m/s.
fn together<S: Lift<f64>>(x: S) -> [Motion<S>; 2] {
    let still = motion([0.0; 6].map(S::lift));
    let mut moving = [0.0, 0.0, 0.0, 2.0, -1.0, 0.0].map(S::lift);
    moving[0] = x;
    [still, motion(moving)]
}

fn at<S: Real>(bodies: &[Motion<S>; 2]) -> Situation<'_, S> {
    let (motions, bodies) = (bodies, &[BodyId(0), BodyId(1)]);
    Situation {
        motions,
        bodies,
        z: &[],
        reaction: Wrench::zero(),
        t: S::zero(),
        held: Held::default(),
        mode: Mode::Open,
        multiplier: S::zero(),
    }
}

/// The wrenches of stiffness on i and j, then of damping.
fn action<S: Real>(e: &SpringDamper<S>, bodies: &[Motion<S>; 2]) -> [Wrench<S>; 4] {
    let mut out = [Wrench::zero(); 4];
    SpringDamper::action(e, &at(bodies), |part, body, w| out[2 * part + body] = w);
    out
}

#[test]
fn where_the_points_meet_the_force_is_finite_and_damps() {
    for free_length in [0.0, 0.4] {
        let e = spring(free_length);
        let [_, stiffness, pulled, damping] = action(&e, &together(0.0));
        assert_eq!((stiffness.force.x, stiffness.force.y), (0.0, 0.0));
        assert_eq!((damping.force.x, damping.force.y), (-6.0, 3.0));
        assert_eq!(pulled.force.x, 6.0);
        let potential = SpringDamper::potential(&e, &at(&together(0.0)));
        close("V", potential, 25.0 * free_length * free_length, 0.0);
    }
}

#[test]
fn the_slope_without_a_free_length_is_the_stiffness_even_where_the_points_meet() {
    for x in [0.0, 1e-200, 1e-9, 0.3] {
        let there = together(Dual::<3>::variable(x, 0));
        let e = SpringDamper::map(&spring(0.0), &mut |s| Dual::lift(*s));
        let [_, stiffness, ..] = action(&e, &there);
        assert_eq!(stiffness.force.x.value, -50.0 * x);
        assert_eq!(stiffness.force.x.slope[0], -50.0);
    }
}

/// A mass on a spring without free length is a plane oscillator: an ellipse, also through the anchor.
#[test]
fn a_mass_passes_through_its_anchor() {
    let m = model(
        r#"
[bodies.ground]
points = { O = [0, 0] }
[bodies.mass]
mass = 2
inertia = 1
points = { P = [0, 0] }
[forces.spring]
type = "spring_damper"
i = "ground.O"
j = "mass.P"
stiffness = 8
"#,
    );
    let (state, _) = start(&m, &[("mass.x", "0.5"), ("mass.y", "0")], &[("mass.vx", "0")]);
    let run = run(&m, &state, &every(0.1, tolerances(3.0, 1e-11, 1e-13)));
    let energies = run.energies(&m).unwrap();
    for (k, t) in run.trajectory.t.iter().enumerate() {
        close("x", run.trajectory.q[3 * k], 0.5 * (2.0 * t).cos(), 1e-9);
        let energy = &energies[5 * k..][..2];
        close("T + V", energy[0] + energy[1], 1.0, 1e-9);
    }
}

/// Samples with and without one sense.
pub fn springs() -> Vec<ForceElement> {
    let mut all = Vec::new();
    let ties =
        [(0.0, None), (0.9, None), (0.9, Some(Only::Tension)), (2.5, Some(Only::Compression))];
    for (free_length, only) in ties {
        all.push(ForceElement::SpringDamper(SpringDamper {
            i: on(1, 0.3, -0.7),
            j: on(2, -1.1, 0.4),
            stiffness: 2.5,
            damping: 0.7,
            free_length,
            preload: 0.3,
            only,
        }));
    }
    all
}
