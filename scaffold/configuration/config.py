"""The configuration files, and the origin of each value.

``ros2-scaffold.toml``, or ``[tool.ros2-scaffold]`` in ``pyproject.toml``, belongs to the project:
`check` looks for it in the common directory of everything that it checks, other verbs in the
current directory, and both in the directories above. ``$XDG_CONFIG_HOME/ros2-scaffold/config.toml``
belongs to the user. The project's file overrides the user's key by key; flags override both. `keys`
defines the keys.

The project's file is untrusted data. It may name content directories, which are code, only if the
user trusts its directory (docs/adr/0002-no-import-of-user-code.md).
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import Any

from scaffold import toml
from scaffold.configuration import keys, trust
from scaffold.configuration.content import is_url
from scaffold.errors import ConfigError
from scaffold.files import home
from scaffold.files.disk import Disk
from scaffold.record import NamedTuple

PROJECT_FILE = "ros2-scaffold.toml"
PYPROJECT_FILE = "pyproject.toml"
TOOL = "ros2-scaffold"
"""The table of ``[tool]`` in ``pyproject.toml``."""
MAX_BYTES = 100_000
"""The size limit of a configuration file."""
MAX_BYTES_OF_PYPROJECT = 1_000_000
"""The size limit of ``pyproject.toml``, which may have tables of other tools."""
USER_FILE = "config.toml"
FLAG = "--content"
"""The origin of directories given as flags."""


class Value(NamedTuple):
    """A value and the file that sets it."""

    value: Any
    origin: str


class Config(NamedTuple):
    """The merged tables: values by ``table.key``."""

    values: Mapping[str, Value]
    directories: tuple[Value, ...] = ()
    """Content directories, relative ones resolved against their file."""
    warnings: tuple[str, ...] = ()
    """Ignored parts of the project's files, one line each."""

    @property
    def content(self) -> tuple[str, ...]:
        """The content directories alone."""
        return tuple(directory.value for directory in self.directories)

    def value(self, key: str) -> Any:  # noqa: ANN401  of any type in TOML
        """Return a value of the type declared in `keys`, or its default."""
        set_value = self.values.get(key)
        if set_value is not None:
            return set_value.value
        return next(item.default for item in keys.KEYS if item.path == key)

    def strings(self, key: str) -> tuple[str, ...]:
        """Return a list of strings, empty when not set."""
        return tuple(self.value(key))

    def origin(self, key: str) -> str:
        """Return the file that sets a value."""
        return self.values[key].origin


class _File(NamedTuple):
    """A configuration file: its tables, without ``[tool.ros2-scaffold]`` around them."""

    path: str
    tables: Mapping[str, Any]
    is_projects: bool

    @property
    def prefix(self) -> str:
        """The prefix of the names of its tables."""
        return f"tool.{TOOL}." if os.path.basename(self.path) == PYPROJECT_FILE else ""


def load(directory: str = ".", content: tuple[str, ...] = (), disk: Disk | None = None) -> Config:
    """Read the user's and the project's file.

    The project's content directories are used only if its directory is trusted. A file above the
    repository that belongs to another user is ignored; without a repository, one above the
    directory.

    Args:
        directory: Where the search for the project's file starts.
        content: Content directories given as flags; they come last.
        disk: Records the files that were searched and their content.

    Raises:
        ConfigError: a file cannot be read, is not TOML, or has an unknown key or a wrong value.
    """
    disk = disk or Disk()
    values: dict[str, Value] = {}
    directories: list[Value] = []
    warnings: list[str] = []
    for file in _files(disk, directory, warnings):
        for table, entries in file.tables.items():
            if table == "content":
                given = {disk.real(path) for path in content}
                listed = _content(disk, entries, file.path)
                named = [path for path in listed if disk.real(path) not in given]
                refused = _why_ignored(disk, file.path) if named and file.is_projects else None
                warnings += [refused] if refused else []
                directories += [] if refused else [Value(path, file.path) for path in named]
                continue
            _validate(file, table, entries)
            for key, value in entries.items():
                values[f"{table}.{key}"] = Value(value, file.path)
    flags = [Value(path, FLAG) for path in content]
    return Config(values, (*directories, *flags), tuple(warnings))


def _files(disk: Disk, directory: str, warnings: list[str]) -> Iterator[_File]:
    user = user_file(disk)
    if user is not None:
        yield _File(user, _read(disk, user), is_projects=False)
    project = _project_file(disk, directory, warnings)
    if project is not None:
        yield project


def _validate(file: _File, table: str, entries: object) -> None:
    """Raise if the configuration has no such table or key, or the value is of another type."""
    if not isinstance(entries, dict):
        raise ConfigError(f"{file.path}: {_misplaced_key(file.prefix, table)}")
    if table not in keys.TABLES:
        raise ConfigError(f"{file.path}: unknown table [{file.prefix}{table}]{_table_hint(table)}")
    if table == keys.ANSWERS:
        return
    allowed = keys.of_table(table)
    for name, value in entries.items():
        if name not in allowed:
            hint = keys.nearest(name, sorted(allowed))
            raise ConfigError(f"{file.path}: [{file.prefix}{table}] has no key {name!r}; {hint}")
        key = allowed[name]
        wrong = key.kind.refuse(value)
        if wrong:
            raise ConfigError(f"{file.path}: {key.path} {wrong}")
        if key.is_projects and not file.is_projects:
            raise ConfigError(
                f"{file.path}: {key.path} is only allowed in the file of a project, because its "
                "paths are relative to it"
            )


def _table_hint(table: str) -> str:
    if table == "tool":
        return ": write [check] instead of [tool.ros2-scaffold.check]"
    inner = next((key.path for key in keys.KEYS if key.path.endswith(f".{table}")), "")
    return f"; did you mean [{inner}]?" if inner else f"; {keys.nearest(table, keys.TABLES)}"


def _misplaced_key(prefix: str, name: str) -> str:
    """Return the error about a key before all tables, and where it belongs."""
    from difflib import get_close_matches

    if name in keys.TABLES:
        return f"{name!r} must be a table: [{prefix}{name}]"
    tables = {key.name: key.table for key in reversed(keys.KEYS)}
    if name in tables:
        return f"{name!r} must be in the table [{prefix}{tables[name]}]"
    closest = get_close_matches(name, tables, n=1)
    if not closest:
        return f"unknown key {name!r}; keys are in tables such as [{prefix}check]"
    table = tables[closest[0]]
    place = f" in [{prefix}{table}]" if table else ""
    return f"unknown key {name!r}; did you mean {closest[0]!r}{place}?"


def named_content(directory: str) -> list[str]:
    """Return the content directories in the project's file of a directory.

    Raises:
        ConfigError: the file cannot be used.
    """
    file = file_in(Disk(), directory)
    return [] if file is None else _content(Disk(), file.tables.get("content", []), file.path)


def user_file(disk: Disk) -> str | None:
    """Return the path of the user's file, ``None`` if there is none."""
    base = home.configuration()
    path = None if base is None else os.path.join(base, USER_FILE)
    return path if path is not None and disk.is_file(path) else None


def _project_file(disk: Disk, directory: str, warnings: list[str]) -> _File | None:
    start = os.path.abspath(directory)
    for current in _parents(start):
        path = _path_in(disk, current)
        if path is None:
            continue
        top = None if disk.is_own(path) else _repository_top(disk, start)
        if top is None or (_is_within(current, top) and not disk.is_shared(current)):
            file = file_in(disk, current)
            if file is not None:
                return file
            continue
        warnings.append(
            f"{path}: ignored: outside of {top} and owned by another user; copy it there to use it"
        )
    return None


def file_in(disk: Disk, directory: str) -> _File | None:
    """Return the project's file in a directory, ``None`` without one.

    Raises:
        ConfigError: there are two, or it cannot be read.
    """
    path = _path_in(disk, directory)
    if path is None:
        return None
    if os.path.basename(path) == PROJECT_FILE:
        if _tool_table(disk, os.path.join(directory, PYPROJECT_FILE)) is not None:
            raise ConfigError(
                f"{directory}: both {PROJECT_FILE} and [tool.{TOOL}] in {PYPROJECT_FILE}; keep one"
            )
        return _File(path, _read(disk, path), is_projects=True)
    table = _tool_table(disk, path)
    return None if table is None else _File(path, table, is_projects=True)


def _path_in(disk: Disk, directory: str) -> str | None:
    """Return the path of the possible project's file in a directory, without parsing it."""
    path = os.path.join(directory, PROJECT_FILE)
    if disk.is_file(path):
        return path
    path = os.path.join(directory, PYPROJECT_FILE)
    return path if _names_tool(disk, path) else None


def _names_tool(disk: Disk, path: str) -> bool:
    """Return whether a ``pyproject.toml`` may have our table; others need not be valid."""
    import re

    if not disk.is_file(path):
        return False
    try:
        data = disk.read(path)
    except OSError:
        return False
    return re.search(_TABLE_IN_PYPROJECT, data) is not None


_TABLE_IN_PYPROJECT = (
    rb"""(?m)^[ \t]*(?:\[[^\n]*|["']?tool["']?[ \t]*\.[ \t]*)?"""
    rb"""["']?ros2[-_]scaffold["']?[ \t]*[].=]"""
)


def _tool_table(disk: Disk, path: str) -> Mapping[str, Any] | None:
    if not _names_tool(disk, path):
        return None
    tables = _read(disk, path, MAX_BYTES_OF_PYPROJECT).get("tool", {})
    table, misspelled = tables.get(TOOL), TOOL.replace("-", "_")
    if table is None and misspelled in tables:
        raise ConfigError(f"{path}: unknown table [tool.{misspelled}]; did you mean [tool.{TOOL}]?")
    if table is not None and not isinstance(table, dict):
        raise ConfigError(f"{path}: tool.{TOOL} must be a table")
    return table


def _repository_top(disk: Disk, start: str) -> str:
    """Return the top of the repository around a directory; without one, the directory itself.

    A repository in a world-writable directory may belong to anybody.
    """
    for current in _parents(start):
        if disk.exists(os.path.join(current, ".git")) and not disk.is_shared(current):
            return current
    return start


def _parents(directory: str) -> Iterator[str]:
    yield directory
    while (parent := os.path.dirname(directory)) != directory:
        yield parent
        directory = parent


def _is_within(directory: str, top: str) -> bool:
    return os.path.commonpath((directory, top)) == top


def _why_ignored(disk: Disk, path: str) -> str | None:
    """Return why the content of a project's file is ignored, ``None`` if it is not."""
    from shlex import quote

    directory = disk.real(os.path.dirname(path))
    if trust.is_trusted(disk, directory):
        return None
    return (
        f"{path}: 'content' ignored: it loads code, and you do not trust this directory; to "
        f"trust it: ros2-scaffold trust {quote(directory)}"
    )


def _read(disk: Disk, path: str, most: int = MAX_BYTES) -> dict[str, Any]:
    try:
        data = disk.read(path, most).decode()
    except OSError as error:
        raise ConfigError(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        raise ConfigError(f"{path}:{line}: not UTF-8") from error
    try:
        entries = toml.loads(data)
        _refuse_large(entries, path)
    except toml.TOMLDecodeError as error:
        raise ConfigError(f"{path}: invalid TOML: {error}") from error
    except RecursionError:
        raise ConfigError(f"{path}: nested too deeply") from None
    except ValueError as error:  # Python rejects numbers with thousands of digits
        raise ConfigError(f"{path}: invalid TOML: a number is too large") from error
    return entries


def _refuse_large(value: object, path: str) -> None:
    """Raise if an integer exceeds the 64 bits of TOML."""
    if isinstance(value, int) and value.bit_length() > _INTEGER_BITS:
        raise ConfigError(f"{path}: invalid TOML: a number is too large")
    if isinstance(value, dict | list):
        for inner in value.values() if isinstance(value, dict) else value:
            _refuse_large(inner, path)


_INTEGER_BITS = 63
"""The bits of TOML integers, without the sign."""


def _content(disk: Disk, entries: object, path: str) -> list[str]:
    if not isinstance(entries, list) or not all(
        isinstance(entry, str) and entry and "\0" not in entry for entry in entries
    ):
        raise ConfigError(f"{path}: content must be a list of directories")
    base = disk.real(os.path.dirname(path))
    return [
        entry if is_url(entry) else os.path.join(base, os.path.expanduser(entry))
        for entry in entries
    ]
