//! Curves that cannot carry a joint, and faults of their definition.

use crate::mechanisms::faults;

/// Builds a joint on a curve; the faults contain the words, or there are none.
fn refuses(curve: &str, joint: &str, words: &[&str]) {
    let text = format!(
        r#"
[bodies.ground]
points = {{ O = [0, 0] }}
[bodies.cam]
mass = 1
inertia = 1
points = {{ O = [0, 0] }}
curves = {{ rim = {curve} }}
[joints.contact]
i = "ground.O"
curve = "cam.rim"
{joint}
"#
    );
    let found = faults(&text);
    for word in words {
        assert!(found.contains(word), "{curve}, {joint}: {found:?} lacks {word:?}");
    }
    assert!(!words.is_empty() || found.is_empty(), "{found}");
}

const POINT: &str = "type = \"point_on_curve\"";
const FLAT: &str = "type = \"flat_on_curve\"";

/// Each refusal names the curve, the place and the number.
#[test]
fn impossible_curves_are_refused() {
    let roller =
        |r: f64, side: &str| format!("type = \"roller_on_curve\"\nradius = {r}\nside = \"{side}\"");
    let circle = "{ circle = [0, 0, 0.05] }";
    refuses(circle, POINT, &[]);
    refuses(circle, &roller(0.2, "right"), &[]);
    refuses(circle, &roller(0.04, "left"), &[]);
    refuses(circle, &roller(0.05, "left"), &["contact.radius", "undercut", "0.05"]);
    let kidney = "{ polar = \"0.05 + 0.02*cos(2*u)\" }";
    // κ = (r - r″)/r² = -55.6 1/m at u = 90°, with r = 0.03 m and r″ = 0.08 m
    refuses(kidney, &roller(0.01, "right"), &[]);
    refuses(kidney, &roller(0.02, "right"), &["undercut", "0.018000", "(0.000000, 0.030000)"]);
    refuses(
        kidney,
        FLAT,
        &["contact.curve", "not strictly convex", "-55.5", "(0.000000, 0.030000)"],
    );
    refuses("{ line = [[0, 0], [1, 0]] }", FLAT, &["not strictly convex"]);
    let cusp = "{ x = \"u^2\", y = \"u^3\", range = [-1, 1] }";
    refuses(cusp, POINT, &["contact.curve", "cusp", "(0.000000, 0.000000)"]);
    refuses(
        "{ points = [[0, 0], [1, 0], [1, 1]], interpolation = \"linear\" }",
        POINT,
        &["corners"],
    );
}

/// Faults of the curve itself, at the curve.
#[test]
fn faulty_curves_are_refused() {
    refuses("{ circle = [0, 0, -1] }", POINT, &["bodies.cam.curves.rim.circle", "-1"]);
    refuses("{ circle = [0, 0] }", POINT, &["must hold 3"]);
    refuses(
        "{ points = [[0, 0], [1, 0]] }",
        POINT,
        &["bodies.cam.curves.rim.points", "at least 3"],
    );
    refuses("{ points = [[0, 0], [1, 0], [1, 0], [2, 3]] }", POINT, &["points 2 and 3"]);
    let closed = "{ points = [[0, 0], [1, 0], [1, 1], [0, 0]], periodic = true }";
    refuses(closed, POINT, &["repeats the first"]);
    refuses("{ circle = [0, 0, 1], polar = \"1\" }", POINT, &["both polar and circle"]);
    refuses("{ x = \"u\", range = [0, 1] }", POINT, &["'y' is missing"]);
    refuses("{ x = \"u\", y = \"0\", range = [1, 0] }", POINT, &["range", "increase"]);
    refuses("{ polar = \"r*2\" }", POINT, &["polar", "'r'"]);
    refuses("{ polar = \"0.1 + t\" }", POINT, &["polar", "time t"]);
    let open = "{ x = \"u\", y = \"u^2\", range = [0, 1], periodic = true }";
    refuses(open, POINT, &["periodic", "apart"]);
    // a unit circle with a gap of 2e-6 m, and one whose derivative turns by about 1e-5 rad
    let circle = |y: &str| {
        let range = "range = [0, 6.283185307179586], periodic = true";
        format!("{{ x = \"cos(u)\", y = \"{y}\", {range} }}")
    };
    refuses(&circle("sin(u)"), POINT, &[]);
    let gap = "sin(u) + 2e-6*u/6.283185307179586";
    refuses(&circle(gap), POINT, &["periodic", "the ends are 2.000e-6 m apart"]);
    let corner = "sin(u) + 1e-6*u*(u - 6.283185307179586)";
    refuses(&circle(corner), POINT, &["periodic", "a corner where it closes itself"]);
    let wrong = faults(
        "[bodies.b]\nmass = 1\ninertia = 1\npoints = { P = [0, 0] }\n[bodies.ground]\ncurves = { rim = { circle = \
         [0, 0, 1] } }\n[joints.c]\ntype = \"point_on_curve\"\ni = \"b.P\"\ncurve = \"ground.rin\"\n",
    );
    assert!(wrong.contains("no curve 'rin'") && wrong.contains("did you mean 'rim'"), "{wrong}");
}

/// A cusp is judged by the size of the curve.
#[test]
fn small_curves_without_a_cusp_are_accepted() {
    for size in ["1e-4", "1e4"] {
        let oval = |least: &str| {
            format!("{{ x = \"{size}*cos(u)\", y = \"{size}*{least}*sin(u)\", range = [0, \"2*pi\"], periodic = true }}")
        };
        refuses(&oval("0.01"), POINT, &[]);
        refuses(&oval("1e-8"), POINT, &["a cusp"]);
    }
}

/// Parts of a formula must meet with one derivative, at conditions inside the range too.
#[test]
fn corners_and_gaps_of_formulas_are_refused_with_their_place() {
    let corner = |law: &str, place: &str| {
        refuses(law, POINT, &["contact.curve", "a corner", place, "C' jumps"]);
        refuses(law, FLAT, &["a corner", place]);
    };
    // r' changes by 0.02 m where the sine changes its sign
    corner("{ polar = \"0.05 + 0.01*abs(sin(u - 1))\" }", "u = 1.000000 at (0.027015, 0.042074)");
    corner("{ polar = \"0.05 + max(0, 0.01*sin(u - 1))\" }", "u = 1.000000");
    corner(
        "{ x = \"u\", y = \"if(u < 0.25, 0, u - 0.25)\", range = [0, 1] }",
        "(0.250000, 0.000000)",
    );
    corner("{ x = \"u\", y = \"min(u, 2*u - 0.3)\", range = [0, 1] }", "(0.300000, 0.300000)");
    // one direction on both sides, but u runs twice as fast
    corner("{ x = \"if(u < 0.5, u, 2*u - 0.5)\", y = \"0\", range = [0, 1] }", "u = 0.500000");
    for law in ["if(u < 2, 0.05, if(u < 4, 0.051, 0.05))", "0.05 + 0.001*floor(cos(u - 2))"] {
        refuses(&format!("{{ polar = \"{law}\" }}"), POINT, &["a gap of 1.000e-3 m", "u = "]);
    }
    for smooth in
        ["abs(sin(u - 1))^3", "max(0, sin(u - 1))^2", "(harmonic(u - 1) - harmonic(u - 4))"]
    {
        refuses(&format!("{{ polar = \"0.05 + 0.001*{smooth}\" }}"), POINT, &[]);
    }
    // the corner is an end of the curve, up to rounding errors
    for range in ["0.2499999999999, 1", "-1, 0.2500000000001"] {
        let law = "x = \"u\", y = \"if(u < 0.25, 0, u - 0.25)\"";
        refuses(&format!("{{ {law}, range = [{range}] }}"), POINT, &[]);
    }
    // a sharp bend is not a corner
    refuses("{ x = \"u\", y = \"if(u < 0, 0, 5e4*u^2)\", range = [-1, 1] }", POINT, &[]);
}

#[test]
fn corners_of_linear_tables_are_refused() {
    let with = |kind: &str| {
        let tables =
            format!("[tables.lift]\nx = [0, 2, 4]\ny = [0, 0.01, 0]\ninterpolation = \"{kind}\"\n");
        let curve = "{ x = \"u\", y = \"lift(u)\", range = [0, 4] }";
        faults(&format!(
            "{tables}[bodies.ground]\npoints = {{ O = [0, 0] }}\ncurves = {{ wire = {curve} }}\n[bodies.b]\nmass = 1\n\
             inertia = 1\npoints = {{ P = [0, 0] }}\n[joints.c]\ntype = \"point_on_curve\"\ni = \"b.P\"\ncurve = \"ground.wire\"\n"
        ))
    };
    assert!(
        with("linear").contains("a corner for u = 2.000000 at (2.000000, 0.010000) m"),
        "{}",
        with("linear")
    );
    assert_eq!(with("cubic"), "");
    assert_eq!(with("monotone"), "");
}
