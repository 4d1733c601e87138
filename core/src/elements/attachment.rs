//! The frame of a joint on one of its bodies.

use crate::math::Local;

/// The joint frame on one body: its origin s′ and the angle of its x″ axis in the body frame. C in Haug (6.6.8) is
/// the rotation by this angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment<S = f64> {
    /// Origin, m.
    pub s: Local<S>,
    /// Angle of x″ from the body's x axis, rad.
    pub axis: S,
}

impl<S> Attachment<S> {
    /// The same over another scalar.
    pub(super) fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Attachment<T> {
        Attachment { s: Local { x: f(&self.s.x), y: f(&self.s.y) }, axis: f(&self.axis) }
    }
}
