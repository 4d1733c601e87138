//! Scalars and the geometry of the plane.
//!
//! Every formula of the core is written once over [`Real`]; which scalar it runs on decides what it
//! yields: `f64` a value, [`Dual`] first derivatives, [`Jet`] time derivatives, [`Lanes`] several
//! simulations at once. They nest: `Dual<3, Lanes<4>>` is the Jacobian of four designs.

mod dual;
mod jet;
mod lanes;
mod plane;
mod real;
mod sine;

pub use dual::Dual;
pub use jet::Jet;
pub use lanes::Lanes;
pub use plane::{Local, Motion, Pose, Rotation, Twist, Vec2, Wrench};
pub use real::{Lift, Real};
