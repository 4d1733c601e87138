//! Elements of a model by their names.

use crate::convert::refuse;
use kempe::elements::BodyId;
use kempe::equations::reactions::Frame;
use kempe::model::Model;
use pyo3::prelude::*;

/// The joint or driver of this name.
pub fn constraint(py: Python<'_>, model: &Model, name: &str) -> PyResult<usize> {
    model.constraint(name).ok_or_else(|| unknown(py, "joint or driver", name))
}

/// The force element of this name.
pub fn force(py: Python<'_>, model: &Model, name: &str) -> PyResult<usize> {
    model.force(name).ok_or_else(|| unknown(py, "force", name))
}

/// The frame of this name.
pub fn frame_named(py: Python<'_>, name: &str) -> PyResult<Frame> {
    match name {
        "global" => Ok(Frame::Global),
        "body" => Ok(Frame::Body),
        "joint" => Ok(Frame::Joint),
        _ => Err(refuse(py, "frame", format!("'{name}'; must be 'global', 'body' or 'joint'"))),
    }
}

/// The body `on`, which must belong to `owner`.
pub fn one_of(
    py: Python<'_>,
    model: &Model,
    bodies: &[BodyId],
    owner: &str,
    on: &str,
) -> PyResult<BodyId> {
    let name = |body: &BodyId| model.bodies[body.0].name.as_str();
    if let Some(body) = bodies.iter().rev().find(|body| name(body) == on) {
        return Ok(*body);
    }
    let names: Vec<&str> = bodies.iter().map(name).collect();
    let joined = names.join(" and ");
    Err(refuse(py, "on", format!("'{on}' is not a body of {owner}; it joins {joined}")))
}

/// The error for an element that does not exist.
pub fn unknown(py: Python<'_>, what: &str, name: &str) -> PyErr {
    refuse(py, name, format!("there is no {what} of this name"))
}
