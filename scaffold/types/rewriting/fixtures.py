"""Passes the values of pytest fixtures to the tests that take them, for the type checker.

A line before ``yield Talker()`` stores the value in a global name, and a line at the start of
``def test_talk(talker):`` assigns it to the parameter.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from scaffold import lazy_re
from scaffold.types.rewriting.callbacks import function_body
from scaffold.types.rewriting.returns import stored_values
from scaffold.types.rewriting.statements import definitions

_FUNCTION = lazy_re.compile(
    r"^[ ]*def (?P<name>[^\W\d]\w*)\((?P<parameters>[^()#]{0,800})\)[^\n:]{0,80}:[^\n]*\n"
    r"(?=\n*(?P<inner> +)\S)",
    re.MULTILINE,
)
_MAX_LENGTH = 2_000
"""The maximum length of decorators that are read."""
_FIXTURE = lazy_re.compile(r"@(?:pytest\.)?fixture\b")


def lines(text: str) -> Iterator[tuple[int, str]]:
    """Yield the lines to insert into a file with tests, each with its position."""
    if "fixture" not in text:
        return
    functions = [*definitions(_FUNCTION, text)]
    names = [function["name"] for function in functions]
    values: dict[str, str] = {}
    for function in functions:
        name = function["name"]
        if names.count(name) > 1 or not any(map(_FIXTURE.match, _decorators(text, function))):
            continue
        start = function.end() - 1
        body = function_body(text, function.start(), start)
        kept = stored_values(body, start)
        if len(kept) == 1:
            ((place, line, stored),) = kept
            values[name] = stored
            yield place, line
    for function in functions if values else ():
        yield from _taken(text, function, values)


def _taken(
    text: str, function: re.Match[str], values: Mapping[str, str]
) -> Iterator[tuple[int, str]]:
    """Yield the lines that assign the values of fixtures to the parameters of a function."""
    decorators = [*_decorators(text, function)]
    is_called = function["name"].startswith("test") or any(map(_FIXTURE.match, decorators))
    for parameter in function["parameters"].split(",") if is_called else ():
        name = parameter.partition(":")[0].strip()
        is_replaced = any(name in re.findall(r"\w+", line) for line in decorators)
        if name in values and not is_replaced:
            yield function.end(), f"{function['inner']}{name} = ({values[name]})[0]"


def _decorators(text: str, function: re.Match[str]) -> Iterator[str]:
    """Yield the lines before a function that are its decorators."""
    before = text[max(function.start() - _MAX_LENGTH, 0) : function.start()]
    for line in reversed(before.split("\n")[:-1]):
        if not line.lstrip().startswith(("@", ")", "]", "'", '"', "(")):
            return
        yield line.strip()
