"""Code that fills a message."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from scaffold.generate.payload import conventions, lookup, recipe, words
from scaffold.generate.payload.code import Block, is_now
from scaffold.generate.payload.imports import LIBRARIES, imports
from scaffold.generate.payload.lookup import HEADER, Types
from scaffold.generate.payload.payloads import Payload
from scaffold.generate.payload.recipe import Recipe
from scaffold.generate.payload.walk import MAX_BRIEF, Walk
from scaffold.model.interfaces.definitions import Definitions

MAX_LINES = 24
"""Maximum number of statements, for readability."""
MAX_CHECKS = 8
MAX_CHECK = 84
"""Maximum length of an expression in a test."""
MAX_LOG = 52
"""Maximum length of a log message."""
MAX_SUMMARY = 70


def of_message(text: str, interfaces: Definitions) -> Payload:
    """Return how to fill messages of a type.

    Args:
        text: ``package/msg/Name``, ``package/Name`` or a bare ``Name``.
        interfaces: Where to look.

    Raises:
        InputError: the type is not known or cannot be used; the message names the nearest
            ones, or the file and the line of what is wrong.
    """
    types = lookup.find(text, "msg", interfaces)
    own = types.interface
    lines, walk = _fill(types)
    words_ = _log_text(types, walk)
    packages, lines_of_imports = imports(types, [*lines, f"f'{words_.log}'"], [own.full_name])
    return Payload(
        package=own.package,
        name=types.own_name,
        imports=lines_of_imports,
        statements=tuple(lines),
        log=words_.log,
        summary=words_.summary,
        checks=tuple(filter(is_short, words_.checks))[:MAX_CHECKS],
        is_stamped=any("self.frame_id" in line for line in lines),
        is_counted=any("self.count" in line for line in lines),
        packages=packages,
        interface_packages=tuple(name for name in packages if name not in LIBRARIES),
        frame=conventions.of_message(own.full_name).frame or words_.frame or recipe.FRAME,
        constants=walk.constants,
        is_changing=changes(lines),
        message=types.own_alias,
    )


def is_short(check: str) -> bool:
    """Return whether the lines of a check fit into a test."""
    return all(len(line) <= MAX_CHECK for line in check.splitlines())


def _fill(types: Types) -> tuple[list[str], Walk]:
    """Return statements: at most `MAX_LINES`, and at least one with a changing value."""
    own = types.interface
    brief, is_changing = 0, False
    while True:
        block, walk = Block(), Walk(types, "msg", changing=is_changing, brief=brief)
        walk.message(block, own.full_name, "msg")
        lines = block.lines()
        if len(lines) > MAX_LINES and brief < MAX_BRIEF:
            brief += 1
        elif own.fields and not changes(lines) and not is_changing:
            is_changing = True
        else:
            return lines, walk


def changes(lines: Iterable[str]) -> bool:
    """Return whether the lines give a different message each time."""
    return any(re.search(r"self\.(count|get_clock)|uuid4", line) for line in lines)


def _log_text(types: Types, walk: Walk) -> Recipe:
    """Return the log text of a message: from its recipe, its only part, or its fields."""
    own = types.interface
    result = recipe.find(own.full_name)
    header = own.section("message").field("header")
    is_stamped = header is not None and header.type.full_name == HEADER
    if result is None:
        result = _words_of_part(types) or _words_of_fields(types, walk)
    if is_stamped:
        result = result._replace(checks=(is_now("message.header.stamp"), *result.checks))
    return result


def _words_of_part(types: Types) -> Recipe | None:
    """Return the words of the only part that a stamped message has."""
    own = types.interface
    parts = [field for field in own.fields if field.name != "header"]
    if len(parts) != 1 or parts[0].type.is_primitive or parts[0].type.is_array:
        return None
    part, name = parts[0].type.full_name, parts[0].name
    part_recipe = recipe.find(part)
    if part_recipe is None:
        return None
    return part_recipe._replace(
        log=joined(re.sub(r"\bmsg\.", f"msg.{name}.", part_recipe.log).split(", ")),
        checks=tuple(
            re.sub(r"\bmessage\.", f"message.{name}.", check) for check in part_recipe.checks
        ),
    )


def _words_of_fields(types: Types, walk: Walk) -> Recipe:
    names = [words.phrase(field.name) for field in types.interface.fields if field.name != "header"]
    return Recipe(
        summary=enumerated(names, "example values for ", MAX_SUMMARY) if names else "nothing",
        log=joined(walk.logged)
        or (enumerated(names, "", MAX_LOG) if names else "an empty message"),
        frame=walk.frame,
        checks=tuple(
            re.sub(r"\bmsg\b", "message", check)
            for check in walk.checks
            if "header.stamp" not in check
        ),
    )


def joined(shown: Iterable[str]) -> str:
    """Join replacement fields, as many as fit into a log message."""
    log = ""
    for item in shown:
        longer = f"{log}, {item}" if log else item
        log = longer if len(longer) <= MAX_LOG else log
    return log


def enumerated(names: Sequence[str], start: str, limit: int) -> str:
    """Join names, as many as fit."""
    for end in range(len(names), 0, -1):
        shown, left = list(names[:end]), len(names) - end
        last = f"{left} more" if left else shown.pop() if len(shown) > 1 else ""
        text = start + ", ".join(shown) + (f" and {last}" if last else "")
        if len(text) <= limit:
            return text
    return f"{start}{len(names)} fields"
