//! Drawings of planar mechanisms as plain data, which figures, films and pages use.
//!
//! [`scene()`] describes a model at some instants of a motion: bodies with their outlines, joints, symbols and
//! bounds. [`display()`] turns a scene into lines, areas and texts that follow the bodies, with positions for all
//! names. A painter places these items at the poses of an instant ([`display::View`], [`display::place()`]) and
//! paints them.
//!
//! ```text
//! plane, numbers ← scene ← display
//! ```
#![forbid(unsafe_code)]

pub mod display;
mod numbers;
mod plane;
pub mod scene;

pub use display::{display, Item, Request, View};
pub use plane::{At, Pose};
pub use scene::{scene, Effort, Scene};
