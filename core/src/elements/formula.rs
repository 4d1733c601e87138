//! The equations of a constraint as formulas to be read: what `kempe show --symbolic` prints.
//!
//! A formula is written in the language of expressions over `i.x i.y i.angle i.vx i.vy i.omega`, the
//! same of `j`, the joint points `i.s.x i.s.y j.s.x j.s.y`, the axes of the joint frame `i.axis
//! j.axis`, and the fields of a driver: `value`, its second derivative in time `ddt(value)`, and
//! `j.coordinate` for the coordinate named in its field, of which `is_x is_y is_angle` is 1 and the
//! others are 0. A test evaluates every formula against Φ, Φ_q and γ of the same element.

/// One equation of a joint or driver as formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Φ.
    pub residual: &'static str,
    /// ∂Φ/∂(xᵢ yᵢ φᵢ xⱼ yⱼ φⱼ).
    pub jacobian: [&'static str; 6],
    /// γ.
    pub gamma: &'static str,
}
