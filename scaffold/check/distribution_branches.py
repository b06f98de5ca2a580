"""Drops findings in code that does not run on the target distribution."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress

from scaffold.ament.codes import CODES
from scaffold.diagnostic import Diagnostic
from scaffold.distributions import VARIABLE
from scaffold.model.cmake import distribution_branches as of_cmake
from scaffold.model.cmake.lists import CMakeLists
from scaffold.model.facts import fact
from scaffold.model.launch.evaluation import distribution_branches as of_launch
from scaffold.model.launch.markup_file import ENDINGS as LAUNCH_ENDINGS
from scaffold.model.package import Package
from scaffold.model.python.conditions import distribution_branches as of_python
from scaffold.model.python.conditions.distribution_conditions import ASKED
from scaffold.source import ViewError

CMAKE_LISTS = "CMakeLists.txt"

Stretch = tuple[int, int, int, int]
"""Line and column of the start and of the end."""


def run_on_target(package: Package, diagnostics: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the findings in code that runs on the target.

    A package for several distributions tests the variable ROS_DISTRO; code in a branch for
    another one is right where it runs. The linters of ament check all branches.
    """
    by_path: dict[str, Sequence[Stretch]] = {}
    for diagnostic in diagnostics:
        at = diagnostic.location
        if diagnostic.code in CODES:
            yield diagnostic
            continue
        if at.path not in by_path:
            by_path[at.path] = _not_run(package, at.path)
        place = (at.line, at.column)
        if not any(item[:2] <= place < item[2:] for item in by_path[at.path]):
            yield diagnostic


def _not_run(package: Package, path: str) -> Sequence[Stretch]:
    if path.rpartition("/")[2] == CMAKE_LISTS or path.endswith(".cmake"):
        return package.remember(("lines not run", path), lambda: _in_cmake(package, path))
    if path.endswith(LAUNCH_ENDINGS):
        return package.remember(("lines not run", path), lambda: _in_launch(package, path))
    return _in_python(package, path) if path in package.python_files else ()


def _in_cmake(package: Package, path: str) -> Sequence[Stretch]:
    with suppress(ViewError):  # which is reported
        source = package.source(path)
        if any(word in source.text for word in of_cmake.WORDS):
            lines = of_cmake.lines_not_run(CMakeLists.parse(source))
            return tuple((first, 0, last + 1, 0) for first, last in lines)
    return ()


@fact
def _in_python(package: Package, path: str) -> Sequence[Stretch]:
    with suppress(ViewError):
        if any(word in package.source(path).text for word in ASKED):
            in_python = of_python.stretches_not_run(package.module(path))
            return (*in_python, *_in_launch(package, path))
    return ()


def _in_launch(package: Package, path: str) -> Sequence[Stretch]:
    """Return the ranges of actions whose conditions are false on the target."""
    with suppress(ViewError):
        if VARIABLE in package.source(path).text and of_launch.has_conditions(package, path):
            return tuple(of_launch.stretches_not_run(package, path))
    return ()
