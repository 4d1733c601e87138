//! The section `[synthesis]` of a case: four-bars through poses or points, and the case of one of them.

use crate::fault::Fault;
use crate::typed::typed;
use kempe::math::Complex;
use kempe::model::Value as Written;
use kempe_synthesis::{
    abs, four_bars, ranked, FourBar, Grashof, Limits, Linkage, PathSearch, Poses, Ranked, Refused,
    Wanted, TYPES,
};
use serde_json::{json, Value};

/// Bodies of the case of a candidate that may have a mass of their own.
const MASSES: [&str; 3] = ["crank", "coupler", "rocker"];
/// Dyads that are sampled without `samples`.
const SAMPLES: f64 = 240.0;

/// What a coupler must do.
enum Given {
    Poses(Poses),
    Path(Points),
}

/// Points of a path with the number of starts and their seed.
struct Points {
    wanted: Wanted,
    starts: Option<usize>,
    seed: u64,
}

/// The search for the four-bars of some points, and its seed. It goes on after the rest of the case has changed.
pub struct Tracing(PathSearch, u64);

/// A task, the limits of its candidates, and their masses.
pub struct Task {
    given: Given,
    limits: Limits,
    masses: [Option<f64>; 3],
}

impl From<Refused> for Fault {
    fn from(refused: Refused) -> Self {
        Fault::new(refused.message).hint(refused.hint)
    }
}

/// The entries of the section.
struct Section<'a>(&'a [(String, Written)]);

impl Section<'_> {
    fn get(&self, key: &str) -> Option<&Written> {
        self.0.iter().find(|(known, _)| known == key).map(|(_, of)| of)
    }

    fn word<'a>(&'a self, key: &str, absent: &'a str) -> &'a str {
        match self.get(key) {
            Some(Written::Text(text)) => text,
            _ => absent,
        }
    }

    fn number(&self, key: &str, unit: &str) -> Result<Option<f64>, Fault> {
        self.get(key).map(|of| typed(of, key, unit)).transpose()
    }

    /// An entry of a table of the section.
    fn entry(&self, key: &str, name: &str) -> Option<&Written> {
        let Some(Written::Table(given)) = self.get(key) else { return None };
        given.iter().find(|(known, _)| known == name).map(|(_, of)| of)
    }

    fn pivot(&self, name: &str) -> Result<Option<Complex>, Fault> {
        let own = self.entry("pivots", name);
        own.map(|at| Ok(complex(&row(at, "pivots", &["m", "m"])?))).transpose()
    }

    fn given(&self) -> Result<Given, Fault> {
        let (task, family) = (self.word("task", ""), self.word("family", "four_bar"));
        let refused = |what: String| {
            let hint = "the command 'kempe synthesis' with this file solves the task";
            Err(Fault::new(format!("{what} is not solved in the page")).hint(hint))
        };
        let traces = task == "path";
        if !(traces || task == "motion") || family != "four_bar" {
            return refused(format!("the task '{task}' for the family '{family}'"));
        }
        let rows = match traces {
            true => rows(self.get("points"), "points", &["m", "m"])?,
            false => rows(self.get("poses"), "poses", &["m", "m", "rad"])?,
        };
        if !traces && rows.len() > 5 {
            return refused(format!("a task of {} poses; two to five are exact. It", rows.len()));
        }
        let places = rows.iter().map(|row| complex(row)).collect();
        let pivots = [self.pivot("O")?, self.pivot("D")?];
        let seed = self.number("seed", "")?.unwrap_or(0.0) as u64;
        if !traces {
            let angles = rows.iter().map(|row| row[2]).collect();
            let samples = self.number("samples", "")?.unwrap_or(SAMPLES) as usize;
            return Ok(Given::Poses(Poses { places, angles, pivots, samples, seed }));
        }
        let cranks = match self.get("angles") {
            Some(given) => row(given, "angles", &vec!["rad"; rows.len()])?,
            None => Vec::new(),
        };
        let offset = self.word("offsets", "free") == "free";
        let wanted = Wanted { places, cranks, offset, pivots, ..Wanted::default() };
        let starts = self.number("starts", "")?.map(|starts| starts as usize);
        Ok(Given::Path(Points { wanted, starts, seed }))
    }
}

impl Task {
    /// Reads the section of a case.
    pub fn read(section: &[(String, Written)]) -> Result<Self, Fault> {
        if section.is_empty() {
            return Err(Fault::new("the case has no section [synthesis]"));
        }
        let of = Section(section);
        let given = of.given()?;
        let mass = |name| of.entry("masses", name).map(|mass| typed(mass, "masses", "kg"));
        let [crank, coupler, rocker] = MASSES.map(|name| mass(name).transpose());
        let limits = Limits {
            tell: of.word("defects", "exclude") == "tell",
            transmission_angle: of.number("transmission_angle", "rad")?,
            grashof: grashof(of.get("grashof"))?,
            within: within(of.get("within"))?,
            way: match of.word("direction", "") {
                "ccw" => 1,
                "cw" => -1,
                _ => 0,
            },
        };
        Ok(Self { given, limits, masses: [crank?, coupler?, rocker?] })
    }

    /// The task and its four-bars, or the reason why there are none. A search tries some more `starts`.
    pub fn described(&self, tracing: &mut Option<Tracing>, starts: usize) -> Value {
        let (mut found, refused) = match self.solved(tracing, starts) {
            Ok(solved) => (solved.described(), Value::Null),
            Err(fault) => {
                (json!({ "complete": false, "excluded": [], "candidates": [] }), fault.value())
            }
        };
        let pair = |at: &Complex| json!([at.re, at.im]);
        let (poses, points): (Vec<Value>, Vec<Value>) = match &self.given {
            Given::Path(of) => (Vec::new(), of.wanted.places.iter().map(pair).collect()),
            Given::Poses(of) => {
                let given = of.places.iter().zip(&of.angles);
                (given.map(|(at, angle)| json!([at.re, at.im, angle])).collect(), Vec::new())
            }
        };
        (found["poses"], found["points"], found["refused"]) =
            (json!(poses), json!(points), refused);
        if let (Given::Path(_), Some(Tracing(search, _))) = (&self.given, tracing) {
            (found["tried"], found["most"]) = (json!(search.tried()), json!(search.most()));
        }
        found
    }

    /// The four-bars, best first.
    pub fn solved(&self, tracing: &mut Option<Tracing>, starts: usize) -> Result<Solved, Fault> {
        let (linkages, complete, either, at) = match &self.given {
            Given::Poses(of) => {
                let (linkages, complete) = four_bars(of)?;
                let at = vec![(of.places[0], of.angles[0]); linkages.len()];
                (linkages, complete, of.pivots == [None, None], at)
            }
            Given::Path(of) => of.found(tracing, starts)?,
        };
        let (kept, excluded) = ranked(&linkages, &self.limits, either, complete);
        let candidates = kept
            .into_iter()
            .map(|one| (FourBar::of(&linkages[one.index].0, &one, at[one.index]), one))
            .collect();
        let errors = linkages.into_iter().map(|(_, error)| error).collect();
        Ok(Solved { candidates, errors, excluded, complete, masses: self.masses })
    }
}

/// Four-bars with their errors, whether these are all, whether the rocker may be the crank, and the place and angle of
/// each moving frame.
type Linkages = (Vec<(Linkage, f64)>, bool, bool, Vec<(Complex, f64)>);

impl Points {
    /// What the search has found after some more starts.
    fn found(&self, tracing: &mut Option<Tracing>, starts: usize) -> Result<Linkages, Fault> {
        let known = tracing
            .take()
            .filter(|Tracing(search, seed)| search.wanted == self.wanted && *seed == self.seed);
        let known = known.and_then(|mut one| one.0.limit(self.starts).then_some(one.0));
        let search = match known {
            Some(search) => search,
            None => PathSearch::new(self.wanted.clone(), self.starts, self.seed)?,
        };
        let search = &mut tracing.insert(Tracing(search, self.seed)).0;
        search.advance(starts)?;
        let found = search.found();
        if found.is_empty() && search.ended() {
            return Err(search.none().into());
        }
        let at = found.iter().map(|one| (one.points[0], one.frame)).collect();
        let linkages = found.into_iter().map(|one| (one.linkage, one.error)).collect();
        let either = self.wanted.cranks.is_empty() && self.wanted.pivots == [None, None];
        Ok((linkages, search.complete(), either, at))
    }
}

/// The four-bars of a task.
pub struct Solved {
    candidates: Vec<(FourBar, Ranked)>,
    errors: Vec<f64>,
    excluded: Vec<(String, usize)>,
    complete: bool,
    masses: [Option<f64>; 3],
}

impl Solved {
    /// All candidates for a page.
    fn described(&self) -> Value {
        let told = |(bar, one): &(FourBar, Ranked)| {
            let [o, a, b, d, p] = bar.pins.map(|at| [at.re, at.im]);
            let of = &one.judged;
            json!({
                "points": { "O": o, "A": a, "B": b, "D": d, "P": p },
                "frame": bar.frame,
                "lengths": of.lengths,
                "type": if of.grashof { TYPES[of.shortest()] } else { "triple-rocker" },
                "grashof": of.grashof,
                "turns": of.turns,
                "transmission_angle": of.least,
                "error": self.errors[one.index],
                "defects": one.defects,
                "crank_angles": one.crank_angles,
            })
        };
        let excluded: Vec<Value> =
            self.excluded.iter().map(|(kind, n)| json!({ "kind": kind, "count": n })).collect();
        let candidates: Vec<Value> = self.candidates.iter().map(told).collect();
        json!({ "complete": self.complete, "excluded": excluded, "candidates": candidates })
    }

    /// The changes of a text that make a candidate its mechanism. `choice` counts from 1.
    pub fn taken(&self, choice: usize) -> Result<Value, Fault> {
        let found = choice.checked_sub(1).and_then(|k| self.candidates.get(k));
        let Some((bar, one)) = found else {
            let count = self.candidates.len();
            return Err(Fault::new(format!("there is no candidate {choice}; there are {count}")));
        };
        let mut changes = changes(bar, one, self.masses);
        changes.push(json!({ "path": ["synthesis", "choice"], "value": choice }));
        Ok(json!({ "changes": changes }))
    }
}

/// The entries of the case of a four-bar, which are those of `kempe.synthesis.Candidate.case`.
fn changes(bar: &FourBar, one: &Ranked, masses: [Option<f64>; 3]) -> Vec<Value> {
    let pair = |at: Complex| json!([at.re, at.im]);
    let [o, a, b, d, p] = bar.pins;
    let rod = |names: [&str; 2], ends: [Complex; 2], mass: Option<f64>| {
        let mass = mass.unwrap_or_else(|| abs(ends[1] - ends[0]));
        let through = json!({ (names[0]): pair(ends[0]), (names[1]): pair(ends[1]) });
        json!({ "type": "bar", "mass": mass, "through": through })
    };
    let coupler = {
        let corners = bar.corners();
        let points = json!({ "A": pair(corners[0]), "B": pair(corners[1]), "P": pair(corners[2]) });
        json!({ "type": "body", "points": points, "shapes": rods(bar, &corners, masses[1]) })
    };
    let pin = |i: &str, j: &str| json!({ "type": "revolute", "i": i, "j": j });
    let (start, rate, t_end) = bar.drive(one);
    let law = format!("{} + {}*t", kempe::case::digits(start), kempe::case::digits(rate));
    let guess = [
        ("crank.angle", start),
        ("coupler.x", p.re),
        ("coupler.y", p.im),
        ("coupler.angle", bar.frame),
        ("rocker.angle", kempe_synthesis::angle(b - d)),
    ];
    let motion = json!({
        "type": "inverse_dynamics", "t_end": t_end, "output_step": t_end / FourBar::OUTPUTS,
    });
    let drive = json!({ "type": "coordinate_driver", "coordinate": "crank.angle", "value": law });
    let all = [
        (vec!["bodies", "ground", "points", "O"], pair(o)),
        (vec!["bodies", "ground", "points", "D"], pair(d)),
        (vec!["bodies", "crank"], rod(["O", "A"], [o, a], masses[0])),
        (vec!["bodies", "coupler"], coupler),
        (vec!["bodies", "rocker"], rod(["D", "B"], [d, b], masses[2])),
        (vec!["joints", "O"], pin("ground.O", "crank.O")),
        (vec!["joints", "A"], pin("crank.A", "coupler.A")),
        (vec!["joints", "B"], pin("coupler.B", "rocker.B")),
        (vec!["joints", "D"], pin("ground.D", "rocker.D")),
        (vec!["drivers", "drive"], drive),
        (vec!["analyses", "motion"], motion),
    ];
    let removed = all.iter().filter(|(path, _)| path.len() == 2);
    let mut found: Vec<Value> =
        removed.map(|(path, _)| json!({ "path": path, "remove": true })).collect();
    found.extend(all.into_iter().map(|(path, value)| json!({ "path": path, "value": value })));
    found.extend(
        guess.map(|(name, value)| json!({ "path": ["start", "guess", name], "value": value })),
    );
    found
}

/// Rods between the corners of the coupler, together its mass.
fn rods(bar: &FourBar, corners: &[Complex; 3], mass: Option<f64>) -> Vec<Value> {
    let sides = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (corners[i], corners[j]));
    let long = |(x, y): &(Complex, Complex)| abs(*y - *x) > 1e-9 * bar.size();
    let sides: Vec<_> = sides.into_iter().filter(long).collect();
    let total: f64 = sides.iter().map(|(x, y)| abs(*y - *x)).sum();
    let share = mass.unwrap_or(total) / total;
    let rod = |(x, y): (Complex, Complex)| {
        let (along, sum) = (y - x, x + y);
        json!({
            "type": "rod",
            "length": abs(along),
            "at": [sum.re / 2.0, sum.im / 2.0],
            "angle": kempe_synthesis::angle(along),
            "mass": share * abs(along),
        })
    };
    sides.into_iter().map(rod).collect()
}

fn grashof(given: Option<&Written>) -> Result<Grashof, Fault> {
    match given {
        Some(Written::Flag(true)) => Ok(Grashof::Holds),
        Some(Written::Text(kind)) => {
            let found = TYPES.iter().position(|known| known == kind).map(Grashof::Is);
            let message = format!("grashof: '{kind}'; must be true or {}", TYPES.join(", "));
            found.ok_or_else(|| Fault::new(message))
        }
        _ => Ok(Grashof::Any),
    }
}

fn within(given: Option<&Written>) -> Result<Option<[[f64; 2]; 2]>, Fault> {
    let Some(given) = given else { return Ok(None) };
    let rows = rows(Some(given), "within", &["m", "m"])?;
    let found = <[Vec<f64>; 2]>::try_from(rows).ok();
    let found = found.map(|rows| rows.map(|row| [row[0], row[1]]));
    let found = found.filter(|rows| rows.iter().all(|row| row[1] >= row[0]));
    let wrong = || Fault::new("within must be [[x_min, x_max], [y_min, y_max]]");
    found.map(Some).ok_or_else(wrong)
}

fn rows(given: Option<&Written>, what: &str, units: &[&str]) -> Result<Vec<Vec<f64>>, Fault> {
    let Some(Written::List(rows)) = given else {
        return Err(Fault::new(format!("[synthesis] has no {what}")));
    };
    rows.iter().map(|one| row(one, what, units)).collect()
}

fn row(given: &Written, what: &str, units: &[&str]) -> Result<Vec<f64>, Fault> {
    match given {
        Written::List(row) if row.len() == units.len() => {
            row.iter().zip(units).map(|(x, unit)| typed(x, what, unit)).collect()
        }
        _ => Err(Fault::new(format!("{what}: a row must have {} numbers", units.len()))),
    }
}

fn complex(row: &[f64]) -> Complex {
    Complex::new(row[0], row[1])
}
