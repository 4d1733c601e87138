//! The derivatives of quantities with respect to time, state and parameters.

use crate::analyses::measures::Measure;
use crate::analyses::signals::Seen;
use crate::equations::kinematics::Motions;
use crate::equations::sensitivity::{variables_from, Slope, ABREAST};
use crate::math::{Listed, Real, ShortArray};
use crate::model::Model;

/// The derivatives of measures by t, q, v, z and the parameters at x = (t, q, v, z): a row for each measure.
/// Accelerations and multipliers are unknown.
pub fn by_state(model: &Model, measures: &[Measure], x: &[f64]) -> Vec<f64> {
    let all = [x, &model.parameters].concat();
    let mut found = vec![0.0; measures.len() * all.len()];
    let constant = model.lift();
    for first in (0..all.len()).step_by(ABREAST) {
        let seeds = variables_from(first, &all);
        let own =
            (first + ABREAST > x.len()).then(|| Model::new(&model.blueprint, &seeds[x.len()..]));
        let values = at(own.as_ref().unwrap_or(&constant), measures, &seeds[..x.len()]);
        for (measure, value) in values.iter().enumerate() {
            let row = &mut found[measure * all.len()..][..all.len()][first..];
            row.iter_mut().zip(value.slope).for_each(|(to, slope)| *to = slope);
        }
    }
    found
}

/// The measures at (t, q, v, z).
fn at(model: &Model<Slope>, measures: &[Measure], x: &[Slope]) -> Vec<Slope> {
    let n = model.layout.n_q;
    let (t, (q, rest)) = (x[0], x[1..].split_at(n));
    let (v, z) = rest.split_at(n);
    let (motions, unknown) = (
        Motions::at(&model.layout, q, v),
        [n, model.layout.n_rows].each(|count| vec![Slope::constant(f64::NAN); count]),
    );
    let (state, solved) = ([q, v, z], [&unknown[0][..], &unknown[1]]);
    let seen = Seen { t, state, works: &[], motions: &motions, solved, so_far: None };
    measures.iter().map(|measure| measure.value_at(model, &seen)).list()
}
