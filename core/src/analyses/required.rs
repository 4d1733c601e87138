//! Quantities that the rest of the mechanism must hold for some joints, such as the centre distance of gears.

use super::closing::Closing;
use crate::elements::derive::{columns_of, participants};
use crate::elements::{At, BodyId, Constraint, Required};
use crate::equations::kinematics::Motions;
use crate::math::{Listed, Motion, Pose};
use crate::model::{column_scales, ForceItem, Model};

/// Largest relative deviation from the required value.
const NEAR: f64 = 1e-6;
/// Largest part of the gradient of a held quantity along admissible motions, as a fraction of the gradient.
const HELD: f64 = 1e-6;

/// A quantity that differs from its required value, or that the mechanism does not hold.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Unmet {
    /// The joint.
    pub name: String,
    /// Difference from the required value, m; zero if the quantity is not held.
    pub gap: f64,
    pub message: String,
    pub hint: &'static str,
}

/// A joint, with or without play.
#[derive(Clone, Copy)]
struct Needing<'m> {
    name: &'m str,
    bodies: &'m [BodyId],
    element: &'m Constraint,
}

fn joints(model: &Model) -> impl Iterator<Item = Needing<'_>> {
    let constraints = model.constraints.iter();
    let rigid = constraints.map(|item| Needing {
        name: &item.name,
        bodies: &item.bodies,
        element: &item.element,
    });
    rigid.chain(model.forces.iter().filter_map(|item| {
        let element = item.element.joint()?;
        Some(Needing { name: &item.name, bodies: &item.bodies, element })
    }))
}

/// The first quantity that differs from its required value at `q`.
pub(super) fn missed(model: &Model, t: f64, q: &[f64]) -> Option<Unmet> {
    let motions = Motions::at_rest(&model.layout, q);
    let of_force = |item: &ForceItem| {
        let bodies: Vec<Pose> = item.bodies.iter().map(|b| motions[b.0].pose).list();
        let required = item.element.requires(&At { bodies: &bodies, own: &[], t })?;
        wrong(&item.name, &required)
    };
    let rigid = joints(model).find_map(|item| {
        let all = required(item, &motions, t).into_iter();
        all.filter_map(|required| wrong(item.name, &required)).next()
    });
    rigid.or_else(|| model.forces.iter().find_map(of_force))
}

/// The first quantity that the mechanism does not hold at `q`, because it changes in an admissible motion.
pub(super) fn loose(model: &Model, t: f64, q: &[f64]) -> Option<Unmet> {
    let motions = Motions::at_rest(&model.layout, q);
    let needs = |item: &Needing<'_>| !required(*item, &motions, t).is_empty();
    let mut needing = joints(model).filter(needs).peekable();
    needing.peek()?;
    let mut closing = Closing::new(model, t, &|| false);
    needing.find_map(|item| {
        let all = required(item, &motions, t).into_iter();
        let gradients = gradients(model, item, &motions, t).into_iter();
        let free = |(_, gradient): &(_, Vec<f64>)| free(&mut closing, q, gradient) > HELD;
        let (required, _) = all.zip(gradients).find(free)?;
        Some(Unmet {
            name: item.name.to_string(),
            gap: 0.0,
            message: format!(
                "joint {}: the mechanism does not hold the {}",
                item.name, required.what
            ),
            hint: required.remedy,
        })
    })
}

fn required(item: Needing<'_>, motions: &[Motion], t: f64) -> Vec<Required<f64>> {
    let bodies: Vec<Pose> = item.bodies.iter().map(|b| motions[b.0].pose).list();
    item.element.requires(&At { bodies: &bodies, own: &[], t })
}

fn wrong(name: &str, required: &Required<f64>) -> Option<Unmet> {
    let Required { what, is, must, remedy } = required;
    let (wrong, needed) = match must {
        Some(must) => ((is - must).abs() > NEAR * must.abs(), format!("be {must:.6} m")),
        None => (*is <= f64::MIN_POSITIVE, "be > 0".to_string()),
    };
    wrong.then(|| Unmet {
        name: name.to_string(),
        gap: must.map_or(0.0, |must| (is - must).abs()),
        message: format!("joint {name}: the {what} is {is:.6} m; must {needed}"),
        hint: remedy,
    })
}

/// The derivatives of the required quantities with respect to the coordinates, shape (n_q) each.
fn gradients(model: &Model, item: Needing<'_>, motions: &[Motion], t: f64) -> Vec<Vec<f64>> {
    let count = required(item, motions, t).len();
    let mut all = vec![vec![0.0; model.layout.n_q]; count];
    let bodies: Vec<Motion> = item.bodies.iter().map(|b| motions[b.0]).list();
    let at = crate::elements::Moving { bodies: &bodies, own: &[], own_rates: &[], t };
    let element = item.element.lift();
    for place in 0..participants(bodies.len(), 0) {
        let mut rows = vec![[0.0; 3]; count];
        let values = |at: &At<'_, _>, out: &mut [_]| {
            let values = element.requires(at).into_iter();
            out.iter_mut().zip(values).for_each(|(out, required)| *out = required.is);
        };
        columns_of(&at, &|body| body == place, false, &values, &mut rows);
        let columns = model.layout.bodies[item.bodies[place].0];
        all.iter_mut().zip(rows).for_each(|(gradient, row)| columns.add(row, gradient));
    }
    all
}

/// The fraction of a gradient that the constraints leave free, 0 to 1.
fn free(closing: &mut Closing<'_>, q: &[f64], gradient: &[f64]) -> f64 {
    let Some([motion]) = closing.motions_under(q, &[gradient.to_vec()]) else { return 0.0 };
    let whole = gradient.iter().zip(column_scales(closing.model())).map(|(g, s)| (g * s).powi(2));
    (closing.product(&motion, &motion) / whole.sum::<f64>()).sqrt()
}
