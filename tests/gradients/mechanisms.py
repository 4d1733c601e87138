"""Random mechanisms with smooth forces, for slopes against differences of runs."""

from typing import Any

import kempe as kp
import numpy as np

#: A method whose error is far below that of a difference of runs.
EXACT = kp.DOP853(rtol=1e-13, atol=1e-15)
STATISTICS = ("final", "final", "max", "min", "peak", "mean", "rms", "integral")


class Random:
    """A mechanism, its variables and its measures, made from a seed."""

    def __init__(self, seed: int) -> None:
        self.dice = np.random.default_rng(seed)
        self.size = float(10.0 ** self.dice.uniform(-1.0, 1.0))
        self.mass = float(10.0 ** self.dice.uniform(-1.0, 1.0))
        self.parameters: dict[str, float] = {"g": 9.81}
        self.calls: list[tuple[str, tuple[Any, ...], dict[str, Any]]] = []
        self.start: dict[str, float] = {}
        self.guess: dict[str, float] = {}
        self.quantities: list[str] = []
        self.driven = False
        [self._chain, self._four_bar, self._slider_crank][seed % 3]()
        self._forces()
        self._drive(seed)

    def _number(self, name: str, low: float, high: float) -> str:
        """A parameter with a random value; returns its name."""
        self.parameters[name] = float(self.dice.uniform(low, high))
        return name

    def _add(self, kind: str, *given: Any, **fields: Any) -> None:
        """A call of the model, which is made when all parameters are known."""
        self.calls.append((kind, given, fields))

    def _body(self, name: str, length: str, ends: tuple[str, str]) -> None:
        """A bar, or a body whose mass centre is beside its line."""
        if self.dice.random() < 0.5:
            mass = self._number(f"m_{name}", self.mass, 3.0 * self.mass)
            self._add("bar", name, mass=mass, length=length, ends=ends)
            return
        self._add(
            "body",
            name,
            mass=self._number(f"m_{name}", self.mass, 3.0 * self.mass),
            inertia=f"{self.mass * self.size**2}*{self._number(f'j_{name}', 0.2, 1.0)}",
            center=(f"0.4*{length}", self._number(f"e_{name}", -0.1 * self.size, 0.1 * self.size)),
            points={ends[0]: (0, 0), ends[1]: (length, 0)},
        )

    def _chain(self) -> None:
        """One to three links below a pin."""
        self._add("ground", P0=(0, 0), Q=("0.3*l0", "1.5*l0"))
        before = "ground"
        for k in range(int(self.dice.integers(1, 4))):
            name = f"link{k}"
            self._body(
                name, self._number(f"l{k}", 0.5 * self.size, self.size), (f"P{k}", f"P{k + 1}")
            )
            self._add("revolute", f"J{k}", f"{before}.P{k}", f"{name}.P{k}")
            self.start[f"{name}.angle"] = float(self.dice.uniform(-2.2, -1.0))
            self.start[f"{name}.omega"] = float(self.dice.uniform(-1.0, 1.0))
            self.quantities += [
                f"{name}.angle",
                f"J{k}.force",
                f"{name}.omega",
                f"{name}.P{k + 1}.y",
            ]
            before = name
        self.bodies = ("ground", "link0", before)
        self.point, self.fixed = f"{before}.P{int(before[4:]) + 1}", "ground.Q"

    def _loop(self) -> None:
        self.start = {"crank.angle": float(self.dice.uniform(0.6, 1.6))}
        self.start["crank.omega"] = float(self.dice.uniform(-2.0, 2.0))
        self.guess |= {"crank.angle": self.start["crank.angle"]}

    def _four_bar(self) -> None:
        lengths = {"a": 0.3, "b": 0.9, "c": 0.7, "d": 1.0}
        for name, x in lengths.items():
            self._number(name, 0.95 * x * self.size, 1.05 * x * self.size)
        self._add("ground", A=(0, 0), D=("d", 0), Q=("0.4*d", "1.2*d"))
        self._body("crank", "a", ("A", "B"))
        self._body("coupler", "b", ("B", "C"))
        self._body("rocker", "c", ("D", "C"))
        self._add("revolute", "A", "ground.A", "crank.A")
        self._add("revolute", "B", "crank.B", "coupler.B")
        self._add("revolute", "C", "coupler.C", "rocker.C")
        self._add("revolute", "D", "ground.D", "rocker.D")
        self._loop()
        self.guess["rocker.angle"] = 1.4
        self.quantities += [
            "rocker.angle",
            "C.force",
            "D.fx",
            "coupler.C.y",
            "rocker.omega",
            "coupler.alpha",
        ]
        self.bodies = ("ground", "crank", "rocker")
        self.point, self.fixed = "coupler.C", "ground.Q"

    def _slider_crank(self) -> None:
        self._number("a", 0.25 * self.size, 0.35 * self.size)
        self._number("b", 0.8 * self.size, self.size)
        self._number("h", -0.1 * self.size, 0.1 * self.size)
        self._add("ground", A=(0, 0), D=(0, "h"), Q=(2.0 * self.size, 0.2 * self.size))
        self._body("crank", "a", ("A", "B"))
        self._body("rod", "b", ("B", "C"))
        self._add(
            "body",
            "slider",
            mass=self._number("m_slider", self.mass, 2.0 * self.mass),
            inertia=self.mass * self.size**2,
            points={"C": (0, 0)},
        )
        self._add("revolute", "A", "ground.A", "crank.A")
        self._add("revolute", "B", "crank.B", "rod.B")
        self._add("revolute", "C", "rod.C", "slider.C")
        self._add("translational", "G", "ground.D", "slider.C")
        self._loop()
        self.guess["slider.x"] = 1.1 * self.size
        self.quantities += ["slider.x", "B.force", "rod.angle", "slider.vx", "slider.ax", "A.fy"]
        self.bodies = ("ground", "crank", "rod")
        self.point, self.fixed = "slider.C", "ground.Q"

    def _forces(self) -> None:
        """One to three smooth forces."""
        weight = self.mass * 9.81
        torque = weight * self.size
        kinds = self.dice.permutation(6)[: int(self.dice.integers(1, 4))]
        for kind in kinds.tolist():
            if kind == 0:
                k = self._number("kt", torque, 3 * torque)
                c = self._number("ct", 0.05 * torque, 0.3 * torque)
                self._add(
                    "torsion_spring",
                    "spiral",
                    *self.bodies[::2],
                    stiffness=k,
                    damping=c,
                    free_angle=0.3,
                )
            elif kind == 1:
                k = self._number("kl", weight / self.size, 4 * weight / self.size)
                c = self._number("cl", 0.05 * weight / self.size, 0.3 * weight / self.size)
                free = self._number("f", 0.3 * self.size, 0.6 * self.size)
                self._add(
                    "spring_damper",
                    "coil",
                    self.fixed,
                    self.point,
                    stiffness=k,
                    damping=c,
                    free_length=free,
                )
                self.quantities.append("coil.force")
            elif kind == 2:
                w = self._number("w", 2.0, 5.0)
                self._add("torque", "shaker", self.bodies[1], torque=f"{0.5 * torque}*sin({w}*t)")
            elif kind == 3:
                u = self._number("u", 0.1 * weight, weight)
                law = f"-{u}*tanh(vx/{self.size}) "
                self._add(
                    "force", "drag", self.point, force=[law.replace("vx", f"{self.point}.vx"), 0]
                )
            elif kind == 4:
                p = self._number("p", 0.2 * weight, weight)
                self._add(
                    "actuator",
                    "pusher",
                    self.fixed,
                    self.point,
                    force=f"{p}*cos(3*t) - {p}*length/{self.size}",
                )
            else:
                b = self._number("kb", weight / self.size, 3 * weight / self.size)
                self._add(
                    "generalized_force",
                    "odd",
                    f"{self.bodies[1]}.angle",
                    value=f"-{b}*{self.size**2}*sin({self.bodies[1]}.angle)",
                )

    def _drive(self, seed: int) -> None:
        """Every fourth mechanism has a driver where one is enough."""
        self.driven = seed % 4 == 3 and "crank.angle" in self.start
        if self.driven:
            self._number("speed", 1.0, 3.0)
            self._add(
                "coordinate_driver",
                "motor",
                "crank.angle",
                value=f"{self.start['crank.angle']} + speed*t + 0.2*sin(speed*t)",
            )
            self.start = {}
            self.quantities.append("motor.effort")

    def case(self) -> kp.Case:
        """The case, with its parameters."""
        model = kp.Model("random", gravity=(0, "-g"), parameters=self.parameters)
        for kind, given, fields in self.calls:
            call = model.ground.points if kind == "ground" else getattr(model, kind)
            call(*given, **fields)
        output = {"t_end": 0.8, "output_step": 0.05}
        run: Any = kp.Dynamics(method=EXACT, **output)
        if self.driven and self.dice.random() < 0.5:
            run = kp.InverseDynamics(**output)
        return kp.Case(model, {"set": self.start, "guess": self.guess}, [run])

    def request(self) -> tuple[list[str], list[str]]:
        """Measures and variables."""
        chosen = self.dice.choice(self.quantities, min(4, len(self.quantities)), replace=False)
        measures = [f"{one}.{self.dice.choice(STATISTICS)}" for one in chosen.tolist()]
        names = [*self.parameters, *self.start]
        count = min(6, len(names))
        return measures, self.dice.choice(names, count, replace=False).tolist()
