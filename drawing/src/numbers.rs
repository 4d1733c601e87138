//! Numbers as short texts: nine significant digits in a scene, four in a drawing.

/// A number to nine significant digits, without a negative zero.
pub fn rounded(value: f64) -> f64 {
    if !value.is_finite() {
        return value;
    }
    // the text of a finite number is a number
    format!("{value:.8e}").parse().unwrap_or(value) + 0.0
}

/// A number with some significant digits and without trailing zeros, like `%g` in C.
pub fn general(value: f64, digits: usize) -> String {
    let written = format!("{value:.*e}", digits.saturating_sub(1));
    let Some((mantissa, exponent)) = written.split_once('e') else { return written };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let short = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => text.to_string(),
    };
    if (-4..digits as i32).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        return short(&format!("{value:.decimals$}"));
    }
    let sign = if exponent < 0 { '-' } else { '+' };
    format!("{}e{sign}{:02}", short(mantissa), exponent.abs())
}

#[cfg(test)]
mod tests {
    use super::{general, rounded};

    #[test]
    fn texts_are_those_of_c() {
        let of = |x: f64| general(x, 4);
        assert_eq!([0.5, 9.81, 12.3456, 9999.5].map(of), ["0.5", "9.81", "12.35", "1e+04"]);
        assert_eq!([100.0, 0.0, 1.2345e-5, -2.5].map(of), ["100", "0", "1.234e-05", "-2.5"]);
    }

    #[test]
    fn nine_digits_are_kept() {
        assert_eq!(rounded(2.0 / 3.0), 0.666666667);
        assert_eq!(rounded(-1.234567894999e-7), -1.23456789e-7);
        assert_eq!(rounded(-0.0).to_bits(), 0.0_f64.to_bits());
        assert!(rounded(f64::NAN).is_nan());
    }
}
