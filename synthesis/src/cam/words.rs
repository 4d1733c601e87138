//! Numbers in messages.

/// A number with some digits, without zeros at its end, and with an exponent where it is shorter.
pub fn short(x: f64, digits: usize) -> String {
    let text = format!("{:.*e}", digits - 1, x);
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    let power: i32 = exponent.parse().unwrap_or(0);
    if power < -4 || power >= digits as i32 {
        let sign = if power < 0 { '-' } else { '+' };
        return format!("{}e{sign}{:02}", trimmed(mantissa), power.abs());
    }
    let decimals = (digits as i32 - 1 - power) as usize;
    trimmed(&format!("{x:.decimals$}")).into()
}

fn trimmed(text: &str) -> &str {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => text,
    }
}

/// An angle in degrees with some digits.
pub fn degrees(angle: f64, digits: usize) -> String {
    short(angle.to_degrees(), digits)
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        let cases = [(0.0, "0"), (0.01, "0.01"), (1e-5, "1e-05"), (123_456_789.0, "1.23457e+08")];
        for (x, wanted) in
            cases.into_iter().chain([(-2.5, "-2.5"), (100.0, "100"), (999_999.7, "1e+06")])
        {
            assert_eq!(short(x, 6), wanted);
        }
    }
}
