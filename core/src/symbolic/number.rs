//! Numbers as keys, and as text.

use std::f64::consts::PI;

/// A number that can be compared and hashed by its bits. Positive and negative zero are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Bits(u64);

impl Bits {
    pub fn of(x: f64) -> Self {
        Self((x + 0.0).to_bits())
    }
    pub fn get(self) -> f64 {
        f64::from_bits(self.0)
    }
}

/// A positive number as texts of its numerator and denominator, where "1" is not to be written. 1/n remains a
/// fraction if it is `divided` further.
pub(super) fn fraction(x: f64, divided: bool, pi: &str, times: &str) -> (String, String) {
    let part = 1.0 / x;
    if short(x) && !(divided && part == part.round()) {
        return (digits(x), "1".to_string());
    }
    for (unit, symbol) in [(1.0, ""), (PI, pi)] {
        for q in 1..=180_u32 {
            let p = (x / unit * f64::from(q)).round();
            let near = (p * unit / f64::from(q) - x).abs() <= 4.0 * f64::EPSILON * x;
            if near && (1.0..1000.0).contains(&p) {
                let top = match (p == 1.0, symbol.is_empty()) {
                    (true, false) => symbol.to_string(),
                    (false, false) => format!("{}{times}{symbol}", digits(p)),
                    _ => digits(p),
                };
                return (top, q.to_string());
            }
        }
    }
    (digits(x), "1".to_string())
}

/// Whether x is a decimal number of few digits.
fn short(x: f64) -> bool {
    x == x.round() || x != 0.5 && digits(x).chars().filter(char::is_ascii_digit).count() <= 5
}

/// The fewest digits that represent x up to rounding errors.
pub(super) fn digits(x: f64) -> String {
    let mut text = x.to_string();
    if x == 0.0 {
        return text;
    }
    for precision in 0..16 {
        let rounded = format!("{x:.precision$e}");
        if let Ok(value) = rounded.parse::<f64>() {
            if (value - x).abs() <= 1e-15 * x.abs() {
                text = if (1e-5..1e15).contains(&x.abs()) { value.to_string() } else { rounded };
                break;
            }
        }
    }
    text
}
