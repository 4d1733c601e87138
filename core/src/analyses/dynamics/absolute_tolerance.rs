//! Absolute tolerances of a mechanism. Metres and radians need different tolerances, so there is one number for each
//! kind of component: lengths, angles, and first-order states. The number for rates is the number for their
//! coordinates, per s.

use crate::analyses::options::{not_negative, OptionKind, Reader};
use crate::elements::{Default, Shape, TOLERANCES};
use crate::integrate::Atol;
use crate::math::Listed;
use crate::model::{size, Model, Value};

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

/// The kind of each component of (q, v, z), as an index into [`TOLERANCES`].
fn kinds(model: &Model) -> impl Iterator<Item = usize> {
    let of_q = model.layout.lengths().into_iter().map(|length| usize::from(!length));
    let of_q: Vec<usize> = of_q.list();
    let states = std::iter::repeat_n(2, model.layout.n_z);
    of_q.clone().into_iter().chain(of_q).chain(states)
}

/// The scale of each kind: the size of the mechanism for lengths, 1 for angles and first-order states.
fn scales(model: &Model) -> [f64; 3] {
    [size(model), 1.0, 1.0]
}

/// The tolerance with one number for each component of (q, v, z), as most methods need it.
pub(super) fn for_model(model: &Model, atol: &Atol) -> Atol {
    match atol {
        Atol::Scaled(part) => {
            let scales = scales(model);
            Atol::Each(kinds(model).map(|kind| part * scales[kind]).list())
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
        let scales = scales(model);
        Some(AbsoluteTolerance::ByKind(kinds(model).map(|k| (own[k], scales[k])).list()))
    }
}
