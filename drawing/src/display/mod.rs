//! The display list of a scene: lines, areas and texts that follow the bodies.
//!
//! ```text
//! items, shapes ← pins ← along ← around, at, wheels ← symbols ← mechanism ─────────────────┐
//! items, text ← placing ← list ← numbered ← layout ← dimensions, gravity; list ← names ────┴─ make
//! ```

mod along;
mod around;
mod at;
mod bodies;
mod dimensions;
mod gravity;
mod items;
mod labels;
mod layout;
mod list;
mod make;
mod mechanism;
mod names;
mod numbered;
mod pins;
mod places;
mod placing;
mod shapes;
mod symbols;
mod taken;
mod text;
mod wheels;

pub use items::{Frame, Item, Kind, Row};
pub use labels::place_labels;
pub use list::{Name, Numbers};
pub use make::{display, Request};
pub use placing::{place, View};
pub use taken::Taken;
pub use text::{one_line, width, Role};
