//! The limits of a motion with their derivatives.

use super::gradient::{NumberSlopes, COUNTS};
use super::statistics::Found;
use super::turning::Turning;
use super::variant::ReadyVariant;
use crate::analyses::assemble::implicit;
use crate::analyses::measures::Measure;
use crate::analyses::record::{Driven, Record};
use crate::analyses::rigid::RigidContacts;
use crate::analyses::second_order;
use crate::analyses::signals::Seen;
use crate::analyses::sweep::Wanted;
use crate::analyses::State;
use crate::elements::QuantityKind;
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::equations::sensitivity::{constants, variables_from, Sensitivity, Slope, ABREAST};
use crate::equations::{constraints, dense};
use crate::math::{Listed, Real};
use crate::model::{size, Model};

impl ReadyVariant<'_> {
    /// The derivatives of the numbers of limits.
    pub fn of_limits(&self, record: &Record) -> NumberSlopes {
        let count = self.count();
        let limit = |name: &str| self.of_limit(record, name);
        let number = |text: &str| match text {
            "lower" | "upper" => limit(text),
            "span" => {
                let (lower, upper) = (limit("lower")?, limit("upper")?);
                Ok(upper.iter().zip(&lower).map(|(upper, lower)| upper - lower).list())
            }
            "start" => self.of_start(record),
            _ => Err(COUNTS.to_string()),
        };
        let each = self.sweep.wanted.iter().map(|one| match one {
            Wanted::Number(text) => number(text.trim()),
            Wanted::Statistic(..) => Err("limits have no statistics".to_string()),
        });
        each.map(|found| match found {
            Ok(slopes) => slopes.into_iter().take(count).map(Ok).list(),
            Err(reason) => vec![Err(reason); count],
        })
        .list()
    }

    /// The derivatives of the lower or the upper limit.
    fn of_limit(&self, record: &Record, name: &str) -> Found {
        let of_side = format!("{name} limit");
        let found = record.positions.iter().find(|(fact, _)| fact.name == of_side);
        let Some((_, State { t, q, .. })) = found else {
            return Err("there is no limit on this side".to_string());
        };
        let Driven { model, .. } = record.driven.as_ref().ok_or("its mechanism is not known")?;
        if !model.blueprint.phases.is_empty() {
            return Err("wheels mesh at angles that the start gives".to_string());
        }
        if q.len() != model.layout.n_rows || second_order::acting(model, *t, q).is_some() {
            return Err("constraints depend on each other".to_string());
        }
        let is_angle = record.findings["unit"] == QuantityKind::Angle.unit();
        let unit = if is_angle { 1.0 } else { size(model) };
        let contacts = RigidContacts::of(model).touched(model, *t, q);
        let turning = match contacts.forces() {
            [] => Some(
                Turning::near(model, unit, *t, q)?
                    .ok_or("a curve ends there, or two limits nearly meet")?,
            ),
            [_] => None,
            _ => return Err("several stops are reached there".to_string()),
        };
        let mut slopes = Vec::new();
        for mut over in self.blocks(model)? {
            slopes.extend(match &turning {
                Some(turning) => turning.slopes(&mut over),
                None => at_stop(model, contacts.forces()[0], (*t, q), &mut over)?,
            });
        }
        Ok(slopes)
    }

    /// The derivatives of the driven value at the start.
    fn of_start(&self, record: &Record) -> Found {
        let Driven { variable, .. } = record.driven.as_ref().ok_or("its mechanism is not known")?;
        let start = &self.ready.start;
        let model = self.sweep.subject(self.ready).released(start);
        let measure = Measure::read(&model, &variable.name);
        let measure = measure.map_err(|_| "kempe has no derivatives of this number")?;
        let mut slopes = Vec::new();
        let starts = self.starts()?.in_time(self.count())?;
        let blocks = self.blocks(&model)?.into_iter().zip(starts);
        for (mut over, [q, v, z]) in blocks {
            over.place(&q, &v, &[]);
            let (t, solved) = (Slope::constant(start.state.t), [&over.a[..], &over.lam]);
            let (state, motions) = ([&q[..], &v, &z], &over.motions);
            let seen = Seen { t, state, works: &[], motions, solved, so_far: None };
            slopes.extend(measure.value_at(&over.model, &seen).slope);
        }
        Ok(slopes)
    }
}

/// The derivatives of the value at which a stop or contact is reached: of the solution t of Φ(q, t) = 0 with a gap of
/// zero.
fn at_stop(
    model: &Model,
    force: usize,
    (t, q): (f64, &[f64]),
    over: &mut Sensitivity,
) -> Result<[f64; ABREAST], String> {
    let n = q.len();
    let gap = |model: &Model<Slope>, t: Slope, q: &[Slope]| {
        let motions = Motions::at_rest(&model.layout, q);
        let z = vec![Slope::zero(); model.layout.n_z];
        forces::threshold(model, force, &motions, Acting { z: &z, lam: None, t })
    };
    let jacobian = dense::jacobian(model, &Motions::at_rest(&model.layout, q), t);
    let nu = constraints::nu(model, q, t);
    let mut matrix = Vec::new();
    for (row, nu) in jacobian.chunks(n).zip(&nu) {
        matrix.extend_from_slice(row);
        matrix.push(-nu);
    }
    let (lifted, unknowns) = (model.lift::<Slope>(), [q, &[t]].concat());
    for first in (0..=n).step_by(ABREAST) {
        let at = variables_from(first, &unknowns);
        let found = gap(&lifted, at[n], &at[..n]);
        matrix.extend(found.slope.iter().take(n + 1 - first));
    }
    let q = constants(q);
    let mut residual = over.open(Slope::constant(t), &q);
    residual.push(gap(&over.model, Slope::constant(t), &q));
    Ok(implicit(matrix, &unknowns, &residual)?[n].slope)
}
