"""``kempe studio``: the page that draws, moves and simulates mechanisms, in a browser."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from kempe.cli.console import remarks

EXAMPLES = """Examples:

  kempe studio

  kempe studio four_bar.toml

  kempe studio --export lecture four_bar.toml

  kempe studio --build
"""


def studio(
    file: Annotated[
        Path | None, typer.Argument(help="A case as TOML or JSON that the page opens.")
    ] = None,
    export: Annotated[
        Path | None,
        typer.Option(
            "--export", metavar="DIR", help="Write the page to DIR/index.html and serve nothing."
        ),
    ] = None,
    port: Annotated[
        int, typer.Option("--port", min=0, max=65535, help="The port; 0 for a free one.")
    ] = 0,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Whether to open a browser.")
    ] = True,
    build: Annotated[
        bool,
        typer.Option(
            "--build", help="Build the page of the present sources first; for a checkout of kempe."
        ),
    ] = False,
) -> None:
    """Draw a linkage in a browser, drag its crank, let it go.

    The page is served on this machine only, until Ctrl-C. It loads no files from other hosts and
    sends no data.
    """
    from kempe.studio import page, sources
    from kempe.studio.build import build as build_page
    from kempe.studio.case_text import case_text

    text = None if file is None else case_text(file)
    if build:
        build_page()
    now = sources.checksum()
    chosen = page.choose(now)
    _name(chosen.version, chosen.sources, now)
    if export is not None:
        remarks().print(f"written: {chosen.export(export, text)}")
        return
    _serve(chosen.opening(text), port, browser)


def _name(version: str, built_from: str, now: str | None) -> None:
    remarks().print(f"studio: the page of kempe {version}, built from sources {built_from}")
    if now not in {None, built_from}:
        remarks().print(
            f"studio: this checkout has other sources, {now}; "
            "kempe studio --build builds their page"
        )


def _serve(page: str, port: int, browser: bool) -> None:
    from kempe.errors import FileError
    from kempe.studio.server import HOST, Server

    try:
        server = Server(page, port)
    except OSError as error:
        raise FileError(
            f"port {port} of {HOST}: {error.strerror or error}", hint="choose another --port"
        ) from error
    with server:
        remarks().print(f"{server.address}  (Ctrl-C ends the server)")
        if browser:
            webbrowser.open(server.address)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            return
