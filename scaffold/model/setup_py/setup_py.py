"""setup.py as data: the arguments of setup()."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.formats.ini import IniOption
from scaffold.model.python.evaluation.evaluator import Elements
from scaffold.model.python.evaluation.values import UNKNOWN, Glob, Unknown
from scaffold.model.python.module import PythonModule
from scaffold.model.setup_py.configured import configured
from scaffold.model.setup_py.data_files import DataFile, data_file, lacks_comma
from scaffold.model.setup_py.entry_points import EntryPoint, EntryPointReader
from scaffold.model.setup_py.evaluator import SetupEvaluator
from scaffold.model.setup_py.keywords import FindPackages, Keyword
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.formats.ini import IniFile
    from scaffold.model.package_files import PackageFiles

_SETUP_FUNCTIONS = frozenset({"setuptools.setup", "distutils.core.setup", "setuptools.core.setup"})
_FIND_PACKAGES = frozenset(
    {"setuptools.find_packages", "setuptools.find_namespace_packages"}
    | {"setuptools.PackageFinder.find", "setuptools.PEP420PackageFinder.find"}
)


class SetupPy:
    """A setup.py, analyzed without running it; the call of setup() may be missing."""

    def __init__(
        self,
        module: PythonModule,
        files: PackageFiles | None = None,
        cfg: IniFile | None = None,
    ) -> None:
        self.module = module
        self.evaluator = SetupEvaluator(module, files)
        self._cfg = cfg

    # -- the call

    @cached_property
    def call(self) -> ast.Call | None:
        """The first call of setup()."""
        for call in self.module.walk(ast.Call):
            if not _SETUP_FUNCTIONS.isdisjoint(self.module.qualified_names(call.func)):
                return call
        return None

    @property
    def location(self) -> Location:
        """The name of the function in the call of setup(), or the start of the file."""
        if self.call is None:
            return Location.start_of(self.module.path)
        return self.module.location(self.call.func)

    @cached_property
    def keywords(self) -> Mapping[str, Keyword]:
        """The keyword arguments by name, also those of a known ``**dict`` and of setup.cfg."""
        result: dict[str, Keyword] = {}
        if self.call is not None and self._cfg is not None:
            result |= {word.name: word for word in configured(self._cfg, self.call)}
        for word in self.call.keywords if self.call else ():
            if word.arg is None:
                result.update(self._unpacked(word.value))
                continue
            value = self.evaluator.value(word.value)
            at = self.module.location(word.value)
            result[word.arg] = Keyword(word.arg, value, word.value, at)
        return result

    @cached_property
    def has_unknown_keywords(self) -> bool:
        """Whether setup() has an unknown ``**`` argument."""
        words = self.call.keywords if self.call else ()
        return any(word.arg is None and self._dict_of(word.value) is None for word in words)

    def keyword(self, name: str) -> Keyword | None:
        """Return a keyword argument of setup()."""
        return self.keywords.get(name)

    def text(self, name: str) -> str | Unknown | None:
        """Return the value of a string keyword; ``None`` without it."""
        word = self.keyword(name)
        if word is None:
            return UNKNOWN if self.has_unknown_keywords else None
        return word.value if isinstance(word.value, str) else UNKNOWN

    def _unpacked(self, node: ast.expr) -> dict[str, Keyword]:
        result: dict[str, Keyword] = {}
        literal = self._dict_of(node)
        for key, value in zip(literal.keys, literal.values, strict=True) if literal else ():
            name = self.evaluator.evaluate(key)
            if isinstance(name, str):
                at = self.module.location(value)
                result[name] = Keyword(name, self.evaluator.value(value), value, at)
        return result

    def _dict_of(self, node: ast.expr) -> ast.Dict | None:
        """Return the dict literal of an expression, also through a name."""
        if isinstance(node, ast.Name):
            if not isinstance(self.evaluator.evaluate(node), dict):
                return None
            node = self.module.index.only_value(node) or node
        return node if isinstance(node, ast.Dict) else None

    # -- keywords

    @property
    def name(self) -> str | Unknown | None:
        """The name of the distribution."""
        return self.text("name")

    @property
    def version(self) -> str | Unknown | None:
        """The version."""
        return self.text("version")

    @property
    def maintainer(self) -> str | Unknown | None:
        """The maintainer."""
        return self.text("maintainer")

    @property
    def maintainer_email(self) -> str | Unknown | None:
        """The maintainer's address."""
        return self.text("maintainer_email")

    @property
    def description(self) -> str | Unknown | None:
        """The description."""
        return self.text("description")

    @property
    def license(self) -> str | Unknown | None:
        """The license."""
        return self.text("license")

    @cached_property
    def packages(self) -> Sequence[str] | FindPackages | Unknown | None:
        """The installed import packages; ``None`` without the keyword."""
        word = self.keyword("packages")
        if word is None:
            return UNKNOWN if self.has_unknown_keywords else None
        if isinstance(word.value, FindPackages):
            return word.value
        node = self._literal(word.node)
        if isinstance(node, ast.Call) and node is not self.call:
            return self._find_packages(node)
        if isinstance(word.value, list | tuple):
            # setuptools also accepts directories: "talker/nodes", "talker/nodes/".
            texts = [item for item in word.value if isinstance(item, str)]
            names = [text.rstrip("/").replace("/", ".") for text in texts]
            return names if len(names) == len(word.value) else UNKNOWN
        return UNKNOWN

    def _find_packages(self, node: ast.Call) -> FindPackages | Unknown:
        name = self.module.qualified_name(node.func)
        if name is None or name not in _FIND_PACKAGES:
            return UNKNOWN
        arguments: dict[str, ast.expr] = dict(
            zip(("where", "exclude", "include"), node.args, strict=False)
        )
        for word in node.keywords:
            if word.arg is None:
                return UNKNOWN
            arguments[word.arg] = word.value
        where = arguments.get("where")
        return FindPackages(
            "." if where is None else self.evaluator.text(where),
            self._texts(arguments.get("exclude"), ()),
            self._texts(arguments.get("include"), ("*",)),
            "namespace" in name or "PEP420" in name,
            self.module.location(node),
        )

    def _texts(self, node: ast.expr | None, default: tuple[str, ...]) -> tuple[str, ...] | Unknown:
        if node is None:
            return default
        value = self.evaluator.evaluate(node)
        if not isinstance(value, list | tuple):
            return UNKNOWN
        texts = tuple(item for item in value if isinstance(item, str))
        return texts if len(texts) == len(value) else UNKNOWN

    def _literal(self, node: ast.expr) -> ast.expr:
        """Return the only value assigned to a name, else the expression itself."""
        return self.module.index.only_value(node) or node

    # -- data_files

    @cached_property
    def data_files(self) -> Sequence[DataFile]:
        """The known entries of data_files; see ``data_files_complete``."""
        return self._configured_files or [
            data_file(self.module, self.evaluator, element)
            for element in self._data_elements.items
            if element.value is not UNKNOWN
            or isinstance(element.node, ast.Tuple | ast.List)
            or lacks_comma(self.evaluator, element.node)
        ]

    @cached_property
    def data_files_complete(self) -> bool:
        """Whether ``data_files`` are complete, each with all its sources."""
        if self.keyword("data_files") is None:
            return not self.has_unknown_keywords
        items, is_complete = self._data_elements
        is_complete = is_complete and all(item.value is not UNKNOWN for item in items)
        return is_complete and all(
            entry.complete and entry.destination is not UNKNOWN for entry in self.data_files
        )

    @cached_property
    def _configured_files(self) -> Sequence[DataFile]:
        """The entries of data_files in setup.cfg."""
        word = self.keyword("data_files")
        values = word.value if word is not None and word.node is self.call else ()
        return [x for x in values if isinstance(x, DataFile)] if isinstance(values, list) else []

    @cached_property
    def _data_elements(self) -> Elements:
        """The items of data_files, except patterns in place of a pair that match nothing."""
        word = self.keyword("data_files")
        if word is None or self._configured_files:
            return Elements((), complete=True)
        items, is_complete = self.evaluator.elements(word.node)
        kept = (
            x for x in items if not isinstance(x.value, Glob) or self.evaluator.paths(x.value) != []
        )
        return Elements(tuple(kept), is_complete)

    # -- entry points

    @cached_property
    def entry_points(self) -> Sequence[EntryPoint]:
        """The known entry points; see ``entry_points_complete``."""
        return [point for point in self._all_entry_points if point is not None]

    @cached_property
    def entry_points_complete(self) -> bool:
        """Whether ``entry_points`` are complete."""
        if self.keyword("entry_points") is None and self.has_unknown_keywords:
            return False
        return all(point is not None for point in self._all_entry_points)

    @property
    def console_scripts(self) -> Sequence[EntryPoint]:
        """The entry points that become executables."""
        return [point for point in self.entry_points if point.group == "console_scripts"]

    @cached_property
    def _all_entry_points(self) -> Sequence[EntryPoint | None]:
        """The entry points; ``None`` for those that are unknown."""
        word = self.keyword("entry_points")
        if word is None:
            return ()
        reader = EntryPointReader(self.module, self.evaluator)
        if isinstance(word.value, str):
            return list(reader.of_text(word.node, word.value))
        if word.node is self.call:
            groups = word.value.values() if isinstance(word.value, dict) else ()
            options = [group for group in groups if isinstance(group, IniOption)]
            return [point for group in options for point in reader.of_option(group, word.node)]
        literal = self._dict_of(word.node)
        if literal is None:
            return (None,)
        points: list[EntryPoint | None] = []
        for key, value in zip(literal.keys, literal.values, strict=True):
            group = self.evaluator.evaluate(key)
            if isinstance(group, str):
                points.extend(reader.of_group(group, value))
            else:
                points.append(None)
        return points
