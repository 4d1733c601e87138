//! Elements as written in a model: fields by name, before names are linked and formulas are read.
//!
//! The declaration of an element yields its methods here, one for each field.

use super::value::Value;
use std::marker::PhantomData;

/// An element of type `E` as written in a model, for
/// [`ModelBuilder::add`](crate::ModelBuilder::add).
///
/// `E::written()` creates an element without fields. Each field of the element has a method of the same name; fields
/// with a default may be omitted.
///
/// ```
/// use kempe::forces::TorsionSpring;
/// let spring = TorsionSpring::written().i("ground").j("rocker").stiffness("k").free_angle("270*deg");
/// ```
#[derive(Clone, Debug)]
pub struct Written<E> {
    fields: Vec<(&'static str, Value)>,
    element: PhantomData<E>,
}

impl<E> Default for Written<E> {
    fn default() -> Self {
        Self { fields: Vec::new(), element: PhantomData }
    }
}

impl<E> Written<E> {
    /// Sets a field. A second value of the same field replaces the first.
    pub(crate) fn with(mut self, field: &'static str, value: Value) -> Self {
        self.fields.retain(|(name, _)| *name != field);
        self.fields.push((field, value));
        self
    }

    /// The fields that were set.
    pub(crate) fn into_fields(self) -> Vec<(&'static str, Value)> {
        self.fields
    }
}

/// Rust type of the argument for a kind of field: numbers, a flag, or otherwise a name or word.
macro_rules! argument {
    (number) => {
        $crate::elements::Number
    };
    (law) => {
        $crate::elements::Number
    };
    (optional_number) => {
        $crate::elements::Number
    };
    (optional_law) => {
        $crate::elements::Number
    };
    (pair) => {
        $crate::elements::Pair
    };
    (optional_pair) => {
        $crate::elements::Pair
    };
    (law_pair) => {
        $crate::elements::Pair
    };
    (triple) => {
        $crate::elements::Numbers
    };
    (laws) => {
        $crate::elements::Numbers
    };
    (units) => {
        $crate::elements::Words
    };
    (terms) => {
        $crate::elements::Terms
    };
    (flag) => {
        bool
    };
    ($name:ident) => {
        String
    };
}
pub(crate) use argument;

/// Declares an element by [`element!`](crate::element) and the methods of its [`Written`] form.
///
/// This macro declares the elements of this crate. Elements of other crates are declared by
/// [`element!`](crate::element), because only this crate can add methods to [`Written`].
macro_rules! declare {
    ($(#[doc = $doc:literal])* $Name:ident, $name:literal {
        $($(#[doc = $about:literal])* $field:ident : $kind:ident $([$($unit:tt)*])? $(= $default:expr)?),+ $(,)?
    }) => {
        $crate::element! {
            $(#[doc = $doc])* $Name, $name {
                $($(#[doc = $about])* $field : $kind $([$($unit)*])? $(= $default)?),+
            }
        }

        impl $Name {
            #[doc = concat!("A `", $name, "` as written in a model, without fields so far.")]
            pub fn written() -> $crate::elements::Written<Self> {
                $crate::elements::Written::default()
            }
        }

        impl $crate::elements::Written<$Name> {
            $(
                $(#[doc = $about])*
                $(#[doc = concat!("\n\nUnit: ", stringify!($($unit)*), ".")])?
                $(#[doc = concat!("\n\nDefault: `", stringify!($default), "`.")])?
                pub fn $field(
                    self,
                    $field: impl Into<$crate::elements::argument!($kind)>,
                ) -> Self {
                    let value: $crate::elements::argument!($kind) = $field.into();
                    self.with($crate::elements::plain(stringify!($field)), value.into())
                }
            )+
        }
    };
}
pub(crate) use declare;
