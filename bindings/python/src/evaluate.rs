//! Equations evaluated at given states.

use crate::assemble::targets;
use crate::convert::{refuse, rows, state, table, Row, Rows};
use crate::guard::guard;
use crate::model::PyModel;
use crate::respond::{self, missing, responses, Table};
use kempe::analyses::assemble::{holding, Request};
use kempe::analyses::dynamics as core;
use kempe::elements::BodyId;
use kempe::equations::actions::{self, each_action};
use kempe::equations::constraints;
use kempe::equations::forces::{self, Acting};
use kempe::equations::kinematics::Motions;
use kempe::equations::measured::{measured as measure, offered, ElementId};
use kempe::equations::reactions::Frame;
use kempe::math::Wrench;
use kempe::model::Model;
use kempe::stabilize::Projection;
use numpy::PyArrayMethods;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Positions and velocities as rows.
pub struct Rates {
    /// Times, s.
    pub t: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Rates {
    /// Reads rows from Python.
    pub fn read(
        py: Python<'_>,
        model: &Model,
        t: &Row<'_>,
        q: &Rows<'_>,
        v: &Rows<'_>,
    ) -> PyResult<Self> {
        let t = t.as_array().to_vec();
        let shape = (t.len(), model.layout.n_q);
        Ok(Self { q: rows(py, "q", q, shape)?, v: rows(py, "v", v, shape)?, t })
    }

    /// Calls `visit` with the motion of all bodies at each state.
    pub fn each(&self, model: &Model, mut visit: impl FnMut(usize, f64, &Motions)) {
        let n = model.layout.n_q;
        let mut motions = Motions::new(&model.layout);
        for (k, &t) in self.t.iter().enumerate() {
            let row = k * n..(k + 1) * n;
            motions.place(&model.layout, &self.q[row.clone()], &self.v[row]);
            visit(k, t, &motions);
        }
    }
}

/// Accelerations, multipliers and regularity at states, without stabilization. With `passing`, also near singular
/// positions.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, passing=false))]
pub fn evaluate<'py>(
    py: Python<'py>,
    model: &PyModel,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
    passing: bool,
) -> PyResult<(Table<'py>, Table<'py>, Table<'py>)> {
    guard("evaluate", || {
        let Rates { t, q, v } = &Rates::read(py, &model.model, &t, &q, &v)?;
        let z = &rows(py, "z", &z, (t.len(), model.model.layout.n_z))?;
        let states = core::States { t, q, v, z };
        let [a, lam, regularity] = responses(py, &model.active, states, passing)?;
        let (n, m, count) = (model.model.layout.n_q, model.active.n_multipliers(), t.len());
        let regularity = table(py, regularity, (count, 1))?;
        Ok((table(py, a, (count, n))?, table(py, lam, (count, m))?, regularity))
    })
}

/// States of an interpolant (q and v), projected like reported states.
#[pyfunction]
#[pyo3(signature = (model, tolerance, t, q, v, z))]
pub fn project<'py>(
    py: Python<'py>,
    model: &PyModel,
    tolerance: f64,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
) -> PyResult<(Table<'py>, Table<'py>)> {
    guard("project", || {
        let Rates { t, q, v } = &Rates::read(py, &model.model, &t, &q, &v)?;
        let z = &rows(py, "z", &z, (t.len(), model.model.layout.n_z))?;
        let (states, projection) = (core::States { t, q, v, z }, Projection { tolerance });
        let found = py.detach(|| model.active.prepared.project(states, projection));
        let [q, v] = found.map_err(|failure| missing(py, failure.reason))?;
        let shape = (t.len(), model.model.layout.n_q);
        Ok((table(py, q, shape)?, table(py, v, shape)?))
    })
}

/// Energies at states, with the works up to them.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, works))]
pub fn energies<'py>(
    py: Python<'py>,
    model: &PyModel,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
    works: Rows<'py>,
) -> PyResult<Table<'py>> {
    guard("energies", || {
        let layout = &model.model.layout;
        let Rates { t, q, v } = &Rates::read(py, &model.model, &t, &q, &v)?;
        let z = &rows(py, "z", &z, (t.len(), layout.n_z))?;
        let works = rows(py, "works", &works, (t.len(), layout.n_works))?;
        let found = respond::energies(py, &model.active, core::States { t, q, v, z }, &works)?;
        table(py, found, (t.len(), core::ENERGIES))
    })
}

/// The position quantities of an element with their rates and accelerations: (n_t, 3 per quantity).
#[pyfunction]
#[pyo3(signature = (model, name, t, q, v, a=None))]
pub fn measured<'py>(
    py: Python<'py>,
    model: &PyModel,
    name: &str,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    a: Option<Rows<'py>>,
) -> PyResult<Table<'py>> {
    guard("measured", || {
        let model = &*model.model;
        let constraint = model.constraint(name).map(ElementId::Constraint);
        let id = constraint.or_else(|| model.force(name).map(ElementId::Force));
        let id = id.ok_or_else(|| unknown(py, "element", name))?;
        let states = Rates::read(py, model, &t, &q, &v)?;
        let (n, count) = (model.layout.n_q, states.t.len());
        let a = a.map(|a| rows(py, "a", &a, (count, n))).transpose()?;
        let a = a.unwrap_or_else(|| vec![0.0; count * n]);
        let mut out = Vec::new();
        states.each(model, |k, _, motions| {
            for jet in measure(model, id, motions, &a[k * n..(k + 1) * n]) {
                out.extend([jet.value, jet.rate, jet.second]);
            }
        });
        table(py, out, (count, 3 * offered(model, id).len()))
    })
}

/// Φ and Φ_q q̇ + Φ_t at states.
#[pyfunction]
#[pyo3(signature = (model, t, q, v))]
pub fn residual<'py>(
    py: Python<'py>,
    model: &PyModel,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
) -> PyResult<(Table<'py>, Table<'py>)> {
    guard("residual", || {
        let active = &model.active;
        let model = &**active.prepared.model();
        let states = Rates::read(py, model, &t, &q, &v)?;
        let (count, m) = (states.t.len(), model.layout.n_rows);
        let (mut phi, mut rate) = (vec![0.0; count * m], vec![0.0; count * m]);
        let mut gamma = vec![0.0; m];
        states.each(model, |k, t, motions| {
            let row = k * m..(k + 1) * m;
            let (phi, rate) = (&mut phi[row.clone()], &mut rate[row]);
            constraints::velocity_terms(model, motions, t, phi, rate, &mut gamma);
        });
        let shape = (count, active.n_rows());
        let (phi, rate) = (active.expand_rows(phi, count), active.expand_rows(rate, count));
        Ok((table(py, phi, shape)?, table(py, rate, shape)?))
    })
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

/// Force, and torque about its place, that a force element or one of its parts exerts on a body.
#[pyfunction]
#[pyo3(signature = (model, name, on, part, frame, t, q, v, z, lam=None))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn force<'py>(
    py: Python<'py>,
    model: &PyModel,
    name: &str,
    on: &str,
    part: Option<&str>,
    frame: &str,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
    lam: Option<Rows<'py>>,
) -> PyResult<Table<'py>> {
    guard("force", || {
        let model = &*model.model;
        let k = model.force(name).ok_or_else(|| unknown(py, "force", name))?;
        let item = &model.forces[k];
        let in_body = frame_named(py, frame)? != Frame::Global;
        let body = one_of(py, model, &item.bodies, name, on)?;
        let wanted = match part {
            None => None,
            Some(part) => {
                let found = item.element.parts().iter().position(|p| p.name == part);
                Some(found.ok_or_else(|| unknown(py, "part", part))?)
            }
        };
        let states = Rates::read(py, model, &t, &q, &v)?;
        let (count, n_z, m) = (states.t.len(), model.layout.n_z, model.n_multipliers());
        let z = rows(py, "z", &z, (count, n_z))?;
        let lam = lam.map(|lam| rows(py, "lam", &lam, (count, m))).transpose()?;
        let mut out = Vec::with_capacity(3 * count);
        states.each(model, |at, t, motions| {
            let mut sum = Wrench::zero();
            let lam = lam.as_ref().map(|lam| &lam[at * m..(at + 1) * m]);
            let acting = Acting { z: &z[at * n_z..(at + 1) * n_z], lam, t };
            each_action(model, k, motions, acting, |part, at, wrench| {
                if at == body && wanted.is_none_or(|wanted| wanted == part) {
                    sum = sum + wrench;
                }
            });
            let turned = motions[body.0].pose.rotation.inverse(sum.force);
            let force = if in_body { [turned.x, turned.y] } else { [sum.force.x, sum.force.y] };
            out.extend([force[0], force[1], sum.torque]);
        });
        table(py, out, (count, 3))
    })
}

/// The point at which a force element acts on a body, or the origin of the body: (n_t, 2), global, m.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn force_place<'py>(
    py: Python<'py>,
    model: &PyModel,
    name: &str,
    on: &str,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
) -> PyResult<Table<'py>> {
    guard("force_place", || {
        let model = &*model.model;
        let k = model.force(name).ok_or_else(|| unknown(py, "force", name))?;
        let body = one_of(py, model, &model.forces[k].bodies, name, on)?;
        let states = Rates::read(py, model, &t, &q, &v)?;
        let (count, n_z) = (states.t.len(), model.layout.n_z);
        let z = rows(py, "z", &z, (count, n_z))?;
        let mut out = Vec::with_capacity(2 * count);
        states.each(model, |at, t, motions| {
            let acting = Acting { z: &z[at * n_z..(at + 1) * n_z], lam: None, t };
            let place = actions::place(model, k, body, motions, acting);
            out.extend([place.x, place.y]);
        });
        table(py, out, (count, 2))
    })
}

/// The results of a force element other than its wrenches: (n_t, n).
#[pyfunction]
#[pyo3(signature = (model, name, t, q, v, z, lam))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn force_results<'py>(
    py: Python<'py>,
    model: &PyModel,
    name: &str,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
    lam: Rows<'py>,
) -> PyResult<Table<'py>> {
    guard("force_results", || {
        let model = &*model.model;
        let k = model.force(name).ok_or_else(|| unknown(py, "force", name))?;
        let states = Rates::read(py, model, &t, &q, &v)?;
        let (count, n_z, m) = (states.t.len(), model.layout.n_z, model.n_multipliers());
        let z = rows(py, "z", &z, (count, n_z))?;
        let lam = rows(py, "lam", &lam, (count, m))?;
        let width = model.forces[k].element.result_quantities().len();
        let mut out = vec![0.0; width * count];
        states.each(model, |at, t, motions| {
            let lam = Some(&lam[at * m..(at + 1) * m]);
            let acting = Acting { z: &z[at * n_z..(at + 1) * n_z], lam, t };
            forces::results(model, k, motions, acting, &mut out[at * width..(at + 1) * width]);
        });
        table(py, out, (count, width))
    })
}

/// Energy that a force element stores, and power that it dissipates: (n_t, 2).
#[pyfunction]
#[pyo3(signature = (model, name, t, q, v, z, lam=None))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn force_energy<'py>(
    py: Python<'py>,
    model: &PyModel,
    name: &str,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
    lam: Option<Rows<'py>>,
) -> PyResult<Table<'py>> {
    guard("force_energy", || {
        let model = &*model.model;
        let k = model.force(name).ok_or_else(|| unknown(py, "force", name))?;
        let states = Rates::read(py, model, &t, &q, &v)?;
        let (count, n_z, m) = (states.t.len(), model.layout.n_z, model.n_multipliers());
        let z = rows(py, "z", &z, (count, n_z))?;
        let lam = lam.map(|lam| rows(py, "lam", &lam, (count, m))).transpose()?;
        let mut out = Vec::with_capacity(2 * count);
        states.each(model, |at, t, motions| {
            let lam = lam.as_ref().map(|lam| &lam[at * m..(at + 1) * m]);
            let acting = Acting { z: &z[at * n_z..(at + 1) * n_z], lam, t };
            out.push(forces::potential(model, k, motions, acting));
            out.push(forces::dissipated(model, k, motions, acting));
        });
        table(py, out, (count, 2))
    })
}

/// The matrices and right sides of the equations at a state. `set` adds rows of drivers as in assembly.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, set))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn matrices<'py>(
    py: Python<'py>,
    model: &PyModel,
    t: f64,
    q: Row<'py>,
    v: Row<'py>,
    z: Row<'py>,
    set: &str,
) -> PyResult<Bound<'py, PyDict>> {
    guard("matrices", || {
        let state = state(py, &model.model, t, [&q, &v, &z])?;
        let set = targets(py, model, "set", set)?;
        let active = model.active.prepared.model();
        let extended = holding(active, &Request { set, t, ..Request::default() });
        let all = kempe::equations::dense::matrices(&extended, t, [&state.q, &state.v, &state.z]);
        let (n, m) = (extended.layout.n_q, extended.layout.n_rows);
        let out = PyDict::new(py);
        out.set_item("M", table(py, all.mass, (n, n))?)?;
        out.set_item("Phi_q", table(py, all.jacobian, (m, n))?)?;
        out.set_item("kkt", table(py, all.kkt, (n + m, n + m))?)?;
        let columns = [("Phi", all.phi), ("nu", all.nu), ("gamma", all.gamma), ("Q", all.forces)];
        for (name, column) in columns {
            let length = column.len();
            let column = table(py, column, (1, length))?.reshape([length])?;
            out.set_item(name, column)?;
        }
        Ok(out)
    })
}
