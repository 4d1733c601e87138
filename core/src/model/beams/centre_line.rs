//! The centre line of a beam without stress: straight, a circular arc, or a spline through points.

use super::super::body_reader::{term, Reader};
use super::super::definition::Value;
use super::super::scope::Reach;
use super::spline::{crosses, crossing, Curved};
use crate::elements::beam_line::{section, AT_GAUSS, GAUSS, NODES, PLACES};
use crate::expression::Tape;
use crate::math::{each, Listed, Local, Pose, ShortArray};
use std::f64::consts::PI;

/// Points of a curved centre line at which crossings are searched, for each of its points.
const FINE: usize = 16;

/// A centre line with its length as text.
pub struct CentreLine {
    form: LineForm,
    pub length: String,
    /// The pose of the first end when assembly starts.
    pub drawn: Option<[Tape; 3]>,
}

/// The shape of a centre line.
enum LineForm {
    Straight,
    /// An arc; the text of the angle between its tangents.
    Arc(String),
    /// A spline through points.
    Spline(Curved),
}

/// Stretch, slide and curvature of an element in the Gauss points without stress.
pub type Strains = [[Tape; 3]; 3];

impl CentreLine {
    /// Reads the one of `length`, `through` and `arc` that is given.
    pub fn read(reader: &mut Reader<'_>) -> Option<Self> {
        let keys = ["length", "through", "arc"];
        let given = keys.into_iter().filter(|key| reader.entry.get(key).is_some()).list();
        match given[..] {
            ["length"] => {
                reader.number("length", "m")?;
                let length = term(reader.entry.get("length")?);
                Some(Self { form: LineForm::Straight, length, drawn: None })
            }
            ["through"] => Self::through(reader),
            ["arc"] => Self::arc(reader),
            [] => {
                reader.missing("a beam needs one of 'length', 'through' and 'arc'");
                None
            }
            [first, second, ..] => {
                reader.report(second, &format!("given beside {first}; remove one of them"));
                None
            }
            _ => None,
        }
    }

    fn through(reader: &mut Reader<'_>) -> Option<Self> {
        let Some(Value::List(items)) = reader.entry.get("through") else {
            reader.report("through", "must be a list of points [[x, y], …]");
            return None;
        };
        if items.len() < 2 {
            reader.report("through", "needs at least two points");
            return None;
        }
        let path = reader.path("through");
        let mut points = Vec::new();
        for (k, item) in items.iter().enumerate() {
            let path = path.iter().cloned().chain([k.to_string()]).list();
            points.push(reader.scope.pair(item, &path, "m", reader.problems)?);
        }
        if let [Value::List(a), Value::List(b)] = &items[..] {
            let [ax, ay, bx, by] = [&a[0], &a[1], &b[0], &b[1]].each(term);
            let length = format!("hypot({bx}-{ax},{by}-{ay})");
            let angle = format!("atan2({by}-{ay},{bx}-{ax})");
            let drawn = [ax, ay, angle].each(|text| reader.compose(&text));
            return Some(Self { form: LineForm::Straight, length, drawn: Some(drawn) });
        }
        let numbers: Option<Vec<[f64; 2]>> =
            points.iter().map(|[x, y]| Some([x.constant()?, y.constant()?])).collect();
        let Some(numbers) = numbers else {
            let message = "a curved centre line needs numbers, not formulas of parameters; \
                give an arc or a length, which may be formulas";
            reader.report("through", message);
            return None;
        };
        let Some(curved) = Curved::new(&numbers) else {
            reader.report("through", "two successive points are equal; remove one of them");
            return None;
        };
        let fine = FINE * numbers.len();
        let places = (0..=fine).map(|k| curved.length() * k as f64 / fine as f64).list();
        let line = curved.places(&places).into_iter().map(|[x, y, _]| [x, y]).list();
        if let Some(at) = crossing(&line) {
            let [x0, y0, angle] = curved.first();
            let (sin, cos) = angle.sin_cos();
            let global = [x0 + cos * at[0] - sin * at[1], y0 + sin * at[0] + cos * at[1]];
            reader.problems.push(crosses(&path, global));
            return None;
        }
        let drawn = curved.first().each(Tape::from);
        let length = format!("({:?})", curved.length());
        Some(Self { form: LineForm::Spline(curved), length, drawn: Some(drawn) })
    }

    fn arc(reader: &mut Reader<'_>) -> Option<Self> {
        let items = match reader.entry.get("arc") {
            Some(Value::List(items)) if items.len() == 5 => items,
            _ => {
                let form = "[x, y, radius, first angle, last angle]";
                reader.report("arc", &format!("must be a list of five numbers {form}"));
                return None;
            }
        };
        let path = reader.path("arc");
        for (k, item) in items.iter().enumerate() {
            let path = path.iter().cloned().chain([k.to_string()]).list();
            let unit = if k < 3 { "m" } else { "rad" };
            let reach = Reach::Parameters;
            reader.scope.formula(item, &path, unit, reach, reader.problems)?;
        }
        let [x, y, radius, from, to] = [0, 1, 2, 3, 4].each(|k: usize| term(&items[k]));
        let turned = format!("({to}-{from})");
        let numbers = [&radius, &turned].each(|text| reader.value(text));
        if numbers[0] <= 0.0 {
            reader.report("arc", &format!("the radius is {} m; must be > 0", numbers[0]));
            return None;
        }
        let whole = std::f64::consts::TAU;
        if numbers[1] == 0.0 || numbers[1].abs() >= whole {
            let message = format!(
                "an arc of {} rad; must be between 0 and 2π, so that the centre line does not cross itself",
                numbers[1]
            );
            reader.report("arc", &message);
            return None;
        }
        let length = format!("({radius}*abs{turned})");
        let drawn = [
            format!("{x}+{radius}*cos({from})"),
            format!("{y}+{radius}*sin({from})"),
            format!("{from}+atan2({turned},0)"),
        ];
        let drawn = drawn.each(|text| reader.compose(&text));
        Some(Self { form: LineForm::Arc(turned), length, drawn: Some(drawn) })
    }

    /// Position and angle at an arc length, in the frame of the first end.
    pub fn place(&self, reader: &mut Reader<'_>, s: &str) -> [Tape; 3] {
        match &self.form {
            LineForm::Straight => [reader.compose(s), Tape::from(0.0), Tape::from(0.0)],
            LineForm::Arc(turned) => {
                let (angle, radius) = (
                    format!("({turned}*({s})/{})", self.length),
                    format!("{}/{turned}", self.length),
                );
                let x = format!("{radius}*sin{angle}");
                let y = format!("{radius}*2*sin({angle}/2)^2");
                [x, y, angle].each(|text| reader.compose(&text))
            }
            LineForm::Spline(curved) => {
                // the angle is continuous along the places before
                let s = reader.value(s);
                let steps = (64.0 * s / curved.length()).ceil().max(1.0) as usize;
                let before = (1..=steps).map(|k| s * k as f64 / steps as f64).list();
                curved.places(&before).last().map_or([0.0; 3], |place| *place).each(Tape::from)
            }
        }
    }

    /// Position and angle at the arc length `to` in the frame of the section at `from`.
    pub fn step(&self, reader: &mut Reader<'_>, from: &str, to: &str) -> [Tape; 3] {
        let LineForm::Spline(curved) = &self.form else {
            return self.place(reader, &format!("(({to})-({from}))"));
        };
        let (from, to) = (reader.value(from), reader.value(to));
        let all = curved.places(&[from, to]);
        let [first, last] = [all[0], all[1]].each(|[x, y, angle]| Pose::new(x, y, angle));
        let at: Local = first.rotation.inverse(last.r - first.r);
        let turned = (last.angle - first.angle + PI).rem_euclid(2.0 * PI) - PI;
        [at.x, at.y, turned].each(Tape::from)
    }

    /// The strains of an element from `start` with the given length that are free of stress: those of the nodes on
    /// the centre line.
    pub fn strains(&self, reader: &mut Reader<'_>, start: &str, length: &str) -> Strains {
        let share = |xi: f64| 0.5 * (1.0 + xi);
        match &self.form {
            LineForm::Straight => [[1.0; 3], [0.0; 3], [0.0; 3]].each(|all| all.each(Tape::from)),
            LineForm::Arc(turned) => {
                // with δ the angle of the element: Σ 2 Nₖ′ (sin, -cos)(δ (σₖ - σ)) / δ
                let delta = format!("({turned}*{length}/{})", self.length);
                let sum = |function: &str, g: usize| {
                    let one = |k: usize| {
                        let turn = share(PLACES[k]) - share(GAUSS[g]);
                        let slope = 2.0 * AT_GAUSS[g].slope[k];
                        format!("({slope:?})*{function}(({turn:?})*{delta})")
                    };
                    format!("({})/{delta}", (0..NODES).map(one).list().join("+"))
                };
                let stretch = [0, 1, 2].each(|g| sum("sin", g));
                let slide = [0, 1, 2].each(|g| format!("-{}", sum("cos", g)));
                let curvature = [0, 1, 2].each(|_| format!("{turned}/{}", self.length));
                [stretch, slide, curvature].each(|all| all.each(|text| reader.compose(&text)))
            }
            LineForm::Spline(curved) => {
                let (start, length) = (reader.value(start), reader.value(length));
                let at = PLACES.each(|xi| start + length * share(xi));
                let poses = curved.places(&at).into_iter().map(|[x, y, a]| Pose::new(x, y, a));
                let poses: Vec<Pose> = poses.list();
                let nodes = [&poses[0], &poses[1], &poses[2], &poses[3]];
                let all = each([0, 1, 2], |g| section(nodes, &AT_GAUSS[g], 2.0 / length));
                let stretch = all.each(|of| of.tangent.x);
                let slide = all.each(|of| of.tangent.y);
                let curvature = all.each(|of| of.curvature);
                [stretch, slide, curvature].each(|all| all.each(Tape::from))
            }
        }
    }
}
