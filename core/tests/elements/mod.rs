//! Elements for tests only: each uses an ability that few or no elements of the list use. They belong
//! to the core where the feature `test-elements` is on, as in its tests.

mod bead;
mod blower;
mod gap_spring;
mod lag;
mod levels;
mod overload;
mod pulley;
mod rubbing;
mod turned_pin;

pub use bead::Bead;
pub use blower::Blower;
pub use gap_spring::GapSpring;
pub use lag::Lag;
pub use levels::Levels;
pub use overload::Overload;
pub use pulley::Pulley;
pub use rubbing::Rubbing;
pub use turned_pin::TurnedPin;
