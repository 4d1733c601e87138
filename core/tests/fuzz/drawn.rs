//! Random cases with every element of the catalogue, ordinary and extreme numbers, and formulas.

use crate::random::Random;
use kempe::case::{write, Case, Format, Start};
use kempe::elements::{catalogue, Default as Preset, Field, Group, Shape, Table};
use kempe::model::{Definition, Entry, Value};

const NAMES: [&str; 6] = ["crank", "b 1", "é-2", "x_3", "k\"4", "9"];

/// The text of a case.
pub fn case(random: &mut Random) -> String {
    let bodies: Vec<String> =
        NAMES[..1 + random.below(NAMES.len() - 1)].iter().map(|n| n.to_string()).collect();
    let mut drawn = Drawn { random, bodies, joints: Vec::new(), wild: false };
    drawn.wild = drawn.random.chance(0.25);
    let mut case = Case { definition: drawn.definition(), ..Case::default() };
    case.start = drawn.start();
    case.analyses = drawn.analyses();
    write(&case, Format::Toml)
}

struct Drawn<'a> {
    random: &'a mut Random,
    bodies: Vec<String>,
    joints: Vec<String>,
    /// Whether numbers may be extreme.
    wild: bool,
}

fn text(text: &str) -> Value {
    Value::Text(text.to_string())
}

impl Drawn<'_> {
    fn definition(&mut self) -> Definition {
        let mut definition = Definition {
            title: self.random.chance(0.5).then(|| "a \"drawn\" case\n".to_string()),
            gravity: Some(Value::List(vec![Value::Number(0.0), Value::Number(-9.81)])),
            redundancy: self.random.chance(0.3).then(|| "allow".to_string()),
            parameters: vec![("k".into(), self.number()), ("L".into(), text("0.5 + 0.5"))],
            ..Definition::default()
        };
        let ground = vec![("points".to_string(), self.points())];
        definition.bodies.push(Entry { name: "ground".into(), fields: ground });
        for name in self.bodies.clone() {
            let fields = self.body();
            definition.bodies.push(Entry { name, fields });
        }
        self.chain(&mut definition.joints);
        let tables = catalogue();
        for number in 0..self.random.below(3) {
            let (group, table) = &tables[self.random.below(tables.len())];
            let name = format!("e{number}");
            let fields = self.fields(table);
            let section = match group {
                Group::Joints => &mut definition.joints,
                Group::Drivers => &mut definition.drivers,
                Group::Forces => &mut definition.forces,
            };
            section.push(Entry { name: name.clone(), fields });
            if *group != Group::Forces {
                self.joints.push(name);
            }
        }
        definition
    }

    fn body(&mut self) -> Vec<(String, Value)> {
        let mut fields = Vec::new();
        if self.random.chance(0.2) {
            fields.push(("outline".into(), self.outline()));
        }
        if self.random.chance(0.1) {
            fields.push(("points".into(), self.points()));
            fields.push(("shapes".into(), self.shapes()));
            return fields;
        }
        fields.push(("mass".to_string(), self.positive()));
        if self.random.chance(0.6) {
            fields.push(("type".into(), text("bar")));
            fields.push(("length".into(), self.positive()));
            fields.push(("ends".into(), Value::List(vec![text("A"), text("B")])));
        } else {
            fields.push(("inertia".into(), self.positive()));
            fields.push(("points".into(), self.points()));
        }
        if self.random.chance(0.3) {
            fields.push(("curves".into(), self.curves()));
        }
        fields
    }

    /// A disc by its mass, and another shape by its density.
    fn shapes(&mut self) -> Value {
        let entry = |key: &str, value: Value| (key.to_string(), value);
        let disc = vec![
            entry("type", text("disc")),
            entry("radius", self.positive()),
            entry("mass", self.positive()),
        ];
        let mut other = match self.random.below(4) {
            0 => vec![entry("type", text("rod")), entry("length", self.positive())],
            1 => vec![
                entry("type", text("plate")),
                entry("width", self.positive()),
                entry("height", self.positive()),
            ],
            2 => vec![
                entry("type", text("ring")),
                entry("inner", self.positive()),
                entry("outer", text("2*L + 3")),
            ],
            _ => {
                let points = (0..3).map(|_| Value::List(vec![self.number(), self.number()]));
                vec![entry("type", text("polygon")), entry("points", Value::List(points.collect()))]
            }
        };
        let section = if other[0].1 == text("rod") { "area" } else { "thickness" };
        let density = if self.random.chance(0.1) { self.number() } else { self.positive() };
        other.extend([entry("density", density), entry(section, self.positive())]);
        if self.random.chance(0.5) {
            other.push(entry("at", Value::List(vec![self.number(), self.number()])));
            other.push(entry("angle", self.number()));
        }
        Value::List(vec![Value::Table(disc), Value::Table(other)])
    }

    fn outline(&mut self) -> Value {
        let (key, value) = match self.random.below(3) {
            0 => {
                let points = (0..4).map(|_| Value::List(vec![self.number(), self.number()]));
                return Value::List(points.collect());
            }
            1 => ("circle", Value::List(vec![self.number(), self.number(), self.positive()])),
            _ => ("path", text("M 0 0 l 1 0 a 1 2 30 0 1 1 1 Q 1 2 3 4 T 1 1 Z m 1 1 h 2")),
        };
        Value::Table(vec![(key.to_string(), value)])
    }

    /// A curve A, and a curve B through points.
    fn curves(&mut self) -> Value {
        let list = |own: &mut Self, n: usize| (0..n).map(|_| own.number()).collect::<Vec<_>>();
        let first = match self.random.below(4) {
            0 => vec![("circle".to_string(), Value::List(list(self, 3)))],
            1 => {
                let ends = [0, 1].map(|_| Value::List(list(self, 2)));
                vec![("line".to_string(), Value::List(ends.to_vec()))]
            }
            2 => vec![("polar".to_string(), text("1 + 0.2*cos(3*u)"))],
            _ => vec![
                ("x".to_string(), text("L*cos(u)")),
                ("y".to_string(), text("u^2 + k")),
                ("range".to_string(), Value::List(list(self, 2))),
            ],
        };
        let count = 2 + self.random.below(5);
        let points: Vec<Value> = (0..count).map(|_| Value::List(list(self, 2))).collect();
        let periodic = Value::Flag(self.random.chance(0.5));
        let second =
            vec![("points".to_string(), Value::List(points)), ("periodic".into(), periodic)];
        Value::Table(vec![("A".into(), Value::Table(first)), ("B".into(), Value::Table(second))])
    }

    fn points(&mut self) -> Value {
        let point = |own: &mut Self| Value::List(vec![own.number(), own.number()]);
        Value::Table(vec![("A".into(), point(self)), ("B".into(), point(self))])
    }

    /// Most bodies hang on the one before.
    fn chain(&mut self, joints: &mut Vec<Entry>) {
        let mut before = "ground.A".to_string();
        for body in self.bodies.clone() {
            if self.random.chance(0.85) {
                let name = format!("pin of {body}");
                let ends = [("i", text(&before)), ("j", text(&format!("{body}.A")))];
                let mut fields = vec![("type".to_string(), text("revolute"))];
                fields.extend(ends.map(|(key, value)| (key.to_string(), value)));
                joints.push(Entry { name: name.clone(), fields });
                self.joints.push(name);
            }
            before = format!("{body}.B");
        }
    }

    fn fields(&mut self, table: &Table) -> Vec<(String, Value)> {
        let mut fields = vec![("type".to_string(), text(table.name))];
        for field in &table.fields {
            if field.default.is_none() || self.random.chance(0.4) {
                fields.push((field.name.to_string(), self.value(field)));
            }
        }
        fields
    }

    fn value(&mut self, field: &Field) -> Value {
        match field.shape {
            Shape::Body => text(&self.owner()),
            Shape::Point => text(&format!("{}.{}", self.owner(), self.random.choice(&["A", "B"]))),
            Shape::Curve => text(&format!("{}.{}", self.owner(), self.random.choice(&["A", "B"]))),
            Shape::Curves => self.curves(),
            Shape::Shapes => self.shapes(),
            Shape::Outline => self.outline(),
            Shape::Section => Value::Table(vec![("circle".to_string(), self.number())]),
            Shape::Corners | Shape::Ranges => {
                let points = (0..4).map(|_| Value::List(vec![self.number(), self.number()]));
                Value::List(points.collect())
            }
            Shape::Coordinate => {
                text(&format!("{}.{}", self.body_name(), self.random.choice(&["x", "y", "angle"])))
            }
            Shape::Number | Shape::Tolerance => match field.default {
                Some(Preset::Number(x)) if self.random.chance(0.2) => Value::Number(x),
                _ => self.number(),
            },
            Shape::Law => self.law(),
            Shape::Pair => Value::List(vec![self.number(), self.number()]),
            Shape::Triple => Value::List(vec![self.number(), self.number(), self.number()]),
            Shape::Terms => {
                let quantity = |random: &str| format!("{}.{random}", self.body_name());
                let names = ["x", "angle"].map(quantity);
                let terms = names.map(|name| (name, self.number()));
                Value::Table(terms.into())
            }
            Shape::Units => Value::List(vec![text("m"), text("rad")]),
            Shape::LawPair | Shape::Laws => Value::List(vec![self.law(), self.law()]),
            Shape::Points => self.points(),
            Shape::TwoTexts => {
                let curve = |_| text(&format!("{}.A", self.owner()));
                Value::List((0..2).map(curve).collect())
            }
            Shape::Names | Shape::Columns => Value::List(vec![text("A"), text("B")]),
            Shape::Numbers => Value::List((0..4).map(|k| Value::Number(f64::from(k))).collect()),
            Shape::Joint | Shape::Name => {
                let known = self.joints.get(self.random.below(self.joints.len())).cloned();
                text(&known.unwrap_or_default())
            }
            Shape::Condition => self.condition(),
            Shape::NameList | Shape::Quantities => Value::List(Vec::new()),
            Shape::Events => Value::Table(vec![("hit".to_string(), self.condition())]),
            Shape::Values => Value::Table(vec![("k".to_string(), self.number())]),
            Shape::Flag => Value::Flag(self.random.chance(0.5)),
            Shape::Count => Value::Number((1 + self.random.below(9)) as f64),
            Shape::Word(words) => text(self.random.choice(words)),
            Shape::Options(_) => Value::Table(Vec::new()),
        }
    }

    fn condition(&mut self) -> Value {
        let body = self.body_name();
        match self.random.below(4) {
            0 => text("t > 0.01"),
            1 => text(&format!("{body}.x - 0.1")),
            2 => text(&format!("{body}.ay < 1")),
            _ => text(&format!("{body}.vy*sin(40*t)")),
        }
    }

    fn body_name(&mut self) -> String {
        self.bodies[self.random.below(self.bodies.len())].clone()
    }

    fn owner(&mut self) -> String {
        if self.random.chance(0.3) {
            "ground".to_string()
        } else {
            self.body_name()
        }
    }

    fn number(&mut self) -> Value {
        const EXTREME: [f64; 9] = [0.0, -0.0, 1e-300, 1e-12, 1e12, 1e155, 1e300, -1.0, 5e-324];
        match self.random.below(10) {
            0 => text("k"),
            1 => text("L*sin(2) + 1"),
            2 | 3 if self.wild => Value::Number(EXTREME[self.random.below(EXTREME.len())]),
            _ => Value::Number(self.random.uniform(-2.0, 2.0)),
        }
    }

    fn positive(&mut self) -> Value {
        match self.number() {
            Value::Number(x) if !self.wild => Value::Number(x.abs() + 0.1),
            _ if !self.wild => text("2*L"),
            value => value,
        }
    }

    fn law(&mut self) -> Value {
        let body = self.body_name();
        match self.random.below(8) {
            0 => text("sin(3*t)"),
            1 => text("0.3 + 2*t"),
            2 => text(&format!("{body}.angle^2")),
            3 => text(&format!("-{body}.vx")),
            4 if self.wild => text("1/t"),
            _ => self.number(),
        }
    }

    fn start(&mut self) -> Start {
        let mut start = Start::default();
        for body in self.bodies.clone() {
            let coordinate = self.random.choice(&["x", "y", "angle", "vx", "vy", "omega"]);
            let entry = (format!("{body}.{coordinate}"), self.number());
            match self.random.below(4) {
                0 => start.set.push(entry),
                1 => start.guess.push(entry),
                _ => {}
            }
        }
        start
    }

    fn analyses(&mut self) -> Vec<Entry> {
        let options = |kind: &str| Value::Table(vec![("type".to_string(), text(kind))]);
        let method = ["auto", "rk45", "dop853", "radau", "generalized_alpha"];
        let mut fields = vec![
            ("type".to_string(), text("dynamics")),
            ("t_end".to_string(), Value::Number(self.random.uniform(0.01, 0.3))),
        ];
        if self.random.chance(0.7) {
            fields.push(("method".into(), options(self.random.choice(&method))));
        }
        if self.random.chance(0.3) {
            let kind = self.random.choice(&["projection", "baumgarte", "none"]);
            fields.push(("stabilization".into(), options(kind)));
        }
        if self.random.chance(0.3) {
            fields.push(("output_step".into(), Value::Number(0.01)));
        }
        vec![Entry { name: "run".into(), fields }]
    }
}
