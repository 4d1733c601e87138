//! Formulas of the columns of a sweep, such as `C.force.max + 0.1*motor.effort.rms`, and comparisons of these.

use super::refused;
use crate::fault::Fault;
use kempe::expression::Expression;

/// The columns in formulas, each once.
pub struct Columns<'a> {
    parameters: &'a [String],
    /// Their names.
    pub found: Vec<String>,
}

impl<'a> Columns<'a> {
    /// No columns yet; formulas may contain these parameters.
    pub fn new(parameters: &'a [String]) -> Self {
        Self { parameters, found: Vec::new() }
    }

    /// A formula in which each column is the name `__c` with its number.
    pub fn named(&mut self, text: &str) -> Result<String, Fault> {
        let none: &[String] = &[];
        if Expression::parse(text).and_then(|of| of.compile(none)).is_ok() {
            return Ok(text.to_string()); // a number with a unit
        }
        let (mut written, mut rest) = (String::new(), text);
        while let Some(first) = rest.chars().next() {
            let is_name = first == '`' || first == '_' || first.is_ascii_alphabetic();
            let length = match is_name {
                true => name(rest),
                false if first.is_ascii_digit() || first == '.' => digits(rest),
                false => first.len_utf8(),
            };
            let (token, after) = rest.split_at(length);
            rest = after;
            match is_name {
                true => written.push_str(&self.token(token, after)?),
                false => written.push_str(token),
            }
        }
        Ok(written)
    }

    /// A name as the core reads it.
    fn token(&mut self, token: &str, after: &str) -> Result<String, Fault> {
        if after.starts_with(':') {
            return Err(refused("numbers of several analyses"));
        }
        if after.trim_start().starts_with('(') {
            return if token == "worst" {
                Err(refused("load cases"))
            } else {
                Ok(token.to_string())
            };
        }
        let bare = token.replace('`', "");
        if self.parameters.contains(&bare) || bare == "pi" || bare == "deg" {
            return Ok(bare);
        }
        let known = self.found.iter().position(|name| *name == bare);
        let place = known.unwrap_or_else(|| {
            self.found.push(bare);
            self.found.len() - 1
        });
        Ok(format!("__c{place}"))
    }
}

/// The length of a name at the beginning of a text: parts with points, quoted parts, and an index.
fn name(text: &str) -> usize {
    let (mut quoted, mut index) = (false, false);
    for (place, c) in text.char_indices() {
        match c {
            '`' => quoted = !quoted,
            '[' => index = true,
            ']' if index => return place + 1,
            _ if quoted || index || c == '_' || c == '.' || c.is_ascii_alphanumeric() => {}
            _ => return place,
        }
    }
    text.len()
}

/// The length of a number at the beginning of a text.
fn digits(text: &str) -> usize {
    let mut before = ' ';
    for (place, c) in text.char_indices() {
        let sign = (c == '-' || c == '+') && (before == 'e' || before == 'E');
        if !(c.is_ascii_digit() || c == '.' || c == 'e' || c == 'E' || sign) {
            return place;
        }
        before = c;
    }
    text.len()
}

/// The smaller and the larger side of a comparison.
pub fn compared(text: &str) -> Result<[&str; 2], Fault> {
    let (mut depth, mut quoted, mut places) = (0, false, Vec::new());
    for (place, c) in text.char_indices() {
        match c {
            '`' => quoted = !quoted,
            '(' => depth += 1,
            ')' => depth -= 1,
            '<' | '>' if depth == 0 && !quoted => places.push(place),
            _ => {}
        }
    }
    let [place] = places[..] else {
        let message = format!("the limit '{text}' is not one comparison");
        return Err(Fault::new(message).hint("write it as C.force.max <= 2e4"));
    };
    let (left, right) = (&text[..place], text[place + 1..].trim_start_matches('='));
    let sides = [left.trim(), right.trim()];
    Ok(if text[place..].starts_with('<') { sides } else { [sides[1], sides[0]] })
}
