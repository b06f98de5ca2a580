"""The Jinja environment for one package: finds, compiles and renders templates."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any, Protocol

from jinja2 import (
    BaseLoader,
    StrictUndefined,
    TemplateNotFound,
    TemplateSyntaxError,
    UndefinedError,
)
from jinja2 import Environment as Jinja
from jinja2.environment import TemplateModule

from scaffold import lazy_re
from scaffold.errors import ContentError
from scaffold.files.disk import digest, read_file
from scaffold.generate.templates import filters
from scaffold.generate.templates.bytecode import Compiled
from scaffold.generate.templates.sandbox import Sandbox, refuse_outside
from scaffold.generate.templates.template import ENDING, MAX_BYTES

_COMMENT = lazy_re.compile(r"^([ \t]*)(?:(#|//):(?: (.*))?|<!--: (.*))$", re.MULTILINE)
"""A tutorial comment: ``#: text``, ``//: text`` or ``<!--: text -->``; may be empty."""
TOO_MUCH_MEMORY = "uses too much memory"


class Engine(Protocol):
    """A renderer, in this process or in another one."""

    def has(self, name: str) -> bool:
        """Return whether there is a file, such as ``launch/_readme.md.jinja``."""

    def text(self, source: str, context: Mapping[str, Any]) -> str:
        """Render a short text; raises ContentError."""

    def file(self, name: str, context: Mapping[str, Any]) -> str:
        """Render a file by its name; raises ContentError."""


class LocalEngine:
    """Renders in this process.

    Args:
        roots: The ``templates`` directories; a later one wins.
        directories: The directories of the templates in them, by name; the first one wins.
        is_tutorial: Whether tutorial comments are kept.
    """

    def __init__(
        self, roots: Sequence[str], directories: Mapping[str, Sequence[str]], *, is_tutorial: bool
    ) -> None:
        self._is_tutorial = is_tutorial
        self._loader = _Loader(roots, directories, is_tutorial=is_tutorial)

    @cached_property
    def _text_environment(self) -> Jinja:
        jinja = Sandbox(
            loader=self._loader,
            undefined=_Undefined,
            keep_trailing_newline=True,
            trim_blocks=True,
            lstrip_blocks=True,
            autoescape=False,
            bytecode_cache=Compiled("tutorial" if self._is_tutorial else "brief"),
        )
        jinja.filters |= {
            "literal": filters.literal,
            "markdown": filters.markdown,
            "regex": re.escape,
            "shell": shlex.quote,
            "slashes": filters.slashes,
            "xml": filters.xml,
        }
        jinja.globals["imports"] = self._imports
        jinja.globals["has"] = self.has
        return jinja

    @cached_property
    def _xml(self) -> Jinja:
        """The same for XML files: whatever a template prints there is escaped."""
        kept = Compiled("tutorial_xml" if self._is_tutorial else "brief_xml")
        return self._text_environment.overlay(finalize=filters.xml, bytecode_cache=kept)

    def has(self, name: str) -> bool:
        """Return whether there is a file, such as ``launch/_readme.md.jinja``."""
        try:
            self._text_environment.get_template(name)
        except TemplateNotFound:
            return False
        return True

    def text(self, source: str, context: Mapping[str, Any]) -> str:
        """Render a short text.

        Raises:
            ContentError: it cannot be rendered.
        """
        if "{" not in source:
            return source
        with _TemplateErrors(source):
            return self._text_environment.get_template(self._loader.named(source)).render(context)

    def file(self, name: str, context: Mapping[str, Any]) -> str:
        """Render a file by its name, such as ``package/README.md.jinja``.

        Raises:
            ContentError: it cannot be rendered.
        """
        jinja = self._xml if name.removesuffix(ENDING).endswith(".xml") else self._text_environment
        with _TemplateErrors(name):
            return jinja.get_template(name).render(context)

    def _imports(self, lines: Iterable[str]) -> str:
        if not self._is_tutorial:
            lines = [line.partition("  #")[0] for line in lines]
        return filters.import_block(lines)


class _Undefined(StrictUndefined):
    """An undefined variable, or a macro that a file lacks."""

    @property
    def _undefined_message(self) -> str:
        if isinstance(self._undefined_obj, TemplateModule):
            return f"{self._undefined_obj.__name__} has no macro {self._undefined_name!r}"
        return super()._undefined_message


class _Loader(BaseLoader):
    """Loads ``<template>/<path>`` and ``_licenses/...``, and handles tutorial comments.

    A short text is a template as well, so that its compiled form is cached like that of files.
    """

    def __init__(
        self, roots: Sequence[str], directories: Mapping[str, Sequence[str]], *, is_tutorial: bool
    ) -> None:
        self._roots = roots
        self._templates = directories
        self._is_tutorial = is_tutorial
        self._texts: dict[str, str] = {}

    def named(self, text: str) -> str:
        """Register a short text as a template and return its name."""
        name = f"text {digest(text.encode('utf-8', 'surrogatepass'))}"
        self._texts[name] = text
        return name

    def get_source(
        self, environment: Jinja, template: str
    ) -> tuple[str, str, Callable[[], bool] | None]:
        """Return the text of a template file."""
        del environment
        if template in self._texts:
            return self._texts[template], template, None
        first, _, rest = template.partition("/")
        if ".." in template.split("/") or os.path.isabs(template):
            raise TemplateNotFound(template)
        for directory in self._directories(first):
            path = os.path.join(directory, *rest.split("/"))
            if os.path.exists(path) and not os.path.isfile(path):
                raise ContentError(f"{path}: is not a file")
            try:
                data = read_file(path, MAX_BYTES)
                refuse_outside(path, [*self._roots, directory])
                return self._with_comments(_decode(data)), path, None
            except (FileNotFoundError, NotADirectoryError):
                continue
            except (OSError, UnicodeDecodeError) as error:
                raise ContentError(f"{path}: {error}") from error
        raise TemplateNotFound(template)

    def _directories(self, first: str) -> list[str]:
        if first in self._templates:
            return list(self._templates[first])
        return [os.path.join(root, first) for root in reversed(self._roots)]

    def _with_comments(self, text: str) -> str:
        if self._is_tutorial:
            return _COMMENT.sub(_learner_line, text)
        return re.sub(r"(?m)^[ \t]*(?:(?:#|//):(?: .*)?|<!--: .*)\n", "", text)


def _learner_line(match: re.Match[str]) -> str:
    indent, mark, words, xml_words = match.groups()
    if xml_words is not None:
        return f"{indent}<!-- {xml_words}"
    return f"{indent}{mark} {words}" if words else ""


class _TemplateErrors:
    """Converts exceptions of Jinja to one-line errors for the template author."""

    def __init__(self, where: str) -> None:
        self._where = where

    def __enter__(self) -> None:
        """Do nothing."""

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: object) -> None:
        if kind is None or not isinstance(error, Exception) or isinstance(error, ContentError):
            return
        at = _line_of(error)
        message = f"template {self._where!r}{at}: {type(error).__name__}: {error}"
        if isinstance(error, UndefinedError | TemplateSyntaxError):  # messages are clear
            message = f"template {self._where!r}{at}: {error}"
        if isinstance(error, TemplateNotFound):
            message = f"template {self._where!r}{at}: no template has the file '{error}'"
        if isinstance(error, MemoryError):
            message = f"template {self._where!r}{at}: {TOO_MUCH_MEMORY}"
        raise ContentError(" ".join(message.split())) from error


def _line_of(error: Exception) -> str:
    """Return the line of an error in a template's file, if Jinja provides it."""
    import traceback

    if isinstance(error, TemplateSyntaxError):
        return f", {error.filename}:{error.lineno}" if _is_file(error.filename) else ""
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if _is_file(frame.filename):
            return f", {frame.filename}:{frame.lineno}"
    return ""


def _is_file(name: str | None) -> bool:
    return name is not None and name.endswith(ENDING)


def _decode(data: bytes) -> str:
    return data.decode().replace("\r\n", "\n").replace("\r", "\n")
