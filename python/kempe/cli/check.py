"""``kempe check``: read a case and assemble its mechanism."""

from __future__ import annotations

from rich.text import Text

from kempe.cli.arguments import File, Settings, assembled, read_case
from kempe.cli.console import answers

EXAMPLES = """Examples:

  kempe check four_bar.toml --set L2=27
"""


def check(file: File, settings: Settings = None) -> None:
    """Read a case, assemble its mechanism and show the configuration, without a simulation."""
    from kempe.cli.mechanism import show_configuration, show_mechanism

    case = read_case(file, settings)
    state = assembled(case)
    console = answers()
    show_mechanism(console, state)
    show_configuration(console, state)
    analyses = ", ".join(f"{name} ({entry['type']})" for name, entry in case.analyses.items())
    console.print()
    console.print(Text(f"{file}: OK; analyses: {analyses or 'none'}"))
