//! The path data of SVG: M L H V C S Q T A Z, absolute and relative (SVG 1.1, section 8.3).
//!
//! The crate svgtypes parses the data, and kurbo provides the curves. Coordinates are in m in the frame of the body,
//! with y upwards. Curves become polylines.

use crate::math::{Listed, Local};
use kurbo::{Arc, CubicBez, ParamCurve, Point, QuadBez, SvgArc, Vec2};
use std::f64::consts::TAU;
use std::ops::Range;
use svgtypes::{Error, PathParser, PathSegment};

/// Number of straight segments for a Bézier curve, and for a full turn of an arc.
const OF_CURVE: usize = 24;
const OF_TURN: f64 = 96.0;

/// A part of a path from one M to the next.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subpath {
    /// Its points in order, m.
    pub points: Vec<Local>,
    /// Whether Z closes it.
    pub closed: bool,
}

/// A fault of a path.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PathFault {
    /// The faulty bytes of the text.
    pub span: Range<usize>,
    /// Description of the fault.
    pub message: String,
}

/// The parts of a path as polylines.
pub(super) fn parse(text: &str) -> Result<Vec<Subpath>, PathFault> {
    let mut pen = Pen { lifted: true, ..Pen::default() };
    for segment in PathParser::from(text) {
        pen.follow(segment.map_err(|error| fault(text, &error))?);
    }
    let found: Vec<Subpath> = pen.parts.into_iter().filter(|part| part.points.len() > 1).list();
    match found.is_empty() {
        true => Err(PathFault { span: 0..text.len(), message: "draws nothing".to_string() }),
        false => Ok(found),
    }
}

/// The position of an error, and its description.
fn fault(text: &str, error: &Error) -> PathFault {
    let place = match error {
        Error::UnexpectedData(place) | Error::InvalidNumber(place) => place - 1,
        _ => usize::MAX,
    };
    let Some((start, found)) = text.char_indices().nth(place) else {
        let message = "ends before its last command has all numbers".to_string();
        return PathFault { span: text.len()..text.len(), message };
    };
    if matches!(error, Error::InvalidNumber(_)) {
        let separates = |c: char| c == ',' || c.is_ascii_whitespace();
        let shown = text[start..].split(separates).next().unwrap_or_default();
        let message = format!("'{shown}' is not a number");
        return PathFault { span: start..start + shown.len(), message };
    }
    let before = PathParser::from(&text[..start]).last();
    let message = match before {
        Some(Err(_)) => "a flag of an arc must be 0 or 1".to_string(),
        None if "LlHhVvCcSsQqTtAaZz".contains(found) => {
            format!("starts with '{found}'; must start with M")
        }
        _ => format!("'{found}' is not a command; must be one of M L H V C S Q T A Z"),
    };
    PathFault { span: start..start + found.len_utf8(), message }
}

/// Draws the parts.
#[derive(Default)]
struct Pen {
    parts: Vec<Subpath>,
    at: Point,
    /// The start of the current part.
    start: Point,
    /// Whether the next line begins a new part.
    lifted: bool,
    /// The last control point, if the previous segment is a cubic curve, and if it is a quadratic curve.
    controls: [Option<Point>; 2],
}

impl Pen {
    fn follow(&mut self, segment: PathSegment) {
        let from = self.at;
        let origin = if segment.is_abs() { Vec2::ZERO } else { from.to_vec2() };
        let point = |x: f64, y: f64| Point::new(x, y) + origin;
        let mut controls = [None, None];
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                self.at = point(x, y);
                (self.start, self.lifted) = (self.at, true);
            }
            PathSegment::LineTo { x, y, .. } => self.line(point(x, y)),
            PathSegment::HorizontalLineTo { x, .. } => self.line(Point::new(origin.x + x, from.y)),
            PathSegment::VerticalLineTo { y, .. } => self.line(Point::new(from.x, origin.y + y)),
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                controls[0] = Some(point(x2, y2));
                self.cubic(point(x1, y1), point(x2, y2), point(x, y));
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                controls[0] = Some(point(x2, y2));
                self.cubic(self.mirrored(0), point(x2, y2), point(x, y));
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                controls[1] = Some(point(x1, y1));
                self.quadratic(point(x1, y1), point(x, y));
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                controls[1] = Some(self.mirrored(1));
                self.quadratic(self.mirrored(1), point(x, y));
            }
            PathSegment::EllipticalArc {
                rx, ry, x_axis_rotation, large_arc, sweep, x, y, ..
            } => {
                let (to, radii) = (point(x, y), Vec2::new(rx, ry));
                let x_rotation = x_axis_rotation.to_radians();
                self.arc(SvgArc { from, to, radii, x_rotation, large_arc, sweep });
            }
            PathSegment::ClosePath { .. } => {
                if let Some(part) = self.parts.last_mut().filter(|_| !self.lifted) {
                    part.closed = true;
                }
                (self.at, self.lifted) = (self.start, true);
            }
        }
        self.controls = controls;
    }

    fn line(&mut self, to: Point) {
        let local = |p: Point| Local::new(p.x, p.y);
        if self.lifted || self.parts.is_empty() {
            self.parts.push(Subpath { points: vec![local(self.at)], closed: false });
            self.lifted = false;
        }
        self.parts.last_mut().expect("just made").points.push(local(to));
        self.at = to;
    }

    /// The control point that continues the previous curve smoothly.
    fn mirrored(&self, kind: usize) -> Point {
        self.controls[kind].map_or(self.at, |control| self.at + (self.at - control))
    }

    /// Adds a curve in segments of equal parameter steps, up to its end.
    fn curve(&mut self, curve: &impl ParamCurve, pieces: usize, to: Point) {
        (1..pieces).for_each(|k| self.line(curve.eval(k as f64 / pieces as f64)));
        self.line(to);
    }

    fn cubic(&mut self, a: Point, b: Point, to: Point) {
        self.curve(&CubicBez::new(self.at, a, b, to), OF_CURVE, to);
    }

    fn quadratic(&mut self, a: Point, to: Point) {
        self.curve(&QuadBez::new(self.at, a, to), OF_CURVE, to);
    }

    fn arc(&mut self, arc: SvgArc) {
        // with scaled radii of order 1, because kurbo draws a line for radii below 1e-5
        let scale = arc.radii.x.abs().max(arc.radii.y.abs());
        let (apart, to) = ((arc.to - arc.from) / scale, arc.to);
        let unit =
            SvgArc { from: Point::ORIGIN, to: apart.to_point(), radii: arc.radii / scale, ..arc };
        let drawn = (apart.hypot() > f64::EPSILON).then(|| Arc::from_svg_arc(&unit)).flatten();
        let Some(drawn) = drawn else { return self.line(to) };
        let drawn = Arc {
            center: arc.from + drawn.center.to_vec2() * scale,
            radii: drawn.radii * scale,
            ..drawn
        };
        let pieces = (drawn.sweep_angle.abs() / TAU * OF_TURN).ceil().max(1.0) as usize;
        self.curve(&drawn, pieces, to);
    }
}
