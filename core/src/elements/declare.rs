//! The declaration of an element. One macro defines the struct over any scalar, its `map` between scalars, its reader
//! and its table of fields.

use super::field::Field;
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
                    fields: vec![$($crate::elements::Field {
                        name: $crate::elements::plain(stringify!($field)),
                        shape: <$crate::elements::$kind as $crate::elements::Kind>::SHAPE,
                        unit: concat!($($(stringify!($unit)),*)?).to_string(),
                        default: <$crate::elements::$kind as $crate::elements::Kind>::DEFAULT
                            $(.or(Some($default.into())))?,
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

            fn scalars<S>(e: &$Name<S>) -> Vec<usize> {
                vec![$({
                    let mut count = 0;
                    // any scalar counts; this one is mapped to elsewhere too, so that it needs no further code
                    <$crate::elements::$kind as $crate::elements::Kind>::map::<S, $crate::math::Jet>(
                        &e.$field, &mut |_| { count += 1; $crate::math::Real::zero() });
                    count
                }),+]
            }
        }
    };
}
