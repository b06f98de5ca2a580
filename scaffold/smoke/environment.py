"""Selects the ROS 2 environment to build and run with, and its variables.

The first of these is used: the sourced environment, an installation in ``/opt/ros``, and the ROS
wheels in the Python environment of this tool.
"""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from glob import escape, glob
from pathlib import Path

from scaffold import distributions
from scaffold.distributions import Distribution
from scaffold.errors import EnvironmentMissingError
from scaffold.programs import installation, wheels
from scaffold.smoke.processes import marks, process
from scaffold.smoke.processes.process import Captured, Origin

INSTALLED = Path("/opt/ros")
DEFAULT_RMW = "rmw_fastrtps_cpp"
TIMEOUT = 120.0
"""Seconds for the start of an interpreter or a shell on a busy machine."""

_PASSED_ON = frozenset(
    {
        "HOME", "USER", "LOGNAME", "SHELL", "LANG", "LANGUAGE", "TZ", "TMPDIR",
        "DISPLAY", "WAYLAND_DISPLAY", "XAUTHORITY", "XDG_RUNTIME_DIR", "CC", "CXX",
    }
)  # fmt: skip
"""User variables that a clean environment inherits, besides ``LC_*``."""

_ROS_PREFIXES = ("ROS_", "RMW_", "RCUTILS_", "AMENT_", "COLCON_", "FASTRTPS_", "FASTDDS_")
_ROS_VARIABLES = frozenset({"CMAKE_PREFIX_PATH", "PYTHONPATH", "CYCLONEDDS_URI"})
"""Variables that another installation may have set, besides those with the prefixes above."""

_FROM_OUTSIDE = frozenset(
    {
        "ROS_DISCOVERY_SERVER", "ROS_STATIC_PEERS", "ROS_LOCALHOST_ONLY", "ROS_SUPER_CLIENT",
        "ROS_NAMESPACE", "ROS_SECURITY_ENABLE", "ROS_SECURITY_STRATEGY", "ROS_SECURITY_KEYSTORE",
        "ROS_SECURITY_ENCLAVE_OVERRIDE", "CYCLONEDDS_URI", "FASTRTPS_DEFAULT_PROFILES_FILE",
        "FASTDDS_DEFAULT_PROFILES_FILE", "COLCON_DEFAULTS_FILE",
    }
)  # fmt: skip
"""Variables that would let executables reach other machines, or change the build."""

_NO_RUN = Origin("environment")

_BOOTSTRAPPED = "_ROS_WHEELS_BOOTSTRAP_COMPLETE"
"""Set by the ROS wheels once LD_LIBRARY_PATH names their libraries."""


@dataclass(frozen=True)
class Environment:
    """A ROS 2 environment that can build and run packages."""

    kind: str
    """``sourced``, ``installed`` or ``wheels``."""
    prefix: str
    rmw: str
    python: str
    """The interpreter that has rclpy."""
    colcon: str
    variables: Mapping[str, str]
    """The whole environment of a child process."""
    distribution: str = ""
    """Its name, such as ``jazzy``; empty if unknown."""
    notes: tuple[str, ...] = ()
    """Why environments that the user may expect were not used."""

    def facts(self) -> dict[str, str]:
        """Return what a report says about it."""
        return {
            "kind": self.kind,
            "distribution": self.distribution,
            "prefix": self.prefix,
            "rmw": self.rmw,
        }


class _UnusableError(Exception):
    """The environment cannot be used; the text says why."""


def select(
    variables: Mapping[str, str],
    *,
    forced: str | None = None,
    wanted: Sequence[Distribution] = (),
    paths: Sequence[str] = (".",),
    installed: Path = INSTALLED,
    own_prefix: str = sys.prefix,
    origin: Origin = _NO_RUN,
) -> Environment:
    """Return the first usable environment, or the requested one.

    Args:
        variables: The environment variables of this process.
        forced: ``sourced``, ``wheels``, the name of an installation, or its directory.
        wanted: The accepted distributions; any if empty.
        paths: The paths to run, for the message.
        installed: The directory of installations, with one directory per distribution.
        own_prefix: The Python environment that may hold the ROS wheels.
        origin: The run.

    Raises:
        EnvironmentMissingError: there is none.
    """
    if forced is not None:
        try:
            return _forced(forced, _without_bootstrap(variables), installed, own_prefix, origin)
        except _UnusableError as reason:
            raise EnvironmentMissingError(f"--ros {forced}: {reason}") from reason
    reasons: list[str] = []
    names = [distribution.name for distribution in wanted]
    for find in _candidates(_without_bootstrap(variables), installed, own_prefix, origin, names):
        try:
            candidate = find()
            if names and candidate.distribution not in ("", *names):
                title = candidate.distribution.capitalize()
                raise _UnusableError(f"{_named(candidate)} is ROS 2 {title}")  # noqa: TRY301
            return replace(candidate, notes=tuple(reasons))
        except _UnusableError as reason:
            reasons.append(str(reason))
    why = f" ({'; '.join(reasons)})" if reasons else ""
    if wanted:
        has_wheels = _has_package(own_prefix, "rclpy")
        raise EnvironmentMissingError(
            _unavailable_message(wanted, why, paths, has_wheels=has_wheels)
        )
    raise EnvironmentMissingError(
        f"no ROS 2 environment found{why}: source the setup file of a ROS 2 installation, "
        f"install ROS 2 Jazzy, or run: {installation.command('ros')}"
    )


def _named(environment: Environment) -> str:
    """Describe an environment in words."""
    if environment.kind == "sourced":
        return "the sourced environment"
    return f"{'the wheels in ' if environment.kind == 'wheels' else ''}{environment.prefix}"


def _unavailable_message(
    wanted: Sequence[Distribution], why: str, paths: Sequence[str], *, has_wheels: bool
) -> str:
    """Return a message that no environment has one of the distributions, and how to get one.

    Args:
        wanted: The accepted distributions.
        why: Why no environment is usable.
        paths: What is run.
        has_wheels: Whether the environment of this tool has wheels of another distribution.
    """
    ways = ["source the setup file of an installation"]
    for distribution in wanted:
        if has_wheels and wheels.command_apart(distribution):
            command = wheels.command_apart(distribution)
            ways.append(
                f"install the wheels of {distribution.title} in a separate environment, and run "
                f"the tool there: {command}"
            )
        elif wheels.command(distribution):
            command = wheels.command(distribution)
            ways.append(f"install the wheels of {distribution.title}: {command}")
    container = wheels.container(wanted[-1], [*paths])
    return (
        f"no ROS 2 {' or '.join(item.title for item in wanted)} found{why}: {'; '.join(ways)}; or "
        f"use a container: {container}"
    )


def _forced(
    wanted: str, variables: Mapping[str, str], installed: Path, own_prefix: str, origin: Origin
) -> Environment:
    """Return the requested environment.

    Raises:
        _UnusableError: it does not exist or is unusable.
    """
    if wanted == "sourced":
        if not variables.get("AMENT_PREFIX_PATH"):
            raise _UnusableError(
                "nothing is sourced; first source the setup file of a ROS 2 installation"
            )
        return _sourced(variables, origin)
    if wanted == "wheels":
        if not _has_package(own_prefix, "rclpy"):
            raise _UnusableError(f"they are missing; run: {installation.command('ros')}")
        return _wheels(variables, own_prefix)
    setup = (Path(wanted) if os.sep in wanted else installed / wanted) / "setup.bash"
    if not setup.is_file():
        names = ", ".join(sorted(path.parent.name for path in installed.glob("*/setup.bash")))
        choices = f"sourced, wheels, {names}" if names else "sourced, wheels"
        raise _UnusableError(f"there is no {setup}; use a directory, or one of {choices}")
    return _installed(variables, setup.absolute(), own_prefix, origin)


def source(setup: Path, variables: Mapping[str, str], origin: Origin = _NO_RUN) -> dict[str, str]:
    """Return the variables after sourcing a setup file in a shell.

    Raises:
        EnvironmentMissingError: the shell failed.
    """
    done = process.capture(*sourcing(setup, variables), origin, TIMEOUT)
    return sourced_variables(setup, done)


def sourcing(setup: Path, variables: Mapping[str, str]) -> tuple[list[str], Mapping[str, str]]:
    """Return the command that sources a setup file in a shell, and its variables."""
    name = "bash" if setup.suffix == ".bash" else "sh"
    shell = shutil.which(name, path=variables.get("PATH") or os.defpath) or f"/bin/{name}"
    return [shell, "-c", '. "$1" && exec env -0', shell, str(setup)], variables


def sourced_variables(setup: Path, done: Captured) -> dict[str, str]:
    """Parse the variables printed by this command.

    Raises:
        EnvironmentMissingError: the shell failed.
    """
    if done.exit_code:
        last = done.err.strip().rpartition("\n")[2] or f"exit code {done.exit_code}"
        raise EnvironmentMissingError(f"{setup} cannot be sourced: {last}")
    pairs = (entry.partition("=") for entry in done.out.split("\0") if entry)
    ignored = {"_", "SHLVL", marks.MARK}
    return {name: value for name, _, value in pairs if name not in ignored}


def _candidates(
    variables: Mapping[str, str],
    installed: Path,
    own_prefix: str,
    origin: Origin,
    names: Sequence[str],
) -> Iterator[Callable[[], Environment]]:
    if variables.get("AMENT_PREFIX_PATH"):
        yield partial(_sourced, variables, origin)
    for setup in sorted(installed.glob("*/setup.bash"), key=_preference):
        if not names or setup.parent.name in names:
            yield partial(_installed, variables, setup, own_prefix, origin)
    if _has_package(own_prefix, "rclpy"):
        yield partial(_wheels, variables, own_prefix)


def _preference(setup: Path) -> tuple[bool, str]:
    return setup.parent.name != distributions.DEFAULT, setup.parent.name


def _sourced(variables: Mapping[str, str], origin: Origin) -> Environment:
    kept = {name: value for name, value in variables.items() if name not in _FROM_OUTSIDE}
    description = "the sourced environment (AMENT_PREFIX_PATH is set)"
    return _from_variables("sourced", kept, description, origin)


def _installed(
    variables: Mapping[str, str], setup: Path, own_prefix: str, origin: Origin
) -> Environment:
    base = {
        name: value
        for name, value in variables.items()
        if not name.startswith(_ROS_PREFIXES) and name not in _ROS_VARIABLES
    }
    if own_prefix != sys.base_prefix:
        # `#!/usr/bin/env python3` has to find the Python that this ROS was built for.
        own = os.path.join(own_prefix, "bin")
        parts = base.get("PATH", os.defpath).split(os.pathsep)
        base["PATH"] = os.pathsep.join(part for part in parts if os.path.normpath(part) != own)
        base.pop("VIRTUAL_ENV", None)
    try:
        sourced = source(setup, base, origin)
    except EnvironmentMissingError as error:
        raise _UnusableError(str(error)) from error
    return _from_variables("installed", sourced, str(setup.parent), origin)


def _wheels(variables: Mapping[str, str], prefix: str) -> Environment:
    binaries = os.path.join(prefix, "bin")
    for needed in ("bin/colcon", "bin/python3", "share/ament_cmake"):
        if not os.path.exists(os.path.join(prefix, needed)):
            raise _UnusableError(f"{prefix} has rclpy but no {needed}")
    passed = {
        name: value
        for name, value in variables.items()
        if name in _PASSED_ON or name.startswith("LC_")
    }
    rmw = _rmw([prefix], None)
    distribution = wheels.of(prefix)
    libraries = f"{escape(prefix)}/lib/python*/site-packages/ros_*.libs"
    made = {
        **passed,
        "PATH": os.pathsep.join((binaries, variables.get("PATH") or os.defpath)),
        "AMENT_PREFIX_PATH": prefix,
        "RMW_IMPLEMENTATION": rmw,
        "ROS_DISTRO": distribution,
        "ROS_VERSION": "2",
        "ROS_PYTHON_VERSION": "3",
        # The wheels would set these themselves by starting every Python twice; programs that are
        # not Python need it as well.
        "LD_LIBRARY_PATH": os.pathsep.join((f"{prefix}/lib", *sorted(glob(libraries)))),
        _BOOTSTRAPPED: "1",
        # The wheels come without local_setup files. This keeps colcon from looking for them and
        # from warning about it; writing them would change the user's Python environment.
        "COLCON_EXTENSION_BLOCKLIST": "colcon_core.prefix_path.ament",
    }
    return Environment(
        kind="wheels",
        prefix=prefix,
        rmw=rmw,
        python=os.path.join(binaries, "python3"),
        colcon=os.path.join(binaries, "colcon"),
        variables=made,
        distribution=distribution,
    )


def _from_variables(
    kind: str, variables: Mapping[str, str], description: str, origin: Origin
) -> Environment:
    """Return the environment described by variables.

    Raises:
        _UnusableError: it cannot build or run packages.
    """
    path = variables.get("PATH") or os.defpath
    python = shutil.which("python3", path=path)
    colcon = shutil.which("colcon", path=path)
    if python is None:
        raise _UnusableError(f"{description} has no python3 on PATH")
    if colcon is None:
        raise _UnusableError(
            f"{description} has no colcon on PATH (python3-colcon-common-extensions)"
        )
    prefixes = [part for part in variables.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if part]
    rmw = _rmw(prefixes, variables.get("RMW_IMPLEMENTATION"))
    # With a missing one, rclpy could not be imported.
    usable = {**variables, "RMW_IMPLEMENTATION": rmw}
    imported = process.capture([python, "-c", "import rclpy"], usable, origin, TIMEOUT)
    if imported.exit_code:
        last = imported.err.strip().rpartition("\n")[2]
        raise _UnusableError(
            f"{description} cannot be used: {python} does not import rclpy: {last}"
        )
    return Environment(
        kind=kind,
        prefix=next((p for p in prefixes if _has_package(p, "rclpy")), "".join(prefixes[-1:])),
        rmw=rmw,
        python=python,
        colcon=colcon,
        variables=usable,
        distribution=variables.get("ROS_DISTRO", ""),
    )


def _rmw(prefixes: list[str], wanted: str | None) -> str:
    """Return the middleware: the wanted one if it is installed and works without a router."""
    result: set[str] = set()
    for prefix in prefixes:
        index = os.path.join(prefix, "share/ament_index/resource_index/rmw_typesupport")
        if os.path.isdir(index):
            result.update(os.listdir(index))
    # The index also names the package that chooses between them.
    usable = sorted(n for n in result if n != "rmw_implementation" and "zenoh" not in n)
    if wanted in usable:
        return str(wanted)
    return usable[0] if usable and DEFAULT_RMW not in usable else DEFAULT_RMW


def _has_package(prefix: str, name: str) -> bool:
    index = os.path.join(prefix, "share/ament_index/resource_index/packages", name)
    return os.path.exists(index)


def _without_bootstrap(variables: Mapping[str, str]) -> dict[str, str]:
    """Remove variables set by the ROS wheels of this process, wrong for another Python."""
    clean = dict(variables)
    if clean.pop(_BOOTSTRAPPED, None) is None:
        return clean
    parts = [part for part in clean.pop("LD_LIBRARY_PATH", "").split(os.pathsep) if part]
    added = {part for part in parts if part.endswith(".libs") and "/site-packages/ros_" in part}
    added |= {part.partition("/lib/python")[0] + "/lib" for part in added}
    added.add(os.path.join(sys.prefix, "lib"))
    kept = [part for part in parts if part not in added]
    if kept:
        clean["LD_LIBRARY_PATH"] = os.pathsep.join(kept)
    return clean
