//! The declaration of an element: one macro emits the struct over any scalar, its `map` between
//! scalars, its reader and its table of fields.

use super::kinds::{Shape, Source};
use crate::expression::Tape;

/// A default value of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Default {
    /// One number.
    Number(f64),
    /// Two numbers.
    Pair([f64; 2]),
    /// true or false.
    Flag(bool),
    /// The options of this type, each with its own default.
    Type(&'static str),
    /// This body.
    Body(&'static str),
    /// Nothing: the field may be left out.
    Absent,
}

impl From<f64> for Default {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}
impl From<[f64; 2]> for Default {
    fn from(x: [f64; 2]) -> Self {
        Self::Pair(x)
    }
}
impl From<&'static str> for Default {
    fn from(body: &'static str) -> Self {
        Self::Body(body)
    }
}

/// One field of an element, for files, the schema, Python and the reference page.
#[derive(Clone, Debug)]
pub struct Field {
    /// Key in the file, argument in Python.
    pub name: &'static str,
    /// The values that it accepts.
    pub shape: Shape,
    /// SI unit; empty for references.
    pub unit: String,
    /// Value if absent; a field without one is required.
    pub default: Option<Default>,
    /// One sentence.
    pub doc: String,
}

impl Field {
    /// A field that must be given.
    pub fn required(name: &'static str, shape: Shape, unit: &str, doc: &str) -> Self {
        Self { name, shape, unit: unit.to_string(), default: None, doc: doc.to_string() }
    }
    /// A field with a default; [`Default::Absent`] if it may be left out.
    pub fn optional(
        name: &'static str,
        shape: Shape,
        unit: &str,
        default: Default,
        doc: &str,
    ) -> Self {
        Self { default: Some(default), ..Self::required(name, shape, unit, doc) }
    }
}

/// The declaration of an element as data.
#[derive(Clone, Debug)]
pub struct Table {
    /// The `type` in the file and the method in Python.
    pub name: &'static str,
    /// Its meaning, equation, source and signs.
    pub doc: String,
    /// Fields in order.
    pub fields: Vec<Field>,
}

/// A family of structs over any scalar, with its declaration.
pub trait Element {
    /// The element over the scalar (or formula) `S`.
    type Over<S>;
    /// The `type` in the file and the method in Python.
    const NAME: &'static str;
    /// The declaration as data.
    fn table() -> Table;
    /// Reads all fields; None if any was faulty (the source keeps the reports).
    fn read(source: &mut dyn Source) -> Option<Self::Over<Tape>>;
    /// The same element over another scalar.
    fn map<S, T>(e: &Self::Over<S>, f: &mut dyn FnMut(&S) -> T) -> Self::Over<T>;
}

/// Doc lines of a declaration, joined.
pub(super) fn join(lines: &[&str]) -> String {
    lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join("\n").trim().to_string()
}

/// Declares an element; see the module's documentation and any element for the form.
#[macro_export]
macro_rules! element {
    ($(#[doc = $doc:literal])* $Name:ident, $name:literal {
        $($(#[doc = $about:literal])* $field:ident : $kind:ident $([$($unit:tt)*])? $(= $default:expr)?),+ $(,)?
    }) => {
        $(#[doc = $doc])*
        #[derive(Clone, Debug)]
        pub struct $Name<S = f64> {
            $($(#[doc = $about])* pub $field: <$crate::elements::$kind as $crate::elements::Kind>::Over<S>,)+
        }

        impl $crate::elements::Element for $Name {
            type Over<S> = $Name<S>;
            const NAME: &'static str = $name;

            fn table() -> $crate::elements::Table {
                $crate::elements::Table {
                    name: $name,
                    doc: $crate::elements::join(&[$($doc),*]),
                    fields: vec![$($crate::elements::Field {
                        name: stringify!($field),
                        shape: <$crate::elements::$kind as $crate::elements::Kind>::SHAPE,
                        unit: concat!($($(stringify!($unit)),*)?).to_string(),
                        default: None$(.or(Some($default.into())))?,
                        doc: $crate::elements::join(&[$($about),*]),
                    }),+],
                }
            }

            fn read(source: &mut dyn $crate::elements::Source)
                -> Option<$Name<$crate::expression::Tape>>
            {
                let mut fields = <Self as $crate::elements::Element>::table().fields.into_iter();
                // every field is read, so that all errors are reported at once
                $(let $field = <$crate::elements::$kind as $crate::elements::Kind>::read(
                    source, &fields.next()?);)+
                Some($Name { $($field: $field?),+ })
            }

            fn map<S, T>(e: &$Name<S>, f: &mut dyn FnMut(&S) -> T) -> $Name<T> {
                $Name { $($field: <$crate::elements::$kind as $crate::elements::Kind>::map(
                    &e.$field, f)),+ }
            }
        }
    };
}
