"""Finds the arguments of calls inside of lambdas, at the place of the lambda.

In ``create_subscription(Imu, 'imu', lambda imu: self.send(smooth(imu, 0.1)), 10)``, ``smooth`` gets
``Imu()``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from scaffold import lazy_re
from scaffold.types.rewriting.statements import statement_around

_LAMBDA = lazy_re.compile(r"\blambda(?: (\w+))?: ")
_SUBSCRIBED = lazy_re.compile(r"\bcreate_subscription\(\s*([\w.]+)\s*,")


def place_of(
    text: str, start: int, end: int, words: Mapping[str, str]
) -> tuple[int, Mapping[str, str]]:
    """Return the start of the line of a call, and the arguments that are known there.

    Args:
        text: The file.
        start: Where the call begins.
        end: Where it ends.
        words: Its arguments, by keyword or number.

    Returns:
        The beginning of the line, if that begins its statement, else -1. Of a call in a lambda, an
        argument that depends on what the lambda gets is left out, unless that is a message.
    """
    place = statement_around(text, start, end)
    line = text.rfind("\n", 0, start) + 1
    if place >= 0 or text.find("lambda", line, start) < 0:
        return place, words
    *_, last = [None, *_LAMBDA.finditer(text, line, start)]
    if last is None or (place := statement_around(text, last.start(), end)) < 0:
        return -1, words
    message = _SUBSCRIBED.search(text, line, last.start())
    name = rf"(?<![\w.]){last[1]}\b(?![ ]*=)"
    if last[1] is None:
        return place, words
    if message is not None:
        made = f"{message[1]}()"
        return place, {key: re.sub(name, made, value) for key, value in words.items()}
    return place, {key: value for key, value in words.items() if not re.search(name, value)}
