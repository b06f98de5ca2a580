"""The Jinja sandbox: no Python internals, no other files, no endless loops."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

from jinja2.exceptions import SecurityError
from jinja2.runtime import Context
from jinja2.sandbox import ImmutableSandboxedEnvironment

from scaffold.errors import ContentError

_MAX_ROUNDS = 1_000_000
"""The total length of all ranges in the files of a package."""
_MAX_REPEATED = 1_000_000
"""The maximum length of a repeated text or list, and of the digits of a power."""


class Sandbox(ImmutableSandboxedEnvironment):
    """Jinja's sandbox, with limits on loops and on operations that multiply data."""

    intercepted_binops = frozenset({"*", "**"})

    def __init__(self, *arguments: Any, **options: Any) -> None:  # noqa: ANN401  those of Jinja
        super().__init__(*arguments, **options)
        self._rounds = 0
        self.globals["range"] = self._range

    def _range(self, *arguments: int) -> range:
        result = range(*arguments)
        self._rounds += len(result)
        if self._rounds > _MAX_ROUNDS:
            raise SecurityError(f"more than {_MAX_ROUNDS} iterations of loops")
        return result

    def call_binop(
        self,
        context: Context,
        operator: str,
        left: Any,  # noqa: ANN401  as Jinja has it
        right: Any,  # noqa: ANN401
    ) -> Any:  # noqa: ANN401
        """Multiply, or raise to a power, within the limit."""
        if operator == "**" and _size(left) * abs(right) > _MAX_REPEATED:
            raise SecurityError("a power is too large")
        if operator == "*":
            for some, times in ((left, right), (right, left)):
                if hasattr(some, "__len__") and len(some) * times > _MAX_REPEATED:
                    raise SecurityError("a repetition is too large")
        return super().call_binop(context, operator, left, right)


def _size(number: Any) -> int:  # noqa: ANN401  whatever a template computes with
    return number.bit_length() if isinstance(number, int) else 1


def refuse_outside(path: str, places: Iterable[str]) -> None:
    """Raise if the real path of a file is not below one of some directories.

    Raises:
        ContentError: it is elsewhere.
    """
    real = os.path.realpath(path)
    if not any(real.startswith(os.path.realpath(place) + os.sep) for place in places):
        raise ContentError(f"{path}: a link to {real}, outside of the templates")


def refuse_leaving(path: str, where: str) -> None:
    """Raise if the path of a rendered file leaves the package.

    Raises:
        ContentError: it does, or is no valid path.
    """
    parts = path.split("/")
    if "\0" in path or not all(parts) or {".", ".."} & set(parts):
        raise ContentError(f"{where}: {path!r} is not a path inside the package")
