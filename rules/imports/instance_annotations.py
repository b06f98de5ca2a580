"""IM053: annotations are read from classes, not from instances."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, PythonRule, Report, Severity
from scaffold.api.distributions import target
from scaffold.api.python import PythonModule

_FIRST = (3, 14)
"""The first Python in which instances do not have ``__annotations__``."""
_NAME = "__annotations__"
_CLASS = (
    "{}from dataclasses import dataclass\n\n\n"
    "@dataclass\nclass Arguments:\n    speed: float\n\n"
    "    def names(self):\n        return list({})\n"
)


class InstanceAnnotations(PythonRule):
    """Code reads the annotations of a class from an instance.

    **Why.** Since Python 3.14, which Lyrical uses, instances do not have them:
    ``self.__annotations__`` raises ``AttributeError``, and ``getattr`` returns its default, as if
    nothing were annotated.

    **Fix.** Read ``type(self).__annotations__``, or use ``dataclasses.fields(self)``.

    **Source.** PEP 649 and 749; launch_pal, commit ce86cbe.
    """

    code = "IM053"
    name = "instance-annotations"
    effect = Effect.STOPS_PROGRAM
    other_severities = {Severity.WARNING: "there is a default"}
    since = "0.2"
    examples = (
        Example(
            "annotations of the class",
            {"arguments.py": _CLASS.format("", "type(self).__annotations__")},
            distro="lyrical",
        ),
        Example(
            "an older Python",
            {"arguments.py": _CLASS.format("", "self.__annotations__")},
        ),
        Example(
            "annotations that remain strings",
            {
                "arguments.py": _CLASS.format(
                    "from __future__ import annotations\n\n", "self.__annotations__"
                )
            },
            distro="lyrical",
        ),
        Example(
            "annotations of an instance",
            {"arguments.py": _CLASS.format("", "self.__annotations__")},
            "9:21: instances have no '__annotations__' in Python 3.14: AttributeError; use "
            "type(self).__annotations__ or dataclasses.fields(self)",
            distro="lyrical",
        ),
        Example(
            "annotations of an instance, with a default",
            {"arguments.py": _CLASS.format("", "getattr(self, '__annotations__', {})")},
            Report(
                "9:21",
                "instances have no '__annotations__' in Python 3.14: this is always "
                "the default; use type(self).__annotations__ or "
                "dataclasses.fields(self)",
                severity=Severity.WARNING,
            ),
            distro="lyrical",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        if target().python < _FIRST or not module.mentions(_NAME):
            return
        if any(
            item.module == "__future__" and any(name.name == "annotations" for name in item.names)
            for item in module.imports
        ):
            return
        python = f"instances have no {_NAME!r} in Python {target().python_version}"
        advice = "use type(self).__annotations__ or dataclasses.fields(self)"
        for node in module.walk(ast.Attribute):
            match node:
                case ast.Attribute(
                    value=ast.Name(id="self"), attr="__annotations__", ctx=ast.Load()
                ):
                    message = f"{python}: AttributeError; {advice}"
                    yield self.report(module.location(node), message)
        for call in module.walk(ast.Call):
            match call:
                case ast.Call(
                    func=ast.Name(id="getattr"),
                    args=[ast.Name(id="self"), ast.Constant(value="__annotations__"), _],
                ):
                    message = f"{python}: this is always the default; {advice}"
                    yield self.report(module.location(call), message, severity=Severity.WARNING)
