"""setup.py and setup.cfg."""

from __future__ import annotations

from scaffold.formats.ini import IniFile, IniOption
from scaffold.model.install.configured_scripts import (
    GROUPS,
    ConfiguredScript,
    call_without_destination,
    configured_scripts,
    installs_configured,
)
from scaffold.model.install.console_scripts import node_scripts
from scaffold.model.install.declared_pytest import (
    EXTRAS,
    SECTION,
    has_extra,
    lacks_pytest,
    setup_cfg,
)
from scaffold.model.install.package_data import installed_data, package_data
from scaffold.model.setup_py import edit as setup_edit
from scaffold.model.setup_py.data_files import DataFile
from scaffold.model.setup_py.entry_points import EntryPoint
from scaffold.model.setup_py.globs import matches
from scaffold.model.setup_py.keywords import FindPackages
from scaffold.model.setup_py.metadata import (
    is_requirement,
    is_specifier,
    is_version,
    requirements,
)
from scaffold.model.setup_py.setup_py import SetupPy

__all__ = [
    "EXTRAS",
    "GROUPS",
    "SECTION",
    "ConfiguredScript",
    "DataFile",
    "EntryPoint",
    "FindPackages",
    "IniFile",
    "IniOption",
    "SetupPy",
    "call_without_destination",
    "configured_scripts",
    "has_extra",
    "installed_data",
    "installs_configured",
    "is_requirement",
    "is_specifier",
    "is_version",
    "lacks_pytest",
    "matches",
    "node_scripts",
    "package_data",
    "requirements",
    "setup_cfg",
    "setup_edit",
]
