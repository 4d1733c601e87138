//! Which options the analyses have, as data: for the reader of files, the schema, Python and docs.

use crate::elements::{Default, Field, Shape, Table};
use std::sync::LazyLock;

/// One set of options of a family.
#[derive(Clone, Debug)]
pub struct Options {
    /// Name of the class in Python.
    pub class: &'static str,
    /// The `type` in the file, and the options.
    pub table: Table,
}

/// Sets of options of which an analysis takes one, such as the methods of integration.
#[derive(Clone, Debug)]
pub struct Family {
    /// The name by which [`Shape::Options`] refers to it.
    pub name: &'static str,
    /// The sets to choose from.
    pub options: Vec<Options>,
}

// made once: every simulation that is asked for is checked by them
static ANALYSES: LazyLock<Vec<Table>> = LazyLock::new(|| vec![dynamics()]);
static FAMILIES: LazyLock<Vec<Family>> = LazyLock::new(|| {
    let methods = vec![rk45(), dop853(), rk4(), generalized_alpha(), hht(), radau(), auto()];
    let stabilizations = vec![baumgarte(), projection(), none()];
    vec![
        Family { name: "method", options: methods },
        Family { name: "stabilization", options: stabilizations },
    ]
});

/// The analyses, by the `type` in the file.
pub fn analysis_tables() -> &'static [Table] {
    &ANALYSES
}

/// The families of options that analyses refer to.
pub fn option_families() -> &'static [Family] {
    &FAMILIES
}

fn number(name: &'static str, unit: &str, default: impl Into<Default>, doc: &str) -> Field {
    Field::optional(name, Shape::Number, unit, default.into(), doc)
}

fn dynamics() -> Table {
    let mut fields = vec![
        Field::required("t_end", Shape::Number, "s", "Time at which the simulation ends."),
        number(
            "t_start",
            "s",
            Default::Absent,
            "Time at which it starts; else that of the state it starts from.",
        ),
    ];
    fields.extend(output_fields());
    fields.extend([
        Field::optional("method", Shape::Options("method"), "", Default::Type("auto"), "Method of integration."),
        Field::optional(
            "stabilization",
            Shape::Options("stabilization"),
            "",
            Default::Type("projection"),
            "What keeps the constraints from drifting.",
        ),
        Field::optional(
            "singularity",
            Shape::Word(&["stop", "pass"]),
            "",
            Default::Absent,
            "At a singular position where the motion does not decide how it goes on: \"stop\" with an error, as without this option, or \"pass\" on.",
        ),
        Field::optional("max_steps", Shape::Count, "", Default::Absent, "Most steps before the solver gives up; if steps of bounded length cannot get to t_end with so many, at once. Else 1 000 000 over the number of moving bodies, at least 50 000."),
        Field::optional(
            "from",
            Shape::Name,
            "",
            Default::Absent,
            "Where it starts: \"start\" or the name of an earlier analysis; else where the analysis before it ended.",
        ),
    ]);
    Table {
        name: "dynamics",
        doc: "Motion under forces, by integration of the equations of motion.".to_string(),
        fields,
    }
}

fn output_fields() -> [Field; 3] {
    [
        number(
            "output_step",
            "s",
            Default::Absent,
            "Time between the reported states; if absent, the steps of the solver are reported.",
        ),
        Field::optional(
            "output",
            Shape::Word(&["steps"]),
            "",
            Default::Absent,
            "\"steps\" says that the steps of the solver are reported; not together with output_step.",
        ),
        Field::optional(
            "dense_output",
            Shape::Flag,
            "",
            Default::Flag(true),
            "Whether the solution can be evaluated at any time.",
        ),
    ]
}

/// Options of every explicit method with step control, and of the automatic choice.
fn adaptive(
    class: &'static str,
    name: &'static str,
    (rtol, atol): (f64, f64),
    doc: &str,
) -> Options {
    let fields = vec![
        number("rtol", "", rtol, "Relative tolerance of one step."),
        number("atol", "", atol, "Absolute tolerance of one step, in the units of the state."),
        number(
            "step",
            "s",
            Default::Absent,
            "Constant step, whatever the tolerances say, without first_step and max_step; else it is controlled.",
        ),
        number("first_step", "s", Default::Absent, "First step; else the solver chooses it."),
        number("max_step", "s", Default::Absent, "Largest step; else without limit."),
    ];
    Options { class, table: Table { name, doc: doc.to_string(), fields } }
}

fn rk45() -> Options {
    let doc = "Explicit Runge-Kutta method of order 5(4) of Dormand and Prince (1980), with step control.";
    adaptive("RK45", "rk45", (1e-6, 1e-9), doc)
}

fn dop853() -> Options {
    let doc =
        "Explicit Runge-Kutta method of order 8(5,3) of Dormand and Prince, with step control: \
               for tolerances below about 1e-6 and smooth forces.";
    adaptive("DOP853", "dop853", (1e-6, 1e-9), doc)
}

fn auto() -> Options {
    let doc = "DOP853, and Radau where a damped motion far faster than what moves makes the model stiff, judged at the \
               start and by the steps on the way; the statistics tell which, and why.";
    let mut options = adaptive("Auto", "auto", (1e-8, 1e-11), doc);
    options.table.fields.retain(|field| field.name != "step"); // there is nothing to choose with it
    options
}

fn rk4() -> Options {
    let fields = vec![Field::required("step", Shape::Number, "s", "Step.")];
    let doc = "Classical Runge-Kutta method of order 4 with a constant step.";
    Options { class: "RK4", table: Table { name: "rk4", doc: doc.to_string(), fields } }
}

/// Options of an implicit method, `own` first; `rtol` and `atol` as docs tell them.
fn implicit(
    class: &'static str,
    name: &'static str,
    own: Option<Field>,
    [rtol, atol]: [&str; 2],
    doc: &str,
) -> Options {
    let tolerance = |what: &str, usual: &str, tight: &str| {
        format!("{what} tolerance of one step, {usual} if absent; with step that of Newton's iteration, {tight}.")
    };
    let mut fields: Vec<Field> = own.into_iter().collect();
    fields.extend([
        number("rtol", "", Default::Absent, &tolerance("Relative", rtol, "1e-10")),
        number("atol", "", Default::Absent, &tolerance("Absolute", atol, "1e-12")),
        number(
            "step",
            "s",
            Default::Absent,
            "Constant step, without control of the error; else the solver chooses its steps.",
        ),
        number(
            "first_step",
            "s",
            Default::Absent,
            "First step; else the solver chooses it; not together with step.",
        ),
        number(
            "max_step",
            "s",
            Default::Absent,
            "Largest step; else without limit; not together with step.",
        ),
    ]);
    Options { class, table: Table { name, doc: doc.to_string(), fields } }
}

fn generalized_alpha() -> Options {
    let doc =
        "Implicit generalized-alpha method of order 2 (Chung and Hulbert 1993) at index 3 (Arnold \
               and Bruels 2007): for stiff forces and moderate accuracy.";
    let rho = number("rho", "", 0.8, "Spectral radius at infinite frequency, in [0, 1): the smaller, the more high frequencies are damped.");
    implicit("GeneralizedAlpha", "generalized_alpha", Some(rho), ["1e-4", "1e-7"], doc)
}

fn hht() -> Options {
    let doc = "Implicit method of order 2 of Hilber, Hughes and Taylor (1977), a case of generalized-alpha, \
               at index 3.";
    let alpha = number(
        "alpha",
        "",
        -0.1,
        "In [-1/3, 0): the smaller, the more high frequencies are damped.",
    );
    implicit("HHT", "hht", Some(alpha), ["1e-4", "1e-7"], doc)
}

fn radau() -> Options {
    let doc = "Implicit Radau IIA method of order 5 at index 2 (Hairer and Wanner 1996), with step control: \
               for stiff forces.";
    implicit("Radau", "radau", None, ["1e-6", "1e-9"], doc)
}

fn baumgarte() -> Options {
    let fields = vec![
        number(
            "alpha",
            "1/s",
            Default::Absent,
            "Factor of the rate of the constraints, as 2 alpha; 10 if absent.",
        ),
        number("beta", "1/s", Default::Absent, "Factor of the constraints, as beta^2; 200 if absent."),
        Field::optional(
            "gains",
            Shape::Word(&["step"]),
            "",
            Default::Absent,
            "\"step\" takes them from each step that is tried, alpha = 7/(12 h) and beta = 1/(sqrt(3) h), and holds the term over it; not together with alpha and beta.",
        ),
    ];
    let doc = "Stabilization of Baumgarte (Haug 7.3.8) for explicit methods: gamma - 2 alpha (Phi_q v + Phi_t) - beta^2 Phi.";
    Options { class: "Baumgarte", table: Table { name: "baumgarte", doc: doc.to_string(), fields } }
}

fn projection() -> Options {
    let doc = "Residual that is left, relative to the size of the mechanism; of angles in rad.";
    let fields = vec![number("tolerance", "", 1e-12, doc)];
    let doc = "Projection of accepted and reported states onto the constraints (Eich 1993).";
    let table = Table { name: "projection", doc: doc.to_string(), fields };
    Options { class: "Projection", table }
}

fn none() -> Options {
    let doc = "No stabilization: the constraints drift with the error of integration.";
    let table = Table { name: "none", doc: doc.to_string(), fields: Vec::new() };
    Options { class: "NoStabilization", table }
}
