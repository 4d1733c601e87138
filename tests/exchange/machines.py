"""Assemblies that the tests write, with their closed solutions."""

from __future__ import annotations

import numpy as np
from exchange.asmt_text import Assembly, Part, X, Z, turn


def slider_crank(r: float, ratio: float, rate: float, mass: float) -> Assembly:
    """A crank at constant rate, a rod and a slide along x, at 0.3 rad; frames are at pins."""
    phi, rod = 0.3, ratio * r
    psi = -np.arcsin(r * np.sin(phi) / rod)
    pin = r * np.array([np.cos(phi), np.sin(phi), 0])
    end = pin[0] + rod * np.cos(psi)
    omega = -r * rate * np.cos(phi) / (rod * np.cos(psi))
    slide = -r * rate * np.sin(phi) - rod * omega * np.sin(psi)
    crank = Part(
        "crank",
        rotation=turn(phi),
        omega=(0, 0, rate),
        mass=mass,
        center=(r / 2, 0, 0.1),
        inertias=(9.0, 9.0, mass * r**2 / 12),
        markers={"O": ((0, 0, 0.2), Z), "A": ((r, 0, 0.2), Z)},
    )
    velocity = rate * np.array([-pin[1], pin[0], 0])
    conrod = Part(
        "rod",
        pin,
        turn(psi),
        velocity,
        (0, 0, omega),
        mass,
        (rod / 2, 0, 0),
        (7.0, 7.0, mass * rod**2 / 12),
        {"A": ((0, 0, 0.2), Z), "B": ((rod, 0, 0.2), Z)},
    )
    piston = Part(
        "piston",
        (end, 0, 0),
        Z,
        (slide, 0, 0),
        (0, 0, 0),
        mass,
        (0, 0, 0),
        (1, 1, 1),
        {"B": ((0, 0, 0.2), Z), "S": ((r, 0, 0), X)},
    )
    joints = [
        ("RevoluteJoint", "J1", {"MarkerI": "/O", "MarkerJ": "/crank/O"}),
        ("RevoluteJoint", "J2", {"MarkerI": "/crank/A", "MarkerJ": "/rod/A"}),
        ("RevoluteJoint", "J3", {"MarkerI": "/rod/B", "MarkerJ": "/piston/B"}),
        ("CylindricalJoint", "J4", {"MarkerI": "/piston/S", "MarkerJ": "/S"}),
    ]
    motion = (
        "RotationalMotion",
        "drive",
        {"MotionJoint": "/J1", "RotationZ": f"{phi!r}d + {rate!r}d*time"},
    )
    return Assembly(
        {"O": ((0, 0, 0.2), Z), "S": ((0, 0, 0), X)},
        [crank, conrod, piston],
        joints,
        [motion],
        gravity=(0, -9.81, 0),
        t_end=6.0 / rate,
        step=0.1 / rate,
    )


def slide_position(r: float, ratio: float, angle: np.ndarray) -> np.ndarray:
    """The place of the pin of the piston."""
    return r * np.cos(angle) + np.sqrt((ratio * r) ** 2 - (r * np.sin(angle)) ** 2)


def spring_pendulum(k: float, length: float) -> Assembly:
    """A mass on a slide along x at a spring to ground, pulled from rest."""
    block = Part(
        "block", (1.5 * length, 0, 0), mass=2.0, markers={"S": ((0, 0, 0), X), "P": ((0, 0, 0), Z)}
    )
    joint = ("TranslationalJoint", "guide", {"MarkerI": "/S", "MarkerJ": "/block/S"})
    spring = (
        "InLineForceTorque",
        "spring",
        {
            "MarkerI": "/O",
            "MarkerJ": "/block/P",
            "tension": f"({k!r}d*(rIJ(self) - {length!r}d) + 0.0d*vrIJ(self))",
            "twist": 0,
        },
    )
    ground = {"O": ((0, 0, 0), Z), "S": ((0, 0, 0), X)}
    return Assembly(ground, [block], [joint], forces=[spring], t_end=1.0, step=0.05)
