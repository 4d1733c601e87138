//! Φ_q and γ, derived from Φ by dual numbers over one participant at a time, and by jets in time.

use super::joint_trait::{At, Joint, Linearized, Moving};
use crate::math::{Dual, Jet, Lift, Motion, Pose, Real, Rotation, Vec2};

/// Dual numbers over the three unknowns of one participant.
pub(crate) type ByThree<S> = Dual<3, S>;

/// A pose whose three coordinates are the seeds.
pub(crate) fn seeded<S: Real>(pose: &Pose<S>) -> Pose<ByThree<S>> {
    // sin and cos are taken from the pose; only their slopes are computed
    let (mut cos, mut sin) = (Dual::lift(pose.rotation.cos), Dual::lift(pose.rotation.sin));
    cos.slope[2] = -pose.rotation.sin;
    sin.slope[2] = pose.rotation.cos;
    Pose {
        r: Vec2::new(Dual::variable(pose.r.x, 0), Dual::variable(pose.r.y, 1)),
        angle: Dual::variable(pose.angle, 2),
        rotation: Rotation { cos, sin },
    }
}

/// A pose as a function of time, with the given velocity and zero acceleration.
pub(crate) fn moving<S: Real>(m: &Motion<S>) -> Pose<Jet<S>> {
    let (s, c, w) = (m.pose.rotation.sin, m.pose.rotation.cos, m.twist.omega);
    let jet = |value, rate| Jet::new(value, rate, S::zero());
    Pose {
        r: Vec2::new(jet(m.pose.r.x, m.twist.velocity.x), jet(m.pose.r.y, m.twist.velocity.y)),
        angle: jet(m.pose.angle, w),
        rotation: Rotation {
            cos: Jet::new(c, -s * w, -c * w * w),
            sin: Jet::new(s, c * w, -s * w * w),
        },
    }
}

/// Calls `f` with n values. A small number of values is kept on the stack.
#[inline(always)]
pub(crate) fn with_values<T: Copy, R>(
    n: usize,
    value: impl Fn(usize) -> T,
    f: impl FnOnce(&mut [T]) -> R,
) -> R {
    match n {
        0 => f(&mut []),
        1 => f(&mut std::array::from_fn::<T, 1, _>(&value)),
        2 => f(&mut std::array::from_fn::<T, 2, _>(&value)),
        3 => f(&mut std::array::from_fn::<T, 3, _>(&value)),
        4 => f(&mut std::array::from_fn::<T, 4, _>(&value)),
        6 => f(&mut std::array::from_fn::<T, 6, _>(&value)),
        9 => f(&mut std::array::from_fn::<T, 9, _>(&value)),
        _ => f(&mut (0..n).map(value).collect::<Vec<T>>()),
    }
}

/// Derives [`Joint::linearize`] from [`Joint::residual`].
pub fn linearize<E: Joint + ?Sized, S: Real>(
    e: &E::Over<S>,
    at: &Moving<'_, S>,
    out: Linearized<'_, S>,
) {
    let residual = |at: &At<'_, Jet<S>>, phi: &mut [Jet<S>]| {
        E::residual(&E::map(e, &mut |s: &S| Jet::lift(*s)), at, phi);
    };
    let columns = |at: &At<'_, ByThree<S>>, phi: &mut [ByThree<S>]| {
        E::residual(&E::map(e, &mut |s: &S| Dual::lift(*s)), at, phi);
    };
    terms(at, residual, [out.residual, out.rate, out.gamma]);
    let m = out.residual.len();
    for (participant, rows) in out.columns.chunks_exact_mut(m).enumerate() {
        let own = participant == at.bodies.len();
        columns_of(at, |body| body == participant, own, columns, rows);
    }
}

/// Number of participants of a joint: its bodies, and one for its internal coordinates.
pub(crate) fn participants(bodies: usize, own: usize) -> usize {
    bodies + usize::from(own > 0)
}

/// Φ, Φ̇ and γ from the jet of `residual` in time.
pub(crate) fn terms<S: Real>(
    at: &Moving<'_, S>,
    residual: impl FnOnce(&At<'_, Jet<S>>, &mut [Jet<S>]),
    [phi, rate, gamma]: [&mut [S]; 3],
) {
    let t = Jet::new(at.t, S::one(), S::zero());
    let own = |k: usize| Jet::new(at.own[k], at.own_rates[k], S::zero());
    with_values(
        at.bodies.len(),
        |b| moving(&at.bodies[b]),
        |bodies| {
            with_values(at.own.len(), own, |own| {
                with_values(
                    phi.len(),
                    |_| Jet::zero(),
                    |jets| {
                        residual(&At { bodies, own, t }, jets);
                        for (k, jet) in jets.iter().enumerate() {
                            (phi[k], rate[k], gamma[k]) = (jet.value, jet.rate, -jet.second);
                        }
                    },
                );
            });
        },
    );
}

/// The rows of Φ_q in the columns of the internal coordinates, or of the bodies whose indices `varies` selects.
pub(crate) fn columns_of<S: Real>(
    at: &Moving<'_, S>,
    varies: impl Fn(usize) -> bool,
    own_varies: bool,
    residual: impl FnOnce(&At<'_, ByThree<S>>, &mut [ByThree<S>]),
    rows: &mut [[S; 3]],
) {
    let body = |b: usize| match varies(b) {
        true => seeded(&at.bodies[b].pose),
        false => at.bodies[b].pose.lift(),
    };
    let own = |k: usize| match own_varies {
        true => Dual::variable(at.own[k], k),
        false => Dual::lift(at.own[k]),
    };
    with_values(at.bodies.len(), body, |bodies| {
        with_values(at.own.len(), own, |own| {
            with_values(
                rows.len(),
                |_| Dual::zero(),
                |phi| {
                    residual(&At { bodies, own, t: Dual::lift(at.t) }, phi);
                    rows.iter_mut().zip(phi).for_each(|(row, phi)| *row = phi.slope);
                },
            );
        });
    });
}
