"""A cam as the result of a design: least size, remarks, case and files."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.design.cams import files
from kempe.design.cams.curves import CamCurves, plane
from kempe.errors import ModelError
from kempe.model.given import value
from kempe.model.values import Number

if TYPE_CHECKING:
    from kempe.case import Case


@dataclass(frozen=True, eq=False, repr=False)
class Cam(CamCurves):
    """A cam with its follower; ``kp.design.cam`` makes it.

    Attributes:
        programme: the lift over the angle of the cam.
        follower: kind and dimensions of the follower.
        clockwise: whether the cam turns clockwise.
        closure: "force", "groove" or "conjugate".
        drive: speed of the cam, mass of the follower and spring.
    """

    def least_base_radius(
        self, pressure_angle: Number | None = None, radius_of_curvature: Number = 0.0
    ) -> float:
        """The least radius of the base circle within limits, m; all else stays as it is.

        Args:
            pressure_angle: its largest magnitude, rad or "30 deg"; no limit by default.
            radius_of_curvature: the least convex one of the profile, m; at 0 the profile is at the
                limit of undercut.

        Raises:
            ModelError: no base circle keeps the limits.
        """
        steep = None if pressure_angle is None else value(pressure_angle, "pressure_angle", "rad")
        sharp = value(radius_of_curvature, "radius_of_curvature", "m")
        found = _core.cam_least_base(self, steep, sharp)
        if found is None:
            hint = "lengthen the segments, choose a gentler law, or lessen the lift or the roller"
            raise ModelError("no base circle keeps the limits", hint=hint)
        return found

    @cached_property
    def remarks(self) -> tuple[str, ...]:
        """What is wrong or doubtful, each with a remedy; empty if nothing is."""
        return tuple(_core.cam_remarks(self))

    @cached_property
    def case(self) -> Case:
        """The cam with its follower as a case, with a turn by ``inverse_dynamics``.

        Bodies are ``cam`` with the curve ``rim``, and ``follower``; joints ``shaft``, ``guide`` or
        ``pivot``, and ``contact``; the driver is ``drive``. ``contact.normal`` is the force between
        roller or face and cam. A knife, a groove and conjugate cams follow the pitch curve both
        ways; the measure ``press`` is the force on the follower along its motion.

        Raises:
            ModelError: the profile is undercut.
        """
        from kempe.case import parsed

        return parsed(_core.cam_case(self), "toml", None)

    def write_dxf(
        self, path: Path | str, *, cutter_radius: Number | None = None, unit: str = "mm"
    ) -> Path:
        """Write the profiles as closed polylines of a DXF drawing, and the shaft as a circle.

        The layers are ``cam``, ``outer`` for the outer wall of a groove, ``conjugate`` for the
        conjugate cam, and with ``cutter_radius`` also ``cutter`` for the path of its centre.

        Args:
            path: the file.
            cutter_radius: radius of a mill or grinding wheel, m.
            unit: unit of the drawing: "mm", "cm", "m", "in" or "ft".

        Raises:
            ModelError: the profile is undercut, or the cutter does not fit into its hollows.
            FileError: the file cannot be written.
        """
        return files.write_dxf(self, Path(path), cutter_radius, unit)

    def write_csv(
        self, path: Path | str, *, step: Number = "1 deg", cutter_radius: Number | None = None
    ) -> Path:
        """Write a table over the angle: lift and derivatives, curves, pressure angle, curvature.

        Args:
            path: the file.
            step: step of the angle, rad or "0.5 deg"; a turn must be a whole number of steps.
            cutter_radius: radius of a mill or grinding wheel, m, for the path of its centre.

        Raises:
            ModelError: the step does not divide a turn, the profile is undercut, or the cutter does
                not fit into its hollows.
            FileError: the file cannot be written.
        """
        return files.write_csv(self, Path(path), step, cutter_radius)

    def cutter_path(self, radius: Number) -> Floats:
        """Path of the centre of a cutter outside of the profile, (n, 2), m.

        In a groove it runs along the inner wall.

        Args:
            radius: of the cutter, m.

        Raises:
            ModelError: the cutter does not fit into the hollows of the profile, or into the groove.
        """
        walls = _core.cam_walls(self, self.angle, value(radius, "cutter_radius", "m"))
        return plane(dict(walls)["cutter"])

    def __repr__(self) -> str:
        kind = "oscillating" if self.follower.arm is not None else "translating"
        steep = np.degrees(self.largest_pressure_angle)
        told = f"{kind} {self.follower.kind}, base radius {self.follower.base:.4g} m"
        wrong = f"; {len(self.remarks)} remarks" if self.remarks else ""
        return f"<Cam: {told}, pressure angle up to {steep:.3g}°{wrong}>"
