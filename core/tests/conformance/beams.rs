//! Elastic pieces of beams between four bodies: forces and potential, dissipation, rigid motions, lanes.

use crate::mechanisms::Random;
use crate::samples::{motion, random};
use kempe::elements::forces::BeamPiece;
use kempe::elements::joints::BeamLock;
use kempe::elements::{BodyId, Constraint, ForceElement, Held, Mode, Situation};
use kempe::math::{Dual, Lift, Motion, Pose, Real, Wrench};

fn piece() -> ForceElement {
    let id = BodyId;
    ForceElement::BeamPiece(BeamPiece {
        i: id(0),
        j: id(1),
        second: id(2),
        third: id(3),
        start: 0.3,
        length: 1.7,
        axial: [3.0, 2.5, 2.0],
        shear: [1.2, 1.1, 1.0],
        bending: [0.7, 0.6, 0.5],
        stretch: [1.0, 0.98, 1.01],
        slide: [0.0, 0.02, -0.01],
        curvature: [0.3, 0.2, 0.1],
        damping: Some(0.4),
        by_force: [1.0; 3],
        by_moment: [2.0; 3],
    })
}

/// Locks of stretch, of shear and of a direction between them.
pub fn locks() -> Vec<Constraint> {
    [[1.0, 0.0], [0.0, 1.0], [0.6, -0.8]].map(lock).into()
}

fn lock(along: [f64; 2]) -> Constraint {
    let [i, j, second, third] = [1, 2, 3, 4].map(BodyId);
    Constraint::BeamLock(BeamLock {
        i,
        j,
        second,
        third,
        length: 1.7,
        along,
        stretch: [1.0, 0.98, 1.01],
        slide: [0.0, 0.02, -0.01],
        curvature: [0.3, 0.2, 0.1],
        bending: [0.7, 0.6, 0.5],
        by_force: [1.0; 3],
        by_moment: [2.0; 3],
    })
}

const BODIES: [BodyId; 4] = [BodyId(0), BodyId(1), BodyId(2), BodyId(3)];

fn at<'a, S: Real>(motions: &'a [Motion<S>; 4], zero: &'a Wrench<S>) -> Situation<'a, S> {
    let (bodies, reaction, mode) = (&BODIES, *zero, Mode::Open);
    let (t, multiplier) = (S::zero(), S::zero());
    Situation { motions, bodies, z: &[], reaction, t, held: Held::default(), mode, multiplier }
}

/// The wrenches of both parts on the four bodies.
fn actions<S: Real>(f: &ForceElement<S>, motions: &[Motion<S>; 4]) -> [[Wrench<S>; 4]; 2] {
    let zero = Wrench::zero();
    let mut out = [[zero; 4]; 2];
    f.action(&at(motions, &zero), &mut |part: usize, body: usize, w| out[part][body] = w);
    out
}

fn each(check: impl Fn(&ForceElement, &[Motion; 4])) {
    let mut numbers = Random::new(7);
    for _ in 0..20 {
        let motions: [Motion; 4] = std::array::from_fn(|_| motion(random(&mut numbers)));
        check(&piece(), &motions);
    }
}

#[test]
fn forces_are_the_slopes_of_the_potential() {
    each(|f, motions| {
        type D = Dual<3>;
        let lifted = f.map(&mut |x| D::lift(*x));
        let [elastic, _] = actions(f, motions);
        for body in 0..4 {
            let mut seeded: [Motion<D>; 4] = motions.map(|motion| motion.lift());
            let Pose { r, angle, .. } = motions[body].pose;
            seeded[body].pose =
                Pose::new(D::variable(r.x, 0), D::variable(r.y, 1), D::variable(angle, 2));
            let zero = Wrench::zero();
            let slope = lifted.potential(&at(&seeded, &zero)).slope;
            let w = elastic[body];
            for (force, slope) in [w.force.x, w.force.y, w.torque].into_iter().zip(slope) {
                assert!((force + slope).abs() < 1e-12 * (1.0 + slope.abs()), "{force} {slope}");
            }
        }
    });
}

#[test]
fn damping_takes_energy_and_leaves_a_rigid_motion_alone() {
    each(|f, motions| {
        let [_, damping] = actions(f, motions);
        let power: f64 = (0..4).map(|k| damping[k].power(motions[k].twist)).sum();
        assert!(power <= 1e-12, "{power}");
        // the nodes turn about the origin
        let turning = motions.map(|mut motion| {
            motion.twist.velocity = motion.pose.r.perp();
            motion.twist.omega = 1.0;
            motion
        });
        let [_, damping] = actions(f, &turning);
        assert!(damping.iter().all(|w| w.force.norm() + w.torque.abs() < 1e-12), "{damping:?}");
    });
}

#[test]
fn forces_and_moments_cancel() {
    each(|f, motions| {
        for wrenches in actions(f, motions) {
            let sum = wrenches.iter().fold(kempe::math::Vec2::zero(), |sum, w| sum + w.force);
            let about = |k: usize| wrenches[k].torque + motions[k].pose.r.cross(wrenches[k].force);
            let moment: f64 = (0..4).map(about).sum();
            assert!(sum.norm() < 1e-12 && moment.abs() < 1e-11, "{sum:?} {moment}");
        }
    });
}
