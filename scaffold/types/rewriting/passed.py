"""The arguments that a file passes to functions and classes of other modules.

These include inherited methods: ``self.send('hello')``.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping

from scaffold import lazy_re
from scaffold.files.limits import most_bytes
from scaffold.model.facts import fact
from scaffold.model.interfaces.syntax import SECTIONS
from scaffold.model.package import Package
from scaffold.record import NamedTuple
from scaffold.types.rewriting.callbacks import arguments_of, function_body
from scaffold.types.rewriting.statements import mentions
from scaffold.types.sources import imported_names

GIVEN = "_ros2_given"
"""The prefix of the global names of passed values."""
_OPENED = lazy_re.compile(r"(\.\w+)?\(")
_METHOD = lazy_re.compile(r"\.(\w+)\(")
_KEPT = lazy_re.compile(r"[ ]*(self\.\w+|\w+)[ ]*(?::[^=]*)?=[ ]*")
"""Matches the text before a call whose result is assigned."""
_SET = lazy_re.compile(r"[ ]*(?::[^=\n]*)?=(?!=)[ ]*(?!None\b)")
"""Matches the text after a name that is assigned."""
_IMPORTING = ("from", "import")
_TAKING = lazy_re.compile(rb"\bdef (?!main\b)\w+\((?!\s{0,9}(?:self|cls)?\s{0,9}\))")
"""Matches a function with arguments, whose types depend on its callers."""
_MOST_PACKAGES = 60
"""In larger workspaces, calls by other packages are not followed: each depends on all others."""
_BOUND = lazy_re.compile(r"\b(?:def|lambda|for|as|global|nonlocal|del|import)\b")
_CLASS = lazy_re.compile(r"^class \w+\(([\w., ]+)\):[^\n]*\n", re.MULTILINE)
"""Matches the head of a class with its bases."""
_OF_SELF = lazy_re.compile(r"(?<![\w.])(?:(self)|super\(\))\.(\w+)\((?!\))")
"""Matches the start of a method call of ``self`` with arguments."""
_REGISTERING = lazy_re.compile(r"\.create_(subscription|service)\(")
_TYPE = lazy_re.compile(r"(?:\w+\.)*[A-Z]\w*")
_OF_NODES = frozenset(
    {"create_client", "create_publisher", "create_service", "create_subscription", "create_timer"}
    | {"declare_parameter", "declare_parameters", "get_parameter", "get_parameters"}
    | {"get_logger", "get_clock", "set_parameters", "create_rate", "has_parameter"}
)
"""Methods that are assumed to be those of rclpy, whatever the class inherits from."""


class Place(NamedTuple):
    """The position of a call of a function of another module."""

    function: str
    """``talker.poses.to_pose``, ``talker.arm.Arm`` or ``talker.arm.Arm.move``."""
    start: int
    arguments: int
    """The start of its arguments; the end of the call if these are given."""
    given: Mapping[str, str] = {}
    """What rclpy passes to a callback, by position: objects of the classes of its messages."""


class Passed(NamedTuple):
    """The arguments that a call passes to a function of another module."""

    function: str
    """See ``Place``."""
    module: str
    """The module of the call."""
    given: Mapping[str, str]
    """By keyword or position: a constant, or the global name of a list that holds the value."""


def own_names(data: bytes, module: str, others: Collection[str] = ()) -> Mapping[str, str]:
    """Return what a file imports from other modules of its workspace, by local name.

    Args:
        data: The content of the file.
        module: Its own dotted name.
        others: The other importable packages of the workspace that it may import.
    """
    own = module.partition(".")[0]
    roots = {own, *others}
    words = [b"from .", *(f"{word} {root}".encode() for word in _IMPORTING for root in roots)]
    if not own or not any(word in data for word in words):
        return {}
    result: dict[str, str] = {}
    for name, called in imported_names(data, module.rpartition(".")[0]):
        root, _, rest = name.partition(".")
        if called and root in roots and rest and rest.partition(".")[0] not in SECTIONS:
            result[called] = name
    return result


def places(text: str, names: Mapping[str, str]) -> Iterator[Place]:
    """Yield the calls of functions, classes and methods of other modules.

    Args:
        text: A file.
        names: What it imports from other modules; see ``own_names``.
    """
    made: dict[str, set[str]] = {}
    for local, name in names.items():
        for start in mentions(text, local):
            opened = _OPENED.match(text, start + len(local))
            if opened is None:
                continue
            function = name + (opened[1] or "")
            yield Place(function, start, opened.end())
            kept = _KEPT.fullmatch(text, text.rfind("\n", 0, start) + 1, start)
            if kept is not None and function.rpartition(".")[2][:1].isupper():
                made.setdefault(kept[1], set()).add(function)
    objects = {local: next(iter(classes)) for local, classes in made.items() if len(classes) == 1}
    for local, class_ in objects.items():
        yield from calls_of_object(text, local, class_)
    yield from registered_callbacks(text, {**names, **objects})
    yield from _inherited(text, names)


def registered_callbacks(text: str, names: Mapping[str, str]) -> Iterator[Place]:
    """Yield the callbacks that are functions of other modules, or methods of their objects.

    Args:
        text: A file.
        names: The functions, classes and objects of other modules that it uses.
    """
    for call in _REGISTERING.finditer(text) if names else ():
        words, end = arguments_of(text, call.end())
        type_ = words.get("0", "")
        owner, dot, method = words.get("callback", words.get("2", "")).rpartition(".")
        function = f"{names.get(owner, '')}.{method}" if dot else names.get(method, "")
        if function.strip(".") == method or not _TYPE.fullmatch(type_):
            continue
        parts = ("Request", "Response") if call[1] == "service" else ("",)
        classes = [f"{type_}.{part}" if part else type_ for part in parts]
        given = {str(number): f"{class_}()" for number, class_ in enumerate(classes)}
        yield Place(function, call.start(), end, given)


def _inherited(text: str, names: Mapping[str, str]) -> Iterator[Place]:
    """Yield the calls of methods that classes inherit from classes of other modules."""
    for class_ in _CLASS.finditer(text) if names else ():
        parts = [base.strip().partition(".") for base in class_[1].split(",")]
        bases = [names[name] + dot + rest for name, dot, rest in parts if name in names]
        start = class_.end()
        body = start + len(function_body(text, class_.start(), start - 1)) - 1
        for call in _OF_SELF.finditer(text, start, body) if bases else ():
            is_own = call[1] is not None and text.find(f"def {call[2]}(", start, body) >= 0
            if not is_own and call[2] not in _OF_NODES:
                method = "" if call[2] == "__init__" else f".{call[2]}"
                first = bases[:1] if parts[0][0] in names else ()
                for base in bases if method else first:
                    yield Place(f"{base}{method}", call.start(), call.end())


def calls_of_object(text: str, name: str, class_: str) -> Iterator[Place]:
    """Yield the calls of methods of a variable or attribute, unless it may be another object."""
    places: list[Place] = []
    times_set = 0
    for start in mentions(text, name):
        end = start + len(name)
        called = _METHOD.match(text, end)
        if called is not None:
            places.append(Place(f"{class_}.{called[1]}", start, called.end()))
        elif _SET.match(text, end):
            times_set += 1
        elif _BOUND.search(text, text.rfind("\n", 0, start) + 1, start):
            return
    if times_set == 1:
        yield from places


def module_of(package: Package, path: str) -> str:
    """Return the dotted name of a module of a package; empty for other files."""
    parts = path.removeprefix("src/").removesuffix(".py").split("/")
    names = {package.name, package.name.removesuffix("_py")}
    is_module = len(parts) > 1 and parts[0] in names and all(map(str.isidentifier, parts))
    return ".".join(parts) if is_module else ""


class CallPlace(NamedTuple):
    """The place of a call in another module."""

    package: Package
    path: str
    line: int

    def seen_from(self, package: Package) -> str:
        """Return the place as text, for a message about a package."""
        start = "" if self.package is package else f"{self.package.name}/"
        return f"line {self.line} of {start}{self.path}"


def calls_from_modules(package: Package, path: str, function: str) -> Iterator[CallPlace]:
    """Yield the place of each call of a function of a module by other modules."""
    called = f"{module_of(package, path)}.{function}"
    for user, other in callers(package, path):
        data = user.data(other)
        text = data.decode()
        for place in places(text, own_names(data, module_of(user, other), other_roots(user, data))):
            if place.function == called:
                yield CallPlace(user, other, text.count("\n", 0, place.start) + 1)


def callers(package: Package, path: str) -> Iterator[tuple[Package, str]]:
    """Yield the other modules of a workspace that call functions of a module."""
    module = module_of(package, path)
    for name, other in _callers(package, path, module) if module else ():
        user = package if name == package.name else package.workspace.get(name)
        if user is not None:
            yield user, other


@fact
def _callers(package: Package, path: str, module: str) -> tuple[tuple[str, str], ...]:
    """Return the names of packages and the paths of modules that call functions of a module."""
    calls = {(package.name, other): called for other, called in _all_called(package).items()}
    if _TAKING.search(package.data(path)):
        calls.update(_calls_of_others(package, module.partition(".")[0]))
    return tuple(
        place
        for place, called in calls.items()
        if place != (package.name, path) and any(name.startswith(f"{module}.") for name in called)
    )


@fact
def _calls_of_others(package: Package, root: str) -> Mapping[tuple[str, str], frozenset[str]]:
    """Return the functions of a package that each module of other packages calls, if any."""
    if len(package.workspace.names) > _MOST_PACKAGES:
        return {}
    result: dict[tuple[str, str], frozenset[str]] = {}
    for other in package.workspace:
        for path, names in _all_called(other).items() if other.name != package.name else ():
            called = frozenset(name for name in names if name.startswith(f"{root}."))
            if called:
                result[other.name, path] = called
    return result


def other_roots(package: Package, data: bytes) -> frozenset[str]:
    """Return the other packages of the workspace that a file of a package may import."""
    names = package.workspace.names
    if not 1 < len(names) <= _MOST_PACKAGES:
        return frozenset()
    return frozenset(name for name in names if name != package.name and name.encode() in data)


@fact
def _all_called(package: Package) -> Mapping[str, frozenset[str]]:
    """Return the functions of other modules that each module of a package calls, if any."""
    called = {path: _called_functions(package, path) for path in package.python_files}
    return {path: names for path, names in called.items() if names}


@fact
def _called_functions(package: Package, path: str) -> frozenset[str]:
    module = module_of(package, path)
    if not module:
        return frozenset()
    try:
        data = package.bytes_of(path, most_bytes(path))
        text = data.decode()
    except (OSError, UnicodeDecodeError):
        return frozenset()
    names = own_names(data, module, other_roots(package, data))
    return frozenset(place.function for place in places(text, names))
