"""Slopes of the quantities of one run over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from kempe.base.arrays import Floats, fixed
from kempe.base.names import entry
from kempe.case import Case
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.functions import refuse_derivatives
from kempe.model.measure_infos import measure_info
from kempe.model.model import Model
from kempe.model.values import texts
from kempe.results.origin import Origin
from kempe.results.state import State
from kempe.sweeps.gradients.run import in_analyses
from kempe.sweeps.numbers import driven_model
from kempe.sweeps.plan import Plan
from kempe.sweeps.variables import check_names, present


@dataclass(frozen=True)
class SlopesAlong:
    """The slopes of a run, computed when a quantity is read.

    Attributes:
        plan: the run as the last analysis of a case, and the variables.
        row: (n_variables,), the values of the variables.
        origin: the recipe of the end of the run.
    """

    plan: Plan
    row: Floats
    origin: Origin
    _known: dict[str, Floats] = field(default_factory=dict)

    @classmethod
    def of(
        cls, model: CompiledModel, start: State, run: Mapping[str, Any], variables: Sequence[str]
    ) -> SlopesAlong:
        """The slopes of a run; everything is checked, and nothing is computed.

        Raises:
            ModelError: a variable is invalid, a law is a Python function, an analysis depends on a
                variable, or it is not known how the start depends on the variables.
        """
        names = tuple(texts(variables, "slopes"))
        refuse_derivatives(model.functions)
        if start.origin is None:
            raise ModelError(
                "slopes: it is not known how the start depends on the variables",
                hint="start from kp.assemble(model, set=…), or from the final state of a run that "
                "has slopes",
            )
        origin = start.origin.then(run)
        made = {"set": dict(origin.set), "guess": dict(origin.guess)}
        own = model.model if model.functions else Model.of_compiled(model)
        case = Case(own, made, origin.analyses)
        check_names(case, names)
        plan = Plan(case, list(origin.analyses)[-1], names, ())
        row = fixed(list(present(case, names).values()))
        for of, told in in_analyses(plan, row).items():
            raise ModelError(f"slopes: {names[of]}: {told}", name=names[of])
        return cls(plan, row, origin)

    @property
    def variables(self) -> dict[str, float]:
        """The variables and their values."""
        return dict(zip(self.plan.names, self.row.tolist(), strict=True))

    @property
    def _run(self) -> Mapping[str, Any]:
        return self.plan.case.analyses[self.plan.analysis]

    def read(self, quantity: str, variable: str, t: Floats) -> Floats:
        """The derivative of a quantity by a variable at the times of the run, (n_t,)."""
        names = {name: k for k, name in enumerate(self.plan.names)}
        column = entry("variable of the slopes", variable, names)
        if quantity not in self._known:
            model, over = self.plan.case.model.compile(), self._run.get("over")
            if over is not None:
                model, _ = driven_model(model, over)
            measure = model.measures.get(quantity) or measure_info(model, quantity)
            _, slopes = self.plan.slopes_at([measure.expression], t, self.row)
            self._known[quantity] = fixed(slopes[:, 0])
        return self._known[quantity][:, column]
