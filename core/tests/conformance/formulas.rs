//! Printed equations of every sample, evaluated by the language of expressions, and their text.

use crate::mechanisms::{close, Random};
use crate::samples::{constraints, terms, Participants};
use kempe::elements::{acts_as_force, catalogue, Constraint, Group, Shape};
use kempe::equations::formulas::{of_element, of_type, Formulas};
use kempe::expression::{Expression, FormulaValues};
use kempe::symbolic::Form;

/// Names with their values; definitions may use those before them.
struct Table {
    names: Vec<String>,
    values: Vec<f64>,
}

impl Table {
    fn value(&self, text: &str) -> f64 {
        let expression = Expression::parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        let tape = expression.compile(self.names.as_slice());
        let tape = tape.unwrap_or_else(|e| panic!("{text}: {e:?}"));
        tape.evaluate(&FormulaValues { parameters: &self.values, time: f64::NAN, variables: &[] })
    }

    fn put(&mut self, name: &str, value: f64) {
        self.names.push(name.to_string());
        self.values.push(value);
    }
}

/// The names that the formulas of a sample may use: fields, coordinates and rates.
fn table(c: &Constraint, at: &Participants, formulas: &Formulas) -> Table {
    let mut table = Table { names: Vec::new(), values: Vec::new() };
    for (side, state) in ["i", "j", "k"].into_iter().zip(&at.bodies) {
        for (name, value) in ["x", "y", "angle", "vx", "vy", "omega"].into_iter().zip(state) {
            table.put(&format!("{side}.{name}"), *value);
        }
    }
    for [u, rate] in &at.own {
        table.put("u", *u);
        table.put("u_rate", *rate);
    }
    let fields = catalogue().into_iter().find(|(_, t)| t.name == c.kind()).unwrap().1.fields;
    let mut laws: Vec<String> = Vec::new();
    for (field, count) in fields.iter().zip(c.scalars()) {
        match field.shape {
            Shape::Law => laws.push(field.name.to_string()),
            Shape::Laws => laws.extend((1..=count).map(|k| format!("{}_{k}", field.name))),
            _ => {}
        }
    }
    let mut names = fields.iter().zip(c.scalars()).flat_map(|(field, count)| {
        let name = field.name;
        match format!("{:?}", field.shape).as_str() {
            _ if count == 0 => vec![],
            "Point" => vec![format!("{name}.s.x"), format!("{name}.s.y")],
            "Pair" => vec![format!("{name}_i"), format!("{name}_j")],
            "Number" | "Law" => vec![name.to_string()],
            "Laws" | "Terms" => (1..=count).map(|k| format!("{name}_{k}")).collect(),
            "Curve" => (0..count).map(|k| format!("number_{k}_of_the_curve")).collect(),
            _ => vec![],
        }
    });
    c.map(&mut |x| table.put(&names.next().unwrap(), *x));
    if let Some(on) = c.curve() {
        for (order, term) in on.curve.derivatives(at.own[0][0]).into_iter().enumerate() {
            let derivative =
                if order == 0 { String::new() } else { format!("_{}", "u".repeat(order)) };
            table.put(&format!("curve.x{derivative}"), term.x);
            table.put(&format!("curve.y{derivative}"), term.y);
        }
    }
    for law in laws {
        table.put(&format!("{law}_t"), 0.0);
        table.put(&format!("{law}_tt"), 0.0);
    }
    for (name, text) in &formulas.definitions {
        let value = table.value(text);
        table.put(name, value);
    }
    table
}

/// The worst differences of Φ, Φ_q and γ from the printed equations.
fn compare(c: &Constraint, formulas: &Formulas, mut check: impl FnMut(&str, f64, f64)) {
    let mut numbers = Random::new(11);
    let m = c.equations().len();
    for _ in 0..10 {
        let at = Participants::random(c, &mut numbers);
        let table = table(c, &at, formulas);
        let ([phi, _, gamma], columns) = terms(c, &at, 0.0);
        assert_eq!(formulas.rows.len(), m);
        for (k, row) in formulas.rows.iter().enumerate() {
            check("Φ", table.value(&row.residual), phi[k]);
            check("γ", table.value(&row.gamma), gamma[k]);
            let moving = c.bodies().iter().map(|body| !body.is_ground()).collect::<Vec<_>>();
            let participants = columns.chunks_exact(m).enumerate();
            let known = participants.filter(|(p, _)| moving.get(*p).copied().unwrap_or(true));
            let numbers: Vec<f64> = known.flat_map(|(_, rows)| rows[k]).collect();
            for (entry, number) in row.jacobian.iter().zip(numbers) {
                check("Φ_q", table.value(entry), number);
            }
        }
    }
}

#[test]
fn printed_equations_give_the_numbers_of_the_element() {
    let listed = catalogue();
    let written = |c: &Constraint| listed.iter().any(|(_, table)| table.name == c.kind());
    for c in constraints().into_iter().filter(written) {
        let formulas = of_element(&c, Form::Expression);
        compare(&c, &formulas, |what, printed, number| {
            close(&format!("{what} of {}", c.kind()), printed, number, 1e-12);
        });
    }
}

#[test]
fn a_wrong_equation_is_seen() {
    for c in constraints().into_iter().take(3) {
        let mut formulas = of_element(&c, Form::Expression);
        formulas.rows[0].gamma.insert_str(0, "1e-9 + ");
        let mut worst = 0.0_f64;
        compare(&c, &formulas, |_, printed, number| worst = worst.max((printed - number).abs()));
        assert!(worst > 5e-10, "{}", c.kind());
    }
}

/// The equations of a type as lines.
fn lines(group: Group, kind: &str, form: Form) -> String {
    let formulas = of_type(group, kind, form).unwrap();
    let mut lines = vec![format!("# {kind}, {form:?}")];
    lines.extend(formulas.definitions.iter().map(|(name, text)| format!("{name} = {text}")));
    for row in &formulas.rows {
        lines.push(format!("Φ = {}", row.residual));
        let entries = formulas.columns.iter().zip(&row.jacobian).filter(|(_, entry)| *entry != "0");
        lines.extend(entries.map(|(column, entry)| format!("∂Φ/∂{column} = {entry}")));
        lines.push(format!("γ = {}", row.gamma));
    }
    lines.join("\n") + "\n\n"
}

/// `KEMPE_WRITE=1` writes the file; read it as you would read a blackboard.
#[test]
fn printed_equations_are_those_of_the_file() {
    let mut text = String::new();
    let for_tests = ["turned_pin", "bead", "levels", "pulley"];
    for (group, table) in catalogue().iter().filter(|(group, _)| *group != Group::Forces) {
        if for_tests.contains(&table.name) || acts_as_force(table.name) {
            continue;
        }
        for form in [Form::Expression, Form::Unicode, Form::Latex] {
            text += &lines(*group, table.name, form);
        }
    }
    if std::env::var_os("KEMPE_WRITE").is_some() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/conformance/formulas.txt");
        std::fs::write(file, &text).unwrap();
        return;
    }
    let known = include_str!("formulas.txt");
    for (line, known) in text.lines().zip(known.lines()) {
        assert_eq!(line, known);
    }
    assert_eq!(text, known, "all:\n{text}");
}
