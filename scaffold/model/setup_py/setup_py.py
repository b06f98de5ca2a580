"""setup.py as data: the arguments of setup()."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from functools import cached_property

from scaffold.model.python.evaluator import Element, Evaluator
from scaffold.model.python.literals import string_pieces
from scaffold.model.python.module import PythonModule
from scaffold.model.python.values import UNKNOWN, Glob, Unknown
from scaffold.record import NamedTuple
from scaffold.source import Location

_SETUP_FUNCTIONS = frozenset({"setuptools.setup", "distutils.core.setup", "setuptools.core.setup"})
_FIND_PACKAGES = frozenset(
    {"setuptools.find_packages", "setuptools.find_namespace_packages"}
    | {"setuptools.PackageFinder.find", "setuptools.PEP420PackageFinder.find"}
)


class Keyword(NamedTuple):
    """A keyword argument of setup()."""

    name: str
    value: object
    """The value; ``UNKNOWN`` if it cannot be evaluated."""
    node: ast.expr
    """The expression of the value."""
    location: Location
    """The place of the value."""


class EntryPoint(NamedTuple):
    """An entry point such as ``talker = demo.talker:main``."""

    group: str
    """``console_scripts`` ..."""
    name: str
    module: str
    function: str
    """The function, dotted for an attribute of a class; empty without a colon."""
    text: str
    """The whole text; the other parts are empty if it is malformed."""
    location: Location
    node: ast.expr
    malformed: str | None = None
    """The error, if it is malformed."""
    joined: tuple[Location, ...] = ()
    """The locations of adjacent literals, if there are several: a comma may be missing."""


class DataFile(NamedTuple):
    """One ``(destination, [sources])`` of data_files."""

    destination: str | Unknown
    sources: tuple[str | Glob | Unknown, ...]
    complete: bool
    """Whether these are all sources."""
    location: Location
    node: ast.expr
    destination_location: Location
    source_locations: tuple[Location, ...]
    """The locations of the sources."""
    conditional: bool = False
    """Added under a condition or in a loop."""
    malformed: str | None = None


class FindPackages(NamedTuple):
    """``find_packages(...)``: the packages are found at build time."""

    where: str | Unknown
    exclude: tuple[str, ...] | Unknown
    include: tuple[str, ...] | Unknown
    namespace: bool
    """Whether directories without ``__init__.py`` are included."""
    location: Location

    def leaves_out(self, name: str) -> bool | Unknown:
        """Tell whether the patterns exclude a package of this name."""
        if isinstance(self.include, Unknown) or isinstance(self.exclude, Unknown):
            return UNKNOWN
        is_taken = any(fnmatchcase(name, pattern) for pattern in self.include)
        return not is_taken or any(fnmatchcase(name, pattern) for pattern in self.exclude)


class SetupPy:
    """A setup.py, analyzed without running it."""

    def __init__(self, module: PythonModule) -> None:
        self.module = module
        self.evaluator = Evaluator(module)

    @classmethod
    def parse(cls, module: PythonModule) -> SetupPy:
        """Return the view of a parsed setup.py; the call of setup() may be missing."""
        return cls(module)

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
        """The keyword arguments by name, including those of a known ``**dict``."""
        result: dict[str, Keyword] = {}
        for word in self.call.keywords if self.call else ():
            if word.arg is None:
                result.update(self._unpacked(word.value))
                continue
            value = self.evaluator.evaluate(word.value)
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
                result[name] = Keyword(name, self.evaluator.evaluate(value), value, at)
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
        node = self._literal(word.node)
        if isinstance(node, ast.Call):
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
        word = self.keyword("data_files")
        if word is None:
            return ()
        return [
            self._data_file(element)
            for element in self.evaluator.elements(word.node).items
            if element.value is not UNKNOWN or isinstance(element.node, ast.Tuple | ast.List)
        ]

    @cached_property
    def data_files_complete(self) -> bool:
        """Whether ``data_files`` are complete, each with all its sources."""
        word = self.keyword("data_files")
        if word is None:
            return not self.has_unknown_keywords
        elements = self.evaluator.elements(word.node)
        items_are_known = elements.complete and all(
            item.value is not UNKNOWN for item in elements.items
        )
        return items_are_known and all(
            entry.complete and entry.destination is not UNKNOWN for entry in self.data_files
        )

    def _data_file(self, element: Element) -> DataFile:
        node, value = element.node, element.value
        problem: str | None
        at = self.module.location(node)
        if isinstance(node, ast.Tuple | ast.List) and len(node.elts) == 2:  # noqa: PLR2004  a pair
            return self._written_data_file(node, at, conditional=element.conditional)
        match value:
            case (str() | Unknown() as destination, list() | tuple() as sources):
                evaluated = tuple(_source(source) for source in sources)
                complete = UNKNOWN not in evaluated
                places = (at,) * len(evaluated)
                return DataFile(
                    destination, evaluated, complete, at, node, at, places, element.conditional
                )
            case Unknown():
                problem = None
            case _:
                problem = "not a pair of a directory and a list of files"
        return DataFile(
            UNKNOWN,
            (),
            complete=False,
            location=at,
            node=node,
            destination_location=at,
            source_locations=(),
            conditional=element.conditional,
            malformed=problem,
        )

    def _written_data_file(
        self, node: ast.Tuple | ast.List, at: Location, *, conditional: bool
    ) -> DataFile:
        first, second = node.elts
        destination = self.evaluator.text(first)
        place = self.module.location(first)
        if isinstance(self.evaluator.evaluate(second), str):
            problem = "the files are a string, not a list"
            return DataFile(
                destination,
                (),
                complete=False,
                location=at,
                node=node,
                destination_location=place,
                source_locations=(),
                conditional=conditional,
                malformed=problem,
            )
        elements = self.evaluator.elements(second)
        sources = tuple(_source(item.value) for item in elements.items)
        places = tuple(self.module.location(item.node) for item in elements.items)
        complete = elements.complete and UNKNOWN not in sources
        return DataFile(destination, sources, complete, at, node, place, places, conditional)

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
        if isinstance(word.value, str):
            return list(self._ini_entry_points(word.node, word.value))
        literal = self._dict_of(word.node)
        if literal is None:
            return (None,)
        points: list[EntryPoint | None] = []
        for key, value in zip(literal.keys, literal.values, strict=True):
            group = self.evaluator.evaluate(key)
            if isinstance(group, str):
                points.extend(self._group(group, value))
            else:
                points.append(None)
        return points

    def _group(self, group: str, node: ast.expr) -> Iterator[EntryPoint | None]:
        value = self.evaluator.evaluate(node)
        if isinstance(value, str):
            for text, at in self._lines_of(node, value):
                yield self._entry_point(group, text, at, node)
            return
        elements = self.evaluator.elements(node)
        for item in elements.items:
            at = self.module.location(item.node)
            if isinstance(item.value, str):
                yield self._entry_point(group, item.value, at, item.node)
            elif isinstance(item.node, ast.Tuple | ast.List):
                yield from self._group(group, item.node)  # setuptools flattens nested lists
            else:
                yield None
        if not elements.complete:
            yield None

    def _ini_entry_points(self, node: ast.expr, value: str) -> Iterator[EntryPoint]:
        group = ""
        for text, at in self._lines_of(node, value):
            if text.startswith("[") and text.endswith("]"):
                group = text[1:-1].strip()
            else:
                yield self._entry_point(group, text, at, node)

    def _lines_of(self, node: ast.expr, value: str) -> Iterator[tuple[str, Location]]:
        """Yield the non-empty lines of a string, with their locations if known."""
        start, end = self.module.span(node)
        at = start
        for line in value.splitlines():
            text = line.strip()
            if not text or text.startswith("#"):
                continue
            begin = self.module.source.text.find(text, at, end)
            if begin >= 0:
                at = begin + len(text)
                yield text, self.module.source.location(begin, at)
            else:
                yield text, self.module.location(node)

    def _entry_point(self, group: str, text: str, at: Location, node: ast.expr) -> EntryPoint:
        name, equals, target = (part.strip() for part in text.partition("="))
        module, colon, function = (part.strip() for part in target.partition("[")[0].partition(":"))
        joined = self._joined_literals(node)
        problem = None
        if not name or not equals or not module:
            problem = "not of the form name = module:function"
        elif "=" in target or ":" in function or ":" in name:
            problem = "two entries run together"
        if problem:
            return EntryPoint(group, "", "", "", text, at, node, problem, joined)
        if not function and (colon or group in {"console_scripts", "gui_scripts"}):
            problem = "no function is named: name = module:function"
        elif not _is_importable(module) or not _is_dotted(function or "x"):
            problem = "module or function is not a Python name"
        return EntryPoint(group, name, module, function, text, at, node, problem, joined)

    def _joined_literals(self, node: ast.expr) -> tuple[Location, ...]:
        """Return the locations of the adjacent literals of a string."""
        if not isinstance(node, ast.Constant | ast.JoinedStr):
            return ()
        pieces = list(string_pieces(self.module, node))
        return tuple(self.module.source.location(*piece) for piece in pieces[1:] and pieces)


def _is_dotted(name: str) -> bool:
    return all(map(str.isidentifier, name.split(".")))


def _is_importable(module: str) -> bool:
    """Tell whether an entry point can have a module, which is imported by a string.

    Unlike in an ``import`` statement, parts of the name may start with a digit.
    """
    return re.fullmatch(r"\w+(?:\.\w+)*", module) is not None


def _source(value: object) -> str | Glob | Unknown:
    return value if isinstance(value, str | Glob) else UNKNOWN
