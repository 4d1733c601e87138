//! Initial value problems, independent of mechanics: y′ = f(t, y), and constrained systems for implicit methods.
//!
//! A method ([`ExplicitMethod`], [`ImplicitMethod`]) starts a [`Stepper`]. The stepper advances the state by one
//! accepted step at a time, can restart from another state at the same time, and locates events. It provides the last
//! [`Step`] with its interpolant.
//!
//! # Properties of a system
//!
//! | trait | content | used for |
//! |---|---|---|
//! | [`Ode`] | `len`, `rate`: the required methods | every explicit method |
//! | [`Structure`] (a value) | numbers of positions, states and quadratures | error norm, cheaper interpolant |
//! | [`Manifold`] | projection of a state; tangential part of an error | drift, errors near singular positions |
//! | [`TimesToAvoid`] | times near which noise dominates f | placement of steps |
//! | [`TrialChanges`] | changes of f before a trial step | gains that follow the step |
//! | [`Dae`] | residuals, tangent, factorised matrices of a constrained system | every implicit method |
//!
//! # Files
//!
//! | file | concept |
//! |---|---|
//! | `ode`, `dae` | the systems |
//! | `stepper`, `step` | the interface of all methods; an accepted step |
//! | `failure`, `arguments` | causes of failure; checks of arguments before the first evaluation |
//! | `step_control`, `step_size`, `fixed_step` | options of steps; choice of the step from the error; constant steps |
//! | `events`, `crossings` | where a function of the state changes sign; all changes of several functions |
//! | `watched` | what is known of functions over parts of a step |
//! | `path` | bounds of the interpolant over parts of a step |
//! | `interpolant`, `hermite_birkhoff` | the state between the ends of a step; the same for systems of second order |
//! | `explicit_stepper`, `explicit_work` | the stepper of explicit methods; its memory |
//! | `step_acceptance`, `step_placement` | the end of a step; steps that avoid a time |
//! | `side_by_side`, `lane_steps` | steps of several explicit steppers in parallel, one in each lane |
//! | `runge_kutta`, `rk45`, `dop853`, `rk4` | the definition of an explicit method, and three of them |
//! | `right_hand_side`, `stages`, `tolerances` | evaluations of f, sums over stages, error norm |
//! | `implicit_stepper` | the stepper of implicit methods |
//! | `implicit_state`, `implicit_steps`, `error_weights`, `evaluation_counter` | parts of the implicit stepper |
//! | `alpha_parameters`, `alpha_step`, `generalized_alpha` | generalized-α at index 3 |
//! | `radau_coefficients`, `radau_step`, `radau` | Radau IIA of order 5 at index 2 |

mod alpha_parameters;
mod alpha_step;
mod arguments;
mod component_polynomials;
mod crossings;
mod dae;
mod dop853;
mod dop853_coefficients;
mod error_weights;
mod evaluation_counter;
mod events;
mod explicit_stepper;
mod explicit_work;
mod failure;
mod fixed_step;
mod generalized_alpha;
mod hermite_birkhoff;
mod implicit_state;
mod implicit_stepper;
mod implicit_steps;
mod interpolant;
mod lane_steps;
mod ode;
mod path;
mod radau;
mod radau_coefficients;
mod radau_step;
mod right_hand_side;
mod rk4;
mod rk45;
mod runge_kutta;
mod side_by_side;
mod stages;
mod statistics;
mod step;
mod step_acceptance;
mod step_control;
mod step_placement;
mod step_size;
mod stepper;
mod tolerances;
mod trial;
mod watched;

pub use alpha_parameters::AlphaParameters;
pub(crate) use component_polynomials::HIGHEST;
pub use crossings::{crossings, scan, Crossing, Scan};
pub use dae::{
    ConstraintLevel, Dae, DaeLengths, DaeRates, DaeResidual, DaeState, Iterate, NewtonCoefficients,
};
pub use dop853::Dop853;
pub use events::{locate, Direction};
pub use failure::Cause;
pub use generalized_alpha::GeneralizedAlpha;
pub use interpolant::Interpolant;
pub use lane_steps::{LaneOde, LaneSteps, Mask, SideBySide, Steppers, Taken};
pub use ode::{Manifold, Ode, Structure, TimesToAvoid, TrialChanges};
pub use path::{Bounds, StepPath};
pub use radau::Radau;
pub(crate) use right_hand_side::all_finite;
pub use rk4::Rk4;
pub use rk45::Rk45;
pub use statistics::StepCounts;
pub use step::{Flow, Step};
pub use step_control::{Atol, StepControl};
pub use stepper::{BoxedStepper, ExplicitMethod, ImplicitMethod, Stepper};
pub use watched::{TooFast, Watch};
