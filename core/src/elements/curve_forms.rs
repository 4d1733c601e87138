//! The forms in which a curve is written, as data: for the reader, the schema and Python.

/// One form of a curve.
#[derive(Clone, Copy, Debug)]
pub struct CurveForm {
    /// The keys that make the form; all are required.
    pub keys: &'static [&'static str],
    /// Optional keys of the form.
    pub more: &'static [&'static str],
    /// The description of the form.
    pub words: &'static str,
}

/// All forms.
pub const CURVE_FORMS: &[CurveForm] = &[
    CurveForm { keys: &["x", "y", "range"], more: &["periodic"], words: "x, y and range" },
    CurveForm { keys: &["polar"], more: &[], words: "polar" },
    CurveForm { keys: &["points"], more: &["periodic", "interpolation"], words: "points" },
    CurveForm { keys: &["circle"], more: &[], words: "circle" },
    CurveForm { keys: &["line"], more: &[], words: "line" },
    CurveForm { keys: &["polygon"], more: &[], words: "polygon" },
];
