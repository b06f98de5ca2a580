"""Finds the hooks that an existing pre-commit configuration lacks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

_CHECK = "ros2-scaffold check"
_COMMANDS = (
    _CHECK,
    f"{_CHECK} --whole-packages",
    f"{_CHECK} --fix",
    f"{_CHECK} --fix --whole-packages",
)
"""Commands of hooks that check all packages of the repository, or those of a commit."""
_IDS = ("ros2-scaffold", "ros2-scaffold-check", "ros2-scaffold-fix")
"""The hooks that our own repository has."""


def missing_entry(existing: bytes, text: str) -> str | None:
    """Return the entry that an existing configuration lacks, in one line.

    ``None`` if the other one has it, or a hook that checks the package as well.

    Args:
        existing: The configuration that exists; whatever is in it.
        text: One with a single entry in ``repos``, which has a single hook.
    """
    import yaml

    (entry,) = yaml.safe_load(text)["repos"]
    (hook,) = entry["hooks"]
    if any(_checks(other, hook.get("files")) for other in _hooks(existing)):
        return None
    line = yaml.safe_dump([entry], default_flow_style=True, sort_keys=False, width=float("inf"))
    return f"- {line.strip()[1:-1]}"


def _checks(hook: dict[str, Any], files: str | None) -> bool:
    """Return whether a hook checks the package of some files, perhaps with others."""
    # One of our own repository has no entry, as it has that of the repository.
    command, chosen = hook.get("entry", _CHECK), hook.get("files")
    if hook.get("id") not in _IDS or not isinstance(command, str):
        return False
    if command in _COMMANDS:
        return chosen is None or chosen == files
    return command.startswith(f"{_CHECK} ") and chosen == files is not None


def _hooks(data: bytes) -> Iterator[dict[str, Any]]:
    import yaml

    try:
        configuration = yaml.safe_load(data)
    except (yaml.YAMLError, UnicodeDecodeError, ValueError, RecursionError):
        return
    for repository in _entries(configuration, "repos"):
        yield from _entries(repository, "hooks")


def _entries(table: object, key: str) -> list[dict[str, Any]]:
    entries = table.get(key) if isinstance(table, dict) else None
    return [item for item in entries if isinstance(item, dict)] if isinstance(entries, list) else []
