"""The interface files of a package, and the calls that generate code for them."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.closure import closure
from scaffold.model.cmake.rosidl import GENERATE, Generation, generations_of
from scaffold.model.contents.ament_cmake import has_unknown_commands
from scaffold.model.facts import fact
from scaffold.model.interfaces.sources import is_test_data
from scaffold.model.interfaces.syntax import SECTIONS, Definition, Problem, ProblemKind, parse
from scaffold.model.remembered import remembered, remembered_list
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_INTERFACES = (".msg", ".srv", ".action")
_USERS = (".py", ".cpp", ".hpp", ".cc", ".h", *_INTERFACES)
"""Extensions of files that use interfaces."""


class InterfaceFile(NamedTuple):
    """A .msg, .srv or .action file of a package."""

    path: str
    kind: str
    name: str
    definition: Definition


def generations(package: Package) -> list[Generation]:
    """Return the calls in CMakeLists.txt; raises ViewError."""
    return package.remember("generations", lambda: generations_of(package.cmake))


def may_generate_more(package: Package) -> bool:
    """Return whether other CMake files or commands may generate interfaces, too."""
    return has_unknown_commands(package) or any(
        "generate" in command.name and "interfaces" in command.name
        for command in package.cmake.commands
        if command.name != GENERATE
    )


def is_interface_package(package: Package) -> bool:
    """Return whether a package installs interfaces; raises ViewError."""
    return any(
        not generation.for_tests and "SKIP_INSTALL" not in generation.options
        for generation in generations(package)
    )


def ungenerated_candidates(package: Package) -> list[str]:
    """Return the files in ``msg/``, ``srv/`` and ``action/`` with that extension."""
    return [
        path
        for path in package.files
        if path.count("/") == 1
        and path.partition("/")[0] in SECTIONS
        and path.endswith(f".{path.partition('/')[0]}")
    ]


def is_commented_out(package: Package, path: str) -> bool:
    """Return whether a comment of CMakeLists.txt mentions a file, which is omitted on purpose."""
    cmake = package.cmake
    name = path.rpartition("/")[2]
    return any(name in cmake.text(token) for token in cmake.comments)


@remembered
def names_used_in_code(package: Package) -> set[str]:
    """Return the words in the workspace's code and interfaces that may name a type of a package.

    ``Beat`` of ``from my_msgs.msg import Beat``, ``my_msgs::msg::Beat``, ``my_msgs/Beat``, or alone
    in an interface of the package that is generated or used itself.
    """
    result: set[str] = set()
    not_generated: dict[str, AbstractSet[str]] = {}
    own: set[str] = set()
    with contextlib.suppress(ViewError):  # packages without CMake generate nothing
        own = {file.path for call in generations(package) for file in call.files}
    for other in package.workspace:
        for path in other.files:
            if not path.endswith(_USERS):
                continue
            with contextlib.suppress(ViewError):
                if other.name == package.name and path in own:
                    result.update(_capitalized(other.source(path).text))
                elif path.endswith(".py"):
                    result.update(_names_used_in_python(other, path, package.name))
                elif other.name == package.name and path.endswith(_INTERFACES):
                    name = path.rpartition("/")[2].rpartition(".")[0]
                    not_generated[name] = _names_used_in(other, path, package.name) - {name}
                else:
                    result.update(_names_used_in(other, path, package.name))
    return result | closure(result, lambda name: not_generated.get(name, ()))


_COMMENT = lazy_re.compile(r"^[ \t]*(?://|#(?!include)).*", re.MULTILINE)
"""Matches a line that is a comment of C++ or Python."""


@fact
def _names_used_in_python(package: Package, path: str, name: str) -> frozenset[str]:
    return _names_used_in(package, path, name)


def _names_used_in(package: Package, path: str, name: str) -> frozenset[str]:
    """Return the words in a file that may be names of types of a package."""
    text = package.source(path).text
    if name not in text:
        return frozenset()
    text = _COMMENT.sub("", text)
    section = r"(?:msg|srv|action)(?:\.|::|/|\s+import\s*\(?)"
    use = rf"\b{re.escape(name)}(?:\.|::|/)(?:{section})?([\w\s,\\]*)"
    return frozenset(word for item in re.findall(use, text) for word in _capitalized(item))


def _capitalized(text: str) -> list[str]:
    return re.findall(r"[A-Z]\w+", text)


@remembered_list
def interface_files(package: Package) -> Iterator[InterfaceFile]:
    """Return the files that ``rosidl_generate_interfaces`` reads, or may read.

    None when nothing is generated: then they may be of ROS 1. Raises ViewError.
    """
    calls = generations(package)
    if not calls:
        return
    listed = {file.path for call in calls for file in call.files}
    knows_all = all(call.is_complete for call in calls)
    others = () if knows_all else ungenerated_candidates(package)
    names = {path.rpartition("/")[2] for path in listed}
    for path in sorted({*listed, *(path for path in others if not is_test_data(path))}):
        is_other = path.rpartition("/")[2] in names  # of ROS 1: one name is generated once
        if path not in listed and (is_other or is_commented_out(package, path)):
            continue
        stem, _, kind = path.rpartition("/")[2].rpartition(".")
        if kind in SECTIONS and package.has(path):
            try:
                source = package.source(path)
            except ViewError:
                continue
            yield InterfaceFile(path, kind, stem, parse(source, package.name, kind, stem))


def problems(package: Package, *kinds: ProblemKind) -> Iterator[Problem]:
    """Yield the problems of some kinds in the interface files of a package."""
    for file in interface_files(package):
        for problem in file.definition.problems:
            if problem.kind in kinds:
                yield problem
