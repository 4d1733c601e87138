//! The unit in which the lengths of a drawing have few digits.

use serde::{Deserialize, Serialize};

/// A unit of lengths.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Length {
    /// Its name.
    pub unit: String,
    /// Its value in m.
    pub metres: f64,
}

/// Lengths below this value, m, are rounding errors.
const NOISE: f64 = 1e-9;

impl Length {
    /// The unit in which a length has one to four digits before the decimal point. From 0.2 m to 2 m, and for
    /// rounding errors, the unit is m.
    pub fn fitting(size: f64) -> Self {
        let power = match size {
            _ if size < NOISE || (0.2..2.0).contains(&size) => 0,
            _ => {
                let least = if size >= 2.0 { size / 2.0 } else { size };
                3 * (least.log10() / 3.0).floor() as i32
            }
        };
        let unit = match power {
            0 => "m".to_string(),
            -3 => "mm".to_string(),
            -6 => "µm".to_string(),
            -9 => "nm".to_string(),
            _ => format!("10{} m", raised(power)),
        };
        Self { unit, metres: 10.0_f64.powi(power) }
    }
}

/// A number as a superscript exponent.
fn raised(power: i32) -> String {
    let digits: Vec<char> = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().collect();
    let of = |c: char| c.to_digit(10).map_or('⁻', |digit| digits[digit as usize]);
    power.to_string().chars().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::Length;

    #[test]
    fn the_unit_keeps_the_numbers_short() {
        let unit = |size| Length::fitting(size).unit;
        assert_eq!([0.19, 0.2, 1999.0, 2001.0].map(unit), ["mm", "m", "m", "10³ m"]);
        assert_eq!([0.0, 3e-6, 4e-9].map(unit), ["m", "µm", "nm"]);
        assert_eq!(Length::fitting(5e3).metres, 1000.0);
    }
}
