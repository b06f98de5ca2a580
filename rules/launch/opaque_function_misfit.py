"""LF057: the function of an OpaqueFunction takes what launch gives, and returns a list."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.launch_entities import function_of
from scaffold.model.launch_py import LaunchCall, LaunchFile
from scaffold.model.launch_signatures import ACTIONS
from scaffold.model.returns import returned

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import OpaqueFunction\n"
    "from launch_ros.actions import Node\n\n\n"
    "def set_up({}):\n    return {}\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([OpaqueFunction(function=set_up{})])\n"
)
_NODE = "Node(package='a', executable='b')"


class OpaqueFunctionMisfit(Rule):
    """The function of an OpaqueFunction takes other arguments, or returns no list of actions.

    **Why.** ``ros2 launch`` stops: ``set_up() takes 0 positional arguments but 1 was given``,
    ``missing 1 required positional argument``, ``'Node' object is not iterable``,
    ``'LaunchDescription' object is not iterable``.

    **Fix.** ``def set_up(context, ...)``, with ``args=[...]`` and ``kwargs={...}`` for the rest;
    ``return [node]``.

    **Source.** ``launch/actions/opaque_function.py``.
    """

    code = "LF057"
    name = "opaque-function-misfit"
    examples = (
        Example(
            "context and a list",
            {
                "launch/a.launch.py": _LAUNCH.format("context", f"[{_NODE}]", ""),
                "launch/b.launch.py": _LAUNCH.format(
                    "context, a, *, b", "[]", ", args=[1], kwargs={'b': 2}"
                ),
            },
        ),
        Example(
            "no context, one action",
            {"launch/a.launch.py": _LAUNCH.format("", _NODE, "")},
            at=("launch/a.launch.py:7", "launch/a.launch.py:11"),
        ),
        Example(
            "an argument that nothing gives, a description",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "context, a", f"LaunchDescription([{_NODE}])", ""
                )
            },
            at=("launch/a.launch.py:7", "launch/a.launch.py:11"),
        ),
        Example(
            "a text for the list of arguments",
            {"launch/a.launch.py": _LAUNCH.format("context, a", "[]", ", args='fast'")},
            at=("launch/a.launch.py:11",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for launch in LaunchFile.of_package(package):
            seen: set[ast.AST] = set()
            for call in launch.find("OpaqueFunction"):
                given = call.given.get("function")
                function = function_of(launch, given)
                if function is None or given is None or function.decorator_list:
                    continue
                problem = _problem(call, function.args)
                if problem:
                    yield self.report(launch.location(given), f"{function.name} {problem}")
                if function in seen:
                    continue
                seen.add(function)
                for statement in returned(function):
                    found = launch.call_of(statement.value)
                    if found is not None and found.kind in {*ACTIONS, "LaunchDescription"}:
                        message = f"{function.name} returns one {found.kind}, not a list: TypeError"
                        yield self.report(launch.location(statement), message)


def _problem(call: LaunchCall, arguments: ast.arguments) -> str:
    """Return how the arguments of a function differ from what it is given."""
    args, kwargs = call.given.get("args"), call.given.get("kwargs")
    if isinstance(args, ast.Constant) and isinstance(args.value, str):
        return "gets a text letter by letter: args=... is a list"
    items = args.elts if isinstance(args, ast.List | ast.Tuple) else []
    if (args is not None and _is_unknown(args, items)) or call.is_open:
        return ""
    words: set[str] = set()
    if kwargs is not None:
        if not isinstance(kwargs, ast.Dict):
            return ""
        keys = [key.value if isinstance(key, ast.Constant) else None for key in kwargs.keys]
        if None in keys:
            return ""
        words = {str(key) for key in keys}
    if "ignore_context" in call.given:
        return ""
    return _misfit(arguments, 1 + len(items), words)


def _is_unknown(args: ast.expr, items: list[ast.expr]) -> bool:
    """Tell whether nobody knows how many arguments there are."""
    listed = isinstance(args, ast.List | ast.Tuple)
    return not listed or any(isinstance(item, ast.Starred) for item in items)


def _misfit(arguments: ast.arguments, count: int, words: set[str]) -> str:
    given = [one.arg for one in [*arguments.posonlyargs, *arguments.args]]
    if not given and arguments.vararg is None:
        return "takes no arguments; it is given the context: TypeError"
    if count > len(given) and arguments.vararg is None:
        return f"is given context and {count - 1} more, and takes {len(given)} in all: TypeError"
    optional = len(arguments.defaults)
    needed = [name for name in given[count : len(given) - optional] if name not in words]
    needed += [
        one.arg
        for one, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
        if default is None and one.arg not in words
    ]
    if needed:
        return f"takes {needed[0]!r}, which args=[...] does not give: TypeError"
    names = {*given, *(one.arg for one in arguments.kwonlyargs)}
    unknown = sorted(words - names)
    if unknown and arguments.kwarg is None:
        return f"takes no {unknown[0]!r}, which kwargs={{...}} gives: TypeError"
    return ""
