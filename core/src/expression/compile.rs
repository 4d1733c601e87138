//! Syntax tree → tape: names become symbols, constant parts become numbers.

use super::names::constant;
use super::operation::{Relation, FUNCTIONS};
use super::parser::wrong_count;
use super::points::TABLE_ENDS;
use super::suggest::did_you_mean;
use super::switch::Piecewise;
use super::table::Table;
use super::tape::{FormulaValues, Instruction, TapeCode};
use super::tree::{Node, NodeKind};
use super::unit::Unit;
use super::{ExpressionError, Names, Symbol, Tape, MAX_OPERANDS};
use crate::math::{Listed, Real};
use std::ops::Range;
use std::sync::Arc;

/// Compiles a tree that was read from `text`.
pub(super) fn compile<N: Names + ?Sized>(
    text: &str,
    nodes: &[Node],
    names: &N,
) -> Result<Tape, ExpressionError> {
    let tape = TapeCode { code: Vec::with_capacity(nodes.len()), ..TapeCode::default() };
    let mut compiler = Compiler { text, tape, depth: 0, conditions: Vec::new() };
    for node in nodes {
        compiler.node(node, names)?;
    }
    compiler.tape.count_switches();
    Ok(compiler.tape.into())
}

struct Compiler<'a> {
    text: &'a str,
    tape: TapeCode,
    /// Operands on the stack after the last instruction.
    depth: usize,
    /// Relations whose `if` follows later.
    conditions: Vec<Relation>,
}

/// The meaning of a name.
enum Meaning {
    One(Instruction),
    Formula(Tape),
}

impl Compiler<'_> {
    fn node<N: Names + ?Sized>(&mut self, node: &Node, names: &N) -> Result<(), ExpressionError> {
        use super::operation::Binary;
        let instruction = match &node.kind {
            NodeKind::Number(value) => Instruction::Constant(*value),
            NodeKind::Name(name) => match self.name(name, node.span.clone(), names)? {
                Meaning::One(instruction) => instruction,
                Meaning::Formula(tape) => return self.insert(&tape, &node.span),
            },
            NodeKind::Unary(operation) => match Piecewise::unary(*operation) {
                Some(piecewise) => Instruction::Piecewise(piecewise),
                None => Instruction::Unary(*operation),
            },
            NodeKind::Binary(Binary::Power) => self.power(),
            NodeKind::Binary(operation) => match Piecewise::binary(*operation) {
                Some(piecewise) => Instruction::Piecewise(piecewise),
                None => Instruction::Binary(*operation),
            },
            NodeKind::Compare(relation) => {
                self.conditions.push(*relation);
                Instruction::Binary(Binary::Subtract)
            }
            NodeKind::If => match self.conditions.pop() {
                Some(relation) => Instruction::Piecewise(Piecewise::Choose(relation)),
                None => unreachable!("the parser lets no `if` pass without a condition"),
            },
            NodeKind::Step5 => Instruction::Piecewise(Piecewise::Step5),
            NodeKind::Call(name, count) => self.table(name, *count, node.span.clone(), names)?,
        };
        self.emit(instruction, &node.span)
    }

    fn name<N: Names + ?Sized>(
        &mut self,
        name: &str,
        span: Range<usize>,
        names: &N,
    ) -> Result<Meaning, ExpressionError> {
        if let Some(value) = constant(name) {
            return Ok(Meaning::One(Instruction::Constant(value)));
        }
        match names.resolve(name) {
            Some(symbol) => {
                self.add_symbol(symbol);
                Ok(Meaning::One(Instruction::Load(symbol)))
            }
            None => match names.formula(name) {
                Some(tape) => Ok(Meaning::Formula(tape)),
                None => Err(unknown(name, span, names)),
            },
        }
    }

    fn add_symbol(&mut self, symbol: Symbol) {
        if !self.tape.symbols.contains(&symbol) {
            self.tape.symbols.push(symbol);
        }
    }

    /// Inserts a formula, whose value is one operand.
    fn insert(&mut self, formula: &Tape, span: &Range<usize>) -> Result<(), ExpressionError> {
        self.tape.operands = self.tape.operands.max(self.depth + formula.operands);
        if self.tape.operands > MAX_OPERANDS {
            return Err(too_many_operands(span));
        }
        formula.symbols.iter().for_each(|symbol| self.add_symbol(*symbol));
        for instruction in &formula.code {
            let own = match *instruction {
                Instruction::Table(k) => Instruction::Table(self.place(&formula.tables[k])),
                other => other,
            };
            self.tape.code.push(own);
        }
        self.depth += 1;
        Ok(())
    }

    /// A call of a table.
    fn table<N: Names + ?Sized>(
        &mut self,
        name: &str,
        count: usize,
        span: Range<usize>,
        names: &N,
    ) -> Result<Instruction, ExpressionError> {
        let known = names.tables();
        let Some(table) = known.iter().find(|table| table.name() == name) else {
            let length = self.text[span.clone()].find('(').unwrap_or(0);
            let written = self.text[span.start..span.start + length].trim_end();
            return Err(unknown_function(name, span.start..span.start + written.len(), names));
        };
        if count != 1 {
            return Err(wrong_count(name, &["x"], count, span));
        }
        if let Some(&Instruction::Constant(x)) = self.tape.code.last() {
            if let Some(refusal) = table.refusal(x) {
                return Err(ExpressionError::new(span, refusal).hint(TABLE_ENDS.to_string()));
            }
        }
        Ok(Instruction::Table(self.place(table)))
    }

    /// The index of a table in the tape, which is added if it is new.
    fn place(&mut self, table: &Arc<Table>) -> usize {
        let tables = &mut self.tape.tables;
        tables.iter().position(|used| used.name() == table.name()).unwrap_or_else(|| {
            tables.push(Arc::clone(table));
            tables.len() - 1
        })
    }

    /// x^p. A constant exponent is moved from the tape into the instruction, which is then defined for x ≤ 0 as well.
    fn power(&mut self) -> Instruction {
        match self.tape.code.last() {
            Some(&Instruction::Constant(exponent)) => {
                self.tape.code.pop();
                self.depth -= 1;
                Instruction::PowerConstant(exponent)
            }
            _ => Instruction::Binary(super::operation::Binary::Power),
        }
    }

    fn emit(
        &mut self,
        instruction: Instruction,
        span: &Range<usize>,
    ) -> Result<(), ExpressionError> {
        let code = &mut self.tape.code;
        code.push(instruction);
        self.depth = self.depth + 1 - instruction.operands();
        self.tape.operands = self.tape.operands.max(self.depth);
        if self.tape.operands > MAX_OPERANDS {
            return Err(too_many_operands(span));
        }
        // a constant operand is a single instruction, so that all operands are constant if and only if the preceding
        // instructions are constants
        let first = code.len() - 1 - instruction.operands();
        let operands = &code[first..code.len() - 1];
        if !operands.is_empty() && operands.iter().all(|i| matches!(i, Instruction::Constant(_))) {
            let value = fold(&code[first..], &self.tape.tables);
            self.require_finite(value, span)?;
            self.tape.code.truncate(first);
            self.tape.code.push(Instruction::Constant(value));
        }
        Ok(())
    }

    fn require_finite(&self, value: f64, span: &Range<usize>) -> Result<(), ExpressionError> {
        if Real::is_finite(value) {
            return Ok(());
        }
        let is = if value.is_nan() { "is not a real number" } else { "is not finite" };
        let words: Vec<_> = self.text[span.clone()].split_whitespace().list();
        let part = words.join(" ");
        let message = match part.chars().count() {
            0..=60 => format!("{part} {is}"),
            _ => format!("this constant {is}"),
        };
        Err(ExpressionError::new(span.clone(), message))
    }
}

/// The value of a piece of tape without symbols, computed by the usual evaluation.
fn fold(code: &[Instruction], tables: &[Arc<Table>]) -> f64 {
    let tape = Tape::from(TapeCode {
        code: code.to_vec(),
        operands: code.len(),
        tables: tables.to_vec(),
        ..TapeCode::default()
    });
    tape.evaluate(&FormulaValues { parameters: &[], time: f64::NAN, variables: &[] })
}

fn too_many_operands(span: &Range<usize>) -> ExpressionError {
    let message =
        format!("the expression holds more than {MAX_OPERANDS} operands open at this point");
    ExpressionError::new(span.clone(), message)
        .hint("give its parts names of their own as parameters".to_string())
}

fn unknown<N: Names + ?Sized>(name: &str, span: Range<usize>, names: &N) -> ExpressionError {
    if name == "t" {
        let hint = "use t in laws of drivers and forces; a mass in tonnes is written '2 tonne'";
        return ExpressionError::new(span, "the time t has no meaning here").hint(hint.to_string());
    }
    let known = names.known();
    let hint = match name.to_ascii_lowercase().as_str() {
        "inf" | "infinity" | "nan" => Some("a number must be finite".to_string()),
        "time" if names.resolve("t") == Some(Symbol::Time) => Some("the time is 't'".to_string()),
        _ => coordinates(name, &known)
            .or_else(|| {
                Unit::parse(name).ok().filter(|_| name.len() > 1)?;
                Some(format!("'{name}' is a unit; write it after a number, such as '2 {name}'"))
            })
            .or_else(|| did_you_mean(name, known.iter().map(String::as_str).chain(["pi", "deg"])))
            .or_else(|| coordinates(name.rsplit_once('.')?.0, &known))
            .or_else(|| (!name.contains('.')).then(|| "declare it in the parameters".to_string())),
    };
    ExpressionError::new(span, format!("unknown name '{name}'")).hint(hint)
}

fn unknown_function<N: Names + ?Sized>(
    name: &str,
    span: Range<usize>,
    names: &N,
) -> ExpressionError {
    let tables = names.tables().iter().map(|table| table.name());
    let hint = match name {
        "log" => Some("write ln for the natural logarithm, log10 for the decimal".to_string()),
        "arcsin" | "arccos" | "arctan" | "arctan2" => Some(format!("write a{}", &name[3..])),
        "pow" => Some("write x^y".to_string()),
        _ => did_you_mean(name, FUNCTIONS.iter().map(|f| f.name).chain(tables))
            .or_else(|| Some(format!("to multiply, write {name}*(...)"))),
    };
    ExpressionError::new(span, format!("unknown function '{name}'")).hint(hint)
}

/// The coordinates of `body` among the known names.
fn coordinates(body: &str, known: &[String]) -> Option<String> {
    let prefix = format!("{body}.");
    let owned: Vec<_> =
        known.iter().filter(|other| other.starts_with(&prefix)).take(8).cloned().list();
    (!owned.is_empty()).then(|| format!("known are {}", owned.join(", ")))
}
