"""Renders the files of a package in memory."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from itertools import chain
from types import MappingProxyType
from typing import Any

from scaffold import lazy_re
from scaffold.configuration import content
from scaffold.errors import ContentError
from scaffold.generate.repository import MARK
from scaffold.generate.templates import filters, licenses
from scaffold.generate.templates.engine import Engine, LocalEngine
from scaffold.generate.templates.sandbox import refuse_leaving, refuse_outside
from scaffold.generate.templates.template import ENDING, MANIFEST, Template
from scaffold.record import NamedTuple

_NAME = lazy_re.compile(r"\{\{ ([\w.]+) \}\}")


class Rendered(NamedTuple):
    """A package in memory."""

    files: Mapping[str, str]
    executable: frozenset[str]
    notes: Mapping[str, str]
    """The purpose of files, by path; not every file has one."""
    unread: tuple[str, ...] = ()
    """Files of the package that tools only read at the top of a git repository."""
    templates: Mapping[str, str] = MappingProxyType({})
    """The template's file by path."""


class Renderer:
    """Renders the files of templates and short texts.

    Args:
        roots: The ``templates`` directories; a later one wins.
        templates: The templates in them.
        is_tutorial: Whether tutorial comments are kept.
    """

    def __init__(
        self, roots: Sequence[str], templates: Mapping[str, Template], *, is_tutorial: bool
    ) -> None:
        directories = {name: template.directories for name, template in templates.items()}
        self._engine = _engine(roots, directories, is_tutorial=is_tutorial)

    def has(self, name: str) -> bool:
        """Return whether there is a file, such as ``launch/_readme.md.jinja``."""
        return self._engine.has(name)

    def text(self, source: str, context: Mapping[str, Any]) -> str:
        """Render a short text.

        Raises:
            ContentError: it cannot be rendered.
        """
        return self._engine.text(source, context) if "{" in source else source

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
        return self._engine.file(name, context)

    def license_header(self, license_: str, context: Mapping[str, Any]) -> str:
        """Return the header of a license as comment lines."""
        return filters.comment(
            self.file(f"{licenses.DIRECTORY}/{license_}/{licenses.HEADER}", context)
        )

    def license_note(self, license_: str, context: Mapping[str, Any]) -> str | None:
        """Return the note about a license, if there is one."""
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
        unread: list[str] = []
        templates: dict[str, str] = {}
        for layer, scope in scopes:
            for source in dict.fromkeys(chain(*map(_sources, layer.directories))):
                if not self._is_included(layer, source, scope):
                    continue
                path = self._path(layer, source, scope)
                is_above = any(fnmatchcase(source, pattern) for pattern in layer.repository)
                if is_above and scope["subdirectory"]:
                    path = f"{MARK}{path}"
                elif is_above:
                    unread.append(path)
                text = self.file(f"{layer.name}/{source}{ENDING}", scope)
                if files.setdefault(path, text) != text:
                    raise ContentError(f"{layer.directory}: {path} is rendered twice")
                templates[path] = _file(layer, source)
                if any(fnmatchcase(source, pattern) for pattern in layer.executable):
                    executable.add(path)
                note = _first_match(layer.notes, source)
                if note:
                    notes[path] = note
        return Rendered(files, frozenset(executable), notes, tuple(unread), templates)

    def _is_included(self, layer: Template, source: str, scope: Mapping[str, Any]) -> bool:
        expression = _first_match(layer.include, source)
        return expression is None or self.condition(str(expression), scope)

    def _path(self, layer: Template, source: str, scope: Mapping[str, Any]) -> str:
        """Fill in the variables of a path; it has no other Jinja."""
        path = _NAME.sub(lambda match: str(_value(match[1], scope)), source)
        where = _file(layer, source)
        refuse_leaving(path, where)
        if "{" in path or "}" in path:
            raise ContentError(f"{where}: a path holds only {{{{ names }}}} that are defined")
        return path


def _engine(
    roots: Sequence[str], directories: Mapping[str, Sequence[str]], *, is_tutorial: bool
) -> Engine:
    """Return the engine: in another process, unless all templates are built in."""
    if are_built_in(roots):
        return LocalEngine(roots, directories, is_tutorial=is_tutorial)
    from scaffold.generate.templates.foreign import ForeignEngine

    return ForeignEngine(roots, directories, is_tutorial=is_tutorial)


def _file(layer: Template, source: str) -> str:
    """Return the template file that is rendered to a path."""
    files = [os.path.join(directory, source + ENDING) for directory in layer.directories]
    return next(filter(os.path.exists, files), files[-1])


def are_built_in(roots: Sequence[str]) -> bool:
    """Return whether all templates are built in."""
    return list(roots) == content.roots("templates")


def _sources(directory: str) -> Iterator[str]:
    """Yield the paths of a template's files without their extension, except partials."""
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
    """Return the value of a dotted name, or the name in braces if it is undefined."""
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
