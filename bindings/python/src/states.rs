//! States in rows, and what follows from them.

use crate::convert::{refuse, rows, table, write, Row, Rows};
use crate::guard::guard;
use crate::measures::measure_at;
use crate::model::{stretches, PyModel, WrittenMode};
use crate::names::{constraint, force, frame_named, one_of, unknown};
use crate::respond::{energies, missing, responses, Table};
use kempe::analyses::dynamics::{self as core, friction_modes, shared_loads};
use kempe::analyses::{not_unique, NotUnique};
use kempe::elements::{BodyId, Mode};
use kempe::equations::actions::{self, each_action};
use kempe::equations::forces::{self, Acting};
use kempe::equations::kinematics::Motions;
use kempe::equations::measured::{measured, offered, ElementId};
use kempe::equations::newton_euler::balances;
use kempe::equations::{constraints, reactions};
use kempe::integrate::Flow;
use kempe::math::Wrench;
use kempe::model::{ForceMode, Model};
use kempe::stabilize::Projection;
use numpy::PyArray1;
use pyo3::prelude::*;

/// States of a model in rows, with accelerations and multipliers where they are known.
#[pyclass(name = "States", module = "kempe._core", frozen)]
pub struct PyStates {
    model: Py<PyModel>,
    t: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    z: Vec<f64>,
    a: Option<Vec<f64>>,
    lam: Option<Vec<f64>>,
}

impl PyStates {
    fn compiled(&self) -> &Model {
        &self.model.get().model
    }

    fn rows(&self) -> core::States<'_> {
        core::States { t: &self.t, q: &self.q, v: &self.v, z: &self.z }
    }

    /// Checks that the multipliers are known.
    fn multipliers(&self, py: Python<'_>) -> PyResult<()> {
        self.lam.as_ref().map(drop).ok_or_else(|| refuse(py, "lam", "is needed".to_string()))
    }

    /// Calls `visit` with the motion of all bodies at each state.
    fn visit(&self, mut visit: impl FnMut(usize, &Motions, Acting<'_, f64>)) {
        let layout = &self.compiled().layout;
        let (n, n_z, m) = (layout.n_q, layout.n_z, self.compiled().n_multipliers());
        let mut motions = Motions::new(layout);
        for (k, &t) in self.t.iter().enumerate() {
            let own = k * n..(k + 1) * n;
            motions.place(layout, &self.q[own.clone()], &self.v[own]);
            let lam = self.lam.as_ref().map(|lam| &lam[k * m..(k + 1) * m]);
            visit(k, &motions, Acting { z: &self.z[k * n_z..(k + 1) * n_z], lam, t });
        }
    }

    /// A table of `width` columns. `fill` fills the row of each state.
    fn each<'py>(
        &self,
        py: Python<'py>,
        width: usize,
        mut fill: impl FnMut(usize, &Motions, Acting<'_, f64>, &mut [f64]),
    ) -> PyResult<Table<'py>> {
        let mut out = vec![0.0; width * self.t.len()];
        self.visit(|k, motions, acting| {
            fill(k, motions, acting, &mut out[k * width..(k + 1) * width]);
        });
        table(py, out, (self.t.len(), width))
    }

    /// A joint or driver, and the body `on`, on which it must act.
    fn touched(&self, py: Python<'_>, joint: &str, on: &str) -> PyResult<(usize, BodyId)> {
        let k = constraint(py, self.compiled(), joint)?;
        let all: Vec<BodyId> = reactions::touched(self.compiled(), k).collect();
        Ok((k, one_of(py, self.compiled(), &all, joint, on)?))
    }

    /// A force element, and the body `on`, on which it must act.
    fn acted(&self, py: Python<'_>, name: &str, on: &str) -> PyResult<(usize, BodyId)> {
        let k = force(py, self.compiled(), name)?;
        Ok((k, one_of(py, self.compiled(), &self.compiled().forces[k].bodies, name, on)?))
    }
}

#[pymethods]
impl PyStates {
    #[new]
    #[pyo3(signature = (model, t, q, v, z, a=None, lam=None))]
    #[allow(clippy::too_many_arguments)] // the arguments of Python
    fn new<'py>(
        py: Python<'py>,
        model: Py<PyModel>,
        t: Row<'py>,
        q: Rows<'py>,
        v: Rows<'py>,
        z: Rows<'py>,
        a: Option<Rows<'py>>,
        lam: Option<Rows<'py>>,
    ) -> PyResult<Self> {
        guard("States", || {
            let compiled = &model.get().model;
            let (n, n_z) = (compiled.layout.n_q, compiled.layout.n_z);
            let (t, m) = (t.as_array().to_vec(), compiled.n_multipliers());
            let read = |name, given: &Rows<'py>, width| rows(py, name, given, (t.len(), width));
            let (q, v, z) = (read("q", &q, n)?, read("v", &v, n)?, read("z", &z, n_z)?);
            let a = a.map(|a| read("a", &a, n)).transpose()?;
            let lam = lam.map(|lam| read("lam", &lam, m)).transpose()?;
            Ok(Self { model, t, q, v, z, a, lam })
        })
    }

    /// Accelerations, multipliers and regularity. With `passing`, also near singular positions.
    fn evaluate<'py>(&self, py: Python<'py>, passing: bool) -> PyResult<[Table<'py>; 3]> {
        guard("States.evaluate", || {
            let active = &self.model.get().active;
            let [a, lam, regularity] = responses(py, active, self.rows(), passing)?;
            let table = |values, width| table(py, values, (self.t.len(), width));
            let (n, m) = (self.compiled().layout.n_q, active.n_multipliers());
            Ok([table(a, n)?, table(lam, m)?, table(regularity, 1)?])
        })
    }

    /// q and v, projected like reported states.
    fn project<'py>(&self, py: Python<'py>, tolerance: f64) -> PyResult<[Table<'py>; 2]> {
        guard("States.project", || {
            let projection = Projection { tolerance };
            let active = &self.model.get().active;
            let found = py.detach(|| active.prepared.project(self.rows(), projection));
            let [q, v] = found.map_err(|failure| missing(py, failure.reason))?;
            let shape = (self.t.len(), self.compiled().layout.n_q);
            Ok([table(py, q, shape)?, table(py, v, shape)?])
        })
    }

    /// Energies, with the works up to the states.
    fn energies<'py>(&self, py: Python<'py>, works: Rows<'py>) -> PyResult<Table<'py>> {
        guard("States.energies", || {
            let shape = (self.t.len(), self.compiled().layout.n_works);
            let works = rows(py, "works", &works, shape)?;
            let found = energies(py, &self.model.get().active, self.rows(), &works)?;
            table(py, found, (self.t.len(), core::ENERGIES))
        })
    }

    /// The position quantities of an element with their rates and accelerations: (n_t, 3 per quantity).
    fn measured<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Table<'py>> {
        guard("States.measured", || {
            let (model, n) = (self.compiled(), self.compiled().layout.n_q);
            let constraint = model.constraint(name).map(ElementId::Constraint);
            let id = constraint.or_else(|| model.force(name).map(ElementId::Force));
            let id = id.ok_or_else(|| unknown(py, "element", name))?;
            let still = vec![0.0; n];
            self.each(py, 3 * offered(model, id).len(), |k, motions, _, out| {
                let a = self.a.as_ref().map_or(&still[..], |a| &a[k * n..(k + 1) * n]);
                for (of, jet) in out.chunks_mut(3).zip(measured(model, id, motions, a)) {
                    of.copy_from_slice(&[jet.value, jet.rate, jet.second]);
                }
            })
        })
    }

    /// Φ and Φ_q q̇ + Φ_t.
    fn residual<'py>(&self, py: Python<'py>) -> PyResult<[Table<'py>; 2]> {
        guard("States.residual", || {
            let active = &self.model.get().active;
            let model = &*active.meshed(&self.t, &self.q);
            let (m, count) = (model.layout.n_rows, self.t.len());
            let [mut phi, mut rate, mut gamma] = [count * m, count * m, m].map(|n| vec![0.0; n]);
            self.visit(|k, motions, Acting { t, .. }| {
                let row = k * m..(k + 1) * m;
                let (phi, rate) = (&mut phi[row.clone()], &mut rate[row]);
                constraints::velocity_terms(model, motions, t, phi, rate, &mut gamma);
            });
            let all = |of| table(py, active.expand_rows(of, count), (count, active.n_rows()));
            Ok([all(phi)?, all(rate)?])
        })
    }

    /// Force, and torque about the joint point, that a joint or driver exerts on a body.
    fn reaction<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
        on: &str,
        frame: &str,
    ) -> PyResult<Table<'py>> {
        guard("States.reaction", || {
            let (frame, model) = (frame_named(py, frame)?, self.compiled());
            let (k, body) = self.touched(py, joint, on)?;
            self.multipliers(py)?;
            self.each(py, 3, |_, motions, acting, out| {
                let found = actions::reaction(model, k, body, frame, motions, acting);
                write(found.unwrap_or_else(Wrench::zero), out);
            })
        })
    }

    /// The impulse of a joint, driver, stop or contact on a body, with impulses as multipliers: N·s, and N·m·s about
    /// the joint point, or about the origin of the body for a stop or contact.
    fn impulse<'py>(&self, py: Python<'py>, name: &str, on: &str) -> PyResult<Table<'py>> {
        guard("States.impulse", || {
            let model = self.compiled();
            let rests = |k: usize| model.forces[k].held_row.is_some();
            if model.constraint(name).is_some() || !model.force(name).is_some_and(rests) {
                return self.reaction(py, name, on, "global");
            }
            let (k, body) = self.acted(py, name, on)?;
            self.multipliers(py)?;
            self.each(py, 3, |_, motions, acting, out| {
                let mode = Mode::Holds(forces::side(model, k, motions, acting));
                let modes = model.whole(k).map(|k| ForceMode::new(k, mode));
                let resting = model.marked(&modes.collect::<Vec<_>>());
                let mut sum = Wrench::zero();
                each_action(&resting, k, motions, acting, |_, at, wrench| {
                    if at == body {
                        sum = sum + wrench;
                    }
                });
                write(sum, out);
            })
        })
    }

    /// The point of application of the reaction of a joint or driver on a body: (n_t, 2), global, m.
    fn place<'py>(&self, py: Python<'py>, joint: &str, on: &str) -> PyResult<Table<'py>> {
        guard("States.place", || {
            let (k, body) = self.touched(py, joint, on)?;
            self.each(py, 2, |_, motions, Acting { t, .. }, out| {
                let place = reactions::place(self.compiled(), k, body, motions, t);
                out.copy_from_slice(&[place.x, place.y]);
            })
        })
    }

    /// The results of a joint other than its reaction, such as the normal force of a roller: (n_t, n).
    fn results<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Table<'py>> {
        guard("States.results", || {
            let model = self.compiled();
            let k = constraint(py, model, joint)?;
            self.multipliers(py)?;
            let width = model.constraints[k].element.result_quantities().len();
            self.each(py, width, |_, motions, acting, out| {
                actions::results_of_joint(model, k, motions, acting, out);
            })
        })
    }

    /// Force, and torque about its place, that a force element or one of its parts exerts on a body.
    fn force<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        on: &str,
        part: Option<&str>,
        frame: &str,
    ) -> PyResult<Table<'py>> {
        guard("States.force", || {
            let in_body = frame_named(py, frame)? != reactions::Frame::Global;
            let (k, body) = self.acted(py, name, on)?;
            let (model, parts) = (self.compiled(), self.compiled().forces[k].element.parts());
            let place = |part| parts.iter().position(|of| of.name == part);
            let wanted = part.map(|part| place(part).ok_or_else(|| unknown(py, "part", part)));
            let wanted = wanted.transpose()?;
            self.each(py, 3, |_, motions, acting, out| {
                let mut sum = Wrench::zero();
                each_action(model, k, motions, acting, |part, at, wrench| {
                    if at == body && wanted.is_none_or(|wanted| wanted == part) {
                        sum = sum + wrench;
                    }
                });
                write(sum, out);
                if in_body {
                    let turned = motions[body.0].pose.rotation.inverse(sum.force);
                    out[..2].copy_from_slice(&[turned.x, turned.y]);
                }
            })
        })
    }

    /// The point at which a force element acts on a body, or the origin of the body: (n_t, 2), global, m.
    fn force_place<'py>(&self, py: Python<'py>, name: &str, on: &str) -> PyResult<Table<'py>> {
        guard("States.force_place", || {
            let (k, body) = self.acted(py, name, on)?;
            self.each(py, 2, |_, motions, acting, out| {
                let place = actions::place(self.compiled(), k, body, motions, acting);
                out.copy_from_slice(&[place.x, place.y]);
            })
        })
    }

    /// The results of a force element other than its wrenches: (n_t, n).
    fn force_results<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Table<'py>> {
        guard("States.force_results", || {
            let (model, k) = (self.compiled(), force(py, self.compiled(), name)?);
            self.multipliers(py)?;
            let width = model.forces[k].element.result_quantities().len();
            self.each(py, width, |_, motions, acting, out| {
                actions::results(model, k, motions, acting, out);
            })
        })
    }

    /// Energy that a force element stores, and power that it dissipates: (n_t, 2).
    fn force_energy<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Table<'py>> {
        guard("States.force_energy", || {
            let (model, k) = (self.compiled(), force(py, self.compiled(), name)?);
            self.each(py, 2, |_, motions, acting, out| {
                out[0] = actions::stored(model, k, motions, acting);
                out[1] = actions::dissipated(model, k, motions, acting);
            })
        })
    }

    /// The balance of each moving body: |Σ F - m a|, |Σ M - J α|, the largest force and moment, and the largest arm;
    /// then of each internal coordinate: |Σ λ ∂Φ/∂u|, the largest term and the largest |∂Φ/∂u|.
    fn newton_euler<'py>(&self, py: Python<'py>) -> PyResult<Table<'py>> {
        guard("States.newton_euler", || {
            let (model, layout) = (self.compiled(), &self.compiled().layout);
            self.multipliers(py)?;
            let a = self.a.as_deref().ok_or_else(|| refuse(py, "a", "is needed".to_string()))?;
            let own = layout.n_q - layout.bodies.iter().map(|body| body.count).sum::<usize>();
            let (n, width) = (layout.n_q, 5 * (model.bodies.len() - 1) + 3 * own);
            self.each(py, width, |k, motions, acting, out| {
                let at = balances(model, motions, &a[k * n..(k + 1) * n], acting);
                let of_bodies = at.bodies.iter().flat_map(|of| {
                    [of.force, of.moment, of.largest_force, of.largest_moment, of.lever]
                });
                let of = at.coordinates.iter();
                let own = of.flat_map(|of| [of.effort, of.largest_effort, of.lever]);
                out.iter_mut().zip(of_bodies.chain(own)).for_each(|(to, x)| *to = x);
            })
        })
    }

    /// The modes of friction, as at the start of a run: the first row of each stretch of rows with the same modes, and
    /// these. Empty where all friction moves.
    fn friction_modes(&self, py: Python<'_>) -> PyResult<Vec<(usize, Vec<WrittenMode>)>> {
        guard("States.friction_modes", || {
            let active = self.model.get().active.prepared.model();
            let found = friction_modes(active, [&self.t, &self.q, &self.v, &self.z]);
            found.map(|of| stretches(&of)).map_err(|failure| missing(py, failure.reason))
        })
    }

    /// The least and the largest multipliers while drivers hold friction at rest, (n_t, m) each. None if no friction is
    /// at rest in this way.
    fn friction_range<'py>(
        &self,
        py: Python<'py>,
        passing: bool,
    ) -> PyResult<Option<[Table<'py>; 2]>> {
        guard("States.friction_range", || {
            let (active, states) = (&self.model.get().active, self.rows());
            let solved = active.prepared.accelerations(states, passing, |_| Flow::Continue);
            let solved = solved.map_err(|failure| missing(py, failure.reason))?;
            let model = active.prepared.model();
            let found = kempe::analyses::friction_range(model, states, passing, &solved.lam);
            let found = found.map_err(|failure| missing(py, failure.reason))?;
            let (count, m) = (self.t.len(), active.n_multipliers());
            let all = |lam: Vec<f64>| table(py, active.expand(lam, count), (count, m));
            found.map(|[low, high]| Ok([all(low)?, all(high)?])).transpose()
        })
    }

    /// The names of what has no unique load at a state: of redundant equations, of second order, and shared at rest.
    fn not_unique(&self) -> PyResult<[Vec<String>; 3]> {
        guard("States.not_unique", || {
            let (active, marked) = (&**self.model.get().active.prepared.model(), self.compiled());
            let open = marked.without(&self.model.get().setting().released).marked(&[]);
            let (n, n_z, mut found) =
                (open.layout.n_q, open.layout.n_z, <[Vec<String>; 3]>::default());
            for (k, t) in self.t.iter().enumerate() {
                let rows = [(&self.q, n), (&self.v, n), (&self.z, n_z)];
                let [q, v, z] = rows.map(|(all, n)| &all[k * n..(k + 1) * n]);
                let NotUnique { redundant, second_order } = not_unique(active, *t, q);
                let name = |k: &usize| active.constraints[*k].name.clone();
                found[0].extend(redundant.iter().map(name));
                found[1].extend(second_order.iter().map(name));
                found[2].extend(shared_loads(&open, &marked.blueprint.modes, *t, [q, v, z]));
            }
            Ok(found)
        })
    }

    /// The values of a measure, from accelerations and multipliers if it needs them.
    fn measure<'py>(&self, py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        guard("States.measure", || {
            let solved = self.a.as_deref().zip(self.lam.as_deref()).map(|(a, lam)| [a, lam]);
            measure_at(py, self.model.get(), text, self.rows(), solved)
        })
    }
}
