//! The equations of a joint or driver as text. Φ, Φ_q and γ follow from its residual, evaluated over
//! [`Symbolic`](crate::symbolic::Symbolic) numbers.

mod generic;
mod names;
mod of_model;
mod scalars;

pub use generic::{of_element, of_type};
pub use of_model::of_constraint;

use crate::elements::{At, BodyId, Constraint};
use crate::math::{Listed, Pose};
use crate::symbolic::{Form, Record, Symbolic};
use names::Coordinates;

/// The equations of one joint or driver.
#[derive(Clone, Debug)]
pub struct Formulas {
    /// The unknowns with respect to which Φ is differentiated, such as `crank.angle`.
    pub columns: Vec<String>,
    /// Named parts of the equations, as pairs of name and formula.
    pub definitions: Vec<(String, String)>,
    /// The scalar equations.
    pub rows: Vec<RowFormulas>,
    /// All names in the equations, in the language of expressions.
    pub names: Vec<String>,
}

/// One scalar equation.
#[derive(Clone, Debug)]
pub struct RowFormulas {
    /// Φ.
    pub residual: String,
    /// ∂Φ/∂q, one entry for each column.
    pub jacobian: Vec<String>,
    /// γ.
    pub gamma: String,
}

/// Evaluates Φ. This is the only function that calls the element.
fn residual(
    element: &Constraint<Symbolic>,
    pose: impl Fn(BodyId) -> Pose<Symbolic>,
    own: &[Symbolic],
    t: Symbolic,
) -> Vec<Symbolic> {
    let bodies: Vec<Pose<Symbolic>> = element.bodies().into_iter().map(pose).list();
    let mut phi = vec![t; element.equations().len()];
    element.residual(&At { bodies: &bodies, own, t }, &mut phi);
    phi
}

/// Differentiates Φ with respect to the coordinates of the bodies `columns` and the internal coordinates, and prints
/// Φ, Φ_q and γ.
fn print(
    record: &Record,
    phi: &[Symbolic],
    (columns, own): (&[&Coordinates], &[Symbolic]),
    form: Form,
) -> Formulas {
    let bodies = columns.iter().flat_map(|body| body.position);
    let unknowns: Vec<Symbolic> = bodies.chain(own.iter().copied()).list();
    let system = record.differentiate(phi, &unknowns);
    let write = |x: &Symbolic| record.write(*x, form);
    let mut all = system.residual.clone();
    all.extend(system.jacobian.iter().flatten().chain(&system.gamma));
    let rows = system.residual.iter().zip(&system.jacobian).zip(&system.gamma);
    Formulas {
        columns: unknowns.iter().map(write).list(),
        definitions: record.definitions(&all, form),
        rows: rows
            .map(|((residual, jacobian), gamma)| RowFormulas {
                residual: write(residual),
                jacobian: jacobian.iter().map(write).list(),
                gamma: write(gamma),
            })
            .list(),
        names: record.names(&all),
    }
}
