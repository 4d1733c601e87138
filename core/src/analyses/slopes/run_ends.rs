//! The end of a run, its states and their scales, as gradients and starts read them.

use crate::analyses::dynamics::{Run, States};
use crate::analyses::measures::Measure;
use crate::analyses::sweep::PreparedModel;
use crate::analyses::AnyAnalysis;
use crate::math::Listed;
use crate::model::{column_scales, usual_energy, Model, WORKS};

/// Error of a coordinate, relative to the size of the mechanism or to a radian, above which derivatives are doubtful. Where
/// errors grow, those of derivatives are about ten times as large.
pub(super) const DOUBTFUL: f64 = 1e-4;

/// A state within a driven run.
pub(super) fn state_at(
    whole: &PreparedModel,
    run: &Run,
    t: f64,
    rests: bool,
) -> Option<[Vec<f64>; 4]> {
    let layout = &whole.model().layout;
    let known = run.trajectory.t.iter().position(|known| *known == t).map(|k| {
        let of = &run.trajectory;
        let row = |table: &[f64], width: usize| table[k * width..(k + 1) * width].to_vec();
        [row(&of.q, layout.n_q), row(&of.v, layout.n_q), row(&of.z, layout.n_z), Vec::new()]
    });
    if known.is_some() && !rests {
        return known;
    }
    let Some(dense) = &run.dense else { return known };
    let y = dense.at(&[t]);
    let [q, v, z, _] = layout.split(&y);
    let Some(projection) = run.projection else {
        return Some([q.to_vec(), v.to_vec(), z.to_vec(), Vec::new()]);
    };
    let states = States { t: &[t], q, v, z };
    let [q, v] = whole.project(states, projection).ok()?;
    Some(match (rests, known) {
        (false, _) => [q, v, z.to_vec(), Vec::new()],
        (true, Some([q, none, z, _])) => [q, none, z, v],
        (true, None) => [q, vec![0.0; v.len()], z.to_vec(), v],
    })
}

/// The function of the condition that ended a run, if one did.
///
/// # Errors
/// The condition cannot be read.
pub(super) fn ending(
    model: &Model,
    run: &Run,
    analysis: &AnyAnalysis,
) -> Result<Option<Measure>, String> {
    let (Some(name), AnyAnalysis::Dynamics(options)) = (&run.stopped_by, analysis) else {
        return Ok(None);
    };
    let event = options.events.iter().find(|event| event.name == *name);
    let text = event.map_or(options.stop.as_ref(), |event| Some(&event.condition));
    let read = text.and_then(|text| Measure::of_condition(model, text).ok());
    read.map(Some).ok_or_else(|| format!("the motion ends at {name}"))
}

/// Why a run has no derivatives; None if it has.
pub(super) fn refusal(model: &Model, run: &Run, is_driven: bool) -> Option<String> {
    let has_phases = run.phases.len() > 1 || run.settings.iter().any(|one| !one.is_plain());
    if is_driven && has_phases {
        return Some("drivers end their motion along the way".to_string());
    }
    if let Some(passed) = run.passed.first() {
        return Some(format!("the motion passes the singular position at t = {:.6} s", passed.t));
    }
    let keeps = model.forces.iter().find(|item| item.element.keeps_speed())?;
    Some(format!(
        "the damping of {} depends on the speed with which each contact begins",
        keeps.name
    ))
}

/// The ends of the steps of a run; its outputs if they are not known.
pub(super) fn steps(run: &Run) -> &[f64] {
    run.dense.as_ref().map_or(&run.trajectory.t, |dense| &dense.t)
}

/// The scale of each component of (state, derivatives of the state by the first variable, and so on). States of first
/// order have the scale of their largest value in the run.
pub(super) fn scales(model: &Model, run: &Run, sizes: &[f64]) -> Vec<f64> {
    let (of_q, n_z) = (column_scales(model), model.layout.n_z);
    let most = |k: usize| {
        let values = run.trajectory.z.iter().skip(k).step_by(n_z);
        values.fold(0.0_f64, |most, z| most.max(z.abs()))
    };
    let states = (0..n_z).map(most).map(|size| if size > 0.0 { size } else { 1.0 }).list();
    let works = vec![usual_energy(model); WORKS];
    let own = [&of_q[..], &of_q, &states, &works].concat();
    let slopes = sizes.iter().flat_map(|size| own.iter().map(move |scale| scale / size));
    own.iter().copied().chain(slopes).list()
}

/// The last state of a run, with its works.
pub(super) fn last_state(model: &Model, run: &Run) -> Vec<f64> {
    let (of, layout) = (&run.trajectory, &model.layout);
    let row = |table: &[f64], width: usize| table[table.len() - width..].to_vec();
    let parts = [
        row(&of.q, layout.n_q),
        row(&of.v, layout.n_q),
        row(&of.z, layout.n_z),
        row(&of.works, layout.n_works),
    ];
    parts.concat()
}

/// The largest distance of the coordinates of two states, relative to their scales.
pub(super) fn distance(one: &[f64], other: &[f64], scales: &[f64]) -> f64 {
    let each = one.iter().zip(other).zip(scales);
    each.map(|((a, b), scale)| (a - b).abs() / scale).fold(0.0, f64::max)
}
