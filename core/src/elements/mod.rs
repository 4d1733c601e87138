//! Elements: joints, drivers and forces. One file is one element.
//!
//! An element declares its fields once ([`element!`]) and states its physics once ([`Joint`] or
//! [`Force`]), generic in the scalar. From that follow the reader of the file, the JSON schema, the
//! Python class, the reference page, and all derivatives. To add one: write its file, name it in the
//! list below, and give it a test and a page.

mod declare;
mod derive;
mod formula;
mod kinds;
mod traits;

pub mod drivers;
pub mod forces;
pub mod joints;

mod catalogue;

pub(crate) use catalogue::jets;
pub use catalogue::{
    catalogue, formulas, Acting, Constraint, ForceElement, Group, Linear, Rows, TypedLoop,
    MOST_EQUATIONS,
};
use declare::join;
pub use declare::{element, Default, Element, Field, Table};
pub use derive::{derived_jacobian, derived_velocity_terms, VelocityTerms};
pub(crate) use derive::{moving, seeded};
pub use formula::Formula;
pub use kinds::{
    body, coordinate, law, number, pair, point, BodyId, Coordinate, CoordinateOf, Kind, PointOn,
    Shape, Source,
};
pub use traits::{Action, Attachment, Equation, Force, Joint, Nature, Part, Side, Situation};
