"""The configuration file, and where each value came from.

``ros2-scaffold.toml`` is the project's: `check` looks for it where everything that it checks is,
other verbs in the current directory, and both above that.
``$XDG_CONFIG_HOME/ros2-scaffold/config.toml`` is the user's. A table ``[check]`` of the project
wins over the user's key by key; flags win over both.

The project's file is data of strangers. What is code, the content directories, it may name only if
the user trusts its directory (docs/adr/0002-no-import-of-user-code.md).
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from scaffold.configuration import trust
from scaffold.errors import ConfigError
from scaffold.files import home
from scaffold.files.disk import Disk
from scaffold.record import NamedTuple

PROJECT_FILE = "ros2-scaffold.toml"
MAX_BYTES = 100_000
"""Of a configuration file, which has some lines."""
USER_FILE = "config.toml"

_CHECK_KEYS = frozenset({"select", "ignore", "per-path-ignores"})
_TABLES = ("check", "new")


class Value(NamedTuple):
    """A value and the file it stands in."""

    value: Any
    origin: str


class Config(NamedTuple):
    """The merged tables: values by ``table.key``."""

    values: Mapping[str, Value]
    content: tuple[str, ...] = ()
    """Content directories, relative ones resolved against their file."""
    warnings: tuple[str, ...] = ()
    """What the project's files say and was ignored, a line each."""

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

    The project's content directories count only if its directory is trusted. A file above the
    repository that belongs to another user is left alone; without a repository, one above the
    directory.

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
    warnings: list[str] = []
    project = _project_file(disk, directory, warnings)
    for path in filter(None, (user_file(disk), project)):
        for table, entries in _read(disk, path).items():
            if table == "content":
                given = {disk.real(item) for item in content}
                listed = _content(disk, entries, path)
                named = [item for item in listed if disk.real(item) not in given]
                refused = _refused(disk, path) if named and path == project else None
                warnings += [refused] if refused else []
                directories += [] if refused else named
                continue
            if not isinstance(entries, dict):
                raise ConfigError(f"{path}: {table!r} is outside of a table such as [check]")
            if table not in _TABLES:
                raise ConfigError(f"{path}: unknown table [{table}]{_table_hint(table)}")
            for key, value in entries.items():
                if table == "check" and key not in _CHECK_KEYS:
                    hint = _nearest(key, sorted(_CHECK_KEYS))
                    raise ConfigError(f"{path}: [check] has no key {key!r}; {hint}")
                values[f"{table}.{key}"] = Value(value, path)
    return Config(values, (*directories, *content), tuple(warnings))


def _table_hint(table: str) -> str:
    if table == "tool":
        return ": write [check] instead of [tool.ros2-scaffold.check]"
    return f"; {_nearest(table, _TABLES)}"


def _nearest(word: str, known: Sequence[str]) -> str:
    from difflib import get_close_matches

    near = get_close_matches(word, known, n=1)
    return f"did you mean {near[0]!r}?" if near else f"known are {', '.join(known)}"


def named_content(directory: str) -> list[str]:
    """Return the content directories that the project's file in a directory names.

    Raises:
        ConfigError: there is no such file, or it cannot be read.
    """
    path = os.path.join(directory, PROJECT_FILE)
    return _content(Disk(), _read(Disk(), path).get("content", []), path)


def user_file(disk: Disk) -> str | None:
    """Return the path of the user's file, ``None`` if there is none."""
    base = home.configuration()
    path = None if base is None else os.path.join(base, USER_FILE)
    return path if path is not None and disk.is_file(path) else None


def _project_file(disk: Disk, directory: str, warnings: list[str]) -> str | None:
    start = os.path.abspath(directory)
    for current in _upwards(start):
        path = os.path.join(current, PROJECT_FILE)
        if disk.is_file(path):
            top = None if disk.is_own(path) else _top(disk, start)
            if top is None or (_is_within(current, top) and not disk.is_shared(current)):
                return path
            warnings.append(
                f"{path}: ignored: it is not in {top} and belongs to another user; copy it there "
                "if it is yours to use"
            )
    return None


def _top(disk: Disk, start: str) -> str:
    """Return the top of the repository around a directory; without one, the directory itself.

    A repository in a directory where everybody may write is that of anybody.
    """
    for current in _upwards(start):
        if disk.exists(os.path.join(current, ".git")) and not disk.is_shared(current):
            return current
    return start


def _upwards(directory: str) -> Iterator[str]:
    yield directory
    while (parent := os.path.dirname(directory)) != directory:
        yield parent
        directory = parent


def _is_within(directory: str, top: str) -> bool:
    return os.path.commonpath((directory, top)) == top


def _refused(disk: Disk, path: str) -> str | None:
    """Return why the content of a project's file is ignored, ``None`` if it is not."""
    from shlex import quote

    directory = disk.real(os.path.dirname(path))
    if trust.is_trusted(disk, directory):
        return None
    return (
        f"{path}: 'content' ignored: it names code, and you do not trust this directory; "
        f"if you do: ros2-scaffold trust {quote(directory)}"
    )


def _read(disk: Disk, path: str) -> dict[str, Any]:
    import sys

    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib
    try:
        data = disk.read(path, MAX_BYTES).decode()
    except OSError as error:
        raise ConfigError(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        raise ConfigError(f"{path}:{line}: not UTF-8") from error
    try:
        entries = tomllib.loads(data)
        _refuse_large(entries, path)
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"{path}: invalid TOML: {error}") from error
    except RecursionError:
        raise ConfigError(f"{path}: nested too deeply") from None
    except ValueError as error:  # Python refuses numbers of thousands of digits
        raise ConfigError(f"{path}: invalid TOML: a number is too large") from error
    return entries


def _refuse_large(value: object, path: str) -> None:
    """Raise if there is an integer that TOML does not have: it ends at 64 bits."""
    if isinstance(value, int) and value.bit_length() > _INTEGER_BITS:
        raise ConfigError(f"{path}: invalid TOML: a number is too large")
    if isinstance(value, dict | list):
        for inner in value.values() if isinstance(value, dict) else value:
            _refuse_large(inner, path)


_INTEGER_BITS = 63
"""Of the integers of TOML, besides their sign."""


def _content(disk: Disk, entries: object, path: str) -> list[str]:
    if not isinstance(entries, list) or not all(
        isinstance(entry, str) and entry and "\0" not in entry for entry in entries
    ):
        raise ConfigError(f"{path}: content must be a list of directories")
    base = disk.real(os.path.dirname(path))
    return [os.path.join(base, os.path.expanduser(entry)) for entry in entries]
