"""The files that a package installs, and where."""

from __future__ import annotations

from scaffold.model.discovery.texts_above import names_above
from scaffold.model.install.modules import (
    absolute_name,
    file_of,
    intended_module,
    is_elsewhere,
    is_installed_by_path,
    is_started,
    may_be_made,
    moved_to,
    own_roots,
    paths_imported_by,
    uninstalled_import,
)
from scaffold.model.install.reach import is_never_run
from scaffold.model.install.resources import own_files
from scaffold.model.install.share import share_of
from scaffold.model.install.unused import is_copy_of_old_code
from scaffold.model.rclpy.running.uncalled import is_uncalled

__all__ = [
    "absolute_name",
    "file_of",
    "intended_module",
    "is_copy_of_old_code",
    "is_elsewhere",
    "is_installed_by_path",
    "is_never_run",
    "is_started",
    "is_uncalled",
    "may_be_made",
    "moved_to",
    "names_above",
    "own_files",
    "own_roots",
    "paths_imported_by",
    "share_of",
    "uninstalled_import",
]
