//! Beams: flexible links of the file. A beam is a chain of bodies, its nodes, with elastic pieces between them.
//!
//! This module is the only place that expands a beam. An end or a named point of a beam is a body, and every reference
//! to it needs no further code.
//!
//! In the rigid form of a model, welds connect neighbouring nodes. Assembly closes the mechanism in this form, so that
//! beams start without strain.

mod along;
mod centre_line;
mod pieces;
mod read;
mod rigid;
mod spline;
mod stiffness;

pub(super) use read::{read, Linked};
pub(super) use rigid::{connect, weld};
