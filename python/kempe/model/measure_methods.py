"""The measures of a model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from kempe.model.values import refuse


class MeasureMethods:
    """Methods of a model that concern measures."""

    _tree: dict[str, Any]

    def _changed(self) -> None:
        raise NotImplementedError

    def _refuse_taken(self, of: str, name: str) -> None:
        raise NotImplementedError

    def measures(
        self, expressions: Mapping[str, str] | None = None, /, **named: str
    ) -> Mapping[str, str]:
        """Add measures, named expressions of quantities: ``m.measures(pin="C.force")``.

        ``sol["pin"]`` contains the values, ``sol.measure("pin")`` the statistics. An expression may
        use all quantities, parameters, tables and t, but no other measure.

        Args:
            expressions: measures by name, for names that are not Python identifiers.
            **named: measures by name.

        Returns:
            All measures of the model.

        Raises:
            ModelError: an expression is not a text, or a name is taken.
        """
        for name, expression in {**(expressions or {}), **named}.items():
            if not isinstance(name, str):
                refuse("measures", f"the name {name!r} is not a text")
            if not isinstance(expression, str):
                refuse(f"measures.{name}", f"{expression!r} is not an expression, as 'C.force' is")
            self._refuse_taken("measures", name)
            self._tree["measures"][name] = expression
            self._changed()
        return dict(self._tree["measures"])
