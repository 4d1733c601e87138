//! The declaration of an element. One macro defines the struct over any scalar, its `map` between scalars, its reader
//! and its table of fields.

use super::field::{Default, Field, Shape};
use super::kinds::Source;
use crate::expression::Tape;
use crate::math::Listed;

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
    /// Reads all fields. None if a field was faulty; the source keeps the reports.
    fn read(source: &mut dyn Source) -> Option<Self::Over<Tape>>;
    /// The same element over another scalar.
    fn map<S, T>(e: &Self::Over<S>, f: &mut dyn FnMut(&S) -> T) -> Self::Over<T>;
    /// The number of scalars of each field, in the order in which [`Element::map`] visits them.
    fn scalars<S>(e: &Self::Over<S>) -> Vec<usize>;
}

/// Doc lines of a declaration, joined.
pub(super) fn join(lines: &[&str]) -> String {
    lines.iter().map(|line| line.trim()).list().join("\n").trim().to_string()
}

/// The declaration of a field: its name, shape, unit and default, and its doc lines.
#[doc(hidden)]
pub type FieldRow<'a> = (&'static str, Shape, &'a str, Option<Default>, &'a [&'a str]);

/// The declarations of fields as data.
#[doc(hidden)]
pub fn declared_fields(declared: &[FieldRow<'_>]) -> Vec<Field> {
    let field = |&(name, shape, unit, default, doc): &FieldRow<'_>| Field {
        name: plain(name),
        shape,
        unit: unit.to_string(),
        default,
        doc: join(doc),
    };
    declared.iter().map(field).list()
}

/// The next field, which has this name.
#[doc(hidden)]
pub fn next_field<'f>(fields: &mut std::slice::Iter<'f, Field>, name: &'static str) -> &'f Field {
    fields.next().filter(|field| field.name == plain(name)).expect("a field of the table")
}

/// The name of a field without the prefix `r#` of Rust keywords, as in `r#static`.
#[doc(hidden)]
pub fn plain(field: &'static str) -> &'static str {
    field.strip_prefix("r#").unwrap_or(field)
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
                    fields: $crate::elements::declared_fields(&[$((
                        stringify!($field),
                        <$crate::elements::$kind as $crate::elements::Kind>::SHAPE,
                        concat!($($(stringify!($unit)),*)?),
                        <$crate::elements::$kind as $crate::elements::Kind>::DEFAULT
                            $(.or(Some($default.into())))?,
                        &[$($about),*],
                    )),+]),
                }
            }

            fn read(source: &mut dyn $crate::elements::Source)
                -> Option<$Name<$crate::expression::Tape>>
            {
                let table = <Self as $crate::elements::Element>::table();
                let mut fields = table.fields.iter();
                // every field is read, so that all errors are reported at once
                match ($(<$crate::elements::$kind as $crate::elements::Kind>::read(
                    source, $crate::elements::next_field(&mut fields, stringify!($field))),)+) {
                    ($(Some($field),)+) => Some($Name { $($field),+ }),
                    _ => None,
                }
            }

            fn map<S, T>(e: &$Name<S>, f: &mut dyn FnMut(&S) -> T) -> $Name<T> {
                $Name { $($field: <$crate::elements::$kind as $crate::elements::Kind>::map(
                    &e.$field, f)),+ }
            }

            fn scalars<S>(e: &$Name<S>) -> Vec<usize> {
                let count = std::cell::Cell::new(0);
                // any scalar counts; this one is mapped to elsewhere too, so that it needs no further code
                let mut visit = |_: &S| -> $crate::math::Jet {
                    count.set(count.get() + 1);
                    $crate::math::Real::zero()
                };
                vec![$({
                    <$crate::elements::$kind as $crate::elements::Kind>::map(&e.$field, &mut visit);
                    count.take()
                }),+]
            }
        }
    };
}
