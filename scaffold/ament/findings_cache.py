"""A cache of style findings by file content.

One small file per checked file, named after a digest of its bytes and of everything else that the
findings depend on. A cache that cannot be read or written is ignored.
"""

from __future__ import annotations

import marshal
import os
from collections.abc import Callable, Sequence

from scaffold.ament.finding import Finding
from scaffold.ament.flake8.builtins import hidden_module
from scaffold.files import cache
from scaffold.files.disk import digest

MAX_ENTRIES = 20_000
KEPT_ENTRIES = 15_000
_MAGIC = b"scaffold-style-1\n"


class Cache:
    """A directory of findings."""

    def __init__(self, directory: str, depends_on: str) -> None:
        self._directory = directory
        self._salt = depends_on.encode("utf-8", "surrogateescape")

    @classmethod
    def of_user(cls, depends_on: Callable[[], str]) -> Cache | None:
        """Return the user's cache, unless it is disabled or there is no home directory."""
        directory = cache.directory("style")
        return None if directory is None else cls(directory, depends_on())

    def key(self, path: str, settings: Sequence[tuple[int, str]], data: bytes) -> str:
        """Return the key of a file, from its bytes and other inputs of rules.

        Args:
            path: Its path in the package.
            settings: The linters that check it, with their options.
            data: Its bytes.
        """
        name = path.rpartition("/")[2]
        is_private = name.startswith("_") and any(asked for _, asked in settings)
        kind = name if is_private else "init" if name == "__init__.py" else "module"
        facts = f"{kind} {hidden_module(path)} {settings}".encode("utf-8", "surrogateescape")
        return digest(b"%s\0%s\0%s" % (self._salt, facts, data))

    def get(self, key: str) -> list[Finding] | None:
        """Return the findings stored under a key."""
        data = cache.read_sealed(self._path(key), _MAGIC)
        return None if data is None else [Finding(*load) for load in marshal.loads(data)]  # noqa: S302  own files

    def put(self, key: str, findings: Sequence[Finding]) -> None:
        """Store findings."""
        cache.write_sealed(self._path(key), _MAGIC, marshal.dumps([*map(tuple, findings)]))

    def trim(self) -> None:
        """Drop the oldest entries when there are too many."""
        try:
            entries = [
                (entry.stat().st_mtime, entry.path)
                for shard in os.scandir(self._directory)
                for entry in os.scandir(shard.path)
            ]
            if len(entries) > MAX_ENTRIES:
                for _, path in sorted(entries)[:-KEPT_ENTRIES]:
                    os.unlink(path)
        except OSError:
            return

    def _path(self, key: str) -> str:
        return os.path.join(self._directory, key[:2], key[2:])
