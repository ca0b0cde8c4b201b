"""Results: the JSON of the program behind attributes."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any, List, Mapping


class Result:
    """A result of the program. It cannot be changed.

    Each field of its JSON, as the program prints it, is an attribute; a list is a tuple.
    """

    report: Mapping[str, Any]
    """Its JSON."""
    text: str
    """Its text."""

    def __init__(self, report: Mapping[str, Any], text: str, **more: Any) -> None:
        fields = {name: tuple(value) if isinstance(value, list) else value for name, value in report.items()}
        vars(self).update(fields, report=report, text=text, **more)

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a {type(self).__name__} cannot be changed")

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and vars(self) == vars(other)

    def __hash__(self) -> int:
        return hash(self.text)

    def __dir__(self) -> List[str]:
        return [name for name in super().__dir__() if not name.startswith("_") or name.startswith("__")]

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.text.strip().splitlines()[0]}>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"


class Judged(Result):
    """A result that is good or bad."""

    def _is_good(self) -> bool:
        raise NotImplementedError

    def _repr_html_(self) -> str:
        color = "#1a7f37" if self._is_good() else "#b42318"
        return f'<pre style="border-left:4px solid {color};padding-left:1em">{html.escape(self.text)}</pre>'
