"""``kempe cam``: the cam for a programme of its follower."""

from __future__ import annotations

from math import degrees
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.text import Text

from kempe.cli.arguments import AsJson, stem
from kempe.cli.console import answers, figure, list_files, table
from kempe.cli.failure import document

if TYPE_CHECKING:
    from kempe.design import Cam

EXAMPLES = """Examples:

  kempe cam lift.csv --base-radius "30 mm" --roller-radius "8 mm"

  kempe cam lift.csv --follower flat --base-radius "40 mm" --speed "300 rpm" --spring 2000 50
"""


def cam(  # noqa: PLR0917 - typer uses the annotations of options and arguments
    file: Annotated[Path, typer.Argument(metavar="FILE", help="CSV: segment, angle, lift, law.")],
    base_radius: Annotated[str, typer.Option(help="Radius at no lift, such as '30 mm'.")],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Folder for results; default out/<FILE>/cam."),
    ] = None,
    follower: Annotated[str, typer.Option(help="roller, knife or flat.")] = "roller",
    roller_radius: Annotated[str, typer.Option(help="Radius of the roller.")] = "0",
    offset: Annotated[str, typer.Option(help="Of the line of travel to the right.")] = "0",
    arm: Annotated[str | None, typer.Option(help="Length of an oscillating follower.")] = None,
    pivot: Annotated[
        tuple[str, str] | None, typer.Option(help="x and y of an oscillating follower's pivot.")
    ] = None,
    face: Annotated[str, typer.Option(help="Distance of a flat face from the pivot.")] = "0",
    closure: Annotated[str, typer.Option(help="force, groove or conjugate.")] = "force",
    direction: Annotated[str, typer.Option(help="ccw or cw.")] = "ccw",
    speed: Annotated[str, typer.Option(help="Of the cam, such as '300 rpm'.")] = "60 rpm",
    mass: Annotated[str, typer.Option(help="Of the follower.")] = "1 kg",
    spring: Annotated[tuple[str, str], typer.Option(help="Stiffness, and force at no lift.")] = (
        "0",
        "0",
    ),
    gravity: Annotated[str, typer.Option(help="Downwards, m/s^2.")] = "9.81",
    step: Annotated[str, typer.Option(help="Step of the angle in the table.")] = "1 deg",
    cutter_radius: Annotated[str | None, typer.Option(help="Adds the path of a cutter.")] = None,
    unit: Annotated[str, typer.Option(help="Of the drawing: mm, cm, m, in or ft.")] = "mm",
    as_json: AsJson = False,
) -> None:
    """Design a cam; write its case, a drawing (DXF), a table (CSV) and a figure."""
    from kempe.base import files
    from kempe.design import cam as made
    from kempe.design import read_programme
    from kempe.plot import save
    from kempe.plot.cam import cam_pages

    sizes: dict[str, Any] = {"base_radius": base_radius, "roller_radius": roller_radius}
    sizes |= {"offset": offset, "arm": arm, "pivot": pivot, "face": face, "closure": closure}
    sizes |= {"direction": direction, "speed": speed, "mass": mass, "spring": spring}
    with document(as_json) as content:
        folder = files.checked_path(output or Path("out") / stem(file) / "cam", "write")
        found = made(follower, read_programme(file), gravity=gravity, **sizes)
        console = answers(silent=as_json)
        console.print(Text(repr(found)[1:-1]))
        table(console, ["", "", ""], _rows(found))
        for remark in found.remarks:
            console.print(Text(f"  {remark}"))
        written = save(cam_pages(found), folder / "figures")
        if not found.undercut:
            written = [*_write(found, folder, step, cutter_radius, unit), *written]
        list_files(console, written)
        content.update({**_summary(found), "files": [str(path) for path in written]})


def _rows(of: Cam) -> list[list[str]]:
    return [
        ["largest lift", figure(of.programme.size), of.programme.unit],
        ["largest pressure angle", f"{degrees(of.largest_pressure_angle):.2f}", "°"],
        ["least radius of curvature", figure(of.least_radius_of_curvature), "m"],
        ["lift-off speed", figure(of.lift_off_speed), "rad/s"],
    ]


def _write(of: Cam, folder: Path, step: str, cutter: str | None, unit: str) -> list[Path]:
    """The case, the drawing and the table."""
    case, drawing, rows = (folder / f"cam.{ending}" for ending in ("toml", "dxf", "csv"))
    of.case.save(case)
    of.write_dxf(drawing, cutter_radius=cutter, unit=unit)
    of.write_csv(rows, step=step, cutter_radius=cutter)
    return [case, drawing, rows]


def _summary(of: Cam) -> dict[str, Any]:
    """The numbers in SI units and rad."""
    return {
        "lift": of.programme.size,
        "pressure_angle": of.largest_pressure_angle,
        "radius_of_curvature": of.least_radius_of_curvature,
        "lift_off_speed": of.lift_off_speed,
        "undercut": [list(part) for part in of.undercut],
        "remarks": list(of.remarks),
    }
