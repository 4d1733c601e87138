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

/// A list of values with a length that is known at run time. Up to `N` values are kept on the stack.
pub(crate) struct Few<T, const N: usize> {
    few: [T; N],
    many: Vec<T>,
    length: usize,
}

impl<T: Copy, const N: usize> Few<T, N> {
    /// A list of equal values.
    #[inline(always)]
    pub fn new(length: usize, value: T) -> Self {
        let many = if length > N { vec![value; length] } else { Vec::new() };
        Self { few: [value; N], many, length }
    }

    /// The values.
    #[inline(always)]
    pub fn all(&mut self) -> &mut [T] {
        match self.length <= N {
            true => &mut self.few[..self.length],
            false => &mut self.many,
        }
    }
}

/// The poses or motions of the bodies of most joints.
pub(crate) type OfBodies<T> = Few<T, 3>;
/// One value for each of up to three equations.
pub(crate) type OfRows<T> = Few<T, 3>;

/// A function that computes Φ. It is not generic, so that its caller is compiled once for each scalar.
pub(crate) type Residual<'f, S> = dyn Fn(&At<'_, S>, &mut [S]) + 'f;

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
    terms(at, &residual, [out.residual, out.rate, out.gamma]);
    let m = out.residual.len();
    for (participant, rows) in out.columns.chunks_exact_mut(m).enumerate() {
        let own = participant == at.bodies.len();
        columns_of(at, &|body| body == participant, own, &columns, rows);
    }
}

/// Number of participants of a joint: its bodies, and one for its internal coordinates.
#[inline]
pub(crate) fn participants(bodies: usize, own: usize) -> usize {
    bodies + usize::from(own > 0)
}

/// Φ, Φ̇ and γ from the jet of `residual` in time.
pub(crate) fn terms<S: Real>(
    at: &Moving<'_, S>,
    residual: &Residual<'_, Jet<S>>,
    [phi, rate, gamma]: [&mut [S]; 3],
) {
    let t = Jet::new(at.t, S::one(), S::zero());
    let mut bodies = OfBodies::new(at.bodies.len(), Pose::identity());
    for (pose, body) in bodies.all().iter_mut().zip(at.bodies) {
        *pose = moving(body);
    }
    let mut own = OfRows::new(at.own.len(), Jet::zero());
    for (k, own) in own.all().iter_mut().enumerate() {
        *own = Jet::new(at.own[k], at.own_rates[k], S::zero());
    }
    let mut jets = OfRows::new(phi.len(), Jet::zero());
    residual(&At { bodies: bodies.all(), own: own.all(), t }, jets.all());
    for (k, jet) in jets.all().iter().enumerate() {
        (phi[k], rate[k], gamma[k]) = (jet.value, jet.rate, -jet.second);
    }
}

/// The rows of Φ_q in the columns of the internal coordinates, or of the bodies whose indices `varies` selects.
pub(crate) fn columns_of<S: Real>(
    at: &Moving<'_, S>,
    varies: &dyn Fn(usize) -> bool,
    own_varies: bool,
    residual: &Residual<'_, ByThree<S>>,
    rows: &mut [[S; 3]],
) {
    let mut bodies = OfBodies::new(at.bodies.len(), Pose::identity());
    for (b, pose) in bodies.all().iter_mut().enumerate() {
        *pose = match varies(b) {
            true => seeded(&at.bodies[b].pose),
            false => at.bodies[b].pose.lift(),
        };
    }
    let mut own = OfRows::new(at.own.len(), Dual::zero());
    for (k, own) in own.all().iter_mut().enumerate() {
        *own = match own_varies {
            true => Dual::variable(at.own[k], k),
            false => Dual::lift(at.own[k]),
        };
    }
    let mut phi = OfRows::new(rows.len(), Dual::zero());
    let t = Dual::lift(at.t);
    residual(&At { bodies: bodies.all(), own: own.all(), t }, phi.all());
    for (row, phi) in rows.iter_mut().zip(phi.all()) {
        *row = phi.slope;
    }
}
