"""axe-core finds no violation in any mode: light and dark, on a desktop and a phone."""

from pathlib import Path

import pytest
from sizes import FULL
from studio.window import Opener

AXE = Path(__file__).parents[2] / "studio" / "node_modules" / "axe-core" / "axe.min.js"
MODES = ("edit", "move", "live", "read", "design")
SIZES = {"desktop": (1280, 800), "phone": (390, 844)}


#: Each size and each set of colours at least once.
LOOKS = [("desktop", "light"), ("phone", "dark")]
OTHERS = [("desktop", "dark"), ("phone", "light")]


@pytest.mark.skipif(not AXE.exists(), reason="axe-core is missing; npm ci in studio/ fetches it")
@pytest.mark.parametrize(("size", "colours"), LOOKS + OTHERS if FULL else LOOKS)
def test_no_rule_of_access_is_violated(fresh: Opener, size: str, colours: str) -> None:
    # the policy of the page would forbid the script of axe-core
    one = fresh(*SIZES[size], color_scheme=colours, bypass_csp=True)
    assert one.call("getComputedStyle(document.body).backgroundColor") == (
        "rgb(16, 19, 23)" if colours == "dark" else "rgb(244, 245, 247)"
    )
    one.page.add_script_tag(path=AXE)
    found = {}
    for mode in MODES:
        one.mode(mode)
        one.page.wait_for_timeout(500)
        if mode == "live":
            one.page.keyboard.press("Space")
        if mode == "design":
            one.page.locator("#by-cam").click()
            one.settle()
        violations = one.call("axe.run().then(({ violations }) => violations)")
        found[mode] = [f"{each['id']}: {each['nodes'][0]['html'][:120]}" for each in violations]
    assert found == {mode: [] for mode in MODES}
