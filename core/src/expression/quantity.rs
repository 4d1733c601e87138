//! A number with a unit, as a whole text: `30 deg`, `-5 kN`.

use super::lexer::{Lexer, TokenKind};
use super::names::is_name_part;
use super::tree::{Node, NodeKind};
use super::unit::{atom, meant, Unit};
use super::ExpressionError;
use crate::math::Listed;
use std::ops::Range;

/// Reads `["-" | "+"] number unit`; `None` if the text is something else.
///
/// A longer text that begins with a quantity (`30 deg + 1`) is an error here. For a number followed by a name that is
/// not a unit (`2 pi`), the error message of the parser is better.
pub(super) fn read(text: &str) -> Result<Option<(Node, Unit)>, ExpressionError> {
    let Some((value, end)) = signed_number(text) else { return Ok(None) };
    let written = text[end..].trim();
    if !written.starts_with(|c: char| c.is_alphabetic() || c == '°') {
        return Ok(None);
    }
    let start = end + text[end..].len() - text[end..].trim_start().len();
    match Unit::parse(written) {
        Ok(unit) => match unit.scale(value) {
            Some(si) => {
                let span = 0..text.trim_end().len();
                Ok(Some((Node { kind: NodeKind::Number(si), span }, unit)))
            }
            None => Err(ExpressionError::new(
                0..text.len(),
                "the quantity is too large or too small for a number in SI units",
            )),
        },
        Err(_) if continues(written) => Err(continued(text, start)),
        Err(error) if is_meant_as_unit(written, &error) => {
            let span = start + error.span.start..start + error.span.end;
            Err(ExpressionError { span, ..error })
        }
        Err(_) => Ok(None),
    }
}

/// The number at the beginning, with its sign, and where it ends.
fn signed_number(text: &str) -> Option<(f64, usize)> {
    let mut lexer = Lexer::new(text);
    let mut token = lexer.next().ok()?;
    let sign = match token.kind {
        TokenKind::Mark('-') => -1.0,
        TokenKind::Mark('+') | TokenKind::Number(_) => 1.0,
        _ => return None,
    };
    if let TokenKind::Mark(_) = token.kind {
        token = lexer.next().ok()?;
    }
    match token.kind {
        TokenKind::Number(value) => Some((sign * value, lexer.position)),
        _ => None,
    }
}

fn first_word(written: &str) -> &str {
    let end = written.find(|c: char| !is_name_part(c) && !c.is_alphabetic() && c != '°');
    &written[..end.unwrap_or(written.len())]
}

/// Whether a unit is followed by more of an expression.
fn continues(written: &str) -> bool {
    atom(first_word(written)).is_some()
        && written.contains(['+', '(', ')', ',', '<', '>', ' ', '-'])
}

fn continued(text: &str, start: usize) -> ExpressionError {
    let word = first_word(&text[start..]);
    let span = start..start + word.len();
    if let Some(product) = spaced(&text[start..]) {
        let once = text[start..].split_whitespace().all(|unit| unit == word);
        let hint = match once {
            true => format!("write '{word}' once, or the product '{product}'"),
            false => format!("write '{product}'"),
        };
        return ExpressionError::new(start..text.len(), "units are separated by spaces").hint(hint);
    }
    let hint = multiplied(text, span.clone()).map(|text| format!("write {text}"));
    ExpressionError::new(span, "a unit may follow only a number that stands alone").hint(hint)
}

/// The longest text that is repeated in a hint, in characters.
const MOST_REPEATED: usize = 60;

/// The text with a factor in SI units in place of the unit at `span`: `1/2 in` → `1/2*0.0254`. None if it is not a unit.
///
/// The product has the value of all factors before the unit, times the unit. Of a long text, only the factor is given.
pub(super) fn multiplied(text: &str, span: Range<usize>) -> Option<String> {
    let unit = Unit::parse(&text[span.clone()]).ok()?;
    let factor = match (&text[span.clone()], unit.scale(1.0)?) {
        ("deg" | "°", _) => "*deg".to_string(),
        (_, 1.0) => String::new(),
        (_, factor) => format!("*{factor:?}"),
    };
    let (before, after) = (text[..span.start].trim(), text[span.end..].trim_end());
    let visible = |c: char| c == ' ' || c.is_ascii_graphic();
    let repeats = text.len() <= MOST_REPEATED && (before.chars().chain(after.chars())).all(visible);
    Some(if repeats { format!("{before}{factor}{after}") } else { format!("…{factor}") })
}

/// Units with spaces between them as a product: `kg m^2`.
fn spaced(written: &str) -> Option<String> {
    let product = written.split_whitespace().list().join("*");
    Unit::parse(&product).is_ok().then_some(product)
}

/// Whether the word after the number is, or is nearly, a unit.
fn is_meant_as_unit(written: &str, error: &ExpressionError) -> bool {
    let word = first_word(written);
    let known = atom(word).is_some() || meant(word).is_some();
    known || (error.hint.is_some() && word == written)
}
