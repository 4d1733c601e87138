//! The path data of SVG: M L H V C S Q T A Z, absolute and relative (SVG 1.1, section 8.3).
//!
//! Coordinates are in m in the frame of the body, y upwards. Curves become polylines.

use crate::math::Local;
use std::ops::Range;

/// Straight pieces of one Bézier curve, and of a full turn of an arc.
const OF_CURVE: usize = 24;
const OF_TURN: f64 = 96.0;

const ORIGIN: Local = Local { x: 0.0, y: 0.0 };

/// A part of a path from one M to the next.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subpath {
    /// Its points in order, m.
    pub points: Vec<Local>,
    /// Whether Z closes it.
    pub closed: bool,
}

/// A faulty place of a path.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    /// The faulty bytes of the text.
    pub span: Range<usize>,
    /// What is wrong there.
    pub message: String,
}

/// The parts of a path as polylines.
pub(super) fn parse(text: &str) -> Result<Vec<Subpath>, Fault> {
    let mut pen =
        Pen { parts: Vec::new(), at: ORIGIN, start: ORIGIN, lifted: true, controls: [None; 2] };
    let mut reader = Reader { text, at: 0 };
    let mut before = None;
    while let Some((command, start)) = reader.command(before)? {
        if before.is_none() && !command.eq_ignore_ascii_case(&'M') {
            let message = format!("starts with '{command}'; must start with M");
            return Err(Fault { span: start..start + 1, message });
        }
        before = Some(command);
        pen.follow(command, &mut reader)?;
    }
    let found: Vec<Subpath> = pen.parts.into_iter().filter(|part| part.points.len() > 1).collect();
    match found.is_empty() {
        true => Err(Fault { span: 0..text.len(), message: "draws nothing".to_string() }),
        false => Ok(found),
    }
}

/// Reads commands and numbers.
struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl Reader<'_> {
    fn skip(&mut self, more: &[char]) {
        let skipped = |c: char| c.is_ascii_whitespace() || more.contains(&c);
        self.at = self.text.len() - self.text[self.at..].trim_start_matches(skipped).len();
    }

    /// The next command and its place; `before` is repeated if numbers follow without one. None at the end.
    fn command(&mut self, before: Option<char>) -> Result<Option<(char, usize)>, Fault> {
        self.skip(if before.is_some() { &[','] } else { &[] });
        let Some(next) = self.text[self.at..].chars().next() else { return Ok(None) };
        let start = self.at;
        if "MmLlHhVvCcSsQqTtAaZz".contains(next) {
            self.at += 1;
            return Ok(Some((next, start)));
        }
        let number = next.is_ascii_digit() || "+-.".contains(next);
        match before {
            Some('M') if number => Ok(Some(('L', start))),
            Some('m') if number => Ok(Some(('l', start))),
            Some(before) if number && !before.eq_ignore_ascii_case(&'Z') => {
                Ok(Some((before, start)))
            }
            _ => {
                let message =
                    format!("'{next}' is not a command; must be one of M L H V C S Q T A Z");
                Err(Fault { span: start..start + next.len_utf8(), message })
            }
        }
    }

    fn number(&mut self) -> Result<f64, Fault> {
        self.skip(&[',']);
        let rest = &self.text[self.at..];
        let length = number_length(rest.as_bytes());
        let found = rest[..length].parse::<f64>().ok().filter(|x| x.is_finite());
        let Some(found) = found else {
            let shown = rest.chars().next();
            let span = self.at..self.at + shown.map_or(0, |c| length.max(c.len_utf8()));
            let message = match shown {
                None => "ends before its last command has all numbers".to_string(),
                Some(_) => format!("'{}' is not a number", &self.text[span.clone()]),
            };
            return Err(Fault { span, message });
        };
        self.at += length;
        Ok(found)
    }

    fn pair(&mut self) -> Result<Local, Fault> {
        Ok(Local::new(self.number()?, self.number()?))
    }

    /// One digit, which need not be separated from the next number.
    fn flag(&mut self) -> Result<bool, Fault> {
        self.skip(&[',']);
        let found = self.text[self.at..].chars().next();
        let span = self.at..self.at + found.map_or(0, char::len_utf8);
        self.at = span.end;
        match found {
            Some('0') => Ok(false),
            Some('1') => Ok(true),
            _ => Err(Fault { span, message: "a flag of an arc must be 0 or 1".to_string() }),
        }
    }
}

/// Length of the number at the start of a text; 0 without one.
fn number_length(text: &[u8]) -> usize {
    let digits = |from: usize| text[from..].iter().take_while(|c| c.is_ascii_digit()).count();
    let sign = |from: usize| usize::from(matches!(text.get(from), Some(b'+' | b'-')));
    let mut end = sign(0);
    let whole = digits(end);
    end += whole;
    let mut some = whole > 0;
    if text.get(end) == Some(&b'.') {
        let fraction = digits(end + 1);
        some |= fraction > 0;
        end += 1 + fraction;
    }
    if !some {
        return 0;
    }
    if matches!(text.get(end), Some(b'e' | b'E')) {
        let start = end + 1 + sign(end + 1);
        let exponent = digits(start);
        if exponent > 0 {
            end = start + exponent;
        }
    }
    end
}

/// Draws the parts.
struct Pen {
    parts: Vec<Subpath>,
    at: Local,
    /// The start of the present part.
    start: Local,
    /// Whether the next line begins a part.
    lifted: bool,
    /// The last control point of a cubic and of a quadratic curve.
    controls: [Option<Local>; 2],
}

impl Pen {
    fn follow(&mut self, command: char, reader: &mut Reader) -> Result<(), Fault> {
        let origin = if command.is_ascii_lowercase() { self.at } else { ORIGIN };
        let mut controls = [None, None];
        match command.to_ascii_uppercase() {
            'M' => {
                self.at = origin + reader.pair()?;
                (self.start, self.lifted) = (self.at, true);
            }
            'L' => self.line(origin + reader.pair()?),
            'H' => self.line(Local::new(origin.x + reader.number()?, self.at.y)),
            'V' => self.line(Local::new(self.at.x, origin.y + reader.number()?)),
            'C' => {
                let [a, b, c] = [reader.pair()?, reader.pair()?, reader.pair()?];
                self.cubic(origin + a, origin + b, origin + c);
                controls[0] = Some(origin + b);
            }
            'S' => {
                let (b, c) = (origin + reader.pair()?, origin + reader.pair()?);
                self.cubic(self.mirrored(0), b, c);
                controls[0] = Some(b);
            }
            'Q' => {
                let (a, b) = (origin + reader.pair()?, origin + reader.pair()?);
                self.quadratic(a, b);
                controls[1] = Some(a);
            }
            'T' => {
                let (a, b) = (self.mirrored(1), origin + reader.pair()?);
                self.quadratic(a, b);
                controls[1] = Some(a);
            }
            'A' => {
                let (radii, turn) = (reader.pair()?, reader.number()?.to_radians());
                let flags = [reader.flag()?, reader.flag()?];
                self.arc(radii, turn, flags, origin + reader.pair()?);
            }
            _ => {
                if let Some(part) = self.parts.last_mut().filter(|_| !self.lifted) {
                    part.closed = true;
                }
                (self.at, self.lifted) = (self.start, true);
            }
        }
        self.controls = controls;
        Ok(())
    }

    fn line(&mut self, to: Local) {
        if self.lifted || self.parts.is_empty() {
            self.parts.push(Subpath { points: vec![self.at], closed: false });
            self.lifted = false;
        }
        self.parts.last_mut().expect("just made").points.push(to);
        self.at = to;
    }

    /// The control point that continues the curve before smoothly.
    fn mirrored(&self, kind: usize) -> Local {
        self.controls[kind].map_or(self.at, |control| self.at + (self.at - control))
    }

    fn cubic(&mut self, a: Local, b: Local, c: Local) {
        let o = self.at;
        for k in 1..=OF_CURVE {
            let s = k as f64 / OF_CURVE as f64;
            let r = 1.0 - s;
            let [i, j, m, n] = [r * r * r, 3.0 * r * r * s, 3.0 * r * s * s, s * s * s];
            let at = |o: f64, a: f64, b: f64, c: f64| i * o + j * a + m * b + n * c;
            self.line(Local::new(at(o.x, a.x, b.x, c.x), at(o.y, a.y, b.y, c.y)));
        }
        self.at = c;
    }

    /// A quadratic curve as a cubic one.
    fn quadratic(&mut self, a: Local, b: Local) {
        let part = |from: Local| {
            Local::new(from.x + (a.x - from.x) * 2.0 / 3.0, from.y + (a.y - from.y) * 2.0 / 3.0)
        };
        self.cubic(part(self.at), part(b), b);
    }

    /// An elliptical arc: from its ends to its centre and angles (SVG 1.1, appendix F.6.5 and F.6.6).
    fn arc(&mut self, radii: Local, turn: f64, [large, sweep]: [bool; 2], to: Local) {
        let (mut rx, mut ry) = (radii.x.abs(), radii.y.abs());
        let from = self.at;
        if rx == 0.0 || ry == 0.0 || from == to {
            return self.line(to);
        }
        let (sin, cos) = turn.sin_cos();
        let half = Local::new((from.x - to.x) / 2.0, (from.y - to.y) / 2.0);
        let (x, y) = (cos * half.x + sin * half.y, cos * half.y - sin * half.x);
        let short = ((x / rx).powi(2) + (y / ry).powi(2)).sqrt();
        if short > 1.0 {
            (rx, ry) = (rx * short, ry * short);
        }
        let (u, v) = (x / rx, y / ry);
        let far = ((1.0 - u * u - v * v).max(0.0) / (u * u + v * v)).sqrt();
        let side = if large == sweep { -far } else { far };
        let (cu, cv) = (side * v, -side * u);
        let middle = Local::new((from.x + to.x) / 2.0, (from.y + to.y) / 2.0);
        let place = |u: f64, v: f64| {
            let (x, y) = (rx * u, ry * v);
            Local::new(middle.x + cos * x - sin * y, middle.y + sin * x + cos * y)
        };
        let (first, last) = ((v - cv).atan2(u - cu), (-v - cv).atan2(-u - cu));
        let full = std::f64::consts::TAU;
        let span = match sweep {
            true => (last - first).rem_euclid(full),
            false => -(first - last).rem_euclid(full),
        };
        let pieces = (span.abs() / full * OF_TURN).ceil().max(1.0) as usize;
        for k in 1..pieces {
            let angle = first + span * k as f64 / pieces as f64;
            self.line(place(cu + angle.cos(), cv + angle.sin()));
        }
        self.line(to);
    }
}
