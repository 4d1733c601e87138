//! Finds the law that has no value if a run fails because the motion is not finite.

use crate::elements::{catalogue, Group};
use crate::equations::forces::{self, Acting};
use crate::equations::held;
use crate::equations::kinematics::Motions;
use crate::expression::Tape;
use crate::math::{Listed, Wrench};
use crate::model::{Model, Variable};

/// Largest distance from the failure at which a law is evaluated, relative to 1 s + |t|. The steps of an integrator
/// shrink before the end of the law's domain.
const NEAR: f64 = 1e-5;

/// A law without a value.
pub(super) struct LawFault {
    /// The law: `torque of drive`, or `of contact touch` for that of an element itself.
    pub law: String,
    /// Whether the law is a formula.
    pub written: bool,
    /// The table that the law evaluates outside its range.
    pub table: Option<String>,
}

/// The first law that has no value near a state at time `t`. The failure is at the time `failed`.
pub(super) fn undefined_law(
    model: &Model,
    (t, failed): (f64, f64),
    [q, v, z]: [&[f64]; 3],
) -> Option<LawFault> {
    let reach = f64::max(NEAR * (1.0 + t.abs()), 2.0 * (failed - t).abs());
    let distances = (0..40).map(|k| reach * 0.5_f64.powi(39 - k));
    let beside = std::iter::once(0.0).chain(distances.flat_map(|d| [d, -d]));
    beside.into_iter().find_map(|d| {
        let moved: Vec<f64> = q.iter().zip(v).map(|(q, v)| q + d * v).list();
        // accelerations are unknown
        let faster = |x: &[f64]| x.iter().map(|x| x * (1.0 + d / (1.0 + t.abs()))).list();
        let [v, z]: [Vec<f64>; 2] = [faster(v), faster(z)];
        undefined_at(model, t + d, [&moved, &v, &z])
    })
}

fn undefined_at(model: &Model, t: f64, [q, v, z]: [&[f64]; 3]) -> Option<LawFault> {
    let motions = Motions::at(&model.layout, q, v);
    let values = held(&model.parameters, &motions, z, t);
    // None where a law has a value; otherwise the reason for its absence, if there is one
    let without = |tape: &Tape| {
        // the states of elements are unknown if only the position is known
        let known = |k: &usize| match Variable::at(*k) {
            Variable::State(k) => k < z.len(),
            Variable::Coordinate(..) | Variable::Internal { .. } => true,
            Variable::Function(_) => false,
        };
        let finite = !tape.variables().all(|k| known(&k)) || tape.evaluate(&values).is_finite();
        (!finite).then(|| tape.refusal(&values))
    };
    let constraints = model.constraints.iter().filter_map(|item| {
        let mut all = Vec::new();
        item.law.as_ref()?.visit(&mut |tape| all.push(without(tape)));
        Some((item.group, item.element.kind(), item.element.scalars(), &item.name, all))
    });
    let forces = model.forces.iter().filter_map(|item| {
        let mut all = Vec::new();
        item.law.as_ref()?.visit(&mut |tape| all.push(without(tape)));
        Some((item.element.group(), item.element.kind(), item.element.scalars(), &item.name, all))
    });
    let written = constraints.chain(forces).find_map(|(group, kind, scalars, name, all)| {
        let (k, table) = all.into_iter().enumerate().find_map(|(k, found)| Some((k, found?)))?;
        let law = format!("{} of {name}", fields(group, kind, &scalars).get(k)?);
        Some(LawFault { law, written: true, table })
    });
    written.or_else(|| {
        let acting = Acting { z, lam: None, t };
        let has_no_value = |k: &usize| {
            let (item, mut finite) = (&model.forces[*k], true);
            let known = item.law.is_none() && item.states.len() <= z.len();
            let look =
                |_, _, w: Wrench<f64>| finite &= (w.force.x + w.force.y + w.torque).is_finite();
            if known {
                forces::each_wrench(model, *k, &motions, acting, look);
            }
            !finite
        };
        let item = &model.forces[(0..model.forces.len()).find(has_no_value)?];
        let law = format!("of {} {}", item.element.kind(), item.name);
        Some(LawFault { law, written: false, table: None })
    })
}

/// The field name of each formula of an element; `scalars` are the numbers of scalars in the fields.
fn fields(group: Group, kind: &str, scalars: &[usize]) -> Vec<&'static str> {
    let declared = catalogue().into_iter().find(|(g, table)| *g == group && table.name == kind);
    let fields = declared.map(|(_, table)| table.fields).unwrap_or_default();
    fields.iter().zip(scalars).flat_map(|(field, count)| vec![field.name; *count]).list()
}
