"""Words of other programs and textbooks, and the names that kempe has for them.

Messages suggest the names; ``docs/synonyms.md`` lists the same words for the search.
"""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

#: Elements, functions and attributes.
NAMES: dict[str, tuple[str, ...]] = {
    "hinge": ("revolute",),
    "pin": ("revolute",),
    "pin_joint": ("revolute",),
    "pivot": ("revolute",),
    "rotational": ("revolute",),
    "prismatic": ("translational",),
    "slider": ("translational",),
    "slide": ("translational",),
    "slot": ("pin_in_slot",),
    "fixed": ("weld",),
    "rigid": ("weld",),
    "rod": ("bar", "distance"),
    "link": ("bar", "body"),
    "link_massless": ("distance",),
    "strut": ("distance",),
    "mass": ("point_mass", "body"),
    "particle": ("point_mass",),
    "cam": ("roller_on_curve", "flat_on_curve"),
    "chain": ("belt",),
    "pulley": ("belt",),
    "rsda": ("torsion_spring",),
    "rotational_spring": ("torsion_spring",),
    "tsda": ("spring_damper",),
    "spring": ("spring_damper", "torsion_spring"),
    "damper": ("spring_damper", "torsion_spring"),
    "gas_spring": ("spring_damper", "actuator"),
    "cylinder": ("actuator",),
    "bumper": ("stop",),
    "driver": ("coordinate_driver",),
    "motion": ("coordinate_driver",),
    "moment": ("torque",),
    "load": ("force", "torque"),
    "simulate": ("dynamics",),
    "solve": ("dynamics", "kinematics"),
    "integrate": ("dynamics",),
    "run": ("dynamics",),
    "linearize": ("modes",),
    "eigenvalues": ("modes",),
    "statics": ("equilibrium", "inverse_dynamics"),
    "optimize": ("sweep",),
    "parameter_study": ("sweep",),
    "monte_carlo": ("tolerances", "sweep"),
    "read": ("load",),
    "workspace": ("reachable",),
    "dof": ("mobility",),
    "gruebler": ("mobility",),
    "video": ("animate",),
}
#: Arguments and fields.
ARGUMENTS: dict[str, tuple[str, ...]] = {
    "dt": ("output_step", "step"),
    "h": ("step", "output_step"),
    "timestep": ("output_step", "step"),
    "time_step": ("output_step", "step"),
    "tf": ("t_end",),
    "tmax": ("t_end",),
    "t_max": ("t_end",),
    "duration": ("t_end",),
    "time": ("t_end", "t"),
    "t0": ("t_start",),
    "solver": ("method",),
    "integrator": ("method",),
    "tol": ("rtol",),
    "tolerance": ("rtol",),
    "rel_tol": ("rtol",),
    "abs_tol": ("atol",),
    "k": ("stiffness",),
    "spring_constant": ("stiffness",),
    "c": ("damping",),
    "d": ("damping",),
    "damper": ("damping",),
    "l0": ("free_length",),
    "rest_length": ("free_length",),
    "length0": ("free_length",),
    "theta0": ("free_angle",),
    "rest_angle": ("free_angle",),
    "m": ("mass",),
    "I": ("inertia",),
    "J": ("inertia",),
    "moment_of_inertia": ("inertia",),
    "l": ("length",),
    "L": ("length",),
    "len": ("length",),
    "g": ("gravity",),
    "mu": ("kinetic", "static"),
    "coefficient": ("kinetic", "static"),
    "a": ("i",),
    "b": ("j",),
    "body1": ("i",),
    "body2": ("j",),
    "parent": ("i",),
    "child": ("j",),
    "at": ("j", "i"),
    "point": ("j", "of"),
    "value": ("force", "torque", "value"),
    "events_": ("events",),
    "rates": ("set",),
    "rate": ("set",),
    "initial": ("set",),
    "alpha_beta": ("alpha", "beta"),
    "gain": ("alpha", "beta"),
    "gains": ("alpha", "beta"),
    "filename": ("path",),
    "file": ("path",),
    "n_steps": ("max_steps",),
    "steps": ("max_steps",),
    "points": ("points", "n"),
    "number": ("n",),
    "samples": ("n",),
}


def suggested(
    word: str, known: Iterable[str], table: dict[str, tuple[str, ...]]
) -> tuple[str, ...]:
    """The known names that a word may mean; empty if there is none."""
    names = [name for name in known if not name.startswith("_")]
    meant = tuple(name for name in table.get(word, table.get(word.lower(), ())) if name in names)
    if meant:
        return meant
    plain = {name.replace("_", "").casefold(): name for name in names}
    near = get_close_matches(word.replace("_", "").casefold(), plain, n=1)
    return (plain[near[0]],) if near else ()


def question(names: tuple[str, ...]) -> str:
    """``did you mean 'stop' or 'contact'?``."""
    return f"did you mean {' or '.join(map(repr, names))}?"
