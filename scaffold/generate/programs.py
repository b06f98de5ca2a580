"""Renders built-in templates without Jinja, whose import alone takes longer than they do.

Jinja parses a template once, `scaffold.generate.translate` makes Python of it, and the user's
cache keeps that. What is not translated, and whatever fails, is left to Jinja: its text or its
error is the one that counts.
"""

from __future__ import annotations

import marshal
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from importlib.util import find_spec
from types import CodeType
from typing import Any

from scaffold import cache
from scaffold.errors import ScaffoldError
from scaffold.generate import filters
from scaffold.generate.sources import Sources
from scaffold.model.disk import digest, stamp

Program = Callable[[dict[str, Any], "Around"], str]
_Kept = dict[str, tuple[str, bytes]]
"""The stamp of its file and the code of each template; none for one that is left to Jinja."""

_MOST = 16
"""Installations and forms of comments whose programs are kept."""
_TEXT = "text "
"""In front of a short text that is a template itself."""


class NotTranslatedError(Exception):
    """Jinja has to render this."""


class Programs:
    """The built-in templates as Python.

    Args:
        sources: Their texts.
        globals_: What all of them may use.
        translate: Returns the code of a template by its name and its text; raises
            `NotTranslatedError`. It is the one that imports Jinja.
    """

    def __init__(
        self,
        sources: Sources,
        globals_: Mapping[str, Any],
        translate: Callable[[str, str], CodeType],
    ) -> None:
        self._sources = sources
        self._globals = {**globals_, "dict": dict, "range": range}
        self._translate = translate
        self._programs: dict[str, Program] = {}
        self._place, self._head = _slot(sources)
        data = cache.read_sealed(self._place, self._head) if self._place else None
        self._kept: _Kept = {} if data is None else marshal.loads(data)  # noqa: S302  own files

    def render(
        self, name: str, context: Mapping[str, Any], shown: Callable[[Any], str]
    ) -> str | None:
        """Return the text that a template gives; ``None`` if Jinja is to be asked.

        Args:
            name: Of its file, or what `named` returned.
            context: The variables.
            shown: Makes text of a value.
        """
        try:
            return self.run(name, {**self._globals, **context}, Around(self, self._globals, shown))
        except ScaffoldError:
            raise
        except Exception:  # noqa: BLE001  Jinja says what is wrong, and where
            return None

    @staticmethod
    def named(text: str) -> str:
        """Return the name of a short text."""
        return _TEXT + text

    def run(self, name: str, scope: dict[str, Any], around: Around) -> str:
        """Run a template in a scope, which then holds what it has set."""
        program = self._programs.get(name)
        if program is None:
            namespace: dict[str, Any] = {}
            exec(self._code(name), namespace)  # noqa: S102  made of the built-in templates
            program = self._programs[name] = namespace["render"]
        return program(scope, around)

    def _code(self, name: str) -> CodeType:
        is_text = name.startswith(_TEXT)
        path = "" if is_text else self._sources.find(name)
        if path is None:
            raise NotTranslatedError(name)
        now = stamp(path) if path else ""
        then, data = self._kept.get(name, (None, b""))
        if then != now:
            text = name.removeprefix(_TEXT) if is_text else self._sources.read(name)
            try:
                data = marshal.dumps(self._translate(name, text))
            except NotTranslatedError:
                data = b""
            self._keep(name, now, data)
        if not data:
            raise NotTranslatedError(name)
        code: CodeType = marshal.loads(data)  # noqa: S302  own files
        return code

    def _keep(self, name: str, now: str, data: bytes) -> None:
        self._kept[name] = now, data
        if self._place and cache.write_sealed(self._place, self._head, marshal.dumps(self._kept)):
            cache.trim(os.path.dirname(self._place), _MOST)


def _slot(sources: Sources) -> tuple[str, bytes]:
    """Return where programs are kept, empty for nowhere, and what they depend on."""
    kept = cache.directory("programs")
    if kept is None:
        return "", b""
    here = os.path.dirname(__file__)
    jinja = find_spec("jinja2")
    own = [os.path.join(here, name) for name in ("programs.py", "translate.py")]
    parts = [sys.version, *map(stamp, [*own, (jinja and jinja.origin) or ""])]
    place = digest(os.fsencode(f"{here} {sources.is_tutorial}"))
    head = b"scaffold-programs-1\n" + digest("\n".join(parts).encode()).encode()
    return os.path.join(kept, place), head


class Around:
    """What a program finds around it: other templates, and what Jinja does with values.

    Args:
        programs: The templates.
        globals_: What all of them may use.
        shown: Makes text of a value.
    """

    def __init__(
        self, programs: Programs, globals_: Mapping[str, Any], shown: Callable[[Any], str]
    ) -> None:
        self._programs = programs
        self._globals = globals_
        self.shown = shown
        self.filters = FILTERS
        self.loop = Loop
        self.nothing = Nothing()

    def included(self, name: str, scope: dict[str, Any]) -> str:
        """Return the text of another template, which sees the variables."""
        return self._programs.run(name, scope.copy(), self)

    def module(self, name: str, scope: dict[str, Any] | None) -> Names:
        """Return what another template sets; it sees the variables of a scope, if there is one."""
        inside = dict(self._globals if scope is None else scope)
        self._programs.run(name, inside, self)
        return Names(inside)

    @staticmethod
    def bound(
        names: Sequence[str],
        needed: Sequence[str],
        given: Sequence[Any],
        named: Mapping[str, Any],
    ) -> dict[str, Any]:
        """Return the arguments of a macro by name."""
        found = {**dict(zip(names, given, strict=False)), **named}
        known = len(given) + len(named) == len(found) and found.keys() <= set(names)
        if not known or not found.keys() >= set(needed):
            raise NotTranslatedError
        return found

    @staticmethod
    def attribute(value: Any, name: str) -> Any:  # noqa: ANN401  whatever a template has
        """Return an attribute, or else an item, as Jinja does."""
        try:
            return getattr(value, name)
        except AttributeError:
            try:
                return value[name]
            except TypeError:
                raise LookupError(name) from None

    @staticmethod
    def item(value: Any, key: Any) -> Any:  # noqa: ANN401  whatever a template has
        """Return an item, or else an attribute, as Jinja does."""
        if isinstance(value, Names):
            return getattr(value, key)
        return value[key]

    @staticmethod
    def defined(look: Callable[[], object]) -> bool:
        """Tell whether there is an attribute or an item."""
        try:
            look()
        except (AttributeError, LookupError):
            return False
        return True


class Nothing:
    """What an ``if`` without ``else`` gives when it is not so."""

    def __str__(self) -> str:
        return ""

    def __len__(self) -> int:
        return 0

    def __iter__(self) -> Iterator[object]:
        return iter(())


class Loop:
    """What a loop tells its body.

    Args:
        index0: The number of the round, from 0.
        length: How many there are.
    """

    def __init__(self, index0: int, length: int) -> None:
        self.index0 = index0
        self.index = index0 + 1
        self.first = index0 == 0
        self.last = self.index == length
        self.length = length


class Names:
    """What a template sets, by attribute."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401  whatever a template has
        try:
            return self._values[name]
        except KeyError:
            raise AttributeError(name) from None


# -- the filters of Jinja that the built-in templates use


def _folded(value: object) -> object:
    return value.lower() if isinstance(value, str) else value


def _indent(text: str, width: int = 4, *, first: bool = False) -> str:
    margin = " " * width
    top, *rest = f"{text}\n".splitlines()
    lines = [margin + top if first else top, *(line and margin + line for line in rest)]
    return "\n".join(lines)


def _join(values: Iterable[object], between: str = "") -> str:
    return between.join(map(str, values))


def _replace(text: str, old: str, new: str) -> str:
    return text.replace(old, new)


def _sort(values: Iterable[Any]) -> list[Any]:
    return sorted(values, key=_folded)  # type: ignore[arg-type]  # Jinja compares them, too


def _minimum(values: Iterable[Any]) -> Any:  # noqa: ANN401  one of them
    return min(values, key=_folded)  # type: ignore[arg-type]  # likewise


def _maximum(values: Iterable[Any]) -> Any:  # noqa: ANN401  one of them
    return max(values, key=_folded)  # type: ignore[arg-type]  # likewise


def _having(values: Iterable[Any], name: str) -> list[Any]:
    return [one for one in values if Around.attribute(one, name)]


def _lacking(values: Iterable[Any], name: str) -> list[Any]:
    return [one for one in values if not Around.attribute(one, name)]


def _reject(values: Iterable[Any], test: str, among: Any) -> list[Any]:  # noqa: ANN401  a container
    if test != "in":
        raise NotTranslatedError(test)
    return [one for one in values if one not in among]


def _trim(text: str) -> str:
    return text.strip()


FILTERS: Mapping[str, Callable[..., object]] = {
    "indent": _indent,
    "join": _join,
    "length": len,
    "list": list,
    "literal": filters.literal,
    "markdown": filters.markdown,
    "max": _maximum,
    "min": _minimum,
    "reject": _reject,
    "rejectattr": _lacking,
    "replace": _replace,
    "selectattr": _having,
    "slashes": filters.slashes,
    "sort": _sort,
    "trim": _trim,
    "xml": filters.xml,
}
