"""Renders templates in memory, sandboxed, with every variable defined."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from functools import cached_property
from typing import Any

from jinja2 import BaseLoader, StrictUndefined, TemplateError, TemplateNotFound
from jinja2 import Environment as Jinja

from scaffold.errors import ContentError
from scaffold.generate import filters, licenses
from scaffold.generate.compiled import Compiled
from scaffold.generate.sandbox import Sandbox, refuse_leaving, refuse_outside
from scaffold.generate.template import ENDING, MANIFEST, MOST_BYTES, Template
from scaffold.model.disk import digest, read_file
from scaffold.record import NamedTuple

_COMMENT = re.compile(r"^([ \t]*)(?:(#|//):(?: (.*))?|<!--: (.*))$", re.MULTILINE)
"""A line for learners: ``#: text``, ``//: text`` or ``<!--: text -->``; alone, an empty line."""


_NAME = re.compile(r"\{\{ ([\w.]+) \}\}")


class Rendered(NamedTuple):
    """A package in memory."""

    files: Mapping[str, str]
    executable: frozenset[str]
    notes: Mapping[str, str]
    """What a file is for, by path; not every file has one."""


class Renderer:
    """Renders the files of templates and short texts.

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
        self._is_tutorial = is_tutorial
        self._loader = _Loader(roots, templates, is_tutorial=is_tutorial)

    @cached_property
    def _plain(self) -> Jinja:
        jinja = Sandbox(
            loader=self._loader,
            undefined=StrictUndefined,
            keep_trailing_newline=True,
            trim_blocks=True,
            lstrip_blocks=True,
            autoescape=False,
            bytecode_cache=Compiled("tutorial" if self._is_tutorial else "brief"),
        )
        jinja.filters |= {
            "literal": filters.literal,
            "markdown": filters.markdown,
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
        return self._plain.overlay(finalize=filters.xml, bytecode_cache=kept)

    def has(self, name: str) -> bool:
        """Tell whether there is a file, such as ``launch/_readme.md.jinja``."""
        try:
            self._plain.get_template(name)
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
        with _Told(source):
            return self._plain.get_template(self._loader.named(source)).render(context)

    def condition(self, expression: str, context: Mapping[str, Any]) -> bool:
        """Evaluate a Jinja expression.

        Raises:
            ContentError: it cannot be evaluated.
        """
        return bool(self.text(f"{{% if {expression} %}}true{{% endif %}}", context))

    def file(self, name: str, context: Mapping[str, Any]) -> str:
        """Render a file by its name, such as ``package/README.md.jinja``.

        Raises:
            ContentError: it cannot be rendered.
        """
        jinja = self._xml if name.removesuffix(ENDING).endswith(".xml") else self._plain
        with _Told(name):
            return jinja.get_template(name).render(context)

    def license_header(self, license_: str, context: Mapping[str, Any]) -> str:
        """Return the header of a licence as comment lines."""
        return filters.comment(
            self.file(f"{licenses.DIRECTORY}/{license_}/{licenses.HEADER}", context)
        )

    def license_note(self, license_: str, context: Mapping[str, Any]) -> str | None:
        """Return what the user should know about a licence, if anything."""
        name = f"{licenses.DIRECTORY}/{license_}/{licenses.NOTE}"
        return self.file(name, context).strip() if self.has(name) else None

    def package(self, scopes: Iterable[tuple[Template, Mapping[str, Any]]]) -> Rendered:
        """Render all files of a package.

        Args:
            scopes: The templates, each with the variables of its files.

        Raises:
            ContentError: a file cannot be rendered, or two with different texts have the same path.
        """
        files: dict[str, str] = {}
        executable: set[str] = set()
        notes: dict[str, str] = {}
        for layer, scope in scopes:
            for source in _sources(layer.directory):
                if not self._is_included(layer, source, scope):
                    continue
                path = self._path(layer, source, scope)
                text = self.file(f"{layer.name}/{source}{ENDING}", scope)
                if files.setdefault(path, text) != text:
                    raise ContentError(f"{layer.directory}: {path} is rendered twice")
                if any(fnmatchcase(source, pattern) for pattern in layer.executable):
                    executable.add(path)
                note = _first_match(layer.notes, source)
                if note:
                    notes[path] = note
        return Rendered(files, frozenset(executable), notes)

    def _is_included(self, layer: Template, source: str, scope: Mapping[str, Any]) -> bool:
        expression = _first_match(layer.include, source)
        return expression is None or self.condition(str(expression), scope)

    def _path(self, layer: Template, source: str, scope: Mapping[str, Any]) -> str:
        """Fill in the names in a path; it holds no other Jinja, so Jinja is not needed."""
        path = _NAME.sub(lambda match: str(_value(match[1], scope)), source)
        where = os.path.join(layer.directory, source + ENDING)
        refuse_leaving(path, where)
        if "{" in path or "}" in path:
            raise ContentError(f"{where}: a path holds only {{{{ names }}}} that are defined")
        return path

    def _imports(self, lines: Iterable[str]) -> str:
        if not self._is_tutorial:
            lines = [line.partition("  #")[0] for line in lines]
        return filters.import_block(lines)


def _sources(directory: str) -> Iterator[str]:
    """Yield the paths of a template's files without their ending, partials left out."""
    for parent, directories, names in os.walk(directory):
        directories.sort()
        for name in directories:
            refuse_outside(os.path.join(parent, name), [directory])
        for name in sorted(names):
            path = os.path.relpath(os.path.join(parent, name), directory).replace(os.sep, "/")
            if path == MANIFEST or (name.startswith(".") and not name.endswith(ENDING)):
                continue
            if not name.endswith(ENDING):
                raise ContentError(f"{os.path.join(parent, name)}: must end in {ENDING}")
            if not name.startswith("_") or name.startswith("__"):
                yield path.removesuffix(ENDING)


def _value(name: str, scope: Mapping[str, Any]) -> object:
    """Return the value of a dotted name, or the name in braces when there is none."""
    value: Any = scope
    for part in name.split("."):
        if not isinstance(value, Mapping) or part not in value:
            return f"{{{name}}}"
        value = value[part]
    return value


def _first_match(table: Mapping[str, str], path: str) -> str | None:
    for pattern, value in table.items():
        if pattern == path or fnmatchcase(path, pattern):
            return value
    return None


class _Loader(BaseLoader):
    """Finds ``<template>/<path>`` and ``_licenses/...``, and handles the lines for learners.

    A short text is a template, too, so that it is kept compiled, as the files are.
    """

    def __init__(
        self, roots: Sequence[str], templates: Mapping[str, Template], *, is_tutorial: bool
    ) -> None:
        self._roots = roots
        self._templates = templates
        self._is_tutorial = is_tutorial
        self._texts: dict[str, str] = {}

    def named(self, text: str) -> str:
        """Return the name of the template that a short text is."""
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
            try:
                data = read_file(path, MOST_BYTES)
                refuse_outside(path, [*self._roots, directory])
                return self._with_comments(_decode(data)), path, None
            except (FileNotFoundError, NotADirectoryError):
                continue
            except (OSError, UnicodeDecodeError) as error:
                raise ContentError(f"{path}: {error}") from error
        raise TemplateNotFound(template)

    def _directories(self, first: str) -> list[str]:
        if first in self._templates:
            return [self._templates[first].directory]
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


class _Told:
    """Turns what Jinja raises into one line for the author of the template."""

    def __init__(self, where: str) -> None:
        self._where = where

    def __enter__(self) -> None:
        """Do nothing."""

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: object) -> None:
        if kind is None or not isinstance(error, Exception) or isinstance(error, ContentError):
            return
        line = getattr(error, "lineno", None) if isinstance(error, TemplateError) else None
        at = f":{line}" if line else _line_of(error)
        message = f"template {self._where!r}{at}: {type(error).__name__}: {error}"
        raise ContentError(" ".join(message.split())) from error


def _line_of(error: Exception) -> str:
    """Return where in a template's file something went wrong, if Jinja knows."""
    import traceback

    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if frame.filename.endswith(ENDING):
            return f", {frame.filename}:{frame.lineno}"
    return ""


def _decode(data: bytes) -> str:
    return data.decode().replace("\r\n", "\n").replace("\r", "\n")
