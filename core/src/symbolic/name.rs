//! Names of the unknowns and constants of an expression, in every printed form.

/// The kind of a name. It determines the position in a product and the order of common factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NameKind {
    /// A velocity.
    Rate,
    /// A constant or a given function of time.
    Field,
    /// Time.
    Time,
    /// A component of a unit vector.
    Direction,
    /// A component of a named vector, or another named part of an expression.
    Part,
    /// A coordinate.
    Coordinate,
}

/// Which component of a vector a name is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Axis {
    /// Along x.
    X,
    /// Along y.
    Y,
}

impl Axis {
    pub(super) fn text(self) -> &'static str {
        ["x", "y"][self as usize]
    }
    pub(super) fn other(self) -> Self {
        [Self::Y, Self::X][self as usize]
    }
}

/// A name.
#[derive(Clone, Debug)]
pub struct Name {
    /// In the language of expressions, such as `crank.omega`.
    pub text: String,
    /// In plain Unicode, such as `φ̇ᵢ`.
    pub unicode: String,
    /// In LaTeX.
    pub latex: String,
    /// Its kind.
    pub kind: NameKind,
    /// The component of a vector that it denotes, if any.
    pub axis: Option<Axis>,
    /// The index of the body that it belongs to. Terms of one body are written side by side.
    pub owner: Option<usize>,
}

impl Name {
    /// A constant, written in the same way in every form.
    pub fn field(text: &str) -> Self {
        Self::new(text, text, &upright(text), NameKind::Field)
    }

    /// Time.
    pub fn time() -> Self {
        Self::new("t", "t", "t", NameKind::Time)
    }

    /// A name that is no component and belongs to no body.
    pub fn new(text: &str, unicode: &str, latex: &str, kind: NameKind) -> Self {
        Self {
            text: text.to_string(),
            unicode: unicode.to_string(),
            latex: latex.to_string(),
            kind,
            axis: None,
            owner: None,
        }
    }
}

/// A name as upright text in a LaTeX formula.
pub(crate) fn upright(name: &str) -> String {
    let mut text = String::from("\\text{");
    for sign in name.chars() {
        match sign {
            '\\' => text.push_str("\\textbackslash{}"),
            '~' => text.push_str("\\textasciitilde{}"),
            '^' => text.push_str("\\textasciicircum{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                text.push('\\');
                text.push(sign);
            }
            _ => text.push(sign),
        }
    }
    text.push('}');
    text
}
