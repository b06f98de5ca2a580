"""The configuration file, and where each value came from.

``ros2-scaffold.toml`` in the current directory or the nearest one above it is the project's;
``$XDG_CONFIG_HOME/ros2-scaffold/config.toml`` is the user's. A table ``[check]`` of the project
wins over the user's key by key; flags win over both.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from scaffold.errors import ConfigError
from scaffold.model.disk import Disk
from scaffold.record import NamedTuple

PROJECT_FILE = "ros2-scaffold.toml"
USER_FILE = os.path.join("ros2-scaffold", "config.toml")

_CHECK_KEYS = frozenset({"select", "ignore", "per-path-ignores"})


class Value(NamedTuple):
    """A value and the file it stands in."""

    value: Any
    origin: str


class Config(NamedTuple):
    """The merged tables: values by ``table.key``."""

    values: Mapping[str, Value]
    content: tuple[str, ...] = ()
    """Content directories, relative ones resolved against their file."""

    def strings(self, key: str) -> tuple[str, ...]:
        """Return a list of strings, empty when not set.

        Raises:
            ConfigError: the value is something else.
        """
        found = self.values.get(key)
        if found is None:
            return ()
        if not isinstance(found.value, list) or not all(isinstance(v, str) for v in found.value):
            raise ConfigError(f"{found.origin}: {key} must be a list of strings")
        return tuple(found.value)

    def string(self, key: str) -> str | None:
        """Return a string, ``None`` when not set.

        Raises:
            ConfigError: the value is something else.
        """
        found = self.values.get(key)
        if found is not None and not isinstance(found.value, str):
            raise ConfigError(f"{found.origin}: {key} must be a string")
        return None if found is None else found.value

    def per_path_ignores(self) -> dict[str, tuple[str, ...]]:
        """Return code prefixes to ignore by path pattern.

        Raises:
            ConfigError: the table has another form.
        """
        found = self.values.get("check.per-path-ignores")
        if found is None:
            return {}
        if not isinstance(found.value, dict) or not all(
            isinstance(codes, list) and all(isinstance(code, str) for code in codes)
            for codes in found.value.values()
        ):
            raise ConfigError(f"{found.origin}: per-path-ignores maps patterns to lists of codes")
        return {pattern: tuple(codes) for pattern, codes in found.value.items()}

    def origin(self, key: str) -> str:
        """Return the file that a value stands in."""
        return self.values[key].origin


def load(directory: str = ".", content: tuple[str, ...] = (), disk: Disk | None = None) -> Config:
    """Read the user's and the project's file.

    Args:
        directory: Where the search for the project's file starts.
        content: Content directories given as flags; they come last.
        disk: Notes which files were looked for and what they hold.

    Raises:
        ConfigError: a file cannot be read, is not TOML, or has an unknown key.
    """
    disk = disk or Disk()
    values: dict[str, Value] = {}
    directories: list[str] = []
    for path in filter(None, (_user_file(disk), _project_file(disk, directory))):
        for table, entries in _read(disk, path).items():
            if table == "content":
                directories += _content(entries, path)
                continue
            if not isinstance(entries, dict):
                raise ConfigError(f"{path}: {table} stands outside of a table such as [check]")
            for key, value in entries.items():
                if table == "check" and key not in _CHECK_KEYS:
                    known = ", ".join(sorted(_CHECK_KEYS))
                    raise ConfigError(f"{path}: [check] has no key {key!r}; it has {known}")
                values[f"{table}.{key}"] = Value(value, path)
    return Config(values, (*directories, *content))


def _user_file(disk: Disk) -> str | None:
    base = os.environ.get("XDG_CONFIG_HOME") or os.path.join(os.path.expanduser("~"), ".config")
    path = os.path.join(base, USER_FILE)
    return path if disk.is_file(path) else None


def _project_file(disk: Disk, directory: str) -> str | None:
    current = os.path.abspath(directory)
    while True:
        path = os.path.join(current, PROJECT_FILE)
        if disk.is_file(path):
            return path
        parent = os.path.dirname(current)
        if parent == current:
            return None
        current = parent


def _read(disk: Disk, path: str) -> dict[str, Any]:
    import sys

    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib
    try:
        return tomllib.loads(disk.read(path).decode())
    except OSError as error:
        raise ConfigError(f"{path}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ConfigError(f"{path}: not TOML: {error}") from error


def _content(entries: object, path: str) -> list[str]:
    if not isinstance(entries, list) or not all(isinstance(entry, str) for entry in entries):
        raise ConfigError(f"{path}: content must be a list of directories")
    base = os.path.dirname(path)
    return [os.path.join(base, os.path.expanduser(entry)) for entry in entries]
