"""The first and the last time of a solution, up to rounding errors."""

import kempe as kp
import pytest


@pytest.mark.parametrize("t_end", [1e-3, 1.0, 1e3])
def test_a_time_may_miss_the_ends_by_rounding_errors_only(t_end: float) -> None:
    m = kp.Model("ball", gravity=(0, -9.81))
    m.point_mass("ball", mass=1)
    start = kp.assemble(m, {"ball.x": 0.0, "ball.y": 0.0, "ball.vx": 1.0})
    for begin in (0.0, 0.5 * t_end, -2.0 * t_end):
        sol = kp.dynamics(m, start, t_start=begin, t_end=t_end)
        largest = max(abs(begin), t_end)
        for end, side in ((begin, -1.0), (t_end, 1.0)):
            inside, outside = end + side * 5e-13 * largest, end + side * 5e-12 * largest
            assert sol(inside)["ball.x"] == pytest.approx(end - begin, abs=1e-11 * largest)
            with pytest.raises(kp.ModelError, match="outside the solution"):
                sol(outside)
            with pytest.raises(kp.ModelError, match="outside the solution"):
                sol([0.5 * (begin + t_end), outside])
