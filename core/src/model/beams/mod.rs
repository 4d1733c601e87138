//! Beams: flexible links of the file. A beam is a chain of bodies, its nodes, with elastic pieces between them.
//!
//! This module is the only place that expands a beam. The first node has the name of the beam, and the others have
//! names with a full stop, such as `rod.B`, which no body of a file can have. An end or a named point of a beam is
//! therefore a body, and every reference to it needs no further code.
//!
//! In the rigid form of a model, joints connect to the first node, and welds carry the other nodes. Assembly closes
//! the mechanism in this form, so that beams start without strain.

mod centre_line;
mod fields;
mod nodes;
mod pieces;
mod read;
mod rigid;
mod spline;
mod stiffness;

pub(super) use fields::beam;
pub(super) use nodes::{ends, names};
pub(super) use read::{is_weld, read, Linked};
pub(super) use rigid::{connect, rigid_bodies, weld};

/// The `type` of a beam.
pub const BEAM: &str = "beam";
/// The kind of the bodies that are the further nodes of a beam.
pub const NODE: &str = "node";

/// Whether a body is a node of a beam without a name of the file.
pub fn is_inner(name: &str) -> bool {
    name.contains(".#")
}

/// The name of the beam to which an item with a name made here belongs, such as `rod` for `rod.B`.
pub fn beam_of(name: &str) -> &str {
    name.split_once('.').map_or(name, |(beam, _)| beam)
}
