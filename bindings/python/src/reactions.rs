//! Reactions at given states, and the balance of each body.

use crate::convert::{rows, table, Row, Rows};
use crate::evaluate::{frame_named, one_of, unknown, Rates};
use crate::guard::guard;
use crate::model::{written_modes, PyModel, WrittenMode};
use crate::respond::{missing, Table};
use kempe::analyses::dynamics::{friction_modes as friction_modes_of, States};
use kempe::elements::{BodyId, Mode};
use kempe::equations::actions::each_action;
use kempe::equations::forces::{self, Acting};
use kempe::equations::newton_euler::balances;
use kempe::equations::reactions;
use kempe::integrate::Flow;
use kempe::math::Wrench;
use kempe::model::{ForceMode, Model};
use pyo3::prelude::*;
use std::collections::BTreeSet;

/// The body `on`, which must belong to the joint or driver.
fn touched(py: Python<'_>, model: &Model, k: usize, on: &str) -> PyResult<BodyId> {
    let all: Vec<BodyId> = reactions::touched(model, k).collect();
    one_of(py, model, &all, &model.constraints[k].name, on)
}

/// Force, and torque about the joint point, that a joint or driver exerts on a body.
#[pyfunction]
#[pyo3(signature = (model, joint, on, frame, t, q, lam))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn reaction<'py>(
    py: Python<'py>,
    model: &PyModel,
    joint: &str,
    on: &str,
    frame: &str,
    t: Row<'py>,
    q: Rows<'py>,
    lam: Rows<'py>,
) -> PyResult<Table<'py>> {
    guard("reaction", || {
        let model = &*model.model;
        let k = model.constraint(joint).ok_or_else(|| unknown(py, "joint or driver", joint))?;
        let frame = frame_named(py, frame)?;
        let body = touched(py, model, k, on)?;
        let states = Rates::read(py, model, &t, &q, &q)?;
        let m = model.n_multipliers();
        let lam = rows(py, "lam", &lam, (states.t.len(), m))?;
        let own = model.layout.constraints[k].rows.clone();
        let mut out = Vec::with_capacity(3 * states.t.len());
        states.each(model, |at, t, motions| {
            let lam = &lam[at * m..][own.clone()];
            let found = reactions::reaction(model, k, body, frame, motions, t, lam);
            let w = found.unwrap_or_else(Wrench::zero);
            out.extend([w.force.x, w.force.y, w.torque]);
        });
        table(py, out, (states.t.len(), 3))
    })
}

/// The impulse of a joint, driver, stop or contact on a body at impacts: force times time, and torque times time
/// about the joint point, or about the origin of the body for a stop or contact.
#[pyfunction]
#[pyo3(signature = (model, name, on, t, q, impulses))]
pub fn impulse<'py>(
    py: Python<'py>,
    model: &PyModel,
    name: &str,
    on: &str,
    t: Row<'py>,
    q: Rows<'py>,
    impulses: Rows<'py>,
) -> PyResult<Table<'py>> {
    guard("impulse", || {
        let known = model.model.force(name).filter(|k| model.model.forces[*k].held_row.is_some());
        let Some(k) = known else {
            return reaction(py, model, name, on, "global", t, q, impulses);
        };
        let model = &*model.model;
        let states = Rates::read(py, model, &t, &q, &q)?;
        let (m, mut out) = (model.n_multipliers(), Vec::new());
        let impulses = rows(py, "impulses", &impulses, (states.t.len(), m))?;
        let body = one_of(py, model, &model.forces[k].bodies, name, on)?;
        let z = vec![0.0; model.layout.n_z];
        states.each(model, |at, t, motions| {
            let acting = Acting { z: &z, lam: Some(&impulses[at * m..(at + 1) * m]), t };
            let mode = Mode::Holds(forces::side(model, k, motions, acting));
            let resting = model.marked(&[ForceMode::new(k, mode)]);
            let mut sum = Wrench::zero();
            each_action(&resting, k, motions, acting, |_, on, wrench| {
                if on == body {
                    sum = sum + wrench;
                }
            });
            out.extend([sum.force.x, sum.force.y, sum.torque]);
        });
        table(py, out, (states.t.len(), 3))
    })
}

/// The point of application of the reaction of a joint or driver on a body: (n_t, 2), global, m.
#[pyfunction]
#[pyo3(signature = (model, joint, on, t, q))]
pub fn place<'py>(
    py: Python<'py>,
    model: &PyModel,
    joint: &str,
    on: &str,
    t: Row<'py>,
    q: Rows<'py>,
) -> PyResult<Table<'py>> {
    guard("place", || {
        let model = &*model.model;
        let k = model.constraint(joint).ok_or_else(|| unknown(py, "joint or driver", joint))?;
        let body = touched(py, model, k, on)?;
        let states = Rates::read(py, model, &t, &q, &q)?;
        let mut out = Vec::with_capacity(2 * states.t.len());
        states.each(model, |_, t, motions| {
            let p = reactions::place(model, k, body, motions, t);
            out.extend([p.x, p.y]);
        });
        table(py, out, (states.t.len(), 2))
    })
}

/// The balance of each moving body: |Σ F - m a|, |Σ M - J α|, the largest single force and moment, and the largest
/// lever arm; then of each internal coordinate: |Σ λ ∂Φ/∂u|, the largest term and the largest |∂Φ/∂u|,
/// (n_t, 5 n_bodies + 3 n_coordinates).
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, a, lam))]
#[allow(clippy::too_many_arguments)] // the arguments of Python
pub fn newton_euler<'py>(
    py: Python<'py>,
    model: &PyModel,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
    a: Rows<'py>,
    lam: Rows<'py>,
) -> PyResult<Table<'py>> {
    guard("newton_euler", || {
        let model = &*model.model;
        let states = Rates::read(py, model, &t, &q, &v)?;
        let count = states.t.len();
        let (n, n_z, m) = (model.layout.n_q, model.layout.n_z, model.n_multipliers());
        let z = rows(py, "z", &z, (count, n_z))?;
        let a = rows(py, "a", &a, (count, n))?;
        let lam = rows(py, "lam", &lam, (count, m))?;
        let mut out = Vec::new();
        states.each(model, |k, t, motions| {
            let lam = Some(&lam[k * m..(k + 1) * m]);
            let acting = Acting { z: &z[k * n_z..(k + 1) * n_z], lam, t };
            let at = balances(model, motions, &a[k * n..(k + 1) * n], acting);
            for of in at.bodies {
                out.extend([of.force, of.moment, of.largest_force, of.largest_moment, of.lever]);
            }
            for of in at.coordinates {
                out.extend([of.effort, of.largest_effort, of.lever]);
            }
        });
        let width = out.len().checked_div(count).unwrap_or(0);
        table(py, out, (count, width))
    })
}

/// The modes of friction at states, as at the start of a run: the first row of each stretch of rows with the same
/// modes, and these. Empty where all friction moves.
#[pyfunction]
pub fn friction_modes<'py>(
    py: Python<'py>,
    model: &PyModel,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
) -> PyResult<Vec<(usize, Vec<WrittenMode>)>> {
    guard("friction_modes", || {
        let active = model.active.prepared.model();
        let (layout, count) = (&active.layout, t.as_array().len());
        let t = t.as_array().to_vec();
        let [q, v] =
            [rows(py, "q", &q, (count, layout.n_q))?, rows(py, "v", &v, (count, layout.n_q))?];
        let z = rows(py, "z", &z, (count, layout.n_z))?;
        let found = friction_modes_of(active, [&t, &q, &v, &z]);
        let found = found.map_err(|failure| missing(py, failure.reason))?;
        let mut stretches: Vec<(usize, Vec<ForceMode>)> = Vec::new();
        let alike = |a: &[ForceMode], b: &[ForceMode]| {
            a.iter().map(|of| (of.force, of.mode)).eq(b.iter().map(|of| (of.force, of.mode)))
        };
        for (row, modes) in found.into_iter().enumerate() {
            if stretches.last().is_none_or(|(_, last)| !alike(last, &modes)) {
                stretches.push((row, modes));
            }
        }
        Ok(stretches.into_iter().map(|(row, modes)| (row, written_modes(&modes))).collect())
    })
}

/// The least and the largest multipliers at states while drivers hold friction at rest, (n_t, m) each. None if no
/// friction is at rest in this way.
#[pyfunction]
#[pyo3(signature = (model, t, q, v, z, passing))]
pub fn friction_range<'py>(
    py: Python<'py>,
    model: &PyModel,
    t: Row<'py>,
    q: Rows<'py>,
    v: Rows<'py>,
    z: Rows<'py>,
    passing: bool,
) -> PyResult<Option<(Table<'py>, Table<'py>)>> {
    guard("friction_range", || {
        let active = &model.active;
        let (layout, count) = (&model.model.layout, t.as_array().len());
        let t = t.as_array().to_vec();
        let [q, v] =
            [rows(py, "q", &q, (count, layout.n_q))?, rows(py, "v", &v, (count, layout.n_q))?];
        let z = rows(py, "z", &z, (count, layout.n_z))?;
        let states = States { t: &t, q: &q, v: &v, z: &z };
        let solved = active.prepared.accelerations(states, passing, |_| Flow::Continue);
        let solved = solved.map_err(|failure| missing(py, failure.reason))?;
        let found =
            kempe::analyses::friction_range(active.prepared.model(), states, passing, &solved.lam);
        let found = found.map_err(|failure| missing(py, failure.reason))?;
        let Some([low, high]) = found else { return Ok(None) };
        let all =
            |lam: Vec<f64>| table(py, active.expand(lam, count), (count, active.n_multipliers()));
        Ok(Some((all(low)?, all(high)?)))
    })
}

/// The names of the joints and drivers without a unique reaction at one of the states.
#[pyfunction]
#[pyo3(signature = (model, t, q))]
pub fn not_unique(
    py: Python<'_>,
    model: &PyModel,
    t: Row<'_>,
    q: Rows<'_>,
) -> PyResult<Vec<String>> {
    guard("not_unique", || {
        let active = &**model.active.prepared.model();
        let t = t.as_array().to_vec();
        let n = active.layout.n_q;
        let q = rows(py, "q", &q, (t.len(), n))?;
        let at =
            |(k, t): (usize, &f64)| kempe::analyses::not_unique(active, *t, &q[k * n..(k + 1) * n]);
        let found: BTreeSet<usize> = t.iter().enumerate().flat_map(at).collect();
        Ok(found.into_iter().map(|k| active.constraints[k].name.clone()).collect())
    })
}

/// The results of a joint other than its reaction, such as the normal force of a roller: (n_t, n).
#[pyfunction]
#[pyo3(signature = (model, joint, t, q, lam))]
pub fn results<'py>(
    py: Python<'py>,
    model: &PyModel,
    joint: &str,
    t: Row<'py>,
    q: Rows<'py>,
    lam: Rows<'py>,
) -> PyResult<Table<'py>> {
    guard("results", || {
        let model = &*model.model;
        let k = model.constraint(joint).ok_or_else(|| unknown(py, "joint or driver", joint))?;
        let states = Rates::read(py, model, &t, &q, &q)?;
        let (m, count) = (model.n_multipliers(), states.t.len());
        let lam = rows(py, "lam", &lam, (count, m))?;
        let own = model.layout.constraints[k].rows.clone();
        let width = model.constraints[k].element.result_quantities().len();
        let mut out = vec![0.0; width * count];
        states.each(model, |at, t, motions| {
            let lam = &lam[at * m..][own.clone()];
            let out = &mut out[at * width..(at + 1) * width];
            reactions::results(model, k, motions, t, lam, out);
        });
        table(py, out, (count, width))
    })
}
