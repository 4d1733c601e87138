//! Mechanisms whose equations depend on each other in every position, because an equation holds only to second order:
//! a link that is as long as the distance of two parallel guides can only stay perpendicular to them.
//!
//! If rows of Φ_q depend on each other, Σ y_k Φ_q,k = 0, velocities must also satisfy B(v, v) = Σ y_k vᵀ Φ_qq,k v = 0.
//! If B = (l·v)², then l·v = 0, and the mechanism moves as if a linear constraint with the row l were written. A sum of
//! such squares, as for three bars in line, gives one row for each. Such a constraint keeps a coordinate, or the
//! difference of two angles, whose derivative is l up to the rows of Φ_q. It is added to the model. The dependent
//! equations then follow from the others at and near this position, which is verified: they are redundant equations of
//! the extended model.

use super::closing::{Closing, Halt};
use super::dependence::{self, Dependent};
use super::freedoms::{freedoms, nearly_free};
use super::mobility::{beyond_doubt, neighbour, plain, Mobility, EXCURSIONS};
use super::second_forms::{forms, independent, lines};
use crate::elements::{holding, BodyId, Coordinate, CoordinateOf, Group};
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::expression::{Symbol, Tape};
use crate::math::{Listed, ShortArray};
use crate::model::{column_scales, Model, Variable};
use std::sync::Arc;

/// Squared rates below this part count as zero.
const EQUAL: f64 = 1e-5;
/// Largest remainder of a row that counts as dependent before a position is corrected.
const BESIDE: f64 = 1e-3;
/// Number of corrections of a position. Each squares its error.
const CORRECTIONS: usize = 3;

/// A coordinate, or the difference of the angles of two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kept {
    of: CoordinateOf,
    from: Option<BodyId>,
}

/// A model with the linear constraints that its second-order equations imply.
#[derive(Clone, Debug)]
struct SecondOrder {
    /// The model with these constraints, which follow all others.
    model: Model,
    /// The coordinates and angles that they keep, as texts.
    kept: Vec<String>,
    /// The mobility of the extended model.
    mobility: Mobility,
}

/// Mobility at an assembled position.
pub fn mobility(model: &Model, t: f64, q: &[f64]) -> Mobility {
    mobility_until(model, t, q, &|| false)
}

/// Mobility at an assembled position. The result is invalid if `stop` returned true.
pub(super) fn mobility_until(model: &Model, t: f64, q: &[f64], stop: Halt<'_>) -> Mobility {
    let mut found = plain(model, t, q, stop);
    let implied = match found.singular_equations.is_empty() {
        true => None,
        false => implied(model, t, q, &found.singular_equations, stop),
    };
    let Some(SecondOrder { kept, mobility, .. }) = implied else { return found };
    let is_singular =
        |one: &Dependent| mobility.singular_equations.iter().any(|it| it.row == one.row);
    let (singular, everywhere) = found.singular_equations.into_iter().partition(is_singular);
    found.degrees_of_freedom = mobility.degrees_of_freedom;
    found.rank = q.len() - mobility.degrees_of_freedom;
    found.singular_equations = singular;
    found.singular = mobility.singular;
    Mobility { second_order: everywhere, kept, ..found }
}

/// The implied linear constraints at a position where equations of joints depend on each other. None if the forms are
/// not sums of squares of linear forms, or if no motion is left.
fn implied(
    model: &Model,
    t: f64,
    q: &[f64],
    singular: &[Dependent],
    stop: Halt<'_>,
) -> Option<SecondOrder> {
    let moving = |k: &usize| !model.constraints[*k].driven;
    let of_joints = singular.iter().filter(|one| one.group.iter().all(moving)).list();
    let free = freedoms(model, t, q, |item| !item.driven)?;
    let kept = squares(model, &free, &forms(model, t, q, &of_joints, &free))?;
    if kept.len() >= free.len() {
        return None;
    }
    let extended = extended(model, q, &kept);
    let mobility = plain(&extended, t, q, stop);
    let redundant = mobility.redundant_equations.len();
    let follows = mobility.singular_equations.len() + of_joints.len() == singular.len();
    if !follows || is_passed([model, &extended], t, q, singular.len(), stop) {
        return None;
    }
    (redundant >= of_joints.len()).then(|| SecondOrder {
        kept: kept.iter().map(|kept| kept.name(model)).list(),
        model: extended,
        mobility,
    })
}

/// Whether fewer than `here` equations restrict the motion beside a position, on the motion that the extended model
/// permits. The equations then hold to second order at this position only, as at the change point of a parallelogram
/// with three cranks.
fn is_passed(
    [model, extended]: [&Model; 2],
    t: f64,
    q: &[f64],
    here: usize,
    stop: Halt<'_>,
) -> bool {
    (0..=EXCURSIONS)
        .filter_map(|held| neighbour(extended, t, q, held, stop))
        .any(|near| plain(model, t, &near, stop).singular_equations.len() < here)
}

/// The model with the linear constraints that its equations of second order imply at a position, if there are any.
pub(super) fn acting(model: &Model, t: f64, q: &[f64]) -> Option<Model> {
    if q.len() != model.layout.n_q || !q.iter().all(|q| q.is_finite()) {
        return None;
    }
    let never: Halt<'_> = &|| false;
    let singular = plain(model, t, q, never).singular_equations;
    implied(model, t, q, &singular, never).map(|found| found.model)
}

/// The position at which equations hold to second order, and the model with the linear constraints that they imply
/// there. Newton's method for Φ = 0 finds half of the digits of such a position. Since B is the derivative of
/// Σ y_k Φ_q,k along the freedoms, this sum vanishes after the step -B⁺ Σ y_k Φ_q,k. The drivers of `held` hold the
/// positions that are set.
pub(super) fn corrected(
    [model, held]: [&Model; 2],
    t: f64,
    q: &[f64],
    stop: Halt<'_>,
) -> Option<(Vec<f64>, Model)> {
    if beyond_doubt(model, t, q) {
        return None;
    }
    let mut near = q.to_vec();
    for _ in 0..CORRECTIONS {
        let dependent = dependence::at(held, t, &near, BESIDE, stop);
        let free = nearly_free(held, t, &near, BESIDE, &|_| true)?;
        if free.is_empty() {
            return None;
        }
        let all: Vec<&Dependent> = dependent.iter().list();
        let forms = forms(held, t, &near, &all, &free);
        let slopes = slopes(held, t, &near, &dependent, &free);
        for (w, step) in free.iter().zip(least_squares(&forms, &slopes, free.len())) {
            near.iter_mut().zip(w).for_each(|(q, w)| *q -= step * w);
        }
    }
    let all = acting(held, t, &near)?;
    let closed = Closing::new(&all, t, stop).close(&mut near).1;
    acting(model, t, &near).filter(|_| closed).map(|acting| (near, acting))
}

/// Σ y_k Φ_q,k along the freedoms, for each dependence.
fn slopes(
    model: &Model,
    t: f64,
    q: &[f64],
    dependent: &[Dependent],
    free: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let mut entries = vec![0.0; model.layout.n_entries];
    constraints::jacobian(model, &Motions::at_rest(&model.layout, q), t, &mut entries);
    let along = |one: &Dependent, w: &[f64]| {
        let terms = model.layout.positions().map(|(row, column, at)| {
            let factor = one.factors.iter().find(|(of, _)| *of == row).map_or(0.0, |(_, y)| *y);
            factor * entries[at] * w[column]
        });
        terms.sum::<f64>()
    };
    dependent.iter().map(|one| free.iter().map(|w| along(one, w)).list()).list()
}

/// The shortest x for which all B x are nearest to the given slopes, by conjugate gradients.
fn least_squares(forms: &[Vec<f64>], slopes: &[Vec<f64>], n: usize) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let times = |form: &[f64], x: &[f64]| form.chunks(n).map(|row| dot(row, x)).list();
    // Σ B² x = Σ B s
    let sum = |parts: &mut dyn Iterator<Item = Vec<f64>>| {
        parts.fold(vec![0.0; n], |sum, part| sum.iter().zip(&part).map(|(a, b)| a + b).list())
    };
    let mut rest = sum(&mut forms.iter().zip(slopes).map(|(form, slope)| times(form, slope)));
    let (mut x, mut way) = (vec![0.0; n], rest.clone());
    let first = dot(&rest, &rest);
    for _ in 0..n {
        let before = dot(&rest, &rest);
        if before <= EQUAL * EQUAL * first {
            break;
        }
        let image = sum(&mut forms.iter().map(|form| times(form, &times(form, &way))));
        let step = before / dot(&way, &image);
        x.iter_mut().zip(&way).for_each(|(x, way)| *x += step * way);
        rest.iter_mut().zip(&image).for_each(|(rest, image)| *rest -= step * image);
        let part = dot(&rest, &rest) / before;
        way.iter_mut().zip(&rest).for_each(|(way, rest)| *way = rest + part * *way);
    }
    x
}

/// Coordinates and differences of angles whose squares span the forms, one for each form; or those whose squares have
/// the forms as sums.
fn squares(model: &Model, free: &[Vec<f64>], forms: &[Vec<f64>]) -> Option<Vec<Kept>> {
    let square = |l: &[f64]| l.iter().flat_map(|a| l.iter().map(move |b| a * b)).list();
    spanning(model, free, &independent(forms.to_vec()), square).or_else(|| {
        let lines = independent(lines(forms, free.len())?);
        spanning(model, free, &lines, <[f64]>::to_vec)
    })
}

/// Coordinates and differences of angles whose images span a space with this orthonormal basis, one for each dimension.
/// The image is that of the rate along the freedoms, a vector of length 1. None if there are none, or too few.
fn spanning(
    model: &Model,
    free: &[Vec<f64>],
    basis: &[Vec<f64>],
    image: impl Fn(&[f64]) -> Vec<f64>,
) -> Option<Vec<Kept>> {
    if basis.is_empty() {
        return None;
    }
    let scales = column_scales(model);
    let (mut kept, mut spanned) = (Vec::new(), Vec::new());
    for candidate in candidates(model) {
        let l = free.iter().map(|w| candidate.along(model, w, &scales)).list();
        let size = l.iter().map(|x| x * x).sum::<f64>();
        if size <= EQUAL {
            continue;
        }
        let image = image(&l.iter().map(|x| x / size.sqrt()).list());
        let with = |forms: &[Vec<f64>]| {
            independent(forms.iter().cloned().chain([image.clone()]).list()).len() - forms.len()
        };
        if with(basis) == 0 && with(&spanned) > 0 {
            spanned = independent(spanned.into_iter().chain([image]).list());
            kept.push(candidate);
        }
        if kept.len() == basis.len() {
            return Some(kept);
        }
    }
    None
}

/// Angles, then differences of angles, then the other coordinates of bodies.
fn candidates(model: &Model) -> impl Iterator<Item = Kept> {
    let bodies: Vec<(usize, usize)> =
        model.layout.bodies.iter().map(|columns| columns.count).enumerate().skip(1).list();
    let turning = bodies.iter().filter(|(_, count)| *count == 3).map(|(b, _)| BodyId(*b)).list();
    let of = |body, coordinate| CoordinateOf { body, coordinate };
    let angle = move |body: &BodyId| of(*body, Coordinate::Angle);
    let alone = turning.iter().map(|body| Kept { of: angle(body), from: None }).list();
    let pairs = turning.iter().enumerate().flat_map(|(k, from)| {
        turning[k + 1..].iter().map(move |body| Kept { of: angle(body), from: Some(*from) })
    });
    let pairs = pairs.list();
    let places = bodies.into_iter().flat_map(move |(b, _)| {
        [Coordinate::X, Coordinate::Y].each(|c| Kept { of: of(BodyId(b), c), from: None })
    });
    alone.into_iter().chain(pairs).chain(places)
}

impl Kept {
    fn column(&self, model: &Model) -> usize {
        model.layout.bodies[self.of.body.0].first + self.of.coordinate.column()
    }

    /// The column of the angle from which it is measured.
    fn reference(&self, model: &Model) -> Option<usize> {
        self.from.map(|body| model.layout.bodies[body.0].first + Coordinate::Angle.column())
    }

    /// Its rate along a freedom, with lengths relative to the size of the mechanism.
    fn along(&self, model: &Model, w: &[f64], scales: &[f64]) -> f64 {
        let column = self.column(model);
        w[column] / scales[column] - self.reference(model).map_or(0.0, |column| w[column])
    }

    fn name(&self, model: &Model) -> String {
        let body = |body: BodyId| model.bodies[body.0].name.as_str();
        let own = format!("{}.{}", body(self.of.body), self.of.coordinate.name());
        self.from.map_or(own.clone(), |from| format!("{own} - {}.angle", body(from)))
    }

    /// Its value at a position, or the formula that keeps it.
    fn law(&self, model: &Model, q: &[f64]) -> Tape {
        let value = q[self.column(model)];
        match (self.from, self.reference(model)) {
            (Some(from), Some(column)) => {
                let angle = Variable::Coordinate(from, Coordinate::Angle).index();
                Tape::shifted(Symbol::Variable(angle), value - q[column])
            }
            _ => value.into(),
        }
    }
}

/// The model with constraints that keep the values of a position.
fn extended(model: &Model, q: &[f64], kept: &[Kept]) -> Model {
    let mut blueprint = model.blueprint.as_ref().clone();
    let added = kept.iter().map(|kept| {
        let constraint = holding(kept.of.into(), kept.law(model, q));
        (kept.name(model), Group::Joints, constraint)
    });
    let all = blueprint.constraints.iter().cloned().chain(added).list();
    blueprint.constraints = all.into();
    blueprint.implied = kept.len();
    blueprint.allow_redundancy = true;
    Model::new(&Arc::new(blueprint), &model.parameters)
}
