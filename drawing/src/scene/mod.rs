//! The static part of a scene: the drawing of a model as plain data.
//!
//! `docs/scene.md` describes its JSON format.

mod bodies;
mod bounds;
mod data;
mod effort;
mod hull;
mod length;
mod make;
pub(crate) mod mark;
mod paths;
mod symbols;
mod teeth;

pub use data::{Body, Curve, Joint, Part, PartForm, Point, Scene, Symbol, Teeth};
pub use effort::{efforts, Effort};
pub use length::Length;
pub use make::scene;
pub(crate) use teeth::outer_radius;
