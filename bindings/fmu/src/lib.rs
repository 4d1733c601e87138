//! The library inside the FMUs that kempe exports.
//!
//! It is the same for all models: it reads the case and the list of variables in the folder `resources` of the FMU, and
//! exports the C functions of FMI 2.0 and FMI 3.0 for co-simulation. A step is a part of a
//! [`SteppedRun`](kempe::SteppedRun).
//!
//! | file | concept |
//! |---|---|
//! | `exported` | `resources/interface.json` and `resources/case.toml` |
//! | `running` | a run of the case with the values that the host has chosen |
//! | `instance` | the states of an instance and its variables; no C |
//! | `snapshot` | a state of an instance, in memory and as bytes |
//! | `location` | the folder of the resources from a URI |
//! | `component` | an instance with its log; panics and errors become a status |
//! | `pointers` | arrays and texts behind the pointers of the host |
//! | `fmi2`, `fmi3` | the functions of each standard |
//! | `refused2`, `refused3` | functions of the standards for what these FMUs do not have |
#![deny(unsafe_code)]

mod component;
mod exported;
mod fmi2;
mod fmi3;
mod instance;
mod location;
mod pointers;
mod processor;
mod refused2;
mod refused3;
mod running;
mod snapshot;
