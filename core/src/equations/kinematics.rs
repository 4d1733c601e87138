//! Poses and twists of all bodies from q and q̇.

use crate::math::{Motion, Pose, Real, Rotation, Twist};

/// Motion of every body, ground first, from q (3 n_b) and v (3 n_b). What `out` holds must come from here or
/// be empty: ground is not written again. No allocation if it has held as many bodies before.
#[inline(always)] // once in an evaluation: a call saves and restores more than it shares
pub fn motions<S: Real>(q: &[S], v: &[S], out: &mut Vec<Motion<S>>) {
    out.resize(q.len() / 3 + 1, Motion { pose: Pose::identity(), twist: Twist::zero() });
    let moving = out[1..].iter_mut().zip(q.chunks_exact(3).zip(v.chunks_exact(3)));
    for (motion, (q, v)) in moving {
        let pose = &mut motion.pose;
        (pose.angle, pose.rotation) = (q[2], Rotation::new(q[2]));
        (pose.r.x, pose.r.y) = (q[0], q[1]);
        put_rates(v, &mut motion.twist);
    }
}

/// Gives the moving bodies the rates v (3 n_b); their positions stay.
pub fn set_rates<S: Real>(v: &[S], motions: &mut [Motion<S>]) {
    for (motion, v) in motions[1..].iter_mut().zip(v.chunks_exact(3)) {
        put_rates(v, &mut motion.twist);
    }
}

/// Number by number: what is put together first is copied twice.
#[inline(always)]
fn put_rates<S: Real>(v: &[S], twist: &mut Twist<S>) {
    (twist.velocity.x, twist.velocity.y) = (v[0], v[1]);
    twist.omega = v[2];
}

/// Motion of every body at rest.
pub fn at_rest<S: Real>(q: &[S]) -> Vec<Motion<S>> {
    let mut out = Vec::with_capacity(q.len() / 3 + 1);
    motions(q, &vec![S::zero(); q.len()], &mut out);
    out
}
