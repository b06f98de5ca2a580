"""Leaves out what is found in code that does not run on the target distribution."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress

from scaffold.diagnostic import Diagnostic
from scaffold.distributions import VARIABLE
from scaffold.model.cmake import distribution_branches as of_cmake
from scaffold.model.cmake.lists import CMakeLists
from scaffold.model.facts import fact
from scaffold.model.package import Package
from scaffold.model.python import distribution_branches as of_python
from scaffold.source import ViewError

CMAKE_LISTS = "CMakeLists.txt"

Lines = tuple[int, int]


def run_on_target(package: Package, diagnostics: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the findings in code that runs on the target.

    A package for several distributions asks for the variable ROS_DISTRO; what is in a branch for
    another one is right where it runs.
    """
    by_path: dict[str, Sequence[Lines]] = {}
    for diagnostic in diagnostics:
        at = diagnostic.location
        if at.path not in by_path:
            by_path[at.path] = _lines_not_run(package, at.path)
        if not any(first <= at.line <= last for first, last in by_path[at.path]):
            yield diagnostic


def _lines_not_run(package: Package, path: str) -> Sequence[Lines]:
    if path.rpartition("/")[2] == CMAKE_LISTS:
        return package.remember(("lines not run", path), lambda: _in_cmake(package, path))
    return _in_python(package, path) if path in package.python_files else ()


def _in_cmake(package: Package, path: str) -> Sequence[Lines]:
    with suppress(ViewError):  # which is reported
        if VARIABLE in package.source(path).text:
            return tuple(of_cmake.lines_not_run(CMakeLists.parse(package.source(path))))
    return ()


@fact
def _in_python(package: Package, path: str) -> Sequence[Lines]:
    with suppress(ViewError):
        if VARIABLE in package.source(path).text:
            return tuple(of_python.lines_not_run(package.module(path)))
    return ()
