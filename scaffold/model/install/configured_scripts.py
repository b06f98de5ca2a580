"""The console scripts that setup.cfg declares, and whether the build installs them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

if TYPE_CHECKING:
    from scaffold.formats.ini import IniOption
    from scaffold.model.cmake.parser import Command
    from scaffold.model.package import Package

GROUPS = "options.entry_points"
"""The section of setup.cfg with the groups of entry points."""
_CALL = "ament_python_install_package"
_KEYWORDS = frozenset(
    {"PACKAGE_DIR", "VERSION", "SETUP_CFG", "DESTINATION", "SCRIPTS_DESTINATION", "SKIP_COMPILE"}
)


class ConfiguredScript(NamedTuple):
    """A console script of setup.cfg, such as ``talker = demo.talker:main``."""

    name: str
    module: str
    function: str
    location: Location


def configured_scripts(package: Package) -> Sequence[ConfiguredScript]:
    """Return the well-formed console scripts of setup.cfg; raises ViewError if it is malformed."""
    if not package.has("setup.cfg"):
        return []
    option = package.setup_cfg.option(GROUPS, "console_scripts")
    return _scripts_in(option) if option is not None else []


def unknown_groups(package: Package) -> bool:
    """Return whether setup.cfg mentions entry points that `configured_scripts` cannot read."""
    if not package.has("setup.cfg") or "entry_points" not in package.source("setup.cfg").text:
        return False
    section = package.setup_cfg.sections.get(GROUPS)
    return section is None


def call_without_destination(package: Package) -> Command | None:
    """Return the call that packs setup.cfg without installing its scripts, if it is the only one.

    ament_python_install_package() installs scripts only with SCRIPTS_DESTINATION.
    """
    calls = package.cmake.find(_CALL)
    if len(calls) != 1 or _given(calls[0], "SETUP_CFG") or _given(calls[0], "SCRIPTS_DESTINATION"):
        return None
    return calls[0]


def installs_configured(package: Package) -> bool:
    """Return whether CMake installs the scripts of setup.cfg for ``ros2 run``.

    Those that setup.py installs are among its own entry points.
    """
    if package.build_type == "ament_python":
        return False
    try:
        return any(_installs(package, call) for call in package.cmake.find(_CALL))
    except ViewError:
        return False


def installs_unknown_scripts(package: Package) -> bool:
    """Return whether CMake installs scripts of a setup.cfg that is elsewhere, or to elsewhere."""
    calls = package.cmake.find(_CALL)
    return any(_given(call, "SCRIPTS_DESTINATION") for call in calls)


def _installs(package: Package, call: Command) -> bool:
    """Return whether a call installs the scripts of the setup.cfg in the root of the package."""
    cmake = package.cmake
    destination = cmake.expand_list(call.keyword("SCRIPTS_DESTINATION", _KEYWORDS), call)
    wanted = f"lib/{package.name}"
    if destination is None or not any(item.rstrip("/") == wanted for item in destination):
        return False
    return cmake.expand_list(call.keyword("SETUP_CFG", _KEYWORDS), call) in ([], ["setup.cfg"])


def _given(call: Command, keyword: str) -> bool:
    return bool(call.keyword(keyword, _KEYWORDS))


def _scripts_in(option: IniOption) -> list[ConfiguredScript]:
    result = []
    for line in option.lines:
        name, _, target = line.text.partition("=")
        module, _, function = target.partition("[")[0].partition(":")
        if name.strip() and module.strip() and function.strip():
            result.append(
                ConfiguredScript(name.strip(), module.strip(), function.strip(), line.location)
            )
    return result
