"""A small set of results in the format of the benchmarks."""

from typing import Any

import pytest
from record import Record


def record(tool: str, curve: str, tolerance: float, ms: float, error: float) -> dict[str, Any]:
    made = Record("flagship", tool, curve, tolerance, 1e-3 * ms, 5, error, 1e-12)
    made.more = {"angle_error": error}
    return made.json()


@pytest.fixture
def results() -> dict[str, Any]:
    evaluation = {"chain_ns": 100.0, "straight_ns": 150.0, "kempe_ns": 150.0, "other_ns": 255.0}
    evaluation |= {"kempe_over_chain": 1.5, "kempe_over_straight": 1.0, "other_over_kempe": 1.7}
    evaluation |= {"centred_ns": 240.0, "centred_over_kempe": 1.6}
    run = {"seconds": 1e-3, "ns_per_evaluation": 100.0, "error_rad": 1e-8}
    runs = [{"chain": run, "straight": run, "kempe": run, "rtol": 1e-6}] * 3
    lost = Record("flagship", "exudyn", "Exudyn generalized-alpha", 1e-3, failure="it stopped")
    return {
        "date": "2000-01-01",
        "machine": {"processor": "P", "cores": 2, "system": "S", "python": "3"},
        "versions": {"kempe": "1", "scipy": "2"},
        "missing": {"numba": "numba is not installed here"},
        "tried": {"kempe": "all"},
        "repeat": 5,
        "floor": {
            "evaluation": evaluation,
            "windows": {"10": 100.0, "100": 100.0, "1000": 140.0, "4000": 500.0},
            "runs": runs,
            "native": {"evaluation": evaluation, "runs": runs},
            "python": {"kempe_seconds": 2e-3, "chain_seconds": 1e-3, "straight_seconds": 1.5e-3},
        },
        "records": [
            record("kempe", "kempe default", 0.0, 2.0, 1e-7),
            record("kempe", "kempe default, states", 0.0, 1.0, 1e-7),
            record("kempe", "kempe RK45, Baumgarte", 1e-3, 1.0, 1e-4),
            record("scipy", "scipy RK45, Baumgarte", 1e-3, 2000.0, 1e-4),
            record("scipy", "scipy RK45, Baumgarte", 1e-6, 6000.0, 1e-8),
            record("mujoco", "MuJoCo RK4", 1e-3, 0.5, 1e-5),
            record("casadi", "CasADi CVODES BDF", 1e-8, 50.0, 1e-7),
            lost.json(),
        ],
    }
