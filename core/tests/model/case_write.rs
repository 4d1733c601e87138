//! Writing: a written case reads as the same case.

use kempe::case::{self, Case, Format, Start};
use kempe::elements::{catalogue, Coordinate, Group, Shape, Table, TOLERANCES};
use kempe::model::{body_tables, Definition, Entry, Value};

const FOUR_BAR: &str = include_str!("../../../examples/four_bar.toml");
const FORMATS: [Format; 2] = [Format::Toml, Format::Json];

/// The text without comments and the blanks before them.
fn bare(toml: &str) -> String {
    toml.lines()
        .map(|line| line.split(" #").next().unwrap_or("").trim_end().to_string() + "\n")
        .collect()
}

#[test]
fn the_flagship_is_written_as_it_stands_in_the_example() {
    let (case, _) = case::read(FOUR_BAR, Format::Toml).expect("the example is right");
    assert_eq!(case::write(&case, Format::Toml), bare(FOUR_BAR));
}

#[test]
fn the_flagship_goes_through_json() {
    let (case, _) = case::read(FOUR_BAR, Format::Toml).expect("the example is right");
    let json = case::write(&case, Format::Json);
    assert!(json.contains("\n    \"crank\": { \"type\": \"bar\", \"mass\": 3, \"length\": \"L1\""));
    let (read, _) = case::read(&json, Format::Json).expect("the written text is valid");
    assert_eq!(read, case);
}

/// Numbers from splitmix64.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as usize % sides
    }
    fn pick<T: Clone>(&mut self, from: &[T]) -> T {
        from[self.roll(from.len())].clone()
    }
    fn number(&mut self) -> f64 {
        let special =
            [0.0, 10.0, -1e300, 5e-324, 1e6, 999_999.0, 0.1, 9_007_199_254_740_993.0, 1e21];
        if self.roll(3) == 0 {
            return self.pick(&special);
        }
        let bits = (self.roll(1 << 52) as u64) << 12 | self.roll(1 << 12) as u64;
        let x = f64::from_bits(bits);
        if x.is_finite() {
            x
        } else {
            1.0
        }
    }
    fn word(&mut self) -> String {
        let letters: Vec<char> = "abzAZ09_- é\"'\\#=[]{},😀\u{202e}°²/`$".chars().collect();
        let length = 1 + self.roll(12);
        (0..length).map(|_| self.pick(&letters)).collect()
    }
    fn text(&mut self) -> String {
        let extra = ["\n", "\t", "\u{1}", "\u{7f}", "\r\n", ".", "\"\"\"", "'''"];
        let word = self.word();
        if self.roll(2) == 0 {
            word + self.pick::<&str>(&extra)
        } else {
            word
        }
    }
    /// A name that has not been used: `used` counts them. Names have no characters of direction.
    fn name(&mut self, used: &mut usize) -> String {
        *used += 1;
        format!("{}x{used}", self.word()).replace('\u{202e}', "")
    }
    /// The name of an analysis, which is also that of a folder.
    fn folder(&mut self, used: &mut usize) -> String {
        self.name(used).replace(['/', '\\', '"'], "").trim().to_string()
    }
    fn formula(&mut self) -> Value {
        if self.roll(2) == 0 {
            Value::Number(self.number())
        } else {
            Value::Text(self.text())
        }
    }
    fn pair(&mut self) -> Value {
        Value::List(vec![self.formula(), self.formula()])
    }

    fn events(&mut self, used: &mut usize) -> Value {
        let event = |own: &mut Self| match own.roll(2) {
            0 => Value::Text(own.text()),
            _ => Value::Table(vec![
                ("condition".to_string(), Value::Text(own.text())),
                ("direction".to_string(), Value::from(own.pick(&["both", "rising"]))),
                ("stop".to_string(), Value::Flag(own.roll(2) == 0)),
            ]),
        };
        Value::Table((0..self.roll(3)).map(|_| (self.name(used), event(self))).collect())
    }

    fn value(&mut self, shape: Shape, used: &mut usize) -> Value {
        match shape {
            Shape::Curves | Shape::Shapes | Shape::Outline | Shape::Corners => {
                self.of_body(shape, used)
            }
            Shape::Body | Shape::Point | Shape::Curve => Value::Text(self.text()),
            Shape::Coordinate | Shape::Joint | Shape::Name => Value::Text(self.text()),
            Shape::Section => Value::Table(vec![("rectangle".to_string(), self.pair())]),
            Shape::Number | Shape::Law => self.formula(),
            Shape::Pair | Shape::LawPair => self.pair(),
            Shape::Ranges => Value::List(vec![self.pair(), self.pair()]),
            Shape::Triple => Value::List(vec![self.formula(), self.formula(), self.formula()]),
            Shape::Laws => Value::List(vec![self.formula(), self.formula()]),
            Shape::Terms => Value::Table(
                (0..1 + self.roll(3)).map(|_| (self.name(used), self.formula())).collect(),
            ),
            Shape::Condition => Value::Text(self.text()),
            Shape::NameList => {
                Value::List((0..self.roll(3)).map(|_| Value::Text(self.name(used))).collect())
            }
            Shape::Quantities | Shape::TwoTexts => {
                Value::List((0..2).map(|_| Value::Text(self.text())).collect())
            }
            Shape::Events => self.events(used),
            Shape::Values => Value::Table(
                (0..1 + self.roll(3)).map(|_| (self.name(used), self.formula())).collect(),
            ),
            Shape::Units => Value::List(vec![Value::from(self.pick(&["m", "rad"]))]),
            Shape::Points => {
                Value::Table((0..self.roll(4)).map(|_| (self.name(used), self.pair())).collect())
            }
            Shape::Names => {
                Value::List(vec![Value::Text(self.name(used)), Value::Text(self.name(used))])
            }
            Shape::Numbers => {
                Value::List((0..self.roll(5)).map(|_| Value::Number(self.number())).collect())
            }
            Shape::Columns => Value::List(vec![Value::from("t / s"), Value::Text(self.name(used))]),
            Shape::Flag => Value::Flag(self.roll(2) == 0),
            Shape::Count => Value::Number(1.0 + self.roll(1 << 40) as f64),
            Shape::Tolerance if self.roll(2) == 0 => self.formula(),
            Shape::Tolerance => Value::Table(
                TOLERANCES.iter().map(|kind| (kind.to_string(), self.formula())).collect(),
            ),
            Shape::Word(words) => Value::from(self.pick(words)),
            Shape::Options(family) => {
                let families = kempe::analyses::option_families();
                let family = families.iter().find(|f| f.name == family).expect("it is listed");
                let options = self.pick(&family.options);
                let mut fields = self.fields(&options.table, true, used);
                for (one, others) in options.excludes {
                    if fields.iter().any(|(key, _)| key == one) {
                        fields.retain(|(key, _)| !others.contains(&key.as_str()));
                    }
                }
                Value::Table(fields)
            }
        }
    }

    /// Values that only bodies have.
    fn of_body(&mut self, shape: Shape, used: &mut usize) -> Value {
        match shape {
            Shape::Curves => {
                let circle = |own: &mut Self| {
                    let numbers = vec![own.formula(), own.formula(), own.formula()];
                    Value::Table(vec![("circle".to_string(), Value::List(numbers))])
                };
                Value::Table((0..self.roll(3)).map(|_| (self.name(used), circle(self))).collect())
            }
            Shape::Shapes => {
                let tables = kempe::model::shape_tables();
                let mut shape = |own: &mut Self| {
                    let table = own.pick(&tables);
                    Value::Table(own.fields(&table, true, used))
                };
                Value::List((0..1 + self.roll(2)).map(|_| shape(self)).collect())
            }
            Shape::Outline => match self.roll(3) {
                0 => self.value(Shape::Corners, used),
                1 => Value::Table(vec![("circle".to_string(), self.value(Shape::Triple, used))]),
                _ => Value::Table(vec![("path".to_string(), Value::Text(self.text()))]),
            },
            Shape::Corners => Value::List((0..3 + self.roll(3)).map(|_| self.pair()).collect()),
            other => self.value(other, used),
        }
    }

    fn fields(&mut self, table: &Table, typed: bool, used: &mut usize) -> Vec<(String, Value)> {
        let mut fields: Vec<(String, Value)> = Vec::new();
        for field in &table.fields {
            if field.default.is_none() || field.name == "length" || self.roll(2) == 0 {
                fields.push((field.name.to_string(), self.value(field.shape, used)));
            }
        }
        if table.name == "body" {
            self.weigh(&mut fields);
        }
        if typed {
            fields.insert(self.roll(fields.len() + 1), ("type".to_string(), table.name.into()));
        }
        fields
    }

    /// A body has shapes, or mass and inertia.
    fn weigh(&mut self, fields: &mut Vec<(String, Value)>) {
        if fields.iter().any(|(key, _)| key == "shapes") {
            fields.retain(|(key, _)| !["mass", "inertia", "center"].contains(&key.as_str()));
            return;
        }
        for key in ["mass", "inertia"] {
            if fields.iter().all(|(known, _)| known != key) {
                fields.push((key.to_string(), self.formula()));
            }
        }
    }

    fn entries(&mut self, tables: &[Table], used: &mut usize) -> Vec<Entry> {
        let mut entry = |dice: &mut Self| {
            let table = dice.pick(tables);
            let typed = table.name != "body" || dice.roll(2) == 0;
            let name = dice.name(used);
            Entry { name, fields: dice.fields(&table, typed, used) }
        };
        (0..self.roll(4)).map(|_| entry(self)).collect()
    }

    /// Tables with points, or with a file.
    fn tables(&mut self, used: &mut usize) -> Vec<Entry> {
        let declared = kempe::model::table_fields();
        let mut table = |k: u64| {
            let mut fields = self.fields(&declared, false, used);
            let file = fields.iter().any(|(key, _)| key == "file");
            let kept = |key: &str| if file { key != "x" && key != "y" } else { key != "columns" };
            fields.retain(|(key, _)| kept(key));
            for key in ["x", "y"] {
                if !file && fields.iter().all(|(known, _)| known != key) {
                    fields.push((key.to_string(), self.value(Shape::Numbers, used)));
                }
            }
            Entry { name: format!("table_{k}"), fields }
        };
        (0..3).map(&mut table).collect()
    }

    fn case(&mut self) -> Case {
        let used = &mut 0;
        let elements = |group: Group| -> Vec<Table> {
            catalogue().into_iter().filter(|(g, _)| *g == group).map(|(_, t)| t).collect()
        };
        let bodies: Vec<Table> = body_tables().into_iter().filter(|t| t.name != "ground").collect();
        let definition = Definition {
            title: (self.roll(2) == 0).then(|| self.text()),
            gravity: (self.roll(2) == 0).then(|| self.pair()),
            redundancy: (self.roll(2) == 0).then(|| "allow".to_string()),
            parameters: (0..self.roll(5)).map(|_| (self.name(used), self.formula())).collect(),
            tables: self.tables(used),
            bodies: self.entries(&bodies, used),
            joints: self.entries(&elements(Group::Joints), used),
            drivers: self.entries(&elements(Group::Drivers), used),
            forces: self.entries(&elements(Group::Forces), used),
            measures: (0..self.roll(3)).map(|_| self.measure(used)).collect(),
            functions: None,
        };
        let analyses: Vec<Table> =
            kempe::analyses::declarations().iter().map(|d| d.table.clone()).collect();
        let mut analyses = self.entries(&analyses, used);
        analyses.iter_mut().for_each(|entry| entry.name = self.folder(used));
        let start = Start { set: self.coordinates(used), guess: self.coordinates(used) };
        let analyses = analyses.into_iter().map(consistent).collect();
        Case { definition, start, analyses, ..Case::default() }
    }

    fn measure(&mut self, used: &mut usize) -> (String, Value) {
        (self.name(used), Value::Text(self.text()))
    }

    fn coordinates(&mut self, used: &mut usize) -> Vec<(String, Value)> {
        let mut key =
            |dice: &mut Self| format!("{}.{}", dice.name(used), dice.pick(&Coordinate::ALL).name());
        (0..self.roll(3)).map(|_| (key(self), self.formula())).collect()
    }
}

/// The analysis without optional fields that refer to other analyses or exclude other fields.
fn consistent(mut analysis: Entry) -> Entry {
    let needs_over = analysis.get("ranges").is_some();
    analysis.fields.retain(|(key, _)| match key.as_str() {
        "from" | "output" => false,
        "over" => needs_over,
        _ => true,
    });
    analysis
}

#[test]
fn any_case_goes_through_both_formats() {
    let mut dice = Dice(7);
    for round in 0..400 {
        let case = dice.case();
        for format in FORMATS {
            let text = case::write(&case, format);
            match case::read(&text, format) {
                Ok((read, _)) => assert_eq!(read, case, "round {round}:\n{text}"),
                Err(faults) => panic!("round {round}: {}\n{text}", faults[0]),
            }
        }
    }
}

#[test]
fn numbers_are_as_short_as_they_can_be() {
    for (x, wanted) in [
        (10.0, "10"),
        (1e6, "1e6"),
        (0.01, "0.01"),
        (1e-6, "1e-6"),
        (123_456_789.0, "123456789"),
        (0.000_12, "1.2e-4"),
        (9_007_199_254_740_992.0, "9.007199254740992e15"),
        (-0.5, "-0.5"),
        (f64::MAX, "1.7976931348623157e308"),
    ] {
        let definition =
            Definition { parameters: vec![("a".into(), x.into())], ..Default::default() };
        let case = Case { definition, ..Default::default() };
        let text = case::write(&case, Format::Toml);
        assert_eq!(text, format!("kempe = 1\n\n[parameters]\na = {wanted}\n"));
    }
}
