"""Overloads for functions that instantiate a class given as argument.

``def make(kind): return kind()`` returns a Pose if its argument is Pose. An overload is added
before the function, which is not changed.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping

from scaffold import lazy_re
from scaffold.types.rewriting import results

_MADE = "_Ros2Made"
_CALLABLE = "_Ros2Callable"
_OVERLOAD = "_ros2_overload"
_DEFINITIONS = f"""
from collections.abc import Callable as {_CALLABLE}
from typing import TypeVar as _Ros2MadeVar
{_MADE} = _Ros2MadeVar("{_MADE}")
"""
_PARAMETER = lazy_re.compile(r"(?:^\(|,)\s*([^\W\d]\w*)")
_HEAD = lazy_re.compile(r"def \w+(\([^\n]*)")
_PARAMETERS = lazy_re.compile(r"[(,][ ]?(\w+)(?=[,:=) ])")
_MAKING = lazy_re.compile(r"(?:return|=) (\w+)\(")
_CALLED = r"\breturn[ \t]+{0}\(|=[ \t]*{0}\("


def generic_heads(text: str) -> Mapping[int, list[str]]:
    """Return the overloads to insert, by position."""
    result: dict[int, list[str]] = {}
    if "return" not in text or not _has_called_parameter(text):
        return result
    for function in results.functions(text):
        names = [name for name in _PARAMETER.findall(function["parameters"]) if name != "self"]
        body = ""
        for name in names:
            if f"{name}(" not in text:
                continue
            body = body or results.body_of(text, function)
            if re.search(_CALLED.format(name), body) and _returns_call_of(name, function, body):
                result[function.start()] = [_head(function, name)]
    return result


def _has_called_parameter(text: str) -> bool:
    """Return whether any parameter is called: a quick check that most files fail."""
    names = {name for head in _HEAD.findall(text) for name in _PARAMETERS.findall(head)}
    return not names.isdisjoint(_MAKING.findall(text))


def definitions() -> str:
    """Return the definitions to append to a file with overloads."""
    return _DEFINITIONS


def _returns_call_of(name: str, function: re.Match[str], body: str) -> bool:
    """Return whether all values that a function returns are results of calling a parameter."""
    if re.search(rf"(?<![\w.]){name}[ \t]*(?::[^=\n]*)?=(?!=)|\b(?:for|as)[ \t]+{name}\b", body):
        return False
    values = results.returned(function["parameters"], body)
    return bool(values) and all(
        isinstance(value, ast.Call) and isinstance(value.func, ast.Name) and value.func.id == name
        for value in values
    )


def _head(function: re.Match[str], name: str) -> str:
    indent = function["indent"]
    parameters = re.sub(
        rf"(?<=[(,\s]){name}\b(?:\s*:[^,=)]*)?",
        f'{name}: "{_CALLABLE}[..., {_MADE}]"',
        function["parameters"],
        count=1,
    )
    return (
        f"{indent}from typing import overload as {_OVERLOAD}\n"
        f"{indent}@{_OVERLOAD}\n"
        f'{indent}def {function["name"]}{parameters} -> "{_MADE}": ...'
    )
