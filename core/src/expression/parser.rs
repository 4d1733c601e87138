//! Tokens → syntax tree, by recursive descent over the grammar in [`super`].

use super::lexer::{Lexer, Token, TokenKind};
use super::names::constant;
use super::operation::{Binary, Call, Function, Relation, Unary};
use super::quantity::multiplied;
use super::tree::{Node, NodeKind};
use super::{ExpressionError, MAX_DEPTH};
use std::ops::Range;

type Parsed<T> = Result<T, ExpressionError>;

/// Reads a whole text as one expression.
pub(super) fn parse(text: &str) -> Parsed<Vec<Node>> {
    read(text, |parser| parser.value())
}

/// Reads a whole text as one expression or one comparison. A comparison is returned as the difference of its sides
/// and the relation.
pub(super) fn parse_condition(text: &str) -> Parsed<(Vec<Node>, Option<Relation>)> {
    let mut nodes = read(text, |parser| parser.comparison())?;
    let Some(Node { kind, .. }) = nodes.last_mut() else { return Ok((nodes, None)) };
    let NodeKind::Compare(relation) = *kind else { return Ok((nodes, None)) };
    *kind = NodeKind::Binary(Binary::Subtract);
    Ok((nodes, Some(relation)))
}

fn read(
    text: &str,
    whole: impl FnOnce(&mut Parser<'_>) -> Parsed<Range<usize>>,
) -> Parsed<Vec<Node>> {
    let mut lexer = Lexer::new(text);
    let token = lexer.next()?;
    if token.kind == TokenKind::End {
        return Err(ExpressionError::new(token.span, "the expression is empty"));
    }
    let mut parser = Parser { text, lexer, token, nodes: Vec::new(), depth: 0 };
    whole(&mut parser)?;
    match parser.token.kind {
        TokenKind::End => Ok(parser.nodes),
        _ => Err(parser.misplaced()),
    }
}

/// Appends nodes in postorder; each method returns the span of what it read.
struct Parser<'a> {
    text: &'a str,
    lexer: Lexer<'a>,
    /// The next token.
    token: Token,
    nodes: Vec<Node>,
    depth: usize,
}

impl Parser<'_> {
    fn advance(&mut self) -> Parsed<Token> {
        let next = self.lexer.next()?;
        Ok(std::mem::replace(&mut self.token, next))
    }

    fn at(&self, mark: char) -> bool {
        self.token.kind == TokenKind::Mark(mark)
    }

    fn push(&mut self, kind: NodeKind, span: Range<usize>) -> Range<usize> {
        self.nodes.push(Node { kind, span: span.clone() });
        span
    }

    /// Reads one nesting level deeper. The limit bounds the recursion of the parser.
    fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.depth == MAX_DEPTH {
            let message = format!("the expression is nested more than {MAX_DEPTH} levels deep");
            return Err(ExpressionError::new(self.token.span.clone(), message)
                .hint("give its parts names of their own as parameters".to_string()));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    /// A number, as opposed to a comparison.
    fn value(&mut self) -> Parsed<Range<usize>> {
        let span = self.comparison()?;
        match self.nodes.last() {
            Some(Node { kind: NodeKind::Compare(_), .. }) => Err(misplaced_comparison(span)),
            _ => Ok(span),
        }
    }

    fn comparison(&mut self) -> Parsed<Range<usize>> {
        let left = self.sum()?;
        let TokenKind::Relation(relation) = self.token.kind else { return Ok(left) };
        self.require_number(&left)?;
        self.advance()?;
        let right = self.sum()?;
        self.require_number(&right)?;
        if let TokenKind::Relation(_) = self.token.kind {
            return Err(ExpressionError::new(
                self.token.span.clone(),
                "only two numbers can be compared at a time",
            )
            .hint("nest one if inside another".to_string()));
        }
        Ok(self.push(NodeKind::Compare(relation), left.start..right.end))
    }

    /// Checks that the subtree read last can be an operand, which a comparison in parentheses cannot be.
    fn require_number(&self, span: &Range<usize>) -> Parsed<()> {
        match self.nodes.last() {
            Some(Node { kind: NodeKind::Compare(_), .. }) => {
                Err(misplaced_comparison(span.clone()))
            }
            _ => Ok(()),
        }
    }

    /// Operands of one precedence with operators between them, from left to right.
    fn chain(
        &mut self,
        operators: &[(char, Binary)],
        operand: fn(&mut Self) -> Parsed<Range<usize>>,
    ) -> Parsed<Range<usize>> {
        let mut left = operand(self)?;
        while let Some(&(_, operation)) = operators.iter().find(|(mark, _)| self.at(*mark)) {
            self.require_number(&left)?;
            self.advance()?;
            let right = operand(self)?;
            self.require_number(&right)?;
            left = self.push(NodeKind::Binary(operation), left.start..right.end);
        }
        Ok(left)
    }

    fn sum(&mut self) -> Parsed<Range<usize>> {
        self.chain(&[('+', Binary::Add), ('-', Binary::Subtract)], Self::product)
    }

    fn product(&mut self) -> Parsed<Range<usize>> {
        self.chain(&[('*', Binary::Multiply), ('/', Binary::Divide)], Self::unary)
    }

    fn unary(&mut self) -> Parsed<Range<usize>> {
        let negative = self.at('-');
        if !negative && !self.at('+') {
            return self.power();
        }
        let sign = self.advance()?.span;
        let operand = self.nested(Self::unary)?;
        self.require_number(&operand)?;
        let span = sign.start..operand.end;
        Ok(if negative { self.push(NodeKind::Unary(Unary::Negate), span) } else { span })
    }

    fn power(&mut self) -> Parsed<Range<usize>> {
        let base = self.primary()?;
        if !self.at('^') {
            return Ok(base);
        }
        self.require_number(&base)?;
        self.advance()?;
        let exponent = self.nested(Self::unary)?;
        self.require_number(&exponent)?;
        Ok(self.push(NodeKind::Binary(Binary::Power), base.start..exponent.end))
    }

    fn primary(&mut self) -> Parsed<Range<usize>> {
        match &self.token.kind {
            TokenKind::Number(value) => {
                let kind = NodeKind::Number(*value);
                let span = self.advance()?.span;
                Ok(self.push(kind, span))
            }
            TokenKind::Name(name) => {
                let name = name.clone();
                let span = self.advance()?.span;
                self.name_or_call(name, span)
            }
            TokenKind::Mark('(') => self.nested(Self::group),
            _ => Err(self.misplaced()),
        }
    }

    fn group(&mut self) -> Parsed<Range<usize>> {
        let open = self.advance()?.span;
        self.comparison()?;
        let close = self.close(&open)?;
        Ok(open.start..close.end)
    }

    /// Reads the parenthesis that closes the parenthesis at `open`.
    fn close(&mut self, open: &Range<usize>) -> Parsed<Range<usize>> {
        match self.token.kind {
            TokenKind::Mark(')') => Ok(self.advance()?.span),
            TokenKind::End => Err(ExpressionError::new(open.clone(), "this '(' is never closed")),
            _ => Err(self.misplaced()),
        }
    }

    fn name_or_call(&mut self, name: String, span: Range<usize>) -> Parsed<Range<usize>> {
        let quoted = self.text[span.clone()].starts_with('`');
        match Call::named(&name) {
            _ if quoted => {}
            Some(function) if self.at('(') => {
                return self.nested(|parser| parser.call(&name, Some(function), span));
            }
            Some(function) => {
                let arguments = function.arguments.join(", ");
                let message = format!("{name} is a function; its arguments must follow");
                return Err(
                    ExpressionError::new(span, message).hint(format!("write {name}({arguments})"))
                );
            }
            None if self.at('(') => return self.nested(|parser| parser.call(&name, None, span)),
            None => {}
        }
        Ok(self.push(NodeKind::Name(name), span))
    }

    /// A call of a function of the language, or of a table, which the compiler looks up.
    fn call(
        &mut self,
        name: &str,
        function: Option<&Function>,
        span: Range<usize>,
    ) -> Parsed<Range<usize>> {
        let open = self.advance()?.span;
        let mut count = 0;
        while !(count == 0 && self.at(')')) {
            self.argument(function, count)?;
            count += 1;
            if !self.at(',') {
                break;
            }
            self.advance()?;
        }
        let span = span.start..self.close(&open)?.end;
        let kind = match function {
            None => NodeKind::Call(name.to_string(), count),
            Some(function) if count != function.arguments.len() => {
                return Err(wrong_count(name, function.arguments, count, span));
            }
            Some(function) => match function.call {
                Call::Unary(operation) => NodeKind::Unary(operation),
                Call::Binary(operation) => NodeKind::Binary(operation),
                Call::If => NodeKind::If,
                Call::Step5 => NodeKind::Step5,
            },
        };
        Ok(self.push(kind, span))
    }

    fn argument(&mut self, function: Option<&Function>, index: usize) -> Parsed<()> {
        if (function.map(|f| f.call), index) != (Some(Call::If), 0) {
            return self.value().map(|_| ());
        }
        let span = self.comparison()?;
        match self.nodes.last() {
            Some(Node { kind: NodeKind::Compare(_), .. }) => Ok(()),
            _ => Err(ExpressionError::new(span, "the first argument of if must be a condition")
                .hint("such as x > 0; conditions are <, <=, > and >=".to_string())),
        }
    }

    /// The error for a misplaced token.
    fn misplaced(&self) -> ExpressionError {
        let span = self.token.span.clone();
        let written = &self.text[span.clone()];
        let after_operand = self.text[..span.start]
            .trim_end()
            .ends_with(|c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | ')' | '`'));
        match &self.token.kind {
            TokenKind::End => ExpressionError::new(span, "the expression ends too early"),
            TokenKind::Number(_) | TokenKind::Name(_) | TokenKind::Mark('(') if after_operand => {
                self.missing_operator(written, span)
            }
            TokenKind::Mark('*') if self.text[..span.start].ends_with('*') => {
                ExpressionError::new(span, "unexpected '*'")
                    .hint("a power is written '^'".to_string())
            }
            TokenKind::Mark(',') if self.depth == 0 => ExpressionError::new(span, "unexpected ','")
                .hint("the decimal mark is a point".to_string()),
            _ => ExpressionError::new(span, format!("unexpected '{written}'")),
        }
    }

    /// The number that ends just before byte `end`.
    fn number_before(&self, end: usize) -> Option<Range<usize>> {
        let end = self.text[..end].trim_end().len();
        self.nodes.iter().rev().find_map(|node| match node.kind {
            NodeKind::Number(_) if node.span.end == end => Some(node.span.clone()),
            _ => None,
        })
    }

    /// The error for two adjacent operands. The second operand, at `span`, may be a unit.
    fn missing_operator(&self, written: &str, span: Range<usize>) -> ExpressionError {
        let number = self.number_before(span.start);
        let multiplied = multiplied(self.text, span.clone());
        if let (Some(_), Some(text)) = (&number, &multiplied) {
            let message = "a unit may follow only a number that stands alone";
            return ExpressionError::new(span, message).hint(format!("write {text}"));
        }
        let hint = match (number, multiplied, &self.token.kind) {
            (Some(number), _, TokenKind::Name(name)) if constant(name).is_none() => {
                let number = &self.text[number];
                format!("'{written}' is not a unit; if it is a name, write {number}*{written}")
            }
            (_, Some(text), _) if constant(written).is_none() => {
                format!("write '*' to multiply, or {text} for the unit")
            }
            _ => "write '*' to multiply".to_string(),
        };
        ExpressionError::new(span, format!("an operator is missing before '{written}'")).hint(hint)
    }
}

fn misplaced_comparison(span: Range<usize>) -> ExpressionError {
    ExpressionError::new(span, "a comparison is allowed only as the first argument of if")
        .hint("write if(a < b, 1, 0) for its value as a number".to_string())
}

/// The error for a call with a wrong number of arguments.
pub(super) fn wrong_count(
    name: &str,
    arguments: &[&str],
    count: usize,
    span: Range<usize>,
) -> ExpressionError {
    let plural = if arguments.len() == 1 { "" } else { "s" };
    let message = format!("{name} takes {} argument{plural}, got {count}", arguments.len());
    ExpressionError::new(span, message).hint(format!("write {name}({})", arguments.join(", ")))
}
