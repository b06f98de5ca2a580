"""Parses YAML files of users, in a subset of YAML without aliases and tags.

The result consists of strings, numbers, booleans, lists and dictionaries. A date stays a string,
keys are unique strings, and aliases and tags are rejected, so that no file expands without bound,
constructs an object or is ambiguous.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NoReturn

from scaffold.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import yaml

    from scaffold.errors import ScaffoldError

MAX_BYTES = 1_000_000
MAX_DEPTH = 40
MAX_NUMBER = 40
"""The maximum length of a number; a longer one is a text with missing quotes."""

_TAG = "tag:yaml.org,2002:"
_NUMBERS = frozenset({f"{_TAG}int", f"{_TAG}float"})
_OTHERS = frozenset({f"{_TAG}bool", f"{_TAG}null"})


def read(path: str, kind: type[ScaffoldError] = InputError) -> Any:  # noqa: ANN401  what it holds
    """Return the content of a file.

    Args:
        path: The file.
        kind: The error to raise.

    Raises:
        ScaffoldError: it cannot be read or used; the message has the file and the line.
    """
    import yaml

    try:
        with open(path, "rb") as file:
            data = file.read(MAX_BYTES + 1)
    except OSError as error:
        raise kind(f"{path}: {error.strerror}") from error
    except ValueError as error:  # a NUL in the path
        raise kind(f"{path}: {error}") from error
    if len(data) > MAX_BYTES:
        raise kind(f"{path}: larger than {MAX_BYTES} bytes")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise kind(f"{path}:{line}: not UTF-8") from error
    reader = _Reader(path, kind)
    try:
        return reader.document(yaml.parse(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader)))
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = mark.line + 1 if mark is not None else 1
        raise kind(f"{path}:{line}: invalid YAML: {error.problem or error.context}") from error
    except yaml.YAMLError as error:
        raise kind(f"{path}: invalid YAML: {' '.join(str(error).split())}") from error


class _Reader:
    """Builds data from parser events."""

    def __init__(self, path: str, kind: type[ScaffoldError]) -> None:
        self._path = path
        self._kind = kind

    def document(self, events: Iterator[yaml.Event]) -> object:
        """Return the only document, ``None`` when there is none."""
        import yaml

        result: object = None
        count = 0
        for event in events:
            if isinstance(event, yaml.DocumentStartEvent):
                count += 1
                if count > 1:
                    self._refuse(event, "a second document; only one is allowed")
            elif isinstance(event, yaml.NodeEvent):
                result = self._value(event, events, 0)
        return result

    def _value(self, event: yaml.Event, events: Iterator[yaml.Event], depth: int) -> object:
        import yaml

        if depth > MAX_DEPTH:
            self._refuse(event, f"nested more than {MAX_DEPTH} levels deep")
        if isinstance(event, yaml.AliasEvent):
            self._refuse(event, f"the alias *{event.anchor}: write its value instead")
        if isinstance(event, yaml.ScalarEvent):
            return self._scalar(event)
        self._refuse_tag(event, {f"{_TAG}seq", f"{_TAG}map"})
        if isinstance(event, yaml.SequenceStartEvent):
            return self._list(events, depth + 1)
        return self._mapping(events, depth + 1)

    def _list(self, events: Iterator[yaml.Event], depth: int) -> list[object]:
        import yaml

        result: list[object] = []
        for event in events:
            if isinstance(event, yaml.SequenceEndEvent):
                break
            result.append(self._value(event, events, depth))
        return result

    def _mapping(self, events: Iterator[yaml.Event], depth: int) -> Mapping[str, object]:
        import yaml

        result: dict[str, object] = {}
        for event in events:
            if isinstance(event, yaml.MappingEndEvent):
                break
            if not isinstance(event, yaml.ScalarEvent):
                self._refuse(event, "a key that is not a string")
            if event.value == "<<" and event.implicit[0]:
                self._refuse(event, "the merge key <<: write its value instead")
            if event.value in result:
                self._refuse(event, f"the key {event.value!r} is a duplicate")
            result[event.value] = self._value(next(events), events, depth)
        return result

    def _scalar(self, event: yaml.ScalarEvent) -> object:
        """Return a text, or the value of an unquoted scalar."""
        from yaml import SafeLoader, ScalarNode

        self._refuse_tag(event, {f"{_TAG}str", "!"})
        if event.tag is not None or not event.implicit[0]:
            return event.value
        loader = SafeLoader("")
        tag = loader.resolve(ScalarNode, event.value, (True, False))  # type: ignore[no-untyped-call]  # of PyYAML
        if tag not in _NUMBERS | _OTHERS:
            return event.value
        if len(event.value) > MAX_NUMBER:
            self._refuse(event, f"a number of {len(event.value)} characters; a string needs quotes")
        try:
            return loader.construct_object(ScalarNode(tag, event.value))
        except (ValueError, OverflowError):
            self._refuse(event, f"{event.value!r} is not a number; a string needs quotes")

    def _refuse_tag(self, event: yaml.Event, allowed: set[str]) -> None:
        tag = getattr(event, "tag", None)
        if tag is not None and tag not in allowed:
            self._refuse(
                event, f"the tag {tag.replace(_TAG, '!!')!r}: write the value without the tag"
            )

    def _refuse(self, event: yaml.Event, reason: str) -> NoReturn:
        mark = event.start_mark
        line = mark.line + 1 if mark is not None else 1
        raise self._kind(f"{self._path}:{line}: {reason}")
