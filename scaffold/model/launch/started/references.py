"""The packages and programs that launch files refer to, and those of smoke.yaml."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.formats import yaml as yaml_tree
from scaffold.model.catalog import ROS_PACKAGES, is_near, similar_package
from scaffold.model.discovery.repos_files import is_fetched, is_included
from scaffold.model.facts import fact
from scaffold.model.launch.markup_file import is_known, markup_files
from scaffold.model.launch.python_file import NODES, LaunchFile, launch_paths
from scaffold.model.launch.unused.unlaunched import is_never_used
from scaffold.model.programs.executables import programs_of
from scaffold.model.python.evaluation.values import UNKNOWN, Unknown
from scaffold.model.released import is_released
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.source import Location


_SMOKE = "smoke.yaml"
_VERBS = ("action", "bag", "component", "interface", "launch", "lifecycle", "node", "param")
_OWNERS: Mapping[str, str] = {
    "xacro": "xacro",
    "rviz2": "rviz2",
    "rqt": "rqt_gui",
    "rqt_graph": "rqt_graph",
    "rqt_plot": "rqt_plot",
    "rqt_image_view": "rqt_image_view",
    "ros2 control": "ros2controlcli",
    **{f"ros2 {verb}": f"ros2{verb}" for verb in (*_VERBS, "pkg", "run", "service", "topic")},
}
"""Programs that launch files run by name, with their packages."""


class Reference(NamedTuple):
    """A reference to a package in a launch file."""

    name: str
    location: Location
    executable: str | Unknown | None
    """The started program; ``None`` if a file of the package is used."""
    executable_location: Location
    is_optional: bool = False
    """Whether it is used under a Python condition, or never, so that it may be missing."""
    program: str = ""
    """A program run by name: ``xacro``, ``ros2 bag``."""


class Suggestion(NamedTuple):
    """The package that a misspelled name refers to."""

    name: str
    reason: str


def package_uses(package: Package) -> list[Reference]:
    """Return the packages that the launch files name, in the order of the text."""
    return package.remember(
        "launch_uses", lambda: [*_in_python(package), *_in_xml(package), *_expected(package)]
    )


def _in_python(package: Package) -> Iterator[Reference]:
    for path in launch_paths(package):
        with suppress(ViewError):
            yield from _in_launch_file(package, path)


@fact
def _in_launch_file(package: Package, path: str) -> tuple[Reference, ...]:
    launch = LaunchFile.of(package, path)
    result: list[Reference] = []
    for use in launch.package_uses:
        call = use.action
        executable: str | Unknown | None = None
        at = use.location
        if call is not None and call.kind != "ComposableNode":
            executable = launch.text(call, "executable") or UNKNOWN
            node = call.given.get("executable")
            at = launch.location(node) if node is not None else at
        optional = launch.is_optional(use.node) or (
            call is not None and is_never_used(launch, call.call)
        )
        result.append(Reference(use.name, use.location, executable, at, optional))
    result += _in_cases(launch)
    for program, node in launch.programs:
        owner = _OWNERS.get(program)
        if owner is not None:
            at = launch.location(node)
            result.append(Reference(owner, at, None, at, launch.is_optional(node), program))
    return tuple(result)


def _in_cases(launch: LaunchFile) -> Iterator[Reference]:
    """Yield the programs of nodes in helper functions and loops, each where it is named."""
    for call in launch.find(*NODES):
        node, program = call.given.get("package"), call.given.get("executable")
        if node is None or program is None or isinstance(launch.text(call, "executable"), str):
            continue
        optional = launch.is_optional(call.call) or is_never_used(launch, call.call)
        for case in launch.cases(call.call):
            with launch.evaluator.bound(case.values):
                names = launch.text(call, "package"), launch.text(call, "executable")
            if isinstance(names[0], str) and isinstance(names[1], str):
                places = (case.place(launch.module, item) for item in (node, program))
                at, program_at = map(launch.location, places)
                yield Reference(names[0], at, names[1], program_at, optional)


def _in_xml(package: Package) -> Iterator[Reference]:
    for file in markup_files(package):
        for node in file.nodes:
            if node.package is not None and is_known(node.package):
                program = node.executable
                executable: str | Unknown = UNKNOWN
                if program is not None and is_known(program):
                    executable = program.value
                at = (program or node.package).location
                yield Reference(node.package.value, node.package.location, executable, at)
        for path in file.paths:
            yield Reference(path.package, path.location, None, path.location)


def _expected(package: Package) -> Iterator[Reference]:
    """Yield the executables of the package that its smoke.yaml describes."""
    if not package.has(_SMOKE):
        return
    with suppress(ViewError):
        for key, node in yaml_tree.mappings(yaml_tree.parse(package.source(_SMOKE))):
            for name, _ in node.pairs if key == "executables" else ():
                yield Reference(package.name, name.location, name.text, name.location)


def exists(package: Package, name: str) -> bool:
    """Return whether a package is known: itself, in the workspace, declared, or released."""
    if name == package.name or name in ROS_PACKAGES or package.workspace.get(name) is not None:
        return True
    try:
        return name in package.manifest.declared_names
    except ViewError:
        return True


def meant_package(package: Package, use: Reference) -> Suggestion | None:
    """Return the package that an unknown package name certainly refers to."""
    if exists(package, use.name) or is_released(use.name):
        return None
    own = programs_of(package).sources
    if isinstance(use.executable, str) and use.executable in own:
        return Suggestion(package.name, f"it has the executable {use.executable!r}")
    if is_near(use.name, package.name):
        return Suggestion(package.name, "this package")
    for other in package.workspace.names:
        if is_near(use.name, other) and not is_included(package, use.name):
            return Suggestion(other, "a package of the workspace")
    for other in sorted(package.manifest.declared_names):
        if is_near(use.name, other):
            return Suggestion(other, "which package.xml declares")
    package_name = None if is_fetched(package, use.name) else similar_package(use.name)
    return Suggestion(package_name, "a package of ROS") if package_name else None
