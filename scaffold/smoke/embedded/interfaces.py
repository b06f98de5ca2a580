"""Builds interface packages that the ROS wheels lack, and caches the results."""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from glob import glob
from pathlib import Path

from scaffold import distributions
from scaffold.files import home
from scaffold.model.package import Package
from scaffold.programs import wheels
from scaffold.smoke.building.build import Layout, build
from scaffold.smoke.embedded.sources import Bundle
from scaffold.smoke.environment import Environment
from scaffold.smoke.processes.process import Origin
from scaffold.smoke.result import Build
from scaffold.smoke.selection import needed_by

PLACE = "interfaces"
"""The directory below the cache, with one for each environment, and in it one per package."""

_GENERATOR = "share/rosidl_generator_py/package.xml"
_INTERFACES = (".msg", ".srv", ".action", ".idl")
_COMPILERS = ("c++", "g++", "clang++")


async def provide(
    environment: Environment,
    packages: Sequence[Package],
    scratch: Path,
    *,
    origin: Origin,
    timeout: float,
    tell: Callable[[str], None],
    announce: Callable[[str], None],
) -> Environment:
    """Return an environment extended by the interfaces that packages need, if possible.

    Args:
        environment: That of the ROS wheels; others are complete and returned unchanged.
        packages: The packages to build.
        scratch: The directory of the run.
        origin: The run that it belongs to.
        timeout: Seconds for the build.
        tell: Called with the current activity.
        announce: Called with interfaces to build, and with missing ones and the reason.
    """
    if environment.kind != "wheels":
        return environment
    bundle = Bundle()
    missing = _missing(environment, bundle, packages)
    if not missing:
        return environment
    places = {name: _place(environment, bundle, complete=full) for name, full in missing.items()}
    remembered = [
        place / name for name, place in places.items() if place and (place / name).is_dir()
    ]
    ready = with_prefixes(environment, remembered)
    known = {path.name for path in remembered}
    new = [name for name in missing if name not in known]
    if not new:
        return ready
    reason = _missing_requirement(environment)
    if reason:
        announce(f"{', '.join(new)}: not among the ROS wheels, and not built: {reason}")
        return ready
    announce(
        f"building {', '.join(new)}, which the ROS wheels lack; this takes minutes, and the result "
        "is cached"
    )
    tell(f"building {', '.join(new)}")
    layout = Layout.below(scratch / PLACE)
    sources = [_written(bundle, name, scratch, complete=missing[name]) for name in new]
    builds = await build(ready, sources, layout, scratch, origin=origin, timeout=timeout)
    for line in _failures(builds):
        announce(line)
    built = [name for name in new if builds[name].ok]
    prefixes = [_moved_to_cache(layout.install / name, places[name]) for name in built]
    return with_prefixes(ready, prefixes)


def _missing(
    environment: Environment, bundle: Bundle, packages: Sequence[Package]
) -> dict[str, bool]:
    """Return the packages of interfaces to build, and whether they need their C++ part as well."""
    own = {package.name for package in packages}
    available = [*own, *_packages_in(environment.prefix)]
    # Dependencies of interface packages need the C++ part as well.
    complete = {*bundle.closure(_needed(filter(_has_interfaces, packages)) - own, available)}
    names = bundle.closure(_needed(packages) - own, available)
    return {name: name in complete for name in names}


def _written(bundle: Bundle, name: str, scratch: Path, *, complete: bool) -> Package:
    """Write a package of interfaces, with its C++ part if it is to be complete."""
    directory = scratch / PLACE / "src" / name
    bundle.write(name, directory, complete=complete)
    return Package.at(str(directory))


def _needed(packages: Iterable[Package]) -> set[str]:
    return {name for package in packages for name in needed_by(package)}


def _has_interfaces(package: Package) -> bool:
    return any(path.endswith(_INTERFACES) for path in package.files)


def with_prefixes(environment: Environment, prefixes: Sequence[Path]) -> Environment:
    """Return an environment that finds the definitions, modules and libraries in prefixes."""
    variables = dict(environment.variables)
    for prefix in prefixes:
        _prepend(variables, "AMENT_PREFIX_PATH", str(prefix))
        _prepend(variables, "LD_LIBRARY_PATH", str(prefix / "lib"))
        for modules in glob(f"{prefix}/lib/python3*/site-packages"):
            _prepend(variables, "PYTHONPATH", modules)
    return replace(environment, variables=variables)


def _prepend(variables: dict[str, str], name: str, path: str) -> None:
    variables[name] = os.pathsep.join(filter(None, (path, variables.get(name))))


def _packages_in(prefix: str) -> list[str]:
    index = os.path.join(prefix, "share/ament_index/resource_index/packages")
    return os.listdir(index) if os.path.isdir(index) else []


def _place(environment: Environment, bundle: Bundle, *, complete: bool) -> Path | None:
    """Return the directory of cached packages; ``None`` without a home directory."""
    cache = home.cache()
    if cache is None:
        return None
    digest = hashlib.sha256(bundle.content + bytes([complete]))
    for path in (environment.python, os.path.join(environment.prefix, _GENERATOR)):
        with suppress(OSError):
            status = os.stat(path)
            digest.update(f"{os.path.realpath(path)} {status.st_mtime_ns}\n".encode())
    return Path(cache, PLACE, digest.hexdigest()[:16])


def _missing_requirement(environment: Environment) -> str:
    if not os.path.exists(os.path.join(environment.prefix, _GENERATOR)):
        command = wheels.command(distributions.target())
        return f"the interface generators are missing; run: {command}"
    path = environment.variables.get("PATH")
    has_compiler = environment.variables.get("CXX") or any(
        shutil.which(name, path=path) for name in _COMPILERS
    )
    return "" if has_compiler else "there is no C++ compiler; run: sudo apt install g++"


def _failures(builds: Mapping[str, Build]) -> Iterator[str]:
    for name, outcome in builds.items():
        if not outcome.ok:
            last = outcome.errors[-1] if outcome.errors else "no message"
            yield f"{name}: not among the ROS wheels, and cannot be built: {last}"


def _moved_to_cache(built: Path, place: Path | None) -> Path:
    """Move a package to the cache; return its directory."""
    if place is None:
        return built
    kept = place / built.name
    try:
        place.mkdir(parents=True, exist_ok=True)
        aside = tempfile.mkdtemp(dir=place, prefix=".new-")
    except OSError:
        return built
    try:
        shutil.copytree(built, aside, symlinks=True, dirs_exist_ok=True)
        os.chmod(aside, 0o755)  # noqa: S103  as colcon makes it
        os.rename(aside, kept)
    except OSError:
        shutil.rmtree(aside, ignore_errors=True)  # another run was faster, or the disk is full
    return kept if kept.is_dir() else built
