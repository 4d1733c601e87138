//! Jumps of the velocities, for instance at impacts: the equations of motion with impulses instead of forces.

use super::motion::Workspace;
use super::{constraints, refine, Gains};
use crate::math::Real;
use crate::model::Model;
use crate::solve::Breakdown;

impl<S: Real> Workspace<S> {
    /// The jump of the velocities that changes each row of Φ_q v by its entry of `rates`, shape (n_rows), without
    /// external impulses: [M Φ_qᵀ; Φ_q 0] (Δv, P) = (0, rates). Returns Δv, shape (n_q), and the impulses P, shape
    /// (n_rows).
    ///
    /// # Errors
    /// [`Breakdown`] if Φ_q loses rank.
    pub fn jump(
        &mut self,
        model: &Model<S>,
        t: S,
        q: &[S],
        rates: &[S],
    ) -> Result<[Vec<S>; 2], Breakdown> {
        self.jump_by(model, t, q, (&vec![S::zero(); self.n_q], rates))
    }

    /// The jump of the velocities due to generalized impulses, shape (n_q): [M Φ_qᵀ; Φ_q 0] (Δv, P) = (impulses, 0).
    /// Returns Δv, shape (n_q).
    ///
    /// # Errors
    /// [`Breakdown`] if Φ_q loses rank.
    pub fn velocity_jump(
        &mut self,
        model: &Model<S>,
        t: S,
        q: &[S],
        impulses: &[S],
    ) -> Result<Vec<S>, Breakdown> {
        let still = vec![S::zero(); model.layout.n_rows];
        self.jump_by(model, t, q, (impulses, &still)).map(|[jump, _]| jump)
    }

    /// The jump of the velocities and the impulses P for generalized impulses and changes of Φ_q v: [M Φ_qᵀ; Φ_q 0] (Δv,
    /// P) = (impulses, rates).
    ///
    /// # Errors
    /// [`Breakdown`] if Φ_q loses rank.
    pub fn jump_by(
        &mut self,
        model: &Model<S>,
        t: S,
        q: &[S],
        (impulses, rates): (&[S], &[S]),
    ) -> Result<[Vec<S>; 2], Breakdown> {
        self.motions.place(&model.layout, q, &vec![S::zero(); self.n_q]);
        let Self { motions, compiled, matrix, memory, .. } = self;
        let mut right = vec![S::zero(); model.layout.n_rows];
        let gains = Gains::default();
        constraints::linearize(model, motions, t, gains, &mut right, matrix.jacobian_mut());
        matrix.set_mass(compiled, motions);
        matrix.factor()?;
        let mut x = [impulses, rates].concat();
        refine::solve(model, motions, matrix, &mut x, memory)?;
        let impulses = x.split_off(self.n_q);
        Ok([x, impulses])
    }
}
