"""Callbacks that a constructor gets and methods of the class call, for TY004."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api.python import PythonModule, conditions_on, given_argument, last_name
from scaffold.api.rclpy import Callback, numbers_taken, rclpy_file
from scaffold.api.types import TypeFinding

_NAMELESS = (
    r"No arguments? provided for required parameters? [^.]+"
    r"|Too many positional arguments: expected \d+, got \d+"
)


def kept_callback_problem(finding: TypeFinding) -> str:
    """Return the problem with a call of a callback that the constructor got; empty if uncertain."""
    node = finding.innermost
    call = node if isinstance(node, ast.Call) else finding.enclosing_call
    if call is None or finding.match(_NAMELESS) is None or _is_chosen(finding.module, call):
        return ""
    if call.keywords or any(isinstance(item, ast.Starred) for item in call.args):
        return ""
    count = len(call.args)
    for callback, place in _passed(finding, call.func):
        takes = numbers_taken(callback)
        if takes is None or count in takes or takes.start < 0 or not takes:
            continue
        least, most = takes.start, takes.stop - 1
        number = str(least) if least == most else f"{least} to {most}"
        name = repr(callback.name) if callback.name else "the function"
        arguments = "argument" if count == 1 else "arguments"
        called = finding.module.text(call.func)
        return f"{called}() passes {count} {arguments}, but {name} from {place} takes {number}"
    return ""


def _is_chosen(module: PythonModule, call: ast.Call) -> bool:
    """Return whether a condition on another attribute may tell which callback it is."""
    return any(
        isinstance(part, ast.Attribute)
        and module.text(part.value) == "self"
        and module.text(part) != module.text(call.func)
        for test in conditions_on(module, call)
        for part in ast.walk(test)
    )


def _passed(finding: TypeFinding, func: ast.expr) -> Iterator[tuple[Callback, str]]:
    """Yield the callbacks that are passed for an attribute, each with the place of the call."""
    module = finding.module
    class_ = module.enclosing_class(func)
    match func:
        case ast.Attribute(value=ast.Name(id="self"), attr=name) if class_ is not None:
            stored = _parameter_stored(module, class_, name)
        case _:
            return
    if stored is None or class_ is None:
        return
    parameter, constructor = stored
    own = rclpy_file(finding.package, module.path)
    places = [(own, call.lineno, f"line {call.lineno}") for call in _calls_in(module, class_.name)]
    for place in finding.calls_from_modules(class_.name):
        file = rclpy_file(place.package, place.path)
        places.append((file, place.line, place.seen_from(finding.package)))
    for file, line, text in places:
        for call in _calls_in(file.module, class_.name):
            value = given_argument(constructor, call, parameter, is_method=True)
            if call.lineno == line and value is not None:
                yield file.callback(value), text


def _calls_in(module: PythonModule, name: str) -> Iterator[ast.Call]:
    """Yield the calls of a class in a file."""
    for call in module.walk(ast.Call):
        if last_name(call.func) == name:
            yield call


def _parameter_stored(
    module: PythonModule, class_: ast.ClassDef, name: str
) -> tuple[ast.arg, ast.FunctionDef] | None:
    """Return the parameter of the constructor in an attribute, if nothing else sets that."""
    stores = [
        use
        for use in module.index.attributes(name)
        if not isinstance(use.ctx, ast.Load)
        and (module.enclosing_class(use) is class_ or module.text(use.value) != "self")
    ]
    match module.parent(stores[0]) if len(stores) == 1 else None:
        case ast.Assign(targets=[_], value=ast.Name() as value):
            parameter = module.index.only_node(value)
            function = module.enclosing_function(value)
            if isinstance(parameter, ast.arg) and isinstance(function, ast.FunctionDef):
                return (parameter, function) if function.name == "__init__" else None
    return None
