//! The numbers of a result that is not a motion.

use crate::math::{Complex, Listed};
use serde_json::Value;

/// One number, or rows of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberList {
    values: Vec<Complex>,
    /// The number of rows; None for one number.
    rows: Option<usize>,
}

impl NumberList {
    /// One number.
    pub fn one(x: f64) -> Self {
        Self { values: vec![Complex::new(x, 0.0)], rows: None }
    }

    /// A list.
    pub fn list(values: impl IntoIterator<Item = f64>) -> Self {
        let values = values.into_iter().map(|x| Complex::new(x, 0.0)).list();
        Self { rows: Some(values.len()), values }
    }

    /// A list of complex numbers.
    pub fn complex(values: Vec<Complex>) -> Self {
        Self { rows: Some(values.len()), values }
    }

    /// A finding: a number, NaN in place of null, 1 and 0 in place of true and false, or the number of entries of a
    /// table.
    pub fn found(finding: &Value) -> Self {
        match finding {
            Value::Array(of) => Self::one(of.len() as f64),
            Value::Object(of) => Self::one(of.len() as f64),
            Value::Bool(is) => Self::one(f64::from(*is)),
            one => Self::one(one.as_f64().unwrap_or(f64::NAN)),
        }
    }

    /// The findings of all points of a path, or of the only point.
    pub fn along(points: &[Self], is_path: bool) -> Self {
        match points {
            [only] if !is_path => only.clone(),
            _ => Self {
                values: points.iter().flat_map(|one| one.values.iter().copied()).list(),
                rows: Some(points.len()),
            },
        }
    }

    /// The number that a text such as `frequency` or `frequency[0]` names.
    ///
    /// # Errors
    /// There is no such number.
    pub fn at(&self, text: &str) -> Result<f64, String> {
        let (name, place) = parts(text);
        let count = self.rows.unwrap_or(0);
        let chosen = match place {
            None if self.values.len() == 1 => &self.values[..],
            None => {
                return Err(format!(
                    "{name} has {count} values; name one of them, such as {name}[0]"
                ));
            }
            Some(place) => {
                let from_end = if place < 0 { count as i64 } else { 0 };
                let row = usize::try_from(place + from_end).ok().filter(|row| *row < count);
                let absent = || format!("{text}: the result has {count} values of {name}");
                let width = self.values.len() / count.max(1);
                self.values.chunks(width.max(1)).nth(row.ok_or_else(absent)?).unwrap_or_default()
            }
        };
        match chosen {
            [only] if only.im == 0.0 => Ok(only.re),
            _ => Err(format!("{text} is not one real number")),
        }
    }
}

/// The name and the place in a text: `frequency[0]` → ("frequency", 0).
pub fn parts(text: &str) -> (&str, Option<i64>) {
    let text = text.trim();
    let place = text.strip_suffix(']').and_then(|text| text.rsplit_once('['));
    let place = place.and_then(|(name, place)| Some((name, place.parse().ok()?)));
    place.map_or((text, None), |(name, place)| (name, Some(place)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_counts_from_either_end() {
        let three = NumberList::list([1.0, 2.0, 3.0]);
        assert_eq!([three.at("x[0]"), three.at("x[-1]")], [Ok(1.0), Ok(3.0)]);
        assert_eq!(three.at("x[3]").unwrap_err(), "x[3]: the result has 3 values of x");
        assert_eq!(three.at("x[-4]").unwrap_err(), "x[-4]: the result has 3 values of x");
        let vague = "x has 3 values; name one of them, such as x[0]";
        assert_eq!(three.at("x").unwrap_err(), vague);
        assert_eq!(NumberList::list([5.0]).at("x"), Ok(5.0));
        assert_eq!(
            NumberList::one(5.0).at("x[0]").unwrap_err(),
            "x[0]: the result has 0 values of x"
        );
    }

    #[test]
    fn rows_and_complex_numbers_are_not_one_number() {
        let rows =
            NumberList::along(&[NumberList::list([1.0, 2.0]), NumberList::list([3.0, 4.0])], true);
        assert_eq!(rows.at("x[1]").unwrap_err(), "x[1] is not one real number");
        let s = NumberList::complex(vec![Complex::new(1.0, 2.0), Complex::new(3.0, 0.0)]);
        assert_eq!(s.at("s[0]").unwrap_err(), "s[0] is not one real number");
        assert_eq!(s.at("s[1]"), Ok(3.0));
    }
}
