//! Text → tokens.

use super::names::{is_name_part, is_name_start};
use super::operation::Relation;
use super::ExpressionError;
use std::ops::Range;

/// The smallest piece of a text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TokenKind {
    /// A number without a sign.
    Number(f64),
    /// A name without its backticks.
    Name(String),
    /// One of `+ - * / ^ ( ) ,`.
    Mark(char),
    /// A comparison.
    Relation(Relation),
    /// The end of the text.
    End,
}

/// A token and its bytes in the text.
#[derive(Clone, Debug)]
pub(super) struct Token {
    pub kind: TokenKind,
    pub span: Range<usize>,
}

/// Reads one token after the other.
pub(super) struct Lexer<'a> {
    text: &'a str,
    /// First byte not read yet; always on a character boundary.
    pub position: usize,
}

impl<'a> Lexer<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, position: 0 }
    }

    fn rest(&self) -> &'a str {
        &self.text[self.position..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// Skips the characters that `accepts` admits and returns their number of bytes.
    fn skip(&mut self, accepts: impl Fn(char) -> bool) -> usize {
        let rest = self.rest();
        let length = rest.len() - rest.trim_start_matches(accepts).len();
        self.position += length;
        length
    }

    /// The next token.
    pub fn next(&mut self) -> Result<Token, ExpressionError> {
        self.skip(|c| matches!(c, ' ' | '\t' | '\n' | '\r'));
        let start = self.position;
        let kind = match self.peek() {
            None => TokenKind::End,
            Some(c) if c.is_ascii_digit() || c == '.' => self.number()?,
            Some(c) if is_name_start(c) || c == '`' => self.name()?,
            Some(c) => self.mark(c)?,
        };
        Ok(Token { kind, span: start..self.position })
    }

    fn number(&mut self) -> Result<TokenKind, ExpressionError> {
        let start = self.position;
        let mut digits = self.skip(|c| c.is_ascii_digit());
        if self.peek() == Some('.') {
            self.position += 1;
            digits += self.skip(|c| c.is_ascii_digit());
        }
        if digits == 0 {
            return Err(ExpressionError::new(start..self.position, "unexpected '.'"));
        }
        if matches!(self.peek(), Some('e' | 'E')) {
            self.exponent(start)?;
        }
        let span = start..self.position;
        let written = &self.text[span.clone()];
        match written.parse::<f64>() {
            Ok(value) if value.is_infinite() => {
                Err(ExpressionError::new(span, format!("{written} is too large for a number"))
                    .hint("the largest is about 1.8e308".to_string()))
            }
            Ok(value) if value == 0.0 && has_digit_above_zero(written) => {
                Err(ExpressionError::new(span, format!("{written} is too small for a number"))
                    .hint("the smallest is about 5e-324; write 0 for none".to_string()))
            }
            Ok(value) => Ok(TokenKind::Number(value)),
            Err(_) => Err(ExpressionError::new(span, format!("{written} is not a number"))),
        }
    }

    fn exponent(&mut self, start: usize) -> Result<(), ExpressionError> {
        self.position += 1;
        if matches!(self.peek(), Some('+' | '-')) {
            self.position += 1;
        }
        if self.skip(|c| c.is_ascii_digit()) > 0 {
            return Ok(());
        }
        let span = start..self.position;
        let written = &self.text[span.clone()];
        Err(ExpressionError::new(span, format!("the exponent of {written} has no digits")))
    }

    fn name(&mut self) -> Result<TokenKind, ExpressionError> {
        let start = self.position;
        let mut name = String::new();
        loop {
            name.push_str(self.name_part(start)?);
            if self.peek() != Some('.') {
                return Ok(TokenKind::Name(name));
            }
            name.push('.');
            self.position += 1;
        }
    }

    fn name_part(&mut self, start: usize) -> Result<&'a str, ExpressionError> {
        match self.peek() {
            Some('`') => self.quoted(),
            Some(c) if is_name_start(c) => {
                let first = self.position;
                self.skip(is_name_part);
                Ok(&self.text[first..self.position])
            }
            _ => {
                let span = start..self.position;
                let written = &self.text[span.clone()];
                Err(ExpressionError::new(span, format!("a coordinate must follow '{written}'"))
                    .hint("such as x, y, angle, vx, vy or omega".to_string()))
            }
        }
    }

    fn quoted(&mut self) -> Result<&'a str, ExpressionError> {
        let start = self.position;
        self.position += 1;
        let length = self.skip(|c| c != '`' && !c.is_control());
        if self.peek() != Some('`') {
            let span = start..start + 1;
            return Err(ExpressionError::new(span, "the name after this backtick does not end")
                .hint("close it with another backtick".to_string()));
        }
        self.position += 1;
        if length == 0 {
            return Err(ExpressionError::new(start..self.position, "a name cannot be empty"));
        }
        Ok(&self.text[start + 1..self.position - 1])
    }

    fn mark(&mut self, c: char) -> Result<TokenKind, ExpressionError> {
        let start = self.position;
        self.position += c.len_utf8();
        let or_equal = self.peek() == Some('=');
        let kind = match (c, or_equal) {
            ('+' | '-' | '*' | '/' | '^' | '(' | ')' | ',', _) => return Ok(TokenKind::Mark(c)),
            ('<', false) => Relation::Less,
            ('<', true) => Relation::LessOrEqual,
            ('>', false) => Relation::Greater,
            ('>', true) => Relation::GreaterOrEqual,
            _ => return Err(unexpected(c, start)),
        };
        self.position += usize::from(or_equal);
        Ok(TokenKind::Relation(kind))
    }
}

fn has_digit_above_zero(number: &str) -> bool {
    let mantissa = number.split(['e', 'E']).next().unwrap_or(number);
    mantissa.contains(|c: char| c.is_ascii_digit() && c != '0')
}

/// The error for a character that is not in the language.
fn unexpected(c: char, start: usize) -> ExpressionError {
    let span = start..start + c.len_utf8();
    let hint = match c {
        '−' | '–' | '—' => "write the minus sign '-'",
        '·' | '×' | '∙' | '⋅' => "write '*' to multiply",
        '÷' | ':' => "write '/' to divide",
        '²' => "write '^2'",
        '³' => "write '^3'",
        '≤' => "write '<='",
        '≥' => "write '>='",
        'π' => "write 'pi'",
        '°' => "write '30*deg'",
        '=' | '!' => "conditions are <, <=, > and >=",
        '[' | ']' | '{' | '}' => "group with parentheses",
        ';' => "arguments are separated by ','",
        _ if c.is_alphanumeric() => "names with other characters are written between backticks",
        _ => return ExpressionError::new(span, format!("unexpected {}", shown(c))),
    };
    ExpressionError::new(span, format!("unexpected {}", shown(c))).hint(hint.to_string())
}

/// A character as printed in an error message: by its code point if it is invisible.
fn shown(c: char) -> String {
    if c.is_control() || c.is_whitespace() || c.escape_debug().count() > 2 {
        format!("character U+{:04X}", c as u32)
    } else {
        format!("'{c}'")
    }
}
