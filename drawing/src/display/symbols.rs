//! The items of symbols: one function for each mark.

use super::around::{self, Around};
use super::items::Item;
use super::pins::pin_at;
use super::{along, at, bodies, wheels};
use crate::scene::Symbol;
use kempe::elements::Mark;

/// The items of a symbol.
///
/// `around` is the ring for a symbol around a point. `aside` is the distance from the line for a symbol that is drawn
/// parallel to others; 0 for a single symbol.
pub fn draw(symbol: &Symbol, around: Around<'_>, aside: f64) -> Vec<Item> {
    match symbol.mark {
        Mark::Pin => pin_at(symbol, 1).to_vec(),
        Mark::Clamp => at::clamp(symbol),
        Mark::Sleeve => at::sleeve(symbol),
        Mark::Slide => at::slide(symbol),
        Mark::Slot => at::slot(symbol),
        Mark::Touch => vec![at::touch(symbol)],
        Mark::Face => vec![at::face(symbol)],
        Mark::RubbingSlide => at::rubbing_slide(symbol),
        Mark::ShiftStop => vec![at::shift_stop(symbol)],
        Mark::ForceArrow => at::straight_arrow(symbol, "force", 1.6),
        Mark::DriveShift => at::straight_arrow(symbol, "drive", 2.4),
        Mark::Track => vec![wheels::track(symbol)],
        Mark::ToothedLine => wheels::toothed_line(symbol),
        Mark::ToothedWheel => wheels::toothed_wheel(symbol),
        Mark::ToothedRing => wheels::toothed_ring(symbol),
        Mark::OpenStrands => vec![wheels::strands(symbol, false)],
        Mark::CrossedStrands => vec![wheels::strands(symbol, true)],
        Mark::Circle => wheels::plain_wheel(symbol),
        Mark::Roller => wheels::roller(symbol),
        Mark::Round => wheels::round_end(symbol),
        Mark::Rod => along::rod(symbol),
        Mark::Beam => bodies::beam(symbol, symbol.bodies[0]),
        Mark::Spring => along::spring(symbol, aside),
        Mark::Dashpot => along::dashpot(symbol, aside),
        Mark::Cylinder => along::cylinder(symbol, "force"),
        Mark::DriveCylinder => along::cylinder(symbol, "drive"),
        Mark::SpiralSpring => around::spiral(symbol, around),
        Mark::RotaryDashpot => around::rotary_dashpot(symbol, around),
        Mark::RubbingPin => around::rubbing_pin(symbol, around),
        Mark::TorqueArrow => around::curved_arrow(symbol, around, "force", 1.6),
        Mark::DriveTurn => around::curved_arrow(symbol, around, "drive", 2.4),
        Mark::TurnStop => around::turn_stop(symbol),
    }
}
