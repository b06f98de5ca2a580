"""The robots of a package: top-level files, as opposed to included parts."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.package import mentions
from scaffold.model.remembered import remembered
from scaffold.model.robot.expressions import SHARE_MARK, is_known
from scaffold.model.robot.files import RobotFile, next_to, robot_file, robot_paths
from scaffold.model.robot.xacro.expansion import Expansion
from scaffold.model.robot.xacro.parts import NOT_URDF, NamedFile, Part
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.formats.xml import Element
    from scaffold.model.package import Package
    from scaffold.source import Location

_NAMED = lazy_re.compile(r"(?:\$\(find ([\w-]+)\)|package://([\w-]+))((?:/[\w.+-]+)+)(.?)")
_LAUNCH = ("launch.py", "launch.xml", "launch.yaml", "launch.yml")
_ASSIGNED = lazy_re.compile(r"[ ]*(\w+)[ ]{0,9}=(?!=)")
"""Matches the start of a line that sets a variable."""
_CONDITIONS = ("xacro:if", "xacro:unless")
_OF_CONTROL = frozenset({"command_interface", "state_interface"})
"""Elements of joints in ros2_control, which may be written by their own macro."""


class Robots(NamedTuple):
    """The robots in the files of a package."""

    whole: list[Expansion]
    """The robots."""
    fragments: list[Expansion]
    """Files and macros not used by any robot."""


@remembered
def robots(package: Package) -> Robots:
    """Return the robots of a package."""
    files: list[RobotFile] = []
    for path in robot_paths(package):
        try:
            file = robot_file(package, path)
        except ViewError:
            continue
        if file is not None:
            files.append(file)
    expansions = [Expansion(file, package).read() for file in files]
    included = {key for expansion in expansions for key in expansion.files}
    patterns = [pattern for expansion in expansions for pattern in expansion.patterns]
    whole: list[Expansion] = []
    fragments: list[Expansion] = []
    for expansion in expansions:
        path = expansion.file.path
        is_included = (package.name, path) in included or any(
            re.fullmatch(pattern, path.rpartition("/")[2]) for pattern in patterns
        )
        if not is_included and (_is_whole(expansion) or is_launched(package, path)):
            whole.append(expansion)
        else:
            fragments.append(Expansion(expansion.file, package, is_open=True).read())
    called = {macro for expansion in whole for macro in expansion.macros}
    fragments += [
        Expansion(file, package, is_open=True).read_macro(element)
        for file in files
        for element in (file.root.descendants() if file.is_xacro else ())
        if element.tag == "xacro:macro" and id(element) not in called
    ]
    return Robots(whole, fragments)


def urdf_parts(package: Package) -> Iterator[Part]:
    """Yield each URDF element in the files of a package, with its values in each call."""
    expansions = robots(package)
    for expansion in (*expansions.whole, *expansions.fragments):
        if not expansion.file.is_robot:
            continue
        pending = [*expansion.root.children]
        while pending:
            part = pending.pop()
            if part.tag in NOT_URDF or any(child.tag in _OF_CONTROL for child in part.children):
                continue
            if part.file.package is package:
                yield part
            pending += part.children


def is_launched(package: Package, path: str) -> bool:
    """Return whether a launch file of a package mentions a file, not only as an argument's value.

    Xacro includes such a file from another one: ``['xacro ', robot, ' wheels:=', wheels]``.
    """
    name = path.rpartition("/")[2]
    return _mentioned_by_launch(package, name) and not _is_given(package, name)


def is_argument_given(package: Package, name: str) -> bool:
    """Return whether a launch file of a package, or its configuration, may pass an argument."""
    return _mentioned_by_launch(package, name, (".yaml", ".yml"))


def _is_given(package: Package, name: str) -> bool:
    """Return whether a launch file passes a variable with a path to xacro as an argument."""
    for path in package.files:
        with suppress(ViewError):
            if path.endswith("launch.py") and mentions(package, path, name, ":="):
                text = package.source(path).text
                lines = [line for line in text.splitlines() if name in line]
                named = [match[1] for match in map(_ASSIGNED.match, lines) if match]
                if any(re.search(rf":=[\"'],\s{{0,99}}{variable}\b", text) for variable in named):
                    return True
    return False


def _mentioned_by_launch(package: Package, word: str, others: tuple[str, ...] = ()) -> bool:
    whole = re.compile(rf"(?<!\w){re.escape(word)}(?!\w)")
    for path in package.files:
        if path.endswith((*_LAUNCH, *others)):
            try:
                is_mentioned = mentions(package, path, word)
                if is_mentioned and whole.search(package.source(path).text):
                    return True
            except ViewError:
                continue
    return False


def _is_whole(expansion: Expansion) -> bool:
    """Return whether a file describes a robot by itself."""
    root = expansion.root
    if not expansion.file.is_xacro:
        return True
    makes_something = any(part.tag != "material" for part in root.children)
    makes_something |= bool(expansion.problems.misfits or expansion.problems.undefined)
    return makes_something and (root.tag != "robot" or root.get("name") is not None)


def named_files(package: Package) -> Iterator[NamedFile]:
    """Yield the files that URDF and xacro files require."""
    parts = list(urdf_parts(package))
    certain = {id(part.element) for part in parts if part.is_certain}
    certain |= {key for expansion in robots(package).whole for key in expansion.certain}
    for path in robot_paths(package):
        try:
            file = robot_file(package, path)
        except ViewError:
            continue
        for element in (file.root, *file.root.descendants()) if file is not None else ():
            is_certain = id(element) in certain or not _is_conditional(element)
            yield from _named_in(path, element, is_certain=is_certain)
    for part in parts:
        written = part.element.get("filename") or ""
        if part.tag in {"mesh", "texture"} and "${" in written:
            value = part.attributes["filename"]
            value = re.sub(f"{SHARE_MARK}([^{SHARE_MARK}]*){SHARE_MARK}", r"$(find \1)", value)
            if is_known(value):
                at = part.at("filename")
                yield from _paths_in(value, part.file.path, at, is_certain=part.is_certain)


def _is_conditional(element: Element) -> bool:
    """Return whether an element is inside of a condition."""
    above = element.parent
    while above is not None and above.tag not in _CONDITIONS:
        above = above.parent
    return above is not None


def _named_in(path: str, element: Element, *, is_certain: bool) -> Iterator[NamedFile]:
    if element.tag == "xacro:include":
        if (element.get("optional") or "false").lower() not in {"false", "0"}:
            return
        name = element.get("filename") or ""
        if name and not name.startswith("/") and {"$", "*", "?", "[", ":"}.isdisjoint(name):
            at = element.attributes["filename"].location
            yield NamedFile("", next_to(path, name), path, at, is_certain)
    for attribute in element.attributes.values():
        yield from _paths_in(attribute.value, path, attribute.location, is_certain=is_certain)
    if "$(find" in element.own_text or "package://" in element.own_text:
        at = element.text_location
        yield from _paths_in(element.own_text, path, at, is_certain=is_certain)


def _paths_in(text: str, user: str, location: Location, *, is_certain: bool) -> Iterator[NamedFile]:
    for match in _NAMED.finditer(text):
        if match[4] not in {"$", "*", "?", "["} and "/.." not in match[3]:
            name = match[1] or match[2]
            yield NamedFile(name, match[3].strip("/"), user, location, is_certain)
