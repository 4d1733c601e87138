//! Initial value problems y′ = f(t, y), without mechanics.
//!
//! A [`Method`] advances an [`Ode`] and shows every accepted [`Step`] to an [`Observer`]; a step
//! carries its own continuous extension, from which output at given times and events are taken.
//!
//! A new scheme is one file: options as a struct with [`Method`]. It evaluates through `right_hand_side`, offers
//! each accepted state to [`Ode::project_accepted`], builds its [`Interpolant`] from stages and a table, and
//! takes no memory per step. An embedded pair implements `EmbeddedPair` and shares `adaptive`.
//!
//! | file | concept |
//! |---|---|
//! | `ode` | what a system, an observer and a method promise each other |
//! | `failure` | how an integration ends early |
//! | `arguments` | what is refused before the first evaluation |
//! | `right_hand_side` | counted, checked evaluations |
//! | `interpolant` | the continuous extension of a step |
//! | `hermite_birkhoff` | that of mechanical systems, from the step before and one evaluation |
//! | `step_size` | choice of the step from the error estimate |
//! | `step_placement` | steps that keep clear of a time near which rates are noise |
//! | `step_control` | tolerances and steps, which all methods share, with their defaults |
//! | `adaptive`, `embedded_pair` | the loop of every embedded pair, and the definition of a pair |
//! | `step_acceptance` | what becomes of a step whose error is accepted |
//! | `fixed_step` | where steps of constant length end |
//! | `stages` | sums over the stages of a step, in blocks of numbers |
//! | `tolerances` | what errors of a step are measured by |
//! | `rk45`, `dop853`, `rk4` | schemes |
//! | `dae` | what a constrained mechanical system and an implicit method promise each other |
//! | `implicit_state`, `error_weights`, `evaluation_counter` | parts that implicit methods share |
//! | `alpha_parameters`, `alpha_step`, `generalized_alpha` | generalized-α at index 3 |
//! | `radau_coefficients`, `radau_step`, `radau` | Radau IIA of order 5 at index 2 |
//! | `events` | where a function of the state changes sign |

mod adaptive;
mod alpha_parameters;
mod alpha_step;
mod arguments;
mod dae;
mod dop853;
mod dop853_coefficients;
mod embedded_pair;
mod error_weights;
mod evaluation_counter;
mod events;
mod failure;
mod fixed_step;
mod generalized_alpha;
mod hermite_birkhoff;
mod implicit_state;
mod interpolant;
mod ode;
mod radau;
mod radau_coefficients;
mod radau_step;
mod right_hand_side;
mod rk4;
mod rk45;
mod stages;
mod step_acceptance;
mod step_control;
mod step_placement;
mod step_size;
mod tolerances;

pub use alpha_parameters::AlphaParameters;
pub use dae::{
    ConstraintLevel, Dae, DaeResidual, ImplicitMethod, Iterate, NewtonCoefficients, SingularMatrix,
};
pub use dop853::Dop853;
pub use events::{locate, Direction};
pub use failure::{Cause, Failure};
pub use generalized_alpha::GeneralizedAlpha;
pub use interpolant::Interpolant;
pub(crate) use interpolant::HIGHEST;
pub use ode::{Ended, Flow, Method, Observer, Ode, Statistics, Step};
pub use radau::Radau;
pub(crate) use right_hand_side::all_finite;
pub use rk4::Rk4;
pub use rk45::Rk45;
pub use step_control::{Atol, StepControl};
