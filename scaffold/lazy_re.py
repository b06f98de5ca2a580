"""Regular expressions that are compiled at their first use.

Compiling one takes 0.2 ms, and `check` imports modules with more than two hundred of them, of which
a run of a small package, or after the edit of a file, uses a quarter.
"""

from __future__ import annotations

TYPE_CHECKING = False  # importing that of typing would take longer
if TYPE_CHECKING:
    import re
    from typing import Any, AnyStr


class _LazyPattern:
    """A pattern, for callers of its methods a ``re.Pattern``."""

    def __init__(self, text: str | bytes, flags: int) -> None:
        self._text = text
        self._flags = flags

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401  of the compiled pattern
        from re import compile as compile_now

        if name.startswith("__"):
            raise AttributeError(name)
        # The later uses find the compiled pattern, and then its method, without this function.
        compiled = self._compiled = compile_now(self._text, self._flags)
        value = self.__dict__[name] = getattr(compiled, name)
        return value


def compile(text: AnyStr, flags: int = 0) -> re.Pattern[AnyStr]:  # noqa: A001  as that of re
    """Return a pattern, for the constants of modules."""
    return _LazyPattern(text, flags)  # type: ignore[return-value]  # it has the same attributes
