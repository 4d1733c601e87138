//! Positions, velocities and accelerations of a driven four-bar against closed forms.

use crate::mechanisms::{close, four_bar_of, motor, run, start};
use crate::{number, reference};
use kempe::analyses::dynamics::Options;

#[test]
fn both_closures_with_first_and_second_derivatives() {
    let truth = reference("closed_forms")["four_bar_position"].clone();
    let table = truth["fourbar_Norton_like_40_120_80_100"].clone();
    let mut checked = 0;
    for (name, values) in table.as_object().unwrap() {
        let Some((degrees, closure)) = name.split_once("deg ") else { continue };
        let law = motor("crank.angle", &format!("{degrees}*deg + t"));
        let m = four_bar_of([100, 40, 120, 80], &law);
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
