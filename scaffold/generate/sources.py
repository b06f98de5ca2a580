"""The texts of templates: where they are, and what is left of the lines for learners."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence

from scaffold.errors import ContentError
from scaffold.generate.confine import refuse_outside
from scaffold.generate.template import Template

_COMMENT = r"(?m)^([ \t]*)(?:(#|//):(?: (.*))?|<!--: (.*))$"
"""A line for learners: ``#: text``, ``//: text`` or ``<!--: text -->``; alone, an empty line."""


class Sources:
    """Finds ``<template>/<path>`` and ``_licenses/...``, and handles the lines for learners.

    Args:
        roots: The ``templates`` directories; a later one wins.
        templates: The templates in them.
        is_tutorial: Whether the lines for learners are kept.
    """

    def __init__(
        self, roots: Sequence[str], templates: Mapping[str, Template], *, is_tutorial: bool
    ) -> None:
        self._roots = roots
        self._templates = templates
        self.is_tutorial = is_tutorial

    def find(self, name: str) -> str | None:
        """Return the file of a template, ``None`` if there is none."""
        first, _, rest = name.partition("/")
        if ".." in name.split("/") or os.path.isabs(name):
            return None
        paths = (os.path.join(one, *rest.split("/")) for one in self._directories(first))
        return next(filter(os.path.isfile, paths), None)

    def read(self, name: str) -> str:
        """Return the text of a template that was found.

        Raises:
            ContentError: it cannot be read, or lies elsewhere.
        """
        path = self.find(name) or name
        refuse_outside(path, [*self._roots, *self._directories(name.partition("/")[0])])
        try:
            with open(path, encoding="utf-8") as file:
                return self._with_comments(file.read())
        except (OSError, UnicodeDecodeError) as error:
            raise ContentError(f"{path}: {error}") from error

    def _directories(self, first: str) -> list[str]:
        if first in self._templates:
            return [self._templates[first].directory]
        return [os.path.join(root, first) for root in reversed(self._roots)]

    def _with_comments(self, text: str) -> str:
        if self.is_tutorial:
            return re.sub(_COMMENT, _learner_line, text)
        return re.sub(r"(?m)^[ \t]*(?:(?:#|//):(?: .*)?|<!--: .*)\n", "", text)


def _learner_line(match: re.Match[str]) -> str:
    indent, mark, words, xml_words = match.groups()
    if xml_words is not None:
        return f"{indent}<!-- {xml_words}"
    return f"{indent}{mark} {words}" if words else ""
