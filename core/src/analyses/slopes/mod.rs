//! Derivatives of the numbers of an analysis with respect to parameters and start values.
//!
//! The derivatives are exact: they differentiate the equations, not differences of runs. A run is computed first and is
//! not changed. Its derivatives follow along its recorded steps, three variables at once.
//!
//! | file | concept |
//! |---|---|
//! | `variables` | parameters and start values as numbers with derivatives |
//! | `ode`, `dae` | the equations of motion together with their derivatives, for explicit and for implicit methods |
//! | `columns` | the layout of states with derivatives |
//! | `stepper` | the stepper of the derivatives |
//! | `run_ends` | the end of a run, its states and their scales |
//! | `starts` | the derivatives of a start |
//! | `triggers` | the functions whose zeros change a motion |
//! | `impacts` | the derivatives of impacts |
//! | `motion` | the derivatives of a motion along its steps |
//! | `at_rest` | the derivatives of an equilibrium |
//! | `equilibrium` | the numbers of an equilibrium |
//! | `limits`, `turning` | limits of motions |
//! | `modes` | the numbers of modes |
//! | `spectrum` | the derivatives of eigenvalues |
//! | `by_state` | the derivatives of quantities with respect to the state |
//! | `driven` | the derivatives of a motion that drivers determine |
//! | `dissipation` | the energies that force elements dissipate, with derivatives |
//! | `reader` | measures with derivatives |
//! | `statistics` | statistics with derivatives |
//! | `extremes` | extreme values with derivatives |
//! | `integrals` | integrals, means and root mean squares with derivatives |
//! | `variant` | a variant of a sweep with its variables |
//! | `gradient` | all numbers and all variables of a request |
//! | `at_outputs` | extreme values at the outputs |
//! | `at_times` | measures and all variables of a request at given times |

mod at_outputs;
mod at_rest;
mod at_times;
mod by_state;
mod columns;
mod dae;
mod dissipation;
mod driven;
mod equilibrium;
mod extremes;
mod gradient;
mod impacts;
mod integrals;
mod limits;
mod modes;
mod motion;
mod ode;
mod reader;
mod run_ends;
mod spectrum;
mod starts;
mod statistics;
mod stepper;
mod triggers;
mod turning;
mod variables;
mod variant;

pub use at_times::AtTimes;
pub use by_state::by_state;
pub use gradient::{Gradient, Remark};
