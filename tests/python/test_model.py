"""Building a model in Python: accepted values, refused values and their messages."""

import warnings
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kempe import _core, _generate
from kempe.model import elements


def test_the_dimensions_of_the_flagship(model: kp.Model) -> None:
    assert (model.n_q, model.n_rows) == (9, 8)
    assert list(model.bodies) == ["crank", "coupler", "rocker"]
    assert list(model.joints) == ["A", "B", "C", "D"]
    assert list(model.forces) == ["spring"]
    assert model.bodies["rocker"].inertia == pytest.approx(4 * 18**2 / 12)
    assert model.bodies["rocker"].points["C"] == pytest.approx((-9, 0))
    assert model.joints["C"].rows == slice(4, 6)
    assert model.forces["spring"].parts == ("stiffness", "damping")
    assert model.gravity == (0.0, -9.81)
    assert model.parameters["k"] == 1e6


@pytest.mark.parametrize("place", [(0.25, -3.0), (-1e3, 2.0)])
def test_what_an_element_lacks_is_zero(place: tuple[float, float]) -> None:
    m = kp.Model("pair")
    m.ground.points(A=place)
    for name in ("one", "two"):
        m.body(name, mass=7, inertia=3, center=(0.5, 0.25), points={"P": (2, -1)})
        m.revolute(f"pin_{name}", "ground.A", f"{name}.P")
    m.coordinate_driver("motor", "one.angle", value="t")
    m.coupling("twice", terms={"one.angle": 2, "two.angle": -1})
    infos = {**m.compile().constraints}
    assert (infos["pin_one"].point_i, infos["pin_one"].point_j) == (place, (2.0, -1.0))
    for name in ("motor", "twice"):
        assert (infos[name].point_i, infos[name].point_j) == ((0.0, 0.0), (0.0, 0.0))
    ground, one = m.compile().all_bodies["ground"], m.bodies["one"]
    assert (ground.mass, ground.inertia, ground.center) == (0.0, 0.0, (0.0, 0.0))
    assert (one.mass, one.inertia, one.center) == (7.0, 3.0, (0.5, 0.25))


@pytest.mark.parametrize(
    ("entry", "kind"),
    [(3, "a number"), ("x", "a text"), ([1, 2], "a list"), (True, "true or false")],
)
def test_an_element_that_is_no_table_is_refused(entry: object, kind: str) -> None:
    with pytest.raises(kp.ModelError, match=f"forces.f: {kind}; must be a table with fields"):
        kp.Model.from_tree({"forces": {"f": entry}}).compile()


NEGATIVE = [(-2.5, 1), (4, -1e-3), (-1, -7), (0, 0), (3, 2)]


@pytest.mark.parametrize(("stiffness", "damping"), NEGATIVE)
def test_a_negative_stiffness_or_damping_is_doubted(stiffness: float, damping: float) -> None:
    m = kp.Model("rod", parameters={"k": stiffness, "c": damping})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "B"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("s", "ground", "rod", stiffness="k", damping=damping)
    expected = set()
    if damping < 0:
        expected |= {f"forces.s.damping is negative, {damping:g}: it adds energy"}
    if stiffness < 0:
        expected |= {f"forces.s.stiffness is negative, {stiffness:g}: it pushes away from rest"}
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        m.compile()
    texts = {str(one.message) for one in told if issubclass(one.category, kp.ModelWarning)}
    assert texts == expected


def test_the_repr_lists_the_elements(model: kp.Model) -> None:
    assert "crank, coupler, rocker" in repr(model)
    assert "spring" in repr(model)


def test_the_compiled_model_is_kept_until_a_change(model: kp.Model) -> None:
    first = model.compile()
    assert model.compile() is first
    model.ground.points(E=(1, 2))
    second = model.compile()
    assert second is not first
    assert second.all_bodies["ground"].points["E"] == (1.0, 2.0)


def test_other_parameters_do_not_change_the_model(model: kp.Model) -> None:
    longer = model.with_parameters({"L1": 11})
    assert longer.bodies["crank"].points["B"][0] == pytest.approx(5.5)
    assert model.bodies["crank"].points["B"][0] == pytest.approx(5.0)


def test_an_unknown_parameter_is_refused(model: kp.Model) -> None:
    with pytest.raises(kp.ModelError, match="stiff"):
        model.with_parameters({"stiff": 1}).compile()


@pytest.mark.parametrize(
    "value", [np.float64(3), np.float32(3), np.int64(3), np.array(3.0), 3, 3.0, "1 + 2"]
)
def test_every_kind_of_number_is_accepted(value: object) -> None:
    m = kp.Model()
    m.bar("rod", mass=value, length=2, ends=("A", "B"))  # type: ignore[arg-type]
    assert m.bodies["rod"].mass == 3.0


@pytest.mark.parametrize(
    "value",
    [True, np.bool_(True), float("nan"), float("inf"), 1j, np.complex128(1), None, [], "", 10**400],
    ids=repr,
)
def test_a_wrong_number_is_refused_with_its_path(value: object) -> None:
    with pytest.raises(kp.ModelError, match=r"joints\.A\.axes\[1\]") as caught:
        kp.Model().revolute("A", "ground.A", "crank.A", axes=(0.0, value))  # type: ignore[arg-type]
    assert caught.value.problems[0].path == "joints.A.axes[1]"


@pytest.mark.parametrize("value", [1.0, "ab", (1,), (1, 2, 3), {"x": 1, "y": 2}], ids=repr)
def test_a_wrong_pair_is_refused_with_its_path(value: object) -> None:
    with pytest.raises(kp.ModelError, match=r"joints\.A\.axes"):
        kp.Model().revolute("A", "ground.A", "crank.A", axes=value)  # type: ignore[arg-type]


def test_a_function_as_a_value_is_refused_with_its_field() -> None:
    with pytest.raises(kp.ModelError, match=r"bodies\.rod\.mass: a Python function"):
        kp.Model().bar("rod", mass=abs, length=1)  # type: ignore[arg-type]


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=1e-300, max_value=1e300))
def test_numbers_reach_the_core_unchanged(mass: float) -> None:
    m = kp.Model()
    m.body("b", mass=mass, inertia=1)
    assert m.bodies["b"].mass == mass


def test_a_name_is_unique_over_all_sections(model: kp.Model) -> None:
    with pytest.raises(kp.ModelError, match=r"taken by bodies\.crank"):
        model.torsion_spring("crank", "ground", "rocker")
    with pytest.raises(kp.ModelError, match=r"taken by joints\.A"):
        model.bar("A", mass=1, length=1)
    with pytest.raises(kp.ModelError, match=r"bodies\.ground\.points\.A"):
        model.ground.points(A=(1, 1))
    assert list(model.bodies) == ["crank", "coupler", "rocker"]


@pytest.mark.parametrize("name", ["t", "pi", "deg", "ground"])
def test_a_reserved_name_is_refused(name: str) -> None:
    with pytest.raises(kp.ModelError, match="reserved"):
        kp.Model().bar(name, mass=1, length=1)


def test_an_unknown_body_is_refused_with_its_path(model: kp.Model) -> None:
    model.revolute("E", "cuopler.B", "rocker.C")
    with pytest.raises(kp.ModelError) as caught:
        model.compile()
    told = str(caught.value) + "".join(map(str, caught.value.problems))
    assert "cuopler" in told
    assert "joints.E.i" in told


def test_an_invalid_structure_is_a_model_error_not_a_file_error() -> None:
    m = kp.Model()
    m.bar("a.b", mass=1, length=1)
    with pytest.raises(kp.ModelError):
        m.compile()


def test_a_body_may_be_given_by_global_points() -> None:
    m = kp.Model()
    m.bar("rod", mass=1, through={"A": (1, 1), "B": (4, 5)})
    assert m.bodies["rod"].inertia == pytest.approx(25 / 12)


@pytest.mark.parametrize("x", [0.5, 0.0, -2.0])
def test_a_bar_between_global_points_may_have_others(x: float) -> None:
    m = kp.Model()
    points = {"M": (x, 0.25), "B": (2, 0)}  # B as its place in the bar
    m.bar("rod", mass=1, through={"A": (1, 1), "B": (4, 5)}, points=points)
    m.ground.points(A=(1, 1))
    m.revolute("A", "ground.A", "rod.A")
    state = kp.assemble(m, set={"rod.angle": 0})
    places = {name: [state[f"rod.{name}.{axis}"] for axis in "xy"] for name in "ABM"}
    assert places["A"] == pytest.approx([1, 1])
    assert places["B"] == pytest.approx([5.5, 1])
    assert places["M"] == pytest.approx([3.5 + x, 1.25])
    assert m.bodies["rod"].inertia == pytest.approx(25 / 12)


def test_the_elements_match_the_catalogue() -> None:
    written = Path(elements.__file__).read_text(encoding="utf-8")
    assert _generate.source(_core.catalogue()) == written


def test_an_element_keeps_its_fields() -> None:
    spring = kp.Model().torsion_spring("s", "ground", "rod", stiffness="2*k")
    assert (spring.stiffness, spring.damping, spring.section) == ("2*k", 0.0, "forces")
    assert spring.tree() == {
        "type": "torsion_spring",
        "i": "ground",
        "j": "rod",
        "stiffness": "2*k",
    }


def test_a_model_has_no_gravity_unless_it_is_given() -> None:
    for options in ({}, {"gravity": (0.0, -9.81)}):
        m = kp.Model("free", **options)
        m.point_mass("p", mass=2)
        weight = kp.assemble(m).matrices().Q
        assert np.asarray(weight).tolist() == ([0.0, -19.62] if options else [0.0, 0.0])
