//! Drivers: constraints that prescribe a motion in time.

mod coordinate_driver;

pub use coordinate_driver::CoordinateDriver;
