"""Cost of means and integrals in sweeps and gradients: CPU time in runs with a final value."""

from __future__ import annotations

from pathlib import Path

import kempe as kp
from gradient_cost import seconds

ROOT = Path(__file__).parents[1]
CASES = {"four_bar": "C.force", "slider_crank": "B.force", "toggle_press": "O.force"}


def main() -> None:
    """Print the ratios for three examples."""
    for name, quantity in CASES.items():
        case = kp.load(ROOT / "examples" / f"{name}.toml")
        parameter, value = next(iter(case.model.parameters.items()))

        def swept(statistic: str) -> float:
            text = [f"{quantity}.{statistic}"]  # noqa: B023
            return seconds(lambda: kp.sweep(case, {parameter: [value]}, text, workers=1))  # noqa: B023

        run = swept("final")
        told = ", ".join(f"{one} {swept(one) / run:.2f}" for one in ("max", "mean", "integral"))
        print(f"{name}: {1e3 * run:.2f} ms; {told} runs")
        for one in ("final", "mean"):
            text = [f"{quantity}.{one}"]
            taken = seconds(lambda text=text: kp.gradient(case, text, [parameter]))  # type: ignore[misc]  # noqa: B023
            print(f"  gradient of {one}: {taken / run:.1f} runs")


if __name__ == "__main__":
    main()
