"""The methods of ``Model`` that give its content as data or text."""

from __future__ import annotations

import json
from typing import Any

from kempe.model.functions import Functions, refuse_saving, without
from kempe.model.table_methods import TableMethods
from kempe.model.values import data


class TreeMethods(TableMethods):
    """The methods of ``Model`` that give its content as data or text."""

    def tree(self) -> dict[str, Any]:
        """A copy of the model as nested mappings with the structure of a case file.

        Raises:
            ModelError: a law is a Python function, which no file contains.
        """
        functions = Functions(self._tree).listed()
        return refuse_saving(functions) if functions else self.shown()

    def shown(self) -> dict[str, Any]:
        """The same with a text in the place of each Python function."""
        kept = {key: value for key, value in self._tree.items() if value not in ({}, "")}
        return {key: without(data(value)) for key, value in kept.items()}

    def json(self) -> str:
        """The tree as JSON, with the points of tables in place of their files.

        Raises:
            ModelError: a law is a Python function, which no file contains.
        """
        return json.dumps(self.with_points(self.tree()), allow_nan=False)

    def text(self) -> str:
        """The same with a text in the place of each Python function."""
        return json.dumps(self.with_points(self.shown()), allow_nan=False)
