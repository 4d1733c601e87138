"""A case with names that would become tags, attributes or styles wherever they were not escaped."""

import json
from typing import Any

#: What a browser would make of a name that is not escaped: a tag, and an attribute of another tag.
TAG, ATTRIBUTE = "harm-tag", "harm"
#: Endings of everything that contains names, and then the tag.
_LONG = (
    "\"'></mtext></math></title></script></style></svg></textarea></pre>-->]]>"
    f'<{TAG}>&lt;{TAG}&gt;&amp;lt;{TAG}&amp;gt;<a/href="/x">\' {ATTRIBUTE}=1 '
)
#: Short enough for formulas, which are omitted if they are long.
_SHORT = f"\"'><{TAG}>&lt;{TAG}&gt;$_{{}}\\"


def name(of: str) -> str:
    """A hostile name of a thing that occurs in formulas; names have no dots."""
    return of + _SHORT


def long(of: str) -> str:
    """A hostile name of another thing."""
    return of + _LONG


def folder(of: str) -> str:
    """A hostile name of an analysis, which is also the name of a folder."""
    return f"{of}&lt;{TAG}&gt;' {ATTRIBUTE}=1 $x$"


def quoted(of: str, *more: str) -> str:
    """A hostile name in a formula, followed by names without quotes."""
    return ".".join((f"`{name(of)}`", *more))


_A, _B, _C, _D = (f".{name(k)}" for k in "ABCD")
_CRANK, _COUPLER, _ROCKER, _BEAD = (name(k) for k in ("crank", "coupler", "rocker", "bead"))


def _bar(length: float, ends: str, **more: Any) -> dict[str, Any]:
    return {"type": "bar", "mass": 1, "length": length, "ends": [name(k) for k in ends], **more}


def _bodies() -> dict[str, Any]:
    slot = {name("slot"): {"circle": [0, 0, 0.5]}}
    return {
        "ground": {"points": {name("A"): [0, 0], name("D"): [4, 0]}},
        _CRANK: _bar(1, "AB"),
        _COUPLER: _bar(4, "BC", curves=slot),
        _ROCKER: _bar(3, "CD"),
        _BEAD: {"mass": 0.1, "inertia": 0.01, "points": {name("P"): [0, 0]}},
    }


def _joints() -> dict[str, Any]:
    ring = {"i": f"{_BEAD}.{name('P')}", "curve": f"{_COUPLER}.{name('slot')}"}
    return {
        name("pin A"): {"type": "revolute", "i": "ground" + _A, "j": _CRANK + _A},
        name("pin B"): {"type": "revolute", "i": _CRANK + _B, "j": _COUPLER + _B},
        name("pin C"): {"type": "revolute", "i": _COUPLER + _C, "j": _ROCKER + _C},
        name("pin D"): {"type": "revolute", "i": "ground" + _D, "j": _ROCKER + _D},
        name("ring"): {"type": "point_on_curve", **ring},
    }


def _drivers() -> dict[str, Any]:
    laws = {
        "motor": (f"{_CRANK}.angle", "0.5 + rate*t"),
        "slip": (f"{_BEAD}.x", f"{quoted('coupler', 'x')} + 0.3"),
        "turn": (f"{_BEAD}.angle", f"0.1*{quoted('crank', 'angle')}"),
    }
    return {
        long(of): {"type": "coordinate_driver", "coordinate": coordinate, "value": value}
        for of, (coordinate, value) in laws.items()
    }


def _forces() -> dict[str, Any]:
    spring = {"i": "ground", "j": _ROCKER, "stiffness": "k", "damping": 1}
    strut = {"i": "ground" + _A, "j": _COUPLER + _C, "stiffness": "10*k", "free_length": 2}
    return {
        long("spring"): {"type": "torsion_spring", **spring},
        long("strut"): {"type": "spring_damper", **strut},
    }


def tree() -> dict[str, Any]:
    """A driven four-bar linkage with springs and a bead; all names that can be hostile are."""
    events = {long("passes"): f"{quoted('crank', 'angle')} - 0.6"}
    run = {"type": "dynamics", "t_end": 0.2, "output_step": 0.02, "events": events}
    return {
        "kempe": 1,
        "title": long("Title. "),
        "gravity": [0, -9.81],
        "parameters": {"k": 3, "rate": 2},
        "bodies": _bodies(),
        "joints": _joints(),
        "drivers": _drivers(),
        "forces": _forces(),
        "measures": {
            long("load"): quoted("pin C", "force"),
            long("swing"): quoted("rocker", "angle"),
        },
        "analyses": {
            folder("run"): run,
            folder("freedom"): {"type": "mobility", "from": "start"},
            folder("modes"): {"type": "modes", "from": "start"},
        },
    }


def text() -> str:
    """The case as JSON."""
    return json.dumps(tree())


#: What the payload has become in a page: tags, attributes, links that lead elsewhere.
HARM = f"""() => {{
  const found = [];
  const look = (root) => {{
    for (const one of root.querySelectorAll("*")) {{
      if (one.localName === "{TAG}") found.push(`tag in ${{one.parentNode.localName}}`);
      if (one.hasAttribute("{ATTRIBUTE}")) found.push(`attribute of ${{one.localName}}`);
      const link = one.getAttribute("href") ?? one.getAttribute("xlink:href");
      if (one.localName === "a" && link && !link.startsWith("#")) found.push(`link ${{link}}`);
    }}
  }};
  look(document);
  return [...new Set(found)];
}}"""
