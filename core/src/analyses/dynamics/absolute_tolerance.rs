//! Absolute tolerances of a mechanism. Metres and radians need different tolerances, so there is one number for each
//! kind of component: lengths, angles, and first-order states. The number for rates is the number for their
//! coordinates, per s.

use crate::analyses::options::{not_negative, OptionKind, Reader};
use crate::elements::{Default, Shape, TOLERANCES};
use crate::integrate::Atol;
use crate::math::Listed;
use crate::model::{column_scales, size, Model, Value};

/// An absolute tolerance as written.
#[derive(Clone, Debug, PartialEq)]
pub enum AbsoluteTolerance {
    /// One number for every component, in the unit of the component.
    Uniform(f64),
    /// For each component of (q, v, z) the number of its kind, if it is given, and the scale of the component.
    ByKind(Vec<(Option<f64>, f64)>),
}

impl AbsoluteTolerance {
    /// The tolerance for the integrator. The tolerance of a kind without a number is `usual` times its scale.
    pub fn resolve(given: Option<Self>, usual: f64) -> Atol {
        match given {
            None => Atol::Scaled(usual),
            Some(Self::Uniform(atol)) => Atol::Scalar(atol),
            Some(Self::ByKind(all)) => {
                Atol::Each(all.into_iter().map(|(own, scale)| own.unwrap_or(usual * scale)).list())
            }
        }
    }
}

/// The kind of each component of (q, v, z), as an index into [`TOLERANCES`], and its scale. The tolerance of a place on
/// a curve is that of lengths, in proportion to its scale. The scale of a state that is a length is the size.
fn components(model: &Model) -> Vec<(usize, f64)> {
    let lengths = model.layout.lengths().into_iter().map(|length| usize::from(!length));
    let of_q: Vec<(usize, f64)> = lengths.zip(column_scales(model)).list();
    let mut states = vec![(2, 1.0); model.layout.n_z];
    for (item, places) in model.forces.iter().zip(&model.layout.states) {
        for (own, (_, scale)) in item.states.iter().zip(&mut states[places.clone()]) {
            *scale = if own.unit == "m" { size(model) } else { 1.0 };
        }
    }
    of_q.clone().into_iter().chain(of_q).chain(states).list()
}

/// The tolerance with one number for each component of (q, v, z), as most methods need it.
pub(super) fn for_model(model: &Model, atol: &Atol) -> Atol {
    match atol {
        Atol::Scaled(part) => {
            Atol::Each(components(model).into_iter().map(|(_, scale)| part * scale).list())
        }
        given => given.clone(),
    }
}

/// The kind of option.
#[allow(non_camel_case_types)] // a type in `options!`, written like a word
pub enum absolute_tolerance {}

impl OptionKind for absolute_tolerance {
    type Value = AbsoluteTolerance;

    fn shape() -> Shape {
        Shape::Tolerance
    }

    fn data(_: &AbsoluteTolerance) -> Default {
        Default::Absent
    }

    fn read(
        reader: &mut Reader<'_>,
        key: &'static str,
        unit: &'static str,
    ) -> Option<AbsoluteTolerance> {
        if !matches!(reader.get(key), Some(Value::Table(_))) {
            return not_negative::read(reader, key, unit).map(AbsoluteTolerance::Uniform);
        }
        let model = reader.model();
        let own = reader.table(key, |reader| {
            let units = ["m", "rad", ""];
            let mut all = [None; 3];
            for ((own, key), unit) in all.iter_mut().zip(TOLERANCES).zip(units) {
                *own = Option::<not_negative>::optional(reader, key, unit, None)?;
            }
            Some(all)
        })?;
        let unit = |k: usize, scale: f64| [size(model), 1.0, scale][k];
        let one =
            |(k, scale): (usize, f64)| (own[k].map(|own| own * (scale / unit(k, scale))), scale);
        Some(AbsoluteTolerance::ByKind(components(model).into_iter().map(one).list()))
    }
}
