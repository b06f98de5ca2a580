"""Standard library modules that only some Python versions have."""

from __future__ import annotations

from collections.abc import Mapping

from scaffold import distributions

_REMOVED_IN: Mapping[tuple[int, int], frozenset[str]] = {
    (3, 10): frozenset({"formatter", "parser", "symbol"}),
    (3, 11): frozenset({"binhex"}),
    (3, 12): frozenset({"asynchat", "asyncore", "distutils", "imp", "smtpd"}),
    (3, 13): frozenset({"cgi", "crypt", "imghdr", "pipes", "sndhdr", "telnetlib"}),
}
"""Modules by the version of Python that removed them."""
_ADDED_IN: Mapping[str, tuple[int, int]] = {
    "tomllib": (3, 11),
    "asyncio.taskgroups": (3, 11),
    "asyncio.timeouts": (3, 11),
    "importlib.resources.abc": (3, 11),
    "importlib.resources.readers": (3, 11),
    "importlib.resources.simple": (3, 11),
    "wsgiref.types": (3, 11),
    "dbm.sqlite3": (3, 13),
    "annotationlib": (3, 14),
    "compression.bz2": (3, 14),
    "compression.gzip": (3, 14),
    "compression.lzma": (3, 14),
    "compression.zlib": (3, 14),
    "compression.zstd": (3, 14),
    "concurrent.interpreters": (3, 14),
    "pathlib.types": (3, 14),
    "string.templatelib": (3, 14),
}
"""Modules with the version of Python that added them."""
_REMOVED_NAMES: Mapping[str, tuple[int, int]] = {
    "sqlite3.version": (3, 14),
    "sqlite3.dbapi2.version": (3, 14),
}
"""Names that typeshed removes too early: the modules create them in ``__getattr__``."""


def removed() -> frozenset[str]:
    """Return the modules that earlier Pythons had and that the target's Python no longer has."""
    python = distributions.target().python
    return frozenset[str]().union(
        *(names for version, names in _REMOVED_IN.items() if version <= python)
    )


def later_modules() -> Mapping[str, str]:
    """Return the modules that the target does not have yet, with the Python that added them."""
    python = distributions.target().python
    return {
        name: ".".join(map(str, version)) for name, version in _ADDED_IN.items() if version > python
    }


def is_of_another(name: str) -> bool:
    """Return whether a module that the target lacks exists in another Python.

    Args:
        name: Its full name; a package counts if all of its modules are new.
    """
    return name.partition(".")[0] in removed() or any(
        item == name or item.startswith(f"{name}.") for item in later_modules()
    )


def still_has(module: str, name: str) -> bool:
    """Return whether the target has a name of a module that the type checker takes for removed.

    Args:
        module: Its full name.
        name: The name in the module.
    """
    removed_in = _REMOVED_NAMES.get(f"{module}.{name}")
    return removed_in is not None and distributions.target().python < removed_in
