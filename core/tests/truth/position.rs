//! Positions, velocities and accelerations of a driven four-bar against closed forms.

use crate::mechanisms::{close, model, run, start};
use crate::{number, reference};
use kempe::analyses::dynamics::Options;

const FOUR_BAR: &str = r#"
[parameters]
th0 = 0
[bodies.ground]
points = { A = [0, 0], D = [100, 0] }
[bodies.crank]
type = "bar"
mass = 1
length = 40
ends = ["A", "B"]
[bodies.coupler]
type = "bar"
mass = 1
length = 120
ends = ["B", "C"]
[bodies.rocker]
type = "bar"
mass = 1
length = 80
ends = ["D", "C"]
[joints.A]
type = "revolute"
i = "ground.A"
j = "crank.A"
[joints.B]
type = "revolute"
i = "crank.B"
j = "coupler.B"
[joints.C]
type = "revolute"
i = "coupler.C"
j = "rocker.C"
[joints.D]
type = "revolute"
i = "ground.D"
j = "rocker.D"
[drivers.motor]
type = "coordinate_driver"
coordinate = "crank.angle"
value = "th0 + t"
"#;

#[test]
fn both_closures_with_first_and_second_derivatives() {
    let truth = reference("closed_forms")["four_bar_position"].clone();
    let table = truth["fourbar_Norton_like_40_120_80_100"].clone();
    let mut checked = 0;
    for (name, values) in table.as_object().unwrap() {
        let Some((degrees, closure)) = name.split_once("deg ") else { continue };
        let m = model(&FOUR_BAR.replace("th0 = 0", &format!("th0 = \"{degrees} deg\"")));
        let (phi2, phi3) = (number(&values["phi2_deg"]), number(&values["phi3_deg"]));
        // a rough guess that decides the closure and the whole turns
        let guess = [
            ("coupler.angle", format!("{}*deg", phi2 + 9.0)),
            ("rocker.angle", format!("{}*deg", phi3 - 9.0)),
        ];
        let guess = guess.each_ref().map(|(key, text)| (*key, text.as_str()));
        let (state, report) = start(&m, &[], &guess);
        assert_eq!(report.degrees_of_freedom, 0);
        let run = run(&m, &state, &Options::classical(0.0));
        close(name, state.q[5].to_degrees(), phi2, 1e-10);
        close(name, state.q[8].to_degrees(), phi3, 1e-10);
        close(name, state.v[5], number(&values["dphi2/dth"]), 1e-12);
        close(name, state.v[8], number(&values["dphi3/dth"]), 1e-12);
        close(name, run.accelerations(&m).unwrap().a[5], number(&values["d2phi2/dth2"]), 1e-11);
        close(name, run.accelerations(&m).unwrap().a[8], number(&values["d2phi3/dth2"]), 1e-11);
        let side = |left: bool| if left { "open" } else { "crossed" };
        assert_eq!(report.modes.len(), 1);
        assert_eq!(side(report.modes[0].left), closure, "{name}");
        assert_eq!(report.alternatives, Some(1));
        checked += 1;
    }
    assert_eq!(checked, 14);
}
