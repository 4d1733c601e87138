"""Former names work and warn at the line of the user, as docs/promise.md states."""

import inspect
import warnings

import kempe as kp
import pytest
from kempe._compact import call
from kempe.base.arguments import ArgumentError, explained
from kempe.base.deprecation import former, former_since, removal, renamed


@renamed("0.3", strength="stiffness", loss="damping")
@explained
def rate(mass: float, *, stiffness: float, damping: float = 0.5) -> tuple[float, float, float]:
    return mass, stiffness, damping


class Thing:
    @former("0.3", "thing.size")
    def length(self) -> float:
        """Its length, m."""
        return 2.0


def test_a_former_argument_works_and_warns_at_the_line_of_the_user() -> None:
    with pytest.warns(DeprecationWarning) as caught:
        assert rate(1, strength=2, loss=3) == (1, 2, 3)
    line = inspect.currentframe().f_lineno - 1  # type: ignore[union-attr]
    assert [(one.filename, one.lineno) for one in caught] == [(__file__, line)] * 2
    assert str(caught[0].message) == (
        "rate: the argument 'strength' is deprecated since version 0.3: write 'stiffness'; "
        "version 0.4 may refuse it"
    )


def test_present_arguments_give_no_warning() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert rate(1, stiffness=2) == (1, 2, 0.5)


def test_both_names_at_once_are_refused_and_the_remedy_works() -> None:
    with pytest.raises(kp.ModelError, match=r"'strength' is the former name of 'stiffness'.*") as e:
        rate(1, strength=2, stiffness=2)
    assert "leave out 'strength'" in str(e.value)
    assert rate(1, stiffness=2) == (1, 2, 0.5)


def test_unknown_arguments_are_refused_as_before() -> None:
    with pytest.raises(ArgumentError, match="unknown argument 'stifness'"):
        rate(1, stifness=2)  # type: ignore[call-arg]


def test_a_former_method_works_and_warns() -> None:
    with pytest.warns(DeprecationWarning, match=r"length is deprecated .*: write thing\.size"):
        assert Thing().length() == 2.0
    assert Thing.length.__doc__ == "Its length, m."


def test_a_former_public_name_works_and_warns(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(kp._FORMER, "simulate_it", ("dynamics", "0.3"))
    with pytest.warns(DeprecationWarning, match=r"write kempe\.dynamics; version 0\.4 may"):
        assert kp.simulate_it is kp.dynamics  # type: ignore[attr-defined]


def test_the_states_mark_former_names() -> None:
    assert former_since(rate) == former_since(Thing.length) == "0.3"
    assert former_since(kp.dynamics) is None
    assert call("rate", rate).endswith("damping=0.5), former since 0.3")


def test_a_name_of_no_argument_is_a_fault_of_the_code() -> None:
    with pytest.raises(ValueError, match="rate has no argument 'x'"):
        renamed("0.3", y="x")(rate)


def test_no_former_name_has_outlived_its_version() -> None:
    present = tuple(map(int, kp.__version__.split(".")[:2]))
    for name, (new, since) in kp._FORMER.items():
        assert name not in kp.__all__ and new in kp.__all__, name
        assert tuple(map(int, removal(since).split("."))) > present, f"remove kempe.{name}"
