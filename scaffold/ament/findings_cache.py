"""A cache of style findings, keyed by the content of a file and what else they depend on."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from scaffold.ament.finding import Finding
from scaffold.ament.flake8.builtins import hidden_module
from scaffold.files.disk import digest
from scaffold.files.values import ValueCache

_MAGIC = b"scaffold-style-1\n"


class StyleCache(ValueCache):
    """The style findings in files.

    Args:
        depends_on: Returns the further dependencies besides the files: the linters.
    """

    def __init__(self, depends_on: Callable[[], str]) -> None:
        super().__init__("styles", _MAGIC)
        self._salt = depends_on().encode("utf-8", "surrogateescape") if self.is_enabled else b""

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
        stored = self.get_value(key)
        return None if stored is None else [Finding(*load) for load in stored]

    def put(self, key: str, findings: Sequence[Finding]) -> None:
        """Store findings."""
        self.put_value(key, [*map(tuple, findings)])
