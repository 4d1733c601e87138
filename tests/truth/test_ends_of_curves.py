"""No analysis passes the end of an open curve."""

import kempe as kp
import pytest


def bead(size, quantity=None, value=None, gravity=(0, 0)):
    """A body on y = x²/size for |x| <= 2 sizes, whose angle is held."""
    m = kp.Model("bead", gravity=gravity)
    shape = {"x": f"{size}*u", "y": f"{size}*u^2", "range": [-2, 2]}
    m.ground.curves(wire=shape)
    m.body("bead", mass=2, inertia=0.1 * size**2, points={"P": (0, 0)})
    m.point_on_curve("on", "bead.P", "ground.wire")
    m.coordinate_driver("upright", "bead.angle", value=0)
    if quantity is not None:
        m.coordinate_driver("drive", quantity, value=value)
    return m


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("analysis", [kp.kinematics, kp.inverse_dynamics])
def test_a_driven_motion_ends_where_its_curve_ends(size, analysis):
    for quantity, value in (("bead.x", f"{size}*(1 + t)"), ("on.u", "1 + t")):
        m = bead(size, quantity, value)
        start = kp.assemble(m)
        with pytest.raises(kp.SingularityError, match="on is at the end of its curve") as error:
            analysis(m, start, t_end=3)
        assert error.value.solution.t[-1] <= 1 + 1e-6
        assert analysis(m, start, t_end=1).t[-1] == 1  # the end itself belongs to the curve
    m = bead(size, "bead.x", f"{size}")
    start = kp.assemble(m)
    with pytest.raises(kp.SingularityError, match="on is at the end of its curve"):
        analysis(m, start, over="drive", range=[size, 3 * size], n=5)
    found = kp.limits(m, start, over="drive")
    for end, wanted in ((found.lower, -2 * size), (found.upper, 2 * size)):
        assert end == pytest.approx(wanted, rel=1e-7)


def test_a_place_of_an_open_curve_has_limits():
    m = bead(1.0, "on.u", "1")
    found = kp.limits(m, kp.assemble(m), over="drive")
    assert (found.lower, found.upper) == (pytest.approx(-2), pytest.approx(2))
    assert "°" not in str(found)


def test_an_equilibrium_beyond_the_end_is_refused():
    m = bead(1.0, gravity=(30, -9.81))  # tan = 3 at u = 1.53
    start = kp.assemble(m, set={"bead.x": 1.0})
    assert kp.equilibrium(m, start).state["on.u"] == pytest.approx(30 / 9.81 / 2, rel=1e-9)
    m = bead(1.0, gravity=(90, -9.81))
    with pytest.raises(kp.ModelError, match="the contact of on leaves its curve"):
        kp.equilibrium(m, kp.assemble(m, set={"bead.x": 1.0}))
