//! Scalars and the geometry of the plane.
//!
//! Every formula of the core is written once over [`Real`]. The scalar determines the result: `f64` gives a value,
//! [`Dual`] first derivatives, [`Jet`] time derivatives, and [`Lanes`] several states or designs at once. Scalars can
//! be nested: `Dual<3, Lanes>` gives the Jacobian of four designs. Derivatives of higher order in one variable are a
//! [`TaylorSeries`]. [`Interval`] gives bounds of all values on an interval.
//!
//! Linear equations may also be [`Complex`]; they require only a [`Field`].

mod array;
pub(crate) mod base;
mod complex;
mod dual;
mod field;
mod interval;
mod jet;
mod lanes;
mod list;
pub(crate) mod operators;
mod order;
mod plane;
mod random;
mod real;
mod series;
mod sine;
mod spline;
mod spline_system;

pub(crate) use array::{each, indexed, ShortArray};
pub use base::{compose, OverBase};
pub use complex::Complex;
pub use dual::Dual;
pub use field::Field;
pub use interval::Interval;
pub use jet::Jet;
pub use lanes::Lanes;
pub(crate) use list::Listed;
pub(crate) use order::Ordered;
pub use plane::{Lever, Local, Motion, Pose, Rotation, Twist, Vec2, Wrench};
pub use random::Random;
pub use real::{ByArgument, ByValues, Largest, Lift, Real};
pub use series::TaylorSeries;
pub use spline::{Interpolation, Spline};
