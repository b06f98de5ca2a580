"""Whether setup.py or setup.cfg declares pytest, without which colcon runs no tests of pytest."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.formats.ini import IniFile
    from scaffold.model.package import Package

EXTRAS = ("test", "tests", "testing")
"""The extras in which colcon looks for pytest."""
SECTION = "options.extras_require"
"""The section of setup.cfg with extras."""


def lacks_pytest(package: Package) -> bool:
    """Return whether a package built by its setup.py certainly declares pytest nowhere."""
    try:
        setup = package.setup_py
        if package.build_type != "ament_python" or setup.call is None:
            return False
        cfg = setup_cfg(package)
    except ViewError:
        return False
    is_old = setup.keyword("tests_require") is not None or (
        cfg is not None and cfg.option("options", "tests_require", "tests-require") is not None
    )
    return not (is_old or setup.has_unknown_keywords or has_extra(package))


def has_extra(package: Package) -> bool:
    """Return whether an extra for tests has pytest, as far as known."""
    extras = package.setup_py.keyword("extras_require")
    if extras is None:
        cfg = setup_cfg(package)
        options = [cfg.option(SECTION, name) for name in EXTRAS] if cfg is not None else []
        lines = [line.text for option in options if option for line in option.lines]
        return any(line.startswith(("pytest", "file:")) for line in lines)
    if not isinstance(extras.value, dict):
        return True
    # A list without pytest has no effect: colcon searches for that name.
    given = [extras.value[name] for name in EXTRAS if name in extras.value]
    return any(not isinstance(item, list) or _names_pytest(item) for item in given)


def setup_cfg(package: Package) -> IniFile | None:
    """Return setup.cfg, if there is one."""
    return package.setup_cfg if package.has("setup.cfg") else None


def _names_pytest(requirements: list[object]) -> bool:
    names = [requirement for requirement in requirements if isinstance(requirement, str)]
    return len(names) < len(requirements) or any(item.startswith("pytest") for item in names)
