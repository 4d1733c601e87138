"""The shape, the internal forces and the stress of a beam along its arc length."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, fixed
from kempe.errors import ModelError
from kempe.model.compiled import BodyInfo

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel
    from kempe.results.motion import Motion

#: The places of an element with results: both ends and the Gauss points.
_STATIONS = 5
#: The results of an element, each in all places.
_ALONG = ("s", "x", "y", "angle", "normal_force", "shear_force", "bending_moment", "stress")
#: Largest relative jump of the bending moment between elements that counts as small.
_SMALL = 1e-3
#: Bending below this angle, or this part of the moment of the other forces, is a rounding error.
_ROUNDING = 1e-9
#: The results of an element as a whole: name, unit, and how those of all elements are joined.
WHOLE = (
    ("stress", "Pa", np.max),
    ("bending_moment", "N*m", np.max),
    ("strain_energy", "J", np.sum),
)


def pieces(compiled: CompiledModel, name: str) -> list[str]:
    """The elastic pieces of a beam from its first end to its last."""
    of = (force for force in compiled.forces.values() if not force.is_shown)
    return [force.name for force in of if force.name.startswith(f"{name}.")]


def has_stress(compiled: CompiledModel, name: str) -> bool:
    """Whether a beam has a section, which gives the stress."""
    return "section" in compiled.tree["bodies"][name]


def locks(compiled: CompiledModel, name: str, strain: str) -> list[str]:
    """The locks ``inextensible`` or ``unsheared`` of a beam; empty if it has none."""
    of = (lock.name for lock in compiled.locks(name))
    return [lock for lock in of if lock.startswith(f"{name}.{strain}_")]


def whole(motion: Motion, name: str, quantity: str) -> Any:
    """A result of a beam as a whole: ``stress``, ``bending_moment`` or ``strain_energy``."""
    k = [known for known, _, _ in WHOLE].index(quantity)
    if quantity == "stress" and (stretch := locks(motion.compiled, name, "inextensible")):
        return np.max(np.stack([motion.results(lock)[..., -1] for lock in stretch]), axis=0)
    of = [motion.force_results(piece) for piece in pieces(motion.compiled, name)]
    column = np.stack([rows[..., _STATIONS * len(_ALONG) + k] for rows in of])
    return WHOLE[k][2](column, axis=0)


@explain_methods
class BeamView:
    """A beam of a motion. All arrays but ``s`` are (n_t, n_s), in a state (n_s,), in SI units.

    Each element has five places: both of its ends, and the three Gauss points between them, in
    which the internal forces are computed. Those of the ends are on the parabola through the Gauss
    points. The arc length repeats between elements, so that a jump at a load is shown.

    Attributes:
        info: the first node of the beam.
    """

    def __init__(self, motion: Motion, info: BodyInfo) -> None:
        self._motion = motion
        self.info = info

    @property
    def name(self) -> str:
        """Name of the beam."""
        return self.info.name

    @property
    def _pieces(self) -> list[str]:
        return pieces(self._motion.compiled, self.name)

    @cached_property
    def _tables(self) -> list[Floats]:
        return [self._motion.force_results(name) for name in self._pieces]

    def _locked(self, strain: str, first: int) -> Floats | None:
        """Results of the locks from column ``first``; None if the beam has the strain."""
        names = locks(self._motion.compiled, self.name, strain)
        if not names:
            return None
        parts = [self._motion.results(name)[..., first : first + _STATIONS] for name in names]
        return fixed(np.concatenate(parts, axis=-1))

    def _along(self, quantity: str) -> Floats:
        first = _STATIONS * _ALONG.index(quantity)
        parts = [table[..., first : first + _STATIONS] for table in self._tables]
        return fixed(np.concatenate(parts, axis=-1))

    @property
    def s(self) -> Floats:
        """Arc length from the first end without stress, (n_s,), m."""
        return fixed(self._along("s").reshape(-1, _STATIONS * len(self._tables))[0])

    @property
    def x(self) -> Floats:
        """Position of the centre line, m."""
        return self._along("x")

    @property
    def y(self) -> Floats:
        """Position of the centre line, m."""
        return self._along("y")

    @property
    def angle(self) -> Floats:
        """Angle of the sections, rad."""
        return self._along("angle")

    @property
    def normal_force(self) -> Floats:
        """Normal force, N; positive if it pulls."""
        locked = self._locked("inextensible", 0)
        return self._along("normal_force") if locked is None else locked

    @property
    def shear_force(self) -> Floats:
        """Shear force, N: that of the part beyond the section, to the left of the beam."""
        locked = self._locked("unsheared", 0)
        return self._along("shear_force") if locked is None else locked

    @property
    def bending_moment(self) -> Floats:
        """Bending moment, N·m; positive if the angle grows along the beam."""
        return self._along("bending_moment")

    @property
    def stress(self) -> Floats:
        """Largest magnitude of the normal stress in a section, abs(N)/A + abs(M) c/I, Pa.

        Raises:
            ModelError: the beam has no section.
        """
        if not has_stress(self._motion.compiled, self.name):
            raise ModelError(
                f"beam {self.name} has EA and EI, which give no stress",
                name=self.name,
                hint="give section and young in place of EA, EI and GA",
            )
        locked = self._locked("inextensible", _STATIONS)
        return self._along("stress") if locked is None else locked

    @property
    def strain_energy(self) -> Any:
        """Elastic energy, (n_t,), in a state a float, J."""
        found = whole(self._motion, self.name, "strain_energy")
        return float(found) if np.ndim(found) == 0 else fixed(found)

    @property
    def error(self) -> float:
        """Estimate of the error of the bending moment, relative to its largest magnitude.

        It is the largest difference of the bending moment between the two sides of a place where
        elements meet and no point has a name. More elements make it smaller.
        """
        moment = self.bending_moment
        largest = np.abs(moment).max(initial=0.0)
        forces = np.abs([self.normal_force, self.shear_force]).max(initial=0.0)
        turned = 2.0 * np.max(self.strain_energy) / largest if largest > 0.0 else 0.0
        if turned < _ROUNDING or largest < _ROUNDING * forces * self.s[-1]:
            return 0.0
        # a joint or torque at a named point may make the moment jump
        ends = [self._motion.compiled.forces[piece].j for piece in self._pieces[:-1]]
        inner = [k for k, node in enumerate(ends) if ".#" in node]
        after = [_STATIONS * (k + 1) for k in inner]
        jumps = np.abs(moment[..., after] - moment[..., [k - 1 for k in after]])
        return float(jumps.max(initial=0.0) / largest)

    @property
    def enough(self) -> int:
        """Number of elements with which ``error`` would be about 1e-3, or that of the beam.

        The jumps of the bending moment decrease with the square of the length of the elements.
        """
        more = np.sqrt(self.error / _SMALL)
        return max(len(self._tables), int(np.ceil(more * len(self._tables))))

    def __repr__(self) -> str:
        error, enough = self.error, self.enough
        more = f", error {error:.1e}: {enough} are enough" if enough > len(self._tables) else ""
        return f"<beam {self.name!r}: {len(self._tables)} elements, {self.s[-1]:g} m{more}>"
