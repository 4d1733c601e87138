//! Units of measure: `deg`, `mm`, `kN/m`, `kg*m^2`.
//!
//! A unit is a product of the units of [`UNITS`], each with an integer exponent: `atom ["^" integer] {("*" | "/")
//! atom ["^" integer]}`, read from left to right, so that `N*m*s/rad` is (N·m·s)/rad. `1/s` is allowed. `·` is read
//! as `*`, `µm` as `um`, `°` as `deg`. Case matters: `mN` is 10⁻³ N, `MN` is 10⁶ N.
//!
//! Angles are dimensionless, as in the SI: `N*m/rad` and `N*m` are equivalent units of a torsional stiffness.

use super::suggest::did_you_mean;
use super::ExpressionError;
use crate::math::Listed;
use std::f64::consts::PI;
use std::fmt;
use std::ops::Range;

/// Exponents of the SI base units of mechanics and electricity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of the metre.
    pub m: i8,
    /// Exponent of the kilogram.
    pub kg: i8,
    /// Exponent of the second.
    pub s: i8,
    /// Exponent of the ampere.
    pub a: i8,
}

impl Dimension {
    /// m^m kg^kg s^s.
    pub const fn new(m: i8, kg: i8, s: i8) -> Self {
        Self { m, kg, s, a: 0 }
    }

    /// The dimension of `self` · `other`^`power`; `None` beyond the range of `i8`.
    pub(super) fn times(self, other: Self, power: i8) -> Option<Self> {
        let exponent = |a: i8, b: i8| a.checked_add(b.checked_mul(power)?);
        Some(Self {
            m: exponent(self.m, other.m)?,
            kg: exponent(self.kg, other.kg)?,
            s: exponent(self.s, other.s)?,
            a: exponent(self.a, other.a)?,
        })
    }

    /// The dimension of `self`^`power`; `None` where an exponent is not a small integer.
    pub(super) fn raised(self, power: f64) -> Option<Self> {
        let exponent = |n: i8| {
            let raised = f64::from(n) * power;
            (raised.fract() == 0.0 && raised.abs() <= f64::from(i8::MAX)).then_some(raised as i8)
        };
        Some(Self {
            m: exponent(self.m)?,
            kg: exponent(self.kg)?,
            s: exponent(self.s)?,
            a: exponent(self.a)?,
        })
    }

    /// The usual unit of a derived dimension, such as `N`, if it has one.
    pub fn common_unit(self) -> Option<&'static str> {
        let of = |name: &str| Unit::parse(name).is_ok_and(|unit| unit.dimension == self);
        ["N", "N*m", "N/m", "N*m*s", "N*s/m", "W", "V", "Ohm", "H", "N*m/A"]
            .into_iter()
            .find(|name| of(name))
    }
}

/// In SI base units, as a unit is written: `kg*m^2*s^-2`; `1` without dimension.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors: Vec<String> = [("kg", self.kg), ("m", self.m), ("s", self.s), ("A", self.a)]
            .into_iter()
            .filter(|(_, exponent)| *exponent != 0)
            .map(|(base, exponent)| match exponent {
                1 => base.to_string(),
                _ => format!("{base}^{exponent}"),
            })
            .list();
        f.write_str(if factors.is_empty() { "1" } else { "" })?;
        f.write_str(&factors.join("*"))
    }
}

/// A unit: SI value = number · `numerator` / `denominator`.
///
/// There are two factors because 1000 is a floating-point number and 10⁻³ is not. `0.3 mm` is therefore rounded only
/// once, to the same number as `3e-4`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Factor to the SI unit.
    pub numerator: f64,
    /// Divisor to the SI unit.
    pub denominator: f64,
    /// The measured quantity.
    pub dimension: Dimension,
}

/// Common spellings of units, in lower case and singular.
const WORDS: &[(&[&str], &str)] = &[
    (&["meter", "metre"], "m"),
    (&["kilometer", "kilometre"], "km"),
    (&["centimeter", "centimetre"], "cm"),
    (&["millimeter", "millimetre"], "mm"),
    (&["micrometer", "micrometre", "micron"], "um"),
    (&["inch", "inche", "\""], "in"),
    (&["foot", "feet"], "ft"),
    (&["kilogram", "kilogramme", "kilo", "kilog"], "kg"),
    (&["gram", "gramme", "gr"], "g"),
    (&["milligram"], "mg"),
    (&["pound", "lbm"], "lb"),
    (&["ounce"], "oz"),
    (&["ton", "megagram"], "tonne"),
    (&["kilopond", "kp"], "kgf"),
    (&["pascal"], "Pa"),
    (&["megapascal"], "MPa"),
    (&["gigapascal"], "GPa"),
    (&["second", "sec"], "s"),
    (&["millisecond", "msec"], "ms"),
    (&["microsecond"], "us"),
    (&["minute"], "min"),
    (&["hour", "hr"], "h"),
    (&["radian"], "rad"),
    (&["degree"], "deg"),
    (&["revolution", "turn"], "rev"),
    (&["newton"], "N"),
    (&["kilonewton"], "kN"),
    (&["joule"], "J"),
    (&["watt"], "W"),
    (&["kilowatt"], "kW"),
    (&["ampere", "amp"], "A"),
    (&["volt"], "V"),
    (&["ohm"], "Ohm"),
    (&["henry"], "H"),
];

const fn unit(numerator: f64, denominator: f64, m: i8, kg: i8, s: i8) -> Unit {
    Unit { numerator, denominator, dimension: Dimension::new(m, kg, s) }
}

/// A unit of electricity.
const fn electric(numerator: f64, denominator: f64, [m, kg, s, a]: [i8; 4]) -> Unit {
    Unit { numerator, denominator, dimension: Dimension { m, kg, s, a } }
}

/// The factors of units. `t` is the time, not the tonne. `Hz` is omitted because it is ambiguous: it may count cycles
/// or radians.
pub const UNITS: &[(&str, Unit)] = &[
    // length
    ("m", unit(1.0, 1.0, 1, 0, 0)),
    ("km", unit(1e3, 1.0, 1, 0, 0)),
    ("cm", unit(1.0, 1e2, 1, 0, 0)),
    ("mm", unit(1.0, 1e3, 1, 0, 0)),
    ("um", unit(1.0, 1e6, 1, 0, 0)),
    ("in", unit(254.0, 1e4, 1, 0, 0)),
    ("ft", unit(3048.0, 1e4, 1, 0, 0)),
    // mass; the pound is 0.453 592 37 kg exactly, and the slug 1 lbf*s^2/ft
    ("kg", unit(1.0, 1.0, 0, 1, 0)),
    ("g", unit(1.0, 1e3, 0, 1, 0)),
    ("mg", unit(1.0, 1e6, 0, 1, 0)),
    ("tonne", unit(1e3, 1.0, 0, 1, 0)),
    ("lb", unit(45_359_237.0, 1e8, 0, 1, 0)),
    ("oz", unit(45_359_237.0, 16e8, 0, 1, 0)),
    ("slug", unit(44_482_216_152_605.0, 3.048e12, 0, 1, 0)),
    // time
    ("s", unit(1.0, 1.0, 0, 0, 1)),
    ("ms", unit(1.0, 1e3, 0, 0, 1)),
    ("us", unit(1.0, 1e6, 0, 0, 1)),
    ("min", unit(60.0, 1.0, 0, 0, 1)),
    ("h", unit(3600.0, 1.0, 0, 0, 1)),
    // angle and angular velocity; the factor of deg is the constant deg of the language
    ("rad", unit(1.0, 1.0, 0, 0, 0)),
    ("mrad", unit(1.0, 1e3, 0, 0, 0)),
    ("deg", unit(PI / 180.0, 1.0, 0, 0, 0)),
    ("rev", unit(2.0 * PI, 1.0, 0, 0, 0)),
    ("rpm", unit(2.0 * PI, 60.0, 0, 0, -1)),
    ("rps", unit(2.0 * PI, 1.0, 0, 0, -1)),
    // force; the pound-force is 4.448 221 615 260 5 N exactly
    ("N", unit(1.0, 1.0, 1, 1, -2)),
    ("mN", unit(1.0, 1e3, 1, 1, -2)),
    ("kN", unit(1e3, 1.0, 1, 1, -2)),
    ("MN", unit(1e6, 1.0, 1, 1, -2)),
    ("kgf", unit(980_665.0, 1e5, 1, 1, -2)),
    ("lbf", unit(44_482_216_152_605.0, 1e13, 1, 1, -2)),
    // pressure
    ("Pa", unit(1.0, 1.0, -1, 1, -2)),
    ("kPa", unit(1e3, 1.0, -1, 1, -2)),
    ("MPa", unit(1e6, 1.0, -1, 1, -2)),
    ("GPa", unit(1e9, 1.0, -1, 1, -2)),
    // energy
    ("J", unit(1.0, 1.0, 2, 1, -2)),
    ("mJ", unit(1.0, 1e3, 2, 1, -2)),
    ("kJ", unit(1e3, 1.0, 2, 1, -2)),
    ("MJ", unit(1e6, 1.0, 2, 1, -2)),
    // power
    ("W", unit(1.0, 1.0, 2, 1, -3)),
    ("mW", unit(1.0, 1e3, 2, 1, -3)),
    ("kW", unit(1e3, 1.0, 2, 1, -3)),
    ("MW", unit(1e6, 1.0, 2, 1, -3)),
    // electricity
    ("A", electric(1.0, 1.0, [0, 0, 0, 1])),
    ("mA", electric(1.0, 1e3, [0, 0, 0, 1])),
    ("V", electric(1.0, 1.0, [2, 1, -3, -1])),
    ("mV", electric(1.0, 1e3, [2, 1, -3, -1])),
    ("kV", electric(1e3, 1.0, [2, 1, -3, -1])),
    ("Ohm", electric(1.0, 1.0, [2, 1, -3, -2])),
    ("mOhm", electric(1.0, 1e3, [2, 1, -3, -2])),
    ("kOhm", electric(1e3, 1.0, [2, 1, -3, -2])),
    ("H", electric(1.0, 1.0, [2, 1, -2, -2])),
    ("mH", electric(1.0, 1e3, [2, 1, -2, -2])),
];

impl Unit {
    /// Reads a unit such as `"kg*m^2"`.
    ///
    /// # Errors
    /// A factor that is not in [`UNITS`], a malformed or absurd exponent; spans are in `text`.
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        let mut product = unit(1.0, 1.0, 0, 0, 0);
        let mut start = 0;
        let mut divide = false;
        loop {
            let rest = &text[start..];
            let end = start + rest.find(['*', '/', '·']).unwrap_or(rest.len());
            // the 1 of 1/s
            let nothing = start == 0 && end < text.len() && text[..end].trim() == "1";
            if !nothing {
                let (factor, power) = factor(text, start..end)?;
                let power = if divide { -power } else { power };
                product = product.times(factor, power).ok_or_else(|| {
                    ExpressionError::new(0..text.len(), "the exponents of the unit are too large")
                })?;
            }
            let Some(mark) = text[end..].chars().next() else { return Ok(product) };
            divide = mark == '/';
            start = end + mark.len_utf8();
        }
    }

    /// The number `value` of this unit in SI; `None` if the result overflows or underflows.
    pub fn scale(&self, value: f64) -> Option<f64> {
        let si = value * self.numerator / self.denominator;
        (si.is_finite() && (si != 0.0 || value == 0.0)).then_some(si)
    }

    /// `self` · `factor`^`power`; `None` if the result overflows.
    fn times(self, factor: Self, power: i8) -> Option<Self> {
        let magnitude = i32::from(power.unsigned_abs());
        let (up, down) = if power < 0 {
            (factor.denominator, factor.numerator)
        } else {
            (factor.numerator, factor.denominator)
        };
        let numerator = self.numerator * up.powi(magnitude);
        let denominator = self.denominator * down.powi(magnitude);
        let dimension = self.dimension.times(factor.dimension, power)?;
        let finite = numerator.is_finite() && denominator.is_finite();
        finite.then_some(Self { numerator, denominator, dimension })
    }
}

/// `atom ["^" integer]` at `span` of `text`.
fn factor(text: &str, span: Range<usize>) -> Result<(Unit, i8), ExpressionError> {
    let raw = &text[span.clone()];
    let from = span.start + raw.len() - raw.trim_start().len();
    let written = raw.trim();
    let span = from..from + written.len();
    let (name, exponent) = written.split_once('^').unwrap_or((written, "1"));
    let power = match exponent.trim().parse::<i8>() {
        Ok(power) if (-9..=9).contains(&power) => power,
        _ => {
            let exponent = exponent.escape_debug();
            let message = format!("the exponent '{exponent}' of a unit is not a small integer");
            return Err(ExpressionError::new(span, message));
        }
    };
    match atom(name.trim()) {
        Some(unit) => Ok((unit, power)),
        None => Err(unknown(name.trim(), span)),
    }
}

/// The unit with that name.
pub(super) fn atom(name: &str) -> Option<Unit> {
    let name = match name {
        "°" => "deg",
        "µm" | "μm" => "um", // micro sign and Greek mu
        "µs" | "μs" => "us",
        "Ω" => "Ohm",
        _ => name,
    };
    UNITS.iter().find(|(known, _)| *known == name).map(|(_, unit)| *unit)
}

/// The unit that a word means: a spelt-out unit, or a product without operators, such as `kNm`.
pub(super) fn meant(word: &str) -> Option<String> {
    let lower = word.to_lowercase();
    let singular = lower.strip_suffix('s').unwrap_or(&lower);
    let spelt = WORDS.iter().find(|(words, _)| words.contains(&singular)).map(|(_, unit)| *unit);
    // a plural such as `kgs` is not a product with the second; did_you_mean finds its unit
    let plural = ["kg", "lb", "rad", "deg", "rev", "mm", "cm", "km", "ft", "min"];
    if word.strip_suffix('s').is_some_and(|one| plural.contains(&one)) {
        return None;
    }
    spelt.map(str::to_string).or_else(|| product(word, 3))
}

/// A word as a product of up to `most` units, the last with a digit as its exponent: `kgm2`.
fn product(word: &str, most: usize) -> Option<String> {
    if atom(word).is_some() {
        return Some(word.to_string());
    }
    let letters = word.trim_end_matches(|c: char| c.is_ascii_digit());
    match word[letters.len()..].parse::<i8>() {
        Ok(power) if atom(letters).is_some() && power < 10 => {
            return Some(format!("{letters}^{power}"))
        }
        _ if most == 1 => return None,
        _ => {}
    }
    // `Nms` contains the metre and the second, not the millisecond
    if let Some(first) = word.strip_suffix("ms").filter(|first| atom(first).is_some()) {
        return Some(format!("{first}*m*s"));
    }
    (1..word.len()).rev().filter(|cut| word.is_char_boundary(*cut)).find_map(|cut| {
        let (first, rest) = word.split_at(cut);
        let first = atom(first).map(|_| first)?;
        product(rest, most - 1).map(|rest| format!("{first}*{rest}"))
    })
}

fn unknown(name: &str, span: Range<usize>) -> ExpressionError {
    if name.is_empty() {
        return ExpressionError::new(span, "a unit is missing here");
    }
    let hint = match name {
        "t" => Some("t is the time; a tonne is 'tonne'".to_string()),
        "Hz" | "kHz" => Some("write rpm, rev/s or rad/s: Hz does not say which".to_string()),
        _ => meant(name)
            .map(|unit| format!("write '{unit}'"))
            .or_else(|| did_you_mean(name, UNITS.iter().map(|(known, _)| known))),
    };
    ExpressionError::new(span, format!("unknown unit '{}'", name.escape_debug())).hint(hint)
}
