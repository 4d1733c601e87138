//! The derivatives of a motion that drivers determine, by the implicit function theorem at each time.

use crate::analyses::assemble::implicit;
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
    let constant = |x: &[f64]| x.iter().map(|x| Slope::constant(*x)).list();
    let at = Slope::constant(t);
    let motions = Motions::at(&model.layout, q, v);
    let jacobian = dense::jacobian(model, &motions, t);
    let (of_q, of_v): (Vec<Slope>, Vec<Slope>) = (constant(q), constant(v));
    let of_q = implicit(jacobian.clone(), q, &block.open(at, &of_q))?;
    let of_v = implicit(jacobian, v, &block.opening(at, &of_q, &of_v))?;
    let mut state = [of_q, of_v, constant(z)].concat();
    state.resize(model.layout.n_y(), Slope::constant(f64::NAN));
    Ok(state)
}
