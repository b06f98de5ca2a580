"""What a configuration of pre-commit that exists lacks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

COMMAND = "ros2-scaffold check"
"""Checks all packages below the top of the repository."""


def missing_entry(there: bytes, text: str) -> str | None:
    """Return the entry that a configuration has and another one lacks, in one line.

    ``None`` if the other one has it, or a hook that checks the package as well.

    Args:
        there: The configuration that exists; whatever is in it.
        text: One with a single entry in ``repos``, which has a single hook.
    """
    import yaml

    (entry,) = yaml.safe_load(text)["repos"]
    (hook,) = entry["hooks"]
    commands = {COMMAND, hook["entry"]}
    for other in _hooks(there):
        # One of our own repository has no entry, as it has that of the repository.
        if other.get("id") == hook["id"] and other.get("entry", COMMAND) in commands:
            return None
    line = yaml.safe_dump([entry], default_flow_style=True, sort_keys=False, width=float("inf"))
    return f"- {line.strip()[1:-1]}"


def _hooks(there: bytes) -> Iterator[dict[str, Any]]:
    import yaml

    try:
        configuration = yaml.safe_load(there)
    except (yaml.YAMLError, UnicodeDecodeError, ValueError, RecursionError):
        return
    for repository in _entries(configuration, "repos"):
        yield from _entries(repository, "hooks")


def _entries(table: object, key: str) -> list[dict[str, Any]]:
    found = table.get(key) if isinstance(table, dict) else None
    return [one for one in found if isinstance(one, dict)] if isinstance(found, list) else []
