"""Every refusal of sweeps and tolerances is met, and says what it said when a person read it."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import sweeps
from refusals.told import check, statements

HERE = Path(__file__).parent
#: The files whose refusals need neither a cluster nor a damaged file.
FILES = ["asked", "design", "numbers", "plan", "result", "run", "scatter", "sobol", "variables"]
FILES += ["wanted"]


@cache
def pendulum(kind: str = "dynamics", *, function: bool = False) -> kp.Case:
    """A rod on a pin, with a spring that its parameter makes stiff."""
    m = kp.Model("pendulum", gravity=(0, -9.81), parameters={"length": "1 m", "k": 50.0, "u": 1.0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length="length", ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("spring", "ground", "rod", stiffness="k")
    if function:
        m.torque("own", "rod", torque=lambda t, _: 0.1 * t)
    analyses = {
        "dynamics": kp.Dynamics(t_end=0.1),
        "steps": kp.Dynamics(t_end=0.1, method=kp.GeneralizedAlpha(step=0.01)),
        "equilibrium": kp.Equilibrium(),
        "modes": kp.Modes(),
    }
    return kp.Case(m, {"set": {"rod.angle": 0.1}}, [analyses[kind]])


def fall() -> kp.Data:
    """A measured motion."""
    t = np.linspace(0.02, 0.08, 5)
    return kp.Data({"t": t, "rod.x": t}, columns={"rod.x": "rod.x"}, shift="late")


def swept(
    variables: Any = None, measures: Any = ("O.force.max",), kind: str = "dynamics", **more: Any
) -> Callable[[], object]:
    given = {"k": [50.0]} if variables is None else variables
    return lambda: kp.sweep(pendulum(kind), given, list(measures), **more)


def of_k(values: Any, **more: Any) -> Callable[[], object]:
    return swept({"k": values}, **more)


def tolerated(deviations: Any, measure: str = "O.force.max", **more: Any) -> Callable[[], object]:
    given = {"n": 4, **more}
    return lambda: kp.tolerances(pendulum(), deviations, measure, **given)


def allocated(limit: Any, costs: Any, measure: str = "O.force.max") -> Callable[[], object]:
    return lambda: sweeps.allocate(pendulum(), measure, limit, costs)


CALLS: dict[str, Callable[[], object]] = {
    "sweep of a model": lambda: kp.sweep(pendulum().model, {"k": [1]}, ["O.force.max"]),  # type: ignore[arg-type]
    "no variables": swept({}),
    "no measures": swept(measures=()),
    "no analysis": lambda: kp.sweep(kp.Case(pendulum().model), {"k": [1]}, ["O.force.max"]),
    "another analysis": swept(analysis="modes"),
    "kept with a function": lambda: kp.sweep(
        pendulum(function=True), {"k": [50.0]}, ["O.force.max"], out="kept.db"
    ),
    "variable": swept({"kk": [1]}),
    "coordinate": swept({"rod.size": [1]}),
    "variable of a number": swept({3: [1]}),
    "design": swept(design="gird"),
    "n of a grid": swept(n=3),
    "grid of a distribution": of_k({"normal": [50, 1]}),
    "grid without n": of_k({"from": 1, "to": 2}, design="paired"),
    "grid too large": swept(
        {name: {"from": 1, "to": 2, "n": 4000} for name in ("k", "length")}
    ),
    "paired": swept({"k": [1, 2], "length": [1]}, design="paired"),
    "random without n": swept(design="random"),
    "latin with half an n": swept(design="latin", n=1.5),
    "sobol": swept(design="sobol", n=100),
    "seed": swept(design="random", n=4, seed=-1),
    "workers": swept(workers=0),
    "form": of_k({"form": 1, "to": 2}),
    "no value": of_k([]),
    "scale": of_k({"from": 1, "to": 2, "n": 3, "scale": "lg"}),
    "log over zero": of_k({"from": -1, "to": 2, "n": 3, "scale": "log"}),
    "n of a range": of_k({"from": 1, "to": 2, "n": 1}),
    "n of a range that is true": of_k({"from": 1, "to": 2, "n": True}),
    "one number": of_k({"uniform": [1]}),
    "deviation": of_k({"normal": [1, 0]}),
    "uniform": of_k({"uniform": [2, 1]}),
    "word": of_k(["50 N"]),
    "table": of_k([[1, 2]]),
    "infinite": of_k([np.inf]),
    "measure twice": swept(measures=["O.force.max"] * 2),
    "no statistic": swept(measures=["O.force"]),
    "word for a statistic": swept(measures=["O.force.mx"]),
    "name for a measure": swept(measures=["frce.max"]),
    "function of a measure": swept(measures=["max(O.force)"]),
    "number of modes in a motion": swept(measures=["frequency[0]"]),
    "number of modes": swept(measures=["omaga[0]"], kind="modes"),
    "quantity of modes": swept(measures=["rod.angle"], kind="modes"),
    "effort by place": swept(measures=["effort[rod.angle]"], kind="equilibrium"),
    "effort of nothing": swept(measures=["effort.rod.angle"], kind="equilibrium"),
    "statistic of one instant": swept(measures=["rod.angle.max"], kind="equilibrium"),
    "whole run of one instant": swept(measures=["energy.balance"], kind="equilibrium"),
    "place of a row": lambda: swept()().case(1),  # type: ignore[attr-defined]
    "no slopes within tolerances": lambda: kp.tolerances(
        pendulum("steps"), {"length": 500.0}, "rod.x.final", n=4
    ),
    "two good variants": tolerated({"length": 1e3}, n=2, seed=3),
    "yield of another analysis": tolerated({"k": 1.0}, subject_to="dynamics:rod.x.max > 1"),
    "yield of a load case": tolerated({"k": 1.0}, subject_to="worst(rod.x.max) > 1"),
    "sobol of tolerances": tolerated({"k": 1.0}, sobol=100),
    "sobol that fails": tolerated({"length": 3.0}, sobol=4),
    "tolerances of a list": tolerated([1.0]),
    "tolerances of nothing": tolerated({}),
    "tolerances of a model": lambda: kp.tolerances(pendulum().model, {"k": 1.0}, "O.force.max"),  # type: ignore[arg-type]
    "variables of a number": swept(3),
    "gradient of nothing": lambda: kp.gradient(pendulum(), ["O.force.max"], []),
    "gradient without measure": lambda: kp.gradient(pendulum(), [], ["k"]),
    "fit of nothing": lambda: kp.fit(pendulum(), fall(), {}),
    "fit of the time": lambda: kp.fit(pendulum(), fall(), {"late": (0.0, 0.01)}),
    "costs of a list": allocated(30.0, [1.0]),
    "costs of nothing": allocated(30.0, {}),
    "limit": allocated("x", {"k": 1.0}),
    "limit without bound": allocated(np.inf, {"k": 1.0}),
    "cost": allocated(30.0, {"k": 0.0}),
    "no slope": lambda: sweeps.allocate(
        pendulum("modes"), "stable", 2.0, {"k": 1.0}
    ),
    "at the limit": allocated(1.0, {"u": 1.0}, "u.max"),
    "no influence": allocated(30.0, {"u": 1.0}),
}  # fmt: skip


def test_every_refusal_says_what_is_wrong_and_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    known = {}
    for name in FILES:
        known |= statements(f"sweeps/{name}.py")
    # the last one is caught, and differences take the place of slopes
    elsewhere = ("not installed", "NoSlopesError")
    known = {place: told for place, told in known.items() if not any(x in told for x in elsewhere)}
    check(HERE / "sweeps.txt", CALLS, known)
