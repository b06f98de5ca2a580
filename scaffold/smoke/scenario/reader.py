"""Parses ``smoke.yaml``; each error is one line with its location."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping
from difflib import get_close_matches
from typing import Any, NoReturn, TypeVar

from scaffold.errors import InputError
from scaffold.formats import yaml as yaml_format
from scaffold.formats.yaml import Alias, Scalar, Sequence, YamlNode
from scaffold.formats.yaml import Mapping as YamlMapping
from scaffold.model.package import Package
from scaffold.smoke.scenario.model import (
    FILE,
    TRANSITIONS,
    Call,
    FieldExpectation,
    Scenario,
    Stimulus,
    TopicExpectation,
)
from scaffold.source import ParseError, ViewError

Value = TypeVar("Value")

_ANY = "any"
_TYPE_PARTS = 3
_TAG = "tag:yaml.org,2002:"
_MAX_DIGITS = 40
_PERCENT = 100


def scenarios(package: Package, executables: Collection[str]) -> dict[str, Scenario]:
    """Return the scenarios of a package by executable; empty without a file.

    Args:
        package: The package.
        executables: The known executables; empty if unknown.

    Raises:
        InputError: the file is invalid.
    """
    if not package.has(FILE):
        return {}
    reader = _Reader(os.path.join(package.directory, FILE))
    try:
        roots = yaml_format.parse(package.source(FILE))
    except ParseError as error:
        reader.refuse(error.location.line, error.message)
    except ViewError as error:
        raise InputError(f"{reader.path}: {error}") from error
    if len(roots) > 1:
        reader.refuse(roots[1].location.line, "a second document; only one is allowed")
    return reader.file(roots[0], executables) if roots else {}


class _Reader:
    def __init__(self, path: str) -> None:
        self.path = path

    def file(self, root: YamlNode, executables: Collection[str]) -> dict[str, Scenario]:
        keys = self._keys(root, FILE, ("executables", "duration"))
        duration = self._optional(keys, "duration", self._positive)
        result: dict[str, Scenario] = {}
        for key, node in self._pairs(keys.get("executables"), "executables"):
            if executables and key.text not in executables:
                nearest = _nearest(key.text, executables) or f"; it has {_listed(executables)}"
                self.refuse(
                    key.location.line, f"the package has no executable {key.text!r}{nearest}"
                )
            result[key.text] = self._scenario(node, key.text, duration)
        return result

    def _scenario(self, node: YamlNode, name: str, duration: float | None) -> Scenario:
        allowed = (
            "arguments", "parameters", "topics", "services", "actions", "publish", "duration",
            "exit_code", "skip", "transitions",
        )  # fmt: skip
        keys = self._keys(node, f"executable {name!r}", allowed)
        own = self._optional(keys, "duration", self._positive)
        return Scenario(
            arguments=tuple(self._optional(keys, "arguments", self._strings) or ()),
            parameters=self._optional(keys, "parameters", self._parameters) or {},
            topics=tuple(self._topic(*pair) for pair in self._pairs(keys.get("topics"), "topics")),
            calls=tuple(
                self._call(kind, *pair)
                for kind in ("service", "action")
                for pair in self._pairs(keys.get(f"{kind}s"), f"{kind}s")
            ),
            stimuli=tuple(
                self._stimulus(*pair) for pair in self._pairs(keys.get("publish"), "publish")
            ),
            duration=duration if own is None else own,
            exit_code=self._optional(keys, "exit_code", self._integer),
            skip=bool(self._optional(keys, "skip", self._boolean)),
            transitions=self._transitions(keys),
        )

    def _transitions(self, keys: Mapping[str, YamlNode]) -> tuple[str, ...]:
        names = self._optional(keys, "transitions", self._strings)
        if names is None:
            return TRANSITIONS
        for name in names:
            if name not in TRANSITIONS:
                line = keys["transitions"].location.line
                nearest = _nearest(name, TRANSITIONS) or f"; there are {_listed(TRANSITIONS)}"
                self.refuse(line, f"there is no transition {name!r}{nearest}")
        return tuple(names)

    def _topic(self, key: Scalar, node: YamlNode) -> TopicExpectation:
        name = self._name(key)
        keys = self._keys(node, f"topic {name!r}", ("type", "rate", "tolerance", "fields"))
        rate = keys.get("rate")
        any_rate = isinstance(rate, Scalar) and rate.text == _ANY
        return TopicExpectation(
            name,
            type=self._optional(keys, "type", lambda item: self._type(item, "msg")),
            rate_hz=None if any_rate else self._optional(keys, "rate", self._rate),
            any_rate=any_rate,
            tolerance=self._optional(keys, "tolerance", self._fraction),
            fields=tuple(self._field(*pair) for pair in self._pairs(keys.get("fields"), "fields")),
        )

    def _field(self, key: Scalar, node: YamlNode) -> FieldExpectation:
        allowed = ("changes", "minimum", "maximum", "equals")
        keys = self._keys(node, f"field {key.text!r}", allowed)
        return FieldExpectation(
            key.text,
            changes=self._optional(keys, "changes", self._boolean),
            minimum=self._optional(keys, "minimum", self._number),
            maximum=self._optional(keys, "maximum", self._number),
            equals=self._optional(keys, "equals", self._value),
            has_equals="equals" in keys,
        )

    def _call(self, kind: str, key: Scalar, node: YamlNode) -> Call:
        name = self._name(key)
        allowed = ("type", "request", "answer") if kind == "service" else ("type", "goal", "result")
        keys = self._keys(node, f"{kind} {name!r}", allowed)
        given = self._required_type(keys, key, f"{kind} {name!r}")
        return Call(
            kind,
            name,
            self._type(given, "srv" if kind == "service" else "action"),
            self._optional(keys, allowed[1], self._fields) or {},
            self._optional(keys, allowed[2], self._fields) or {},
        )

    def _stimulus(self, key: Scalar, node: YamlNode) -> Stimulus:
        name = self._name(key)
        keys = self._keys(node, f"topic {name!r}", ("type", "message", "rate"))
        return Stimulus(
            name,
            self._type(self._required_type(keys, key, f"topic {name!r}"), "msg"),
            self._optional(keys, "message", self._fields) or {},
            self._optional(keys, "rate", self._positive) or 1.0,
        )

    # -- values

    def _name(self, key: Scalar) -> str:
        """Return a name with its leading slash."""
        if not key.text.strip("/") or any(letter.isspace() for letter in key.text):
            self.refuse(key.location.line, f"{key.text!r} is not a valid ROS name")
        return key.text if key.text.startswith("/") else f"/{key.text}"

    def _type(self, node: YamlNode, kind: str) -> str:
        parts = self._string(node).split("/")
        if len(parts) == _TYPE_PARTS - 1:
            parts.insert(1, kind)
        if len(parts) != _TYPE_PARTS or parts[1] != kind or not all(map(str.isidentifier, parts)):
            self._refuse_value(node, f"a type such as 'package/{kind}/Name'")
        return "/".join(parts)

    def _rate(self, node: YamlNode) -> float:
        number = self._value(node)
        if not _is_number(number) or number <= 0:
            self._refuse_value(node, f"a rate in hertz above 0, or {_ANY!r}")
        return float(number)

    def _fraction(self, node: YamlNode) -> float:
        if isinstance(node, Scalar) and node.text.endswith("%"):
            number = _as_float(node.text[:-1].strip())
            number = None if number is None else number / _PERCENT
        else:
            value = self._value(node)
            number = float(value) if _is_number(value) else None
        if number is None or not 0 < number <= 1:
            self._refuse_value(node, "a tolerance above 0 up to 1, or a percentage such as '5 %'")
        return number

    def _positive(self, node: YamlNode) -> float:
        number = self._value(node)
        if not _is_number(number) or not 0 < number < float("inf"):
            self._refuse_value(node, "a number above 0")
        return float(number)

    def _number(self, node: YamlNode) -> float:
        number = self._value(node)
        if not _is_number(number):
            self._refuse_value(node, "a number")
        return float(number)

    def _integer(self, node: YamlNode) -> int:
        number = self._value(node)
        if not isinstance(number, int) or isinstance(number, bool):
            self._refuse_value(node, "a whole number")
        return number

    def _boolean(self, node: YamlNode) -> bool:
        value = self._value(node)
        if not isinstance(value, bool):
            self._refuse_value(node, "true or false")
        return value

    def _string(self, node: YamlNode) -> str:
        value = self._value(node)
        if not isinstance(value, str):
            self._refuse_value(node, "a string")
        return value

    def _strings(self, node: YamlNode) -> list[str]:
        if not isinstance(node, Sequence):
            self._refuse_value(node, "a list of strings")
        return [str(self._scalar(item)) for item in node.items]

    def _scalar(self, node: YamlNode) -> str:
        if not isinstance(node, Scalar):
            self._refuse_value(node, "a string")
        return node.text

    def _fields(self, node: YamlNode) -> Mapping[str, Any]:
        value = self._value(node)
        if not isinstance(value, dict):
            self._refuse_value(node, "fields with their values")
        return value

    def _parameters(self, node: YamlNode) -> Mapping[str, Any]:
        """Return parameters; nested ones get names with dots."""
        result: dict[str, Any] = {}
        waiting = [("", self._fields(node))]
        while waiting:
            prefix, values = waiting.pop(0)
            for name, value in values.items():
                if isinstance(value, Mapping):
                    waiting.append((f"{prefix}{name}.", value))
                elif value is None:
                    self._refuse_value(node, f"parameters with values; {prefix}{name} has none")
                else:
                    result[f"{prefix}{name}"] = value
        return result

    def _value(self, node: YamlNode) -> Any:  # noqa: ANN401  what the file holds
        """Return a YAML value; aliases are not expanded, and no objects are constructed."""
        if isinstance(node, Alias):
            self.refuse(node.location.line, f"the alias *{node.name}: write its value instead")
        if isinstance(node, Scalar):
            return self._scalar_value(node)
        if isinstance(node, Sequence):
            return [self._value(item) for item in node.items]
        return {key.text: self._value(item) for key, item in self._pairs(node, "a mapping")}

    def _scalar_value(self, node: Scalar) -> object:
        from yaml import SafeLoader, ScalarNode

        if not node.is_plain or node.tag is not None:
            return node.text
        loader = SafeLoader("")
        tag = loader.resolve(ScalarNode, node.text, (True, False))  # type: ignore[no-untyped-call]  # of PyYAML
        plain_tags = {f"{_TAG}{kind}" for kind in ("int", "float", "bool", "null")}
        if tag not in plain_tags or len(node.text) > _MAX_DIGITS:
            return node.text
        return loader.construct_object(ScalarNode(tag, node.text))

    # -- structure

    def _keys(self, node: YamlNode, holder: str, allowed: tuple[str, ...]) -> dict[str, YamlNode]:
        result: dict[str, YamlNode] = {}
        for key, value in self._pairs(node, holder):
            if key.text not in allowed:
                hint = _nearest(key.text, allowed) or f"; it has {_listed(allowed)}"
                self.refuse(key.location.line, f"{holder} has no key {key.text!r}{hint}")
            result[key.text] = value
        return result

    def _pairs(self, node: YamlNode | None, holder: str) -> list[tuple[Scalar, YamlNode]]:
        if node is None or (isinstance(node, Scalar) and self._scalar_value(node) is None):
            return []
        if not isinstance(node, YamlMapping):
            self.refuse(node.location.line, f"{holder} needs keys with values")
        names: set[str] = set()
        for key, _ in node.pairs:
            if key.text in names:
                self.refuse(key.location.line, f"{holder} has the key {key.text!r} twice")
            names.add(key.text)
        return node.pairs

    @staticmethod
    def _optional(
        keys: Mapping[str, YamlNode], name: str, read: Callable[[YamlNode], Value]
    ) -> Value | None:
        return read(keys[name]) if name in keys else None

    def _required_type(self, keys: Mapping[str, YamlNode], holder: Scalar, kind: str) -> YamlNode:
        if "type" not in keys:
            self.refuse(holder.location.line, f"{kind} needs the key 'type'")
        return keys["type"]

    def _refuse_value(self, node: YamlNode, wanted: str) -> NoReturn:
        if isinstance(node, Scalar):
            self.refuse(node.location.line, f"{node.text!r} is not {wanted}")
        self.refuse(node.location.line, f"not {wanted}")

    def refuse(self, line: int, reason: str) -> NoReturn:
        raise InputError(f"{self.path}:{line}: {reason}")


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _as_float(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _nearest(word: str, words: Collection[str]) -> str:
    matches = get_close_matches(word, sorted(words), 1)
    return f"; did you mean {matches[0]!r}?" if matches else ""


def _listed(names: Collection[str]) -> str:
    return ", ".join(sorted(names))
