//! Tables: values and derivatives, faults, and calls in formulas.

use super::PARAMETERS;
use kempe::expression::unit::Dimension;
use kempe::expression::{
    Expression, ExpressionError, FormulaValues, Inferred, Names, Outside, Points, Symbol, Table,
    TableError,
};
use kempe::math::{Dual, Interpolation, Jet, Lanes};
use kempe::symbolic::{record, Form};
use std::sync::Arc;

const X: [f64; 6] = [0.0, 0.4, 1.1, 1.5, 2.7, 3.0];
const Y: [f64; 6] = [0.2, -0.3, 0.5, 0.9, 0.4, 0.7];
/// The same with equal ends.
const CLOSED: [f64; 6] = [0.2, -0.3, 0.5, 0.9, 0.4, 0.2];

fn points<'a>(x: &'a [f64], y: &'a [f64]) -> Points<'a> {
    Points {
        x,
        y,
        x_unit: None,
        y_unit: None,
        interpolation: Interpolation::Cubic,
        periodic: false,
        outside: Outside::Refuse,
    }
}

fn table(points: &Points) -> Table {
    Table::new("lift", points).unwrap()
}

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= tolerance * (1.0 + expected.abs()), "{what}: {found}, expected {expected}");
}

fn jet(table: &Table, x: f64) -> [f64; 3] {
    let found: Jet = table.value(Jet::new(x, 1.0, 0.0));
    [found.value, found.rate, found.second]
}

/// Values of SciPy 1.17 (CubicSpline with natural and periodic ends, make_interp_spline with k = 5 and third and
/// fourth derivative 0 or periodic, PchipInterpolator) at 0.1, 0.9, 1.3 and 2.9, each with two derivatives.
#[test]
fn curves_are_those_of_scipy() {
    const AT: [f64; 4] = [0.1, 0.9, 1.3, 2.9];
    let cubic = [
        [0.030402874564459937, -1.6365084204413474, 1.7838850174216017],
        [0.17326068406456657, 1.6528684017160868, 0.6703121666785172],
        [0.7600904678944749, 1.0362914800066372, -3.0045233947237424],
        [0.5801304868831, 1.1490213483767493, 1.4902134837674916],
    ];
    let quintic = [
        [-0.01764985492318785, -1.8628643416572561, 6.265571028780398],
        [0.1875292295695788, 1.5795242769288775, 0.5525915241193202],
        [0.7551186815831568, 1.0300890020729068, -2.829543061562737],
        [0.5591129769087035, 1.2024702340959954, 4.1214503318043825],
    ];
    let monotone = [
        [0.002617694805194796, -1.8037743506493507, 3.875811688311689],
        [0.23321156345498617, 1.5076047630756262, -0.736239418314657],
        [0.753012048192771, 1.2349397590361448, -2.6506024096385543],
        [0.565185185185185, 1.3333333333333337, 1.8888888888889],
    ];
    let periodic_cubic = [
        [0.06801633275261323, -1.4634179732868755, -1.7592247386759574],
        [0.16640953210552512, 1.714247843039655, 0.5623792931806877],
        [0.7527322735191637, 1.004099666085947, -2.6366136759581877],
        [0.29003133952768106, -0.7144909988385597, -3.0264576074332137],
    ];
    let periodic_quintic = [
        [0.07138623605883576, -1.40200351950177, -1.6330332458800607],
        [0.12719555989843107, 1.895407485338089, 1.0532662537732065],
        [0.77592707016193, 1.0085292640897856, -3.947124445063489],
        [0.29674140372114455, -0.7918328598475276, -3.4185249095298573],
    ];
    for (interpolation, y, periodic, expected) in [
        (Interpolation::Cubic, Y, false, cubic),
        (Interpolation::Quintic, Y, false, quintic),
        (Interpolation::Monotone, Y, false, monotone),
        (Interpolation::Cubic, CLOSED, true, periodic_cubic),
        (Interpolation::Quintic, CLOSED, true, periodic_quintic),
    ] {
        let table = table(&Points { interpolation, periodic, ..points(&X, &y) });
        for (x, expected) in AT.into_iter().zip(expected) {
            let shifts: &[f64] = if periodic { &[0.0, 3.0, -6.0] } else { &[0.0] };
            for shift in shifts {
                let found = jet(&table, x + shift);
                for n in 0..3 {
                    close(found[n], expected[n], 1e-12, &format!("{interpolation:?} {n} at {x}"));
                    close(table.derivative(n, x + shift), expected[n], 1e-12, "derivative");
                }
            }
        }
        X.iter().zip(y).for_each(|(x, y)| close(table.value(*x), y, 1e-14, "at a point"));
    }
    let linear = table(&Points { interpolation: Interpolation::Linear, ..points(&X, &Y) });
    let [value, slope, bend] = jet(&linear, 0.9);
    close(value, -0.3 + 0.8 * 0.5 / 0.7, 1e-15, "line");
    close(slope, 0.8 / 0.7, 1e-15, "slope of a line");
    assert_eq!(bend, 0.0);
}

#[test]
fn units_scale_points_and_their_slopes() {
    let (x, y) = ([0.0, 90.0, 180.0, 270.0, 360.0], [0.0, 10.0, 20.0, 10.0, 0.0]);
    let written = Points { x_unit: Some("deg"), y_unit: Some("mm"), ..points(&x, &y) };
    let table = table(&Points { periodic: true, ..written });
    let half = std::f64::consts::PI;
    close(table.value(half), 0.02, 1e-15, "lift at 180°");
    close(table.value(half / 4.0), 0.01 * table_in_units(&x, &y, 45.0) / 10.0, 1e-14, "at 45°");
    assert_eq!(table.period(), Some(2.0 * half));
    assert_eq!(table.x_dimension(), Some(Dimension::new(0, 0, 0)));
    assert_eq!(table.y_dimension(), Some(Dimension::new(1, 0, 0)));
}

fn table_in_units(x: &[f64], y: &[f64], at: f64) -> f64 {
    table(&Points { periodic: true, ..points(x, y) }).value(at)
}

#[test]
fn outside_is_refused_held_or_continued() {
    let of = |outside| table(&Points { outside, ..points(&X, &Y) });
    let (first, last) = (jet(&of(Outside::Refuse), 0.0), jet(&of(Outside::Refuse), 3.0));
    for (x, end, at) in [(-0.5, first, 0.0), (3.25, last, 3.0)] {
        assert!(of(Outside::Refuse).value(x).is_nan());
        assert_eq!(jet(&of(Outside::Hold), x), [end[0], 0.0, 0.0]);
        let [value, slope, second] = jet(&of(Outside::Linear), x);
        close(value, end[0] + end[1] * (x - at), 1e-15, "tangent");
        assert_eq!([slope, second], [end[1], 0.0]);
        assert_eq!(of(Outside::Linear).derivative(1, x), end[1]);
        assert_eq!(of(Outside::Hold).derivative(1, x), 0.0);
    }
    // rounding of an angle at the end is not outside
    assert!(of(Outside::Refuse).value(3.0 + 1e-12).is_finite());
    assert!(of(Outside::Refuse).value(3.0 + 1e-6).is_nan());
    assert!(of(Outside::Hold).value(f64::NAN).is_nan());
    let refusal = of(Outside::Refuse).refusal(3.25).unwrap();
    assert_eq!(refusal, "table 'lift' is read at x = 3.25, outside its range from 0 to 3");
    assert_eq!(of(Outside::Refuse).refusal(2.0), None);
}

#[test]
fn derivatives_hold_on_every_scalar() {
    for outside in [Outside::Hold, Outside::Linear] {
        for interpolation in Interpolation::ALL {
            let table = table(&Points { interpolation, outside, ..points(&X, &Y) });
            let xs = [-0.3, 0.2, 1.2, 3.4];
            let lanes = table.value(Lanes::new(xs)).to_array();
            for (x, lane) in xs.into_iter().zip(lanes) {
                assert_eq!(lane.to_bits(), table.value(x).to_bits());
                let h = 1e-6;
                let slope = (table.value(x + h) - table.value(x - h)) / (2.0 * h);
                let dual: Dual<3> = table.value(Dual::variable(x, 0));
                close(dual.slope[0], slope, 1e-8, &format!("{interpolation:?} at {x}"));
                let bend = (jet(&table, x + h)[1] - jet(&table, x - h)[1]) / (2.0 * h);
                close(jet(&table, x)[2], bend, 1e-7, &format!("{interpolation:?} at {x}"));
            }
        }
    }
}

#[test]
fn kinks_are_the_places_that_are_not_smooth() {
    let of = |interpolation, periodic, outside, y: &[f64; 6]| {
        let table = table(&Points { interpolation, periodic, outside, ..points(&X, y) });
        let kinks = table.kinks();
        (kinks.iter().map(|kink| kink.x).collect::<Vec<_>>(), kinks.first().map(|kink| kink.order))
    };
    let (inner, seam) = (X[1..5].to_vec(), X[..5].to_vec());
    let none = (Vec::new(), None);
    assert_eq!(of(Interpolation::Linear, false, Outside::Refuse, &Y), (inner.clone(), Some(1)));
    assert_eq!(of(Interpolation::Monotone, false, Outside::Refuse, &Y), (inner, Some(2)));
    assert_eq!(of(Interpolation::Monotone, true, Outside::Refuse, &CLOSED), (seam, Some(2)));
    assert_eq!(of(Interpolation::Cubic, false, Outside::Refuse, &Y), none);
    assert_eq!(of(Interpolation::Quintic, true, Outside::Refuse, &CLOSED), none);
    let ends = vec![0.0, 3.0];
    assert_eq!(of(Interpolation::Cubic, false, Outside::Hold, &Y), (ends.clone(), Some(1)));
    assert_eq!(of(Interpolation::Quintic, false, Outside::Linear, &Y), (ends, Some(2)));
}

#[track_caller]
fn fails(points: &Points, field: &str, entry: Option<usize>, text: &str) {
    let TableError { field: at, entry: k, message, hint } = Table::new("lift", points).unwrap_err();
    assert_eq!((at, k), (field, entry), "{message}");
    let whole = format!("{message}; {}", hint.unwrap_or_default());
    assert_eq!(whole, text);
}

#[test]
fn faults_name_the_entry_and_a_remedy() {
    let x = [0.0, 1.0, 3.0, 2.0];
    let y = [0.0, 1.0, 0.0, 1.0];
    let sort = "x[3] = 2 does not exceed x[2] = 3; sort the points by x";
    fails(&points(&x, &y), "x", Some(3), sort);
    let twice = "x[1] = 0 does not exceed x[0] = 0; remove one of the two points";
    fails(&points(&[0.0, 0.0, 1.0], &[0.0; 3]), "x", Some(1), twice);
    fails(&points(&x, &y[..3]), "y", None, "3 numbers, but x has 4; give one y for each x");
    let few = "2 points; the interpolation quintic needs at least 3; give more points, or choose another interpolation";
    let quintic = Interpolation::Quintic;
    fails(&Points { interpolation: quintic, ..points(&X[..2], &Y[..2]) }, "x", None, few);
    let few = "3 points; the interpolation periodic cubic needs at least 4; give more points, or choose another interpolation";
    fails(&Points { periodic: true, ..points(&X[..3], &Y[..3]) }, "x", None, few);
    let open = "y[5] = 0.7 is not y[0] = 0.2, as a period needs; repeat the first y at the end of the period, or remove periodic";
    fails(&Points { periodic: true, ..points(&X, &Y) }, "y", Some(5), open);
    let nan = "y[1] is NaN; must be a finite number; remove this point";
    fails(&points(&X[..3], &[0.0, f64::NAN, 1.0]), "y", Some(1), nan);
    let unit = Points { x_unit: Some("degree"), ..points(&X, &Y) };
    fails(&unit, "x_unit", None, "unknown unit 'degree'; write 'deg'");
    let fault = Table::new("lift", &points(&[0.0, 1e-300, 1.0], &[0.0, 1.0, 0.0])).unwrap_err();
    assert!(fault.message.ends_with("are too close or too far apart"), "{}", fault.message);
}

/// Parameters a to d and the time, and the tables `lift` (deg → mm) and `gain`.
struct WithTables(Vec<Arc<Table>>);

impl Names for WithTables {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        PARAMETERS.as_slice().resolve(name).or((name == "t").then_some(Symbol::Time))
    }
    fn known(&self) -> Vec<String> {
        PARAMETERS.map(String::from).to_vec()
    }
    fn tables(&self) -> &[Arc<Table>] {
        &self.0
    }
}

fn names() -> WithTables {
    let written = Points { x_unit: Some("deg"), y_unit: Some("mm"), ..points(&X, &Y) };
    let hold = Points { outside: Outside::Hold, ..points(&X, &Y) };
    let gain = Table::new("gain", &hold).unwrap();
    WithTables(vec![Arc::new(table(&written)), Arc::new(gain)])
}

fn error(text: &str) -> ExpressionError {
    Expression::parse(text).and_then(|e| e.compile(&names())).unwrap_err()
}

#[test]
fn formulas_call_tables() {
    let names = names();
    let [lift, gain] = [0, 1].map(|k| Arc::clone(&names.0[k]));
    let e = Expression::parse("2*gain(a - t) + lift( 1.3*deg )/gain(a)").unwrap();
    assert_eq!(e.to_string(), "2*gain(a-t)+lift(1.3*deg)/gain(a)");
    let tape = e.compile(&names).unwrap();
    let scope = FormulaValues { parameters: &[2.0, 0.0, 0.0, 0.0], time: 0.75, variables: &[] };
    let expected = 2.0 * gain.value(1.25) + lift.value(1.3_f64.to_radians()) / gain.value(2.0);
    close(tape.evaluate(&scope), expected, 1e-15, "value");
    // at a place that varies, gain is read once; a constant is folded
    assert_eq!(tape.tables(), [&gain]);
    assert_eq!(
        Expression::parse("gain(0.9)").unwrap().compile(&names).unwrap().constant(),
        Some(gain.value(0.9))
    );
    let tape = Expression::parse("lift(t)").unwrap().compile(&names).unwrap();
    let late = FormulaValues { parameters: &[], time: 1.0, variables: &[] };
    let refusal = "table 'lift' is read at x = 57.29577951 deg, outside its range from 0 to 3 deg";
    assert_eq!(tape.refusal(&late).as_deref(), Some(refusal));
}

#[test]
fn wrong_calls_are_refused() {
    assert_eq!(error("lift(1, 2)").to_string(), "lift takes 1 argument, got 2; write lift(x)");
    assert_eq!(error("1 + lifd(t)").to_string(), "unknown function 'lifd'; did you mean 'lift'?");
    assert_eq!(error("1 + lifd (t)").span, 4..8);
    let outside = error("lift(1)");
    assert!(outside.message.starts_with("table 'lift' is read at x = 57.29577951 deg, outside"));
    assert!(outside.hint.unwrap().contains("outside = \"hold\""));
    assert_eq!(error("lift + 1").message, "unknown name 'lift'");
}

#[test]
fn tables_have_dimensions() {
    let length = Inferred::Of(Dimension::new(1, 0, 0));
    let infer =
        |text: &str, of: Inferred| Expression::parse(text).unwrap().infer(&names(), &|_| of);
    assert_eq!(infer("lift(t)", Inferred::Open).unwrap(), length);
    assert_eq!(infer("2*lift(1*deg)", Inferred::Open).unwrap(), length);
    assert_eq!(infer("gain(t)", length).unwrap(), Inferred::Open);
    let fault = infer("lift(a)", length).unwrap_err();
    let text = "'a' is in m, but lift(x) needs rad; x_unit of table 'lift' must fit";
    assert_eq!(fault.to_string(), text);
}

#[test]
fn printed_equations_have_the_name_of_the_table_and_its_derivatives() {
    let table = table(&points(&X, &Y));
    let [unicode, latex] = [Form::Unicode, Form::Latex].map(|form| {
        record(|record| {
            let t = record.time();
            let phi = t - table.value(t + t);
            let found = record.differentiate(&[phi], &[t]);
            let write = |x| record.write(x, form);
            [write(found.residual[0]), write(found.jacobian[0][0]), write(found.gamma[0])]
        })
    });
    assert_eq!(unicode, ["t − lift(2·t)", "1 − 2·lift'(2·t)", "4·lift''(2·t)"]);
    assert_eq!(latex[2], "4 \\, \\text{lift}''\\left(2 \\, t\\right)");
}
