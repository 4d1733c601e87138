//! The derivatives of a motion that drivers determine, by the implicit function theorem at each time.

use crate::analyses::assemble::{determined, implicit};
use crate::equations::dense;
use crate::equations::kinematics::Motions;
use crate::equations::sensitivity::{Sensitivity, Slope};
use crate::math::{Listed, Real};
use crate::model::Model;

/// The state at a time with its derivatives, in which the drivers determine all coordinates.
///
/// # Errors
/// The reason for which there are no derivatives.
pub(super) fn state(
    model: &Model,
    block: &mut Sensitivity,
    t: f64,
    [q, v, z]: [&[f64]; 3],
) -> Result<Vec<Slope>, String> {
    let constant = |x: &[f64]| -> Vec<Slope> { x.iter().map(|x| Slope::constant(*x)).list() };
    let at = Slope::constant(t);
    let general = || dense::jacobian(model, &Motions::at(&model.layout, q, v), t);
    let follow = |x: &[f64], residual: Vec<Slope>| match determined(model, (t, q), x, &residual) {
        Some(found) => Ok(found),
        None => implicit(general(), x, &residual),
    };
    let of_q = follow(q, block.open(at, &constant(q)))?;
    let of_v = follow(v, block.opening(at, &of_q, &constant(v)))?;
    let mut state = [of_q, of_v, constant(z)].concat();
    state.resize(model.layout.n_y(), Slope::constant(f64::NAN));
    Ok(state)
}
