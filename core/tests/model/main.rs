//! Models: texts, expressions and fields, how they are read, checked, built and written, and the messages of their faults.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod builder;
mod building;
mod case_broken;
mod case_check;
mod case_hostile;
mod case_places;
mod case_read;
mod case_schema;
mod case_times;
mod case_write;
mod curve_faults;
mod dimensions;
mod edges;
mod expression;
mod fields;
mod functions;
mod many_problems;
mod measures;
mod quantities;
mod refused;
mod remedies;
mod running;
mod shapes;
mod spline;
mod symbolic;
mod symbols;
mod tables;
