//! Elements: joints, drivers and forces. Each element has one file.
//!
//! An element declares its fields once ([`element!`](crate::element)) and states its physics once ([`Joint`] or
//! [`Force`]), generic in the scalar. The reader of files, the JSON schema, the Python class, the
//! reference page and all derivatives follow from these two. To add an element, write its file, name it
//! in `list.rs`, and give it a test sample and a page. No other file names it.

mod declare;
pub(crate) mod derive;
mod dispatch;
mod field;
mod force_trait;
mod joint_trait;
mod kinds;
mod list;
mod symbols;
mod value;
mod written;

pub mod drivers;
pub mod forces;
pub mod joints;
#[cfg(feature = "test-elements")]
#[path = "../../tests/elements/mod.rs"]
pub mod test_elements;

use declare::join;
pub use declare::{Element, Table};
pub use dispatch::{Group, Place, Pooled, VisitForces, VisitJoints};
pub use field::{Default, Field, Shape};
pub use force_trait::{Force, Nature, OwnPowers, OwnState, Part, Situation};
pub use joint_trait::{At, Attachment, Equation, Fixes, Joint, Linearized, Moving};
pub use kinds::{
    body, coordinate, joint, law, number, pair, point, BodyId, Coordinate, CoordinateOf, JointId,
    Kind, PointOn, Source,
};
pub use list::{catalogue, holding, states_of, Constraint, ForceElement, ForcePools, JointPools};
pub use symbols::{Mark, SceneSymbol, SymbolEnd};
pub use value::{Number, Pair, Value};
pub use written::Written;
pub(crate) use written::{argument, declare as element};
