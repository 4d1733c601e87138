//! Broken files: each fault is reported with its place, a description and a remedy.

use kempe::case::{self, Diagnostic, Format};

/// Text after the first line `kempe = 1`, line and column of a fault, parts of the displayed text.
type Row = (&'static str, usize, usize, &'static str, &'static str);

const TOML: &[Row] = &[
    // sections
    ("[body.a]\n", 2, 2, "body: unknown key 'body'", "hint: did you mean 'bodies'?"),
    ("[joint.a]\n", 2, 2, "unknown key 'joint'", "did you mean 'joints'?"),
    ("[param]\na = 1\n", 2, 2, "unknown key 'param'", "did you mean 'parameters'?"),
    ("gravty = [0, 1]\n", 2, 1, "unknown key 'gravty'", "did you mean 'gravity'?"),
    ("wheels = 4\n", 2, 1, "unknown key 'wheels'", "it may have kempe, title"),
    ("title = 3\n", 2, 9, "title: a number; must be a text", ""),
    ("gravity = 9.81\n", 2, 11, "a number; must be a list of two numbers [x, y]", ""),
    ("gravity = [0, 0, -9.81]\n", 2, 11, "a list of 3; must be a list of two numbers", ""),
    ("gravity = [0, true]\n", 2, 15, "gravity.1: true or false; must be a number", ""),
    ("parameters = [1]\n", 2, 14, "a list; must be a table of names and numbers", ""),
    ("[[joints]]\ntype = \"revolute\"\n", 2, 1, "a list; must be a table", "write [joints.NAME]"),
    ("[joints]\nA = 3\n", 3, 5, "joints.A: a number; must be a table with fields", ""),
    // names
    ("[parameters]\npi = 3\n", 3, 1, "'pi' is reserved", "take another name"),
    ("[parameters]\n'a.b' = 3\n", 3, 1, "must not contain '.'", ""),
    ("[parameters]\n\"\" = 3\n", 3, 1, "parameters.\"\": a name must not be empty", ""),
    ("[joints.ground]\ntype = 'revolute'\ni = 'a.b'\nj = 'c.d'\n", 2, 9, "'ground' is reserved", ""),
    ("[bodies.\"a\u{202e}b\"]\nmass = 1\ninertia = 1\n", 2, 9, "must not contain U+202E", ""),
    ("[bodies.\"a\u{2066}\"]\nmass = 1\ninertia = 1\n", 2, 9, "must not contain U+2066", ""),
    ("[bodies.\"\u{200b}\"]\nmass = 1\ninertia = 1\n", 2, 9, "must not contain U+200B", ""),
    ("[parameters]\n\"k\u{200f}\" = 1\n", 3, 1, "must not contain U+200F", ""),
    ("[bodies.ground.points]\n\"A\u{202a}\" = [0, 0]\n", 3, 1, "must not contain U+202A", ""),
    ("[analyses.\"a\u{061c}\"]\ntype = 'dynamics'\nt_end = 1\n", 2, 11, "U+061C", ""),
    ("[bodies.\"a\\tb\"]\nmass = 1\ninertia = 1\n", 2, 9, "must not contain control", ""),
    (
        "[bodies.A]\nmass = 1\ninertia = 1\n[joints.A]\ntype = 'revolute'\ni = 'a.b'\nj = 'c.d'\n",
        5,
        9,
        "joints.A: 'A' is already the name of a body",
        "share one namespace",
    ),
    // bodies
    ("[bodies.a]\ntype = 'bra'\nmass = 1\n", 3, 8, "unknown type of body 'bra'", "mean 'bar'?"),
    ("[bodies.a]\ntype = 3\n", 3, 8, "bodies.a.type: a number; must be a text", ""),
    ("[bodies.a]\ntype = 'revolute'\n", 3, 8, "unknown type", "'revolute' belongs in [joints]"),
    ("[bodies.a]\ntype = 'ground'\n", 3, 8, "unknown type of body 'ground'", "body, bar, point_mass or beam"),
    ("[bodies.a]\ninertia = 1\n", 2, 9, "bodies.a.mass: missing; body needs it", "Mass; 0 where the mechanism determines the motion (kg)"),
    ("[bodies.a]\nmas = 1\ninertia = 1\n", 3, 1, "unknown field 'mas' of body", "mean 'mass'?"),
    ("[bodies.a]\nmass = [1]\ninertia = 1\n", 3, 8, "a list; must be a number or a formula", ""),
    ("[bodies.a]\nmass = true\ninertia = 1\n", 3, 8, "true or false; must be a number", ""),
    ("[bodies.a]\ntype = 'bar'\nmass = 1\n", 2, 9, "bodies.a.length: missing", "through = {"),
    (
        "[bodies.a]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A']\n",
        6,
        8,
        "a list of 1; must be a list of two names",
        "",
    ),
    (
        "[bodies.a]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A', 'A']\n",
        6,
        8,
        "both are 'A'; must be two different names",
        "",
    ),
    (
        "[bodies.a]\ntype = 'bar'\nmass = 1\nlength = 1\nends = ['A', 2]\n",
        6,
        14,
        "ends.1: a number; must be a name",
        "",
    ),
    ("[bodies.ground]\nmass = 1\n", 3, 1, "unknown field 'mass' of ground", "it may have points"),
    ("[bodies.ground]\npoints = { A = 1 }\n", 3, 16, "points.A: a number; must be a list", ""),
    ("[bodies.ground]\npoints = [[0, 0]]\n", 3, 10, "a list; must be a table of points", ""),
    // elements
    ("[joints.A]\ni = 'a.b'\n", 2, 9, "joints.A.type: missing", "write type = \"revolute\""),
    ("[joints.A]\ntype = 'revolut'\n", 3, 8, "unknown type of joint", "mean 'revolute'?"),
    ("[joints.A]\ntype = 'dynamics'\n", 3, 8, "unknown type", "belongs in [analyses]"),
    ("[forces.A]\ntype = 'revolute'\n", 3, 8, "unknown type of force", "belongs in [joints]"),
    ("[joints.A]\ntype = 'revolute'\ni = 'a.b'\n", 2, 9, "joints.A.j: missing", "Point of body j"),
    (
        "[joints.A]\ntype = 'revolute'\ni = 'a.b'\nj = 3\n",
        5,
        5,
        "a number; must be a point as \"body.point\"",
        "",
    ),
    // start
    ("[start]\nsets = {}\n", 3, 1, "unknown key 'sets' of start", "did you mean 'set'?"),
    ("[start]\nset = { a = 1 }\n", 3, 9, "'a' is not a coordinate", ""),
    ("[start]\nset = { 'a.agle' = 1 }\n", 3, 9, "unknown coordinate 'agle'", "mean 'angle'?"),
    ("[start.set.a]\nphi = 1\n", 3, 1, "unknown coordinate 'phi'", "x, y, angle, vx, vy or omega"),
    ("[start]\nset = { 'a.x' = 1, a.x = 2 }\n", 3, 22, "a.x is given twice", ""),
    ("[start]\nset = { 'a.x' = [1] }\n", 3, 17, "a list; must be a number or a formula", ""),
    // analyses
    ("[analyses.a]\ntype = 'dynamic'\n", 3, 8, "unknown type of analysis", "mean 'dynamics'?"),
    ("[analyses.a]\ntype = 'dynamics'\n", 2, 11, "t_end: missing", "simulation ends (s)"),
    ("[analyses.start]\ntype = 'dynamics'\nt_end = 1\n", 2, 11, "'start' is where a case", ""),
    (
        "[analyses.'a/b']\ntype = 'dynamics'\nt_end = 1\n",
        2,
        11,
        "must not contain '/'",
        "its results go to a folder of this name",
    ),
    ("[analyses.'/tmp/x']\ntype = 'dynamics'\nt_end = 1\n", 2, 11, "must not contain '/'", ""),
    ("[analyses.'a\\\\b']\ntype = 'dynamics'\nt_end = 1\n", 2, 11, "must not contain '\\'", ""),
    ("[analyses.'C:x']\ntype = 'dynamics'\nt_end = 1\n", 2, 11, "must not contain ':'", ""),
    ("[analyses.'..']\ntype = 'dynamics'\nt_end = 1\n", 2, 11, "must not contain '.'", ""),
    ("[analyses.'a ']\ntype = 'dynamics'\nt_end = 1\n", 2, 11, "must not begin or end with", ""),
    (
        "[analyses.ab]\ntype = 'dynamics'\nt_end = 1\n[analyses.AB]\ntype = 'dynamics'\nt_end = 1\n",
        5,
        11,
        "differs from 'ab' only in upper and lower case",
        "a folder of this name",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\nfrom = 'a'\n",
        5,
        8,
        "no earlier analysis 'a'",
        "\"start\" or the name of an earlier",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\nmethod = { type = 'rk54' }\n",
        5,
        19,
        "unknown type of method 'rk54'",
        "did you mean 'rk45'?",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\nmethod = { rtol = 1 }\n",
        5,
        1,
        "method.type: missing",
        "\"auto\", \"rk45\", \"dop853\", \"rk4\", \"generalized_alpha\", \"hht\" or \"radau\"",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\nmethod = { type = 'rk4', stp = 1, step = 1 }\n",
        5,
        26,
        "unknown field 'stp' of rk4",
        "did you mean 'step'?",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\nstabilization = 'none'\n",
        5,
        17,
        "must be a table such as { type = \"projection\" }",
        "",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\nmax_steps = 1.5\n",
        5,
        13,
        "1.5; must be a whole number from 1",
        "",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\ndense_output = 1\n",
        5,
        16,
        "a number; must be true or false",
        "",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\noutput = 'step'\n",
        5,
        10,
        "unknown word 'step'",
        "did you mean 'steps'?",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\noutput = 'steps'\noutput_step = 1\n",
        5,
        10,
        "not together with output_step",
        "",
    ),
    (
        "[analyses.a]\ntype = 'dynamics'\nt_end = 1\nmethod = { type = 'rk45', step = 1, max_step = 1 }\n",
        5,
        48,
        "analyses.a.method.max_step: not together with step; remove one of them",
        "",
    ),
    // values
    ("[parameters]\na = nan\n", 3, 5, "parameters.a: nan; must be a finite number", ""),
    ("[parameters]\na = -inf\n", 3, 5, "-inf; must be a finite number", ""),
    ("[parameters]\na = 1e999\n", 3, 5, "number is too large", ""),
    ("[parameters]\na = 9007199254740993\n", 3, 5, "integer is beyond 2^53", ""),
    ("[parameters]\na = 0xFFFFFFFFFFFFFFFFFFFFF\n", 3, 5, "integer is beyond 2^53", ""),
    ("[parameters]\na = 1979-05-27\n", 3, 5, "a date is not a value of a case", ""),
    // syntax
    ("[parameters]\na = 1\na = 2\n", 4, 1, "key 'a' is given twice", "already exists in line 3"),
    ("[parameters]\n[parameters]\n", 3, 2, "key 'parameters' is given twice", "already exists in line 2"),
    ("title = unquoted\n", 2, 9, "string values must be quoted", ""),
    ("[parameters\na = 1\n", 2, 12, "unclosed table; expected ']'", ""),
    ("title = \"open\n", 2, 14, "invalid basic string; expected '\"'", ""),
    ("gravity = [0, 1\n", 2, 16, "unclosed array; expected ']'", ""),
    ("title =\n", 2, 8, "the value is missing", ""),
    ("title = \"a\\qb\"\n", 2, 12, "missing escaped value", ""),
];

const JSON: &[Row] = &[
    ("{}", 1, 1, "kempe: missing", "write `\"kempe\": 1` as the first line"),
    (
        "{\"kempe\": 1, \"joints\": []}",
        1,
        24,
        "a list; must be a table of named tables",
        "write \"joints\": { \"NAME\": { } } for each",
    ),
    (
        "{\"kempe\": 1, \"forces\": {\"A\": {\"type\": \"revolute\"}}}",
        1,
        39,
        "unknown type of force 'revolute'",
        "'revolute' belongs in \"joints\"",
    ),
    (
        "{\"kempe\": 1, \"bodies\": {\"b\": {\"type\": \"bar\", \"mass\": 1}}}",
        1,
        25,
        "missing; bar needs its length or two points",
        "\"through\": { \"A\": [0, 0], \"B\": [1, 2] }",
    ),
    (
        "{\"kempe\": 1, \"bodies\": {\"ground\": {\"points\": 3}}}",
        1,
        46,
        "must be a table of points { \"P\": [x, y] }",
        "",
    ),
    (
        "{\"kempe\": 1, \"start\": {\"set\": 3}}",
        1,
        31,
        "must be a table such as { \"crank.angle\": 0 }",
        "",
    ),
    (
        "{\"kempe\": 1, \"analyses\": {\"a\": {\"type\": \"dynamics\", \"t_end\": 1, \"method\": \"rk45\"}}}",
        1,
        75,
        "must be a table such as { \"type\": \"auto\" }",
        "",
    ),
    ("[1]", 1, 1, "expected '{'; a case is a table", ""),
    ("", 1, 1, "EOF while parsing a value", ""),
    ("{\"kempe\": 1,}", 1, 13, "key must be a string", ""),
    ("{\"kempe\": 1 \"title\": 2}", 1, 13, "expected `,` or `}`", ""),
    ("{\"kempe\" 1}", 1, 10, "expected `:`", ""),
    ("{\"kempe\": 1, // no\n}", 1, 14, "JSON has no comments", ""),
    ("{\"kempe\": 1}\n# no", 2, 1, "JSON has no comments", ""),
    ("{\"kempe\": 01}", 1, 12, "invalid number", ""),
    ("{\"kempe\": .5}", 1, 11, "expected value", ""),
    ("{\"kempe\": 1, \"title\": 'a'}", 1, 23, "a text is written in double quotes", ""),
    ("{\"kempe\": 1, \"title\": abc}", 1, 23, "expected value", ""),
    ("{\"kempe\": 1, \"title\": null}", 1, 23, "title: null is not a value of a case", ""),
    ("{\"kempe\": 1, \"title\": \"a\n\"}", 1, 25, "the text has no closing '\"'", ""),
    ("{\"kempe\": 1, \"title\": \"a\\q\"}", 1, 26, "invalid escape", ""),
    ("{\"kempe\": 1, \"title\": \"\\ud800\"}", 1, 23, "unexpected end of hex escape", ""),
    ("{\"kempe\": 1, \"title\": \"a\tb\"}", 1, 25, "control character (\\u0000-\\u001F) found", ""),
    (
        "{\"kempe\": 1,\n\"parameters\": {\"a\": NaN}}",
        2,
        21,
        "expected value; a number must be finite",
        "",
    ),
    (
        "{\"kempe\": 1, \"parameters\": {\"a\": -Infinity}}",
        1,
        35,
        "invalid number; a number must be finite",
        "",
    ),
    (
        "{\"kempe\": 1,\n\"title\": \"a\",\n\"title\": \"b\"}",
        3,
        1,
        "given twice",
        "already exists in line 2",
    ),
    ("{\"kempe\": 1", 1, 12, "EOF while parsing an object", ""),
    (
        "{\"kempe\": 1, \"joints\": {\"A\": {}}}",
        1,
        25,
        "joints.A.type: missing",
        "write \"type\": \"revolute\"",
    ),
];

fn faults(text: &str, format: Format) -> Vec<Diagnostic> {
    match case::read(text, format) {
        Ok(_) => panic!("nothing is wrong with {text}"),
        Err(faults) => faults,
    }
}

fn check(text: &str, format: Format, row: &Row) {
    let found = faults(text, format);
    let all: Vec<String> = found.iter().map(Diagnostic::to_string).collect();
    let hit = found.iter().zip(&all).any(|(fault, shown)| {
        (fault.line, fault.column) == (row.1, row.2)
            && shown.contains(row.3)
            && shown.contains(row.4)
    });
    assert!(hit, "{row:?}:\n{}", all.join("\n"));
    assert_eq!(found.len(), 1, "{text}:\n{}", all.join("\n"));
}

#[test]
fn each_fault_of_a_toml_file_is_found_alone_and_in_its_place() {
    for row in TOML {
        // a joint, force or analysis of an unknown type has nothing else wrong
        check(&format!("kempe = 1\n{}", row.0), Format::Toml, row);
    }
}

#[test]
fn each_fault_of_a_json_file_is_found_alone_and_in_its_place() {
    for row in JSON {
        check(row.0, Format::Json, row);
    }
}

#[test]
fn the_version_is_asked_first() {
    let newer = faults("kempe = 2\nwheels = 3\n", Format::Toml);
    let wanted = "kempe: this file is format 2; this kempe reads 1 (line 1, column 9)\n  1 | kempe = 2\n    |         ^\nhint: update kempe";
    assert_eq!(newer.iter().map(Diagnostic::to_string).collect::<Vec<_>>(), [wanted]);
    let text = faults("kempe = \"1\"", Format::Toml);
    assert_eq!(text[0].message, "a text; must be the number 1");
    let older = faults("kempe = 0", Format::Toml);
    assert_eq!(older[0].message, "there is no format 0; this kempe reads 1");
}

#[test]
fn all_faults_come_at_once_in_the_order_of_the_text() {
    let text = "wheels = 1\n[bodies.a]\ntype = 'bar'\nmas = nan\n[joints.A]\ntype = 'revolut'\n";
    let found = faults(text, Format::Toml);
    let places: Vec<(usize, &str)> = found.iter().map(|f| (f.line, f.message.as_str())).collect();
    let wanted = [
        (1, "missing; a case begins with the version of its format"),
        (1, "unknown key 'wheels'"),
        (2, "missing; bar needs its length or two points"),
        (4, "unknown field 'mas' of bar"),
        (4, "nan; must be a finite number"),
        (6, "unknown type of joint 'revolut'"),
    ];
    assert_eq!(places, wanted);
    let syntax = faults("title = unquoted\n[parameters\na = 1\nb = \"open\n", Format::Toml);
    assert_eq!(syntax.iter().map(|f| f.line).collect::<Vec<_>>(), [1, 2, 4]);
}
