//! Quantities that the rest of the mechanism must hold for some joints, such as the centre distance of gears.

use crate::elements::derive::{columns_of, participants};
use crate::elements::{At, Required};
use crate::equations::augmented::Augmented;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::{Listed, Motion, Pose};
use crate::model::{column_scales, ConstraintItem, Model};

/// Largest relative deviation from the required value.
const NEAR: f64 = 1e-6;
/// Largest part of the gradient of a held quantity along admissible motions, as a fraction of the gradient.
const HELD: f64 = 1e-6;
/// Damping for dependent rows, see [`super::closing`].
const REDUNDANT: f64 = 1e-9;

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

/// The first quantity that differs from its required value at `q`.
pub(super) fn missed(model: &Model, t: f64, q: &[f64]) -> Option<Unmet> {
    let motions = Motions::at_rest(&model.layout, q);
    model.constraints.iter().find_map(|item| {
        let all = required(item, &motions, t).into_iter();
        all.filter_map(|required| wrong(item, &required)).next()
    })
}

/// The first quantity that the mechanism does not hold at `q`, because it changes in an admissible motion.
pub(super) fn loose(model: &Model, t: f64, q: &[f64]) -> Option<Unmet> {
    let motions = Motions::at_rest(&model.layout, q);
    let needs = |item: &&ConstraintItem| !required(item, &motions, t).is_empty();
    let mut needing = model.constraints.iter().filter(needs).peekable();
    needing.peek()?;
    let projection = AdmissibleProjection::new(model, &motions, t)?;
    needing.find_map(|item| {
        let all = required(item, &motions, t);
        let free = gradients(model, item, &motions, t).into_iter().map(|g| projection.free(&g));
        let (required, _) = all.into_iter().zip(free).find(|(_, free)| *free > HELD)?;
        Some(Unmet {
            name: item.name.clone(),
            gap: 0.0,
            message: format!(
                "joint {}: the mechanism does not hold the {}",
                item.name, required.what
            ),
            hint: required.remedy,
        })
    })
}

fn required(item: &ConstraintItem, motions: &[Motion], t: f64) -> Vec<Required<f64>> {
    let bodies: Vec<Pose> = item.bodies.iter().map(|b| motions[b.0].pose).list();
    item.element.requires(&At { bodies: &bodies, own: &[], t })
}

fn wrong(item: &ConstraintItem, required: &Required<f64>) -> Option<Unmet> {
    let Required { what, is, must, remedy } = required;
    let (wrong, needed) = match must {
        Some(must) => ((is - must).abs() > NEAR * must.abs(), format!("be {must:.6} m")),
        None => (*is <= f64::MIN_POSITIVE, "be > 0".to_string()),
    };
    wrong.then(|| Unmet {
        name: item.name.clone(),
        gap: must.map_or(0.0, |must| (is - must).abs()),
        message: format!("joint {}: the {what} is {is:.6} m; must {needed}", item.name),
        hint: remedy,
    })
}

/// The derivatives of the required quantities with respect to the coordinates, shape (n_q) each.
fn gradients(model: &Model, item: &ConstraintItem, motions: &[Motion], t: f64) -> Vec<Vec<f64>> {
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

/// The projection onto the admissible motions, Φ_q v = 0.
struct AdmissibleProjection {
    matrix: Augmented,
    /// Squares of the scales of the coordinates.
    squares: Vec<f64>,
    rows: usize,
}

impl AdmissibleProjection {
    fn new(model: &Model, motions: &Motions, t: f64) -> Option<Self> {
        let rows = model.layout.n_rows;
        let squares: Vec<f64> = column_scales(model).iter().map(|scale| scale * scale).list();
        let weights: Vec<f64> = squares.iter().map(|square| 1.0 / square).list();
        let mut matrix = Augmented::new(model);
        matrix.set_weights(&weights);
        constraints::jacobian(model, motions, t, matrix.jacobian_mut());
        let factored = [0.0, REDUNDANT].into_iter().any(|damping| {
            matrix.set_damping((0..rows).map(|_| damping));
            matrix.factor().is_ok()
        });
        factored.then_some(Self { matrix, squares, rows })
    }

    /// The fraction of a gradient that the constraints leave free, 0 to 1.
    fn free(&self, gradient: &[f64]) -> f64 {
        let mut x = gradient.to_vec();
        x.resize(gradient.len() + self.rows, 0.0);
        self.matrix.solve(&mut x);
        let left = x.iter().zip(&self.squares).map(|(v, square)| v * v / square).sum::<f64>();
        let whole = gradient.iter().zip(&self.squares).map(|(g, s)| g * g * s).sum::<f64>();
        (left / whole).sqrt()
    }
}
