//! Analyses: what a user asks of a model.

mod option_tables;

pub use option_tables::{analysis_tables, option_families, Family, Options};
