"""The URDF and xacro files of a package and of its workspace."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

from scaffold.formats import xml_reader
from scaffold.model.install.share import share_of
from scaffold.model.launch.files import launch_files
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import ParseError, Source, UnreadEndError

if TYPE_CHECKING:
    from scaffold.formats.xml import Element
    from scaffold.model.package import Package

ENDINGS = (".urdf", ".xacro")
_OF_SRDF = frozenset({"disable_collisions", "end_effector", "group", "group_state"})
"""Elements of SRDF, which only MoveIt reads."""
_OF_OTHERS = frozenset({"test", "tests", "template", "templates"})
"""Directories whose files are no robots of the package."""


class RobotFile(NamedTuple):
    """A file that describes a robot or a part of it."""

    package: Package
    path: str
    root: Element

    @property
    def is_xacro(self) -> bool:
        """Whether xacro reads it."""
        return self.path.endswith(".xacro") or self.root.get("xmlns:xacro") is not None

    @property
    def is_robot(self) -> bool:
        """Whether it is URDF, and neither SDF nor SRDF."""
        if self.root.tag != "robot" or ".srdf" in self.path:
            return False
        return all(element.tag not in _OF_SRDF for element in self.root.descendants())


def robot_paths(package: Package) -> list[str]:
    """Return the files that are URDF or xacro by their name.

    Tests are skipped, as are templates of other tools, and programs for browsers, which
    have their own parser.
    """
    return [
        path
        for path in package.files
        if path.endswith(ENDINGS)
        and _OF_OTHERS.isdisjoint(path.split("/"))
        and not _is_of_browser(package, path)
    ]


def _is_of_browser(package: Package, path: str) -> bool:
    """Return whether a file is in a directory built by npm."""
    parts = path.split("/")[:-1]
    return any(
        package.has("/".join((*parts[:depth], "package.json"))) for depth in range(len(parts) + 1)
    )


@remembered
def robot_file(package: Package, path: str) -> RobotFile | None:
    """Return a file; ``None`` if it has a document type, which is not supported.

    Raises:
        ViewError: it does not exist, or is not well-formed.
    """
    try:
        source = xml_reader.decode(path, package.data(path))
        # urdfdom ignores namespaces: elements of Drake need no declaration.
        is_xacro = not path.endswith(".urdf") or "xacro" in source.text
        root = xml_reader.parse(source, has_namespaces=is_xacro).root
        return RobotFile(package, path, root)
    except ParseError as error:
        if "DOCTYPE" in error.message or not package.bytes_of(path).strip():
            return None
        message = error.message.replace("package.xml", path).replace(" such as <package>", "")
        if '"xacro:" is not declared' in message:
            message += (
                "; xacro and urdfdom reject the file: write "
                'xmlns:xacro="http://www.ros.org/wiki/xacro" in its root element'
            )
        is_read = path.endswith(".urdf") and _is_read_by_urdfdom(package, path, error)
        raise (UnreadEndError if is_read else ParseError)(error.location, message) from None


def _is_read_by_urdfdom(package: Package, path: str, error: ParseError) -> bool:
    """Return whether an error is outside of the top elements of a file that xacro does not read.

    urdfdom reads the first ``<robot>`` at the top (tinyxml2) and ignores the rest; a surplus
    end tag ends the document. xacro rejects both.
    """
    source = xml_reader.decode(path, package.data(path))
    at = source.offset(error.location.line, error.location.column)
    before, after = source.text[:at], source.text[at:]
    parts = [before] if after.startswith("</") else [before, f"<robots>{after}</robots>"]
    try:
        for part in parts:
            xml_reader.parse(Source(path, part), has_namespaces=False)
    except ParseError:
        return False
    name = posixpath.basename(path).encode()
    return "<robot" in source.text and not any(
        name in data and b"xacro" in data for data in map(package.data, launch_files(package))
    )


def source_of(package: Package, path: str) -> str:
    """Return the source of a file in the share directory; the path itself if there is none."""
    return share_of(package).files.get(path, path)


def next_to(path: str, name: str) -> str:
    """Return the path of a file given relative to another one."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(path), name))
