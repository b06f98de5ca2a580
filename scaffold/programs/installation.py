"""How this tool was installed, for the commands that its messages suggest.

The tool is on no package index, and somebody else could register its name there. So the commands
name the source from which the tool was installed, or a clone.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from shlex import quote
from urllib.parse import unquote, urlsplit

PROJECT = "ros2-scaffold"
CLONE = "in a clone of its repository"


def command(extra: str = "") -> str:
    """Return the command that installs the tool again from its source.

    Args:
        extra: An optional extra to install with it, such as ``ros``.
    """
    extras = f"[{extra}]" if extra else ""
    origin = _recorded_origin()
    url, vcs = str(origin.get("url", "")), _table(origin, "vcs_info").get("vcs")
    parts = urlsplit(url)
    if parts.scheme and vcs:
        return f"{_installer()} {quote(f'{PROJECT}{extras} @ {vcs}+{url}')}"
    path = unquote(parts.path)
    if parts.scheme == "file" and os.path.isfile(os.path.join(path, "pyproject.toml")):
        option = "--editable " if _table(origin, "dir_info").get("editable") else ""
        return f"{_installer()} {option}{quote(path + extras)}"
    return f"pipx install --force '.{extras}' ({CLONE})"


def source(extra: str = "") -> str:
    """Return the source of the tool for pip: a directory, a repository, or a placeholder.

    Args:
        extra: An optional extra to install with it.
    """
    extras = f"[{extra}]" if extra else ""
    origin = _recorded_origin()
    url, vcs = str(origin.get("url", "")), _table(origin, "vcs_info").get("vcs")
    path = unquote(urlsplit(url).path)
    if url and vcs:
        return f"{PROJECT}{extras} @ {vcs}+{url}"
    is_clone = url.startswith("file:") and os.path.isfile(os.path.join(path, "pyproject.toml"))
    return f"{path if is_clone else f'/CLONE/OF/{PROJECT}'}{extras}"


def apart(extra: str) -> str:
    """Return the command that installs the tool with an extra in a separate environment."""
    place = f"{extra}-environment"
    return f"python3 -m venv {place} && {place}/bin/pip install {quote(source(extra))}"


def _installer() -> str:
    """Return the command of the installer of the current environment."""
    parts = os.path.abspath(sys.prefix).split(os.sep)
    if "pipx" in parts:
        return "pipx install --force"
    if "uv" in parts and "tools" in parts:
        return "uv tool install --force"
    return f"{quote(sys.executable or 'python3')} -m pip install"


def _recorded_origin() -> Mapping[str, object]:
    """Return the recorded origin of the installation (PEP 610); empty for one from an index."""
    import json
    from importlib.metadata import PackageNotFoundError, distribution

    try:
        entries = json.loads(distribution(PROJECT).read_text("direct_url.json") or "{}")
    except (PackageNotFoundError, OSError, ValueError):
        return {}
    return entries if isinstance(entries, dict) else {}


def _table(entries: Mapping[str, object], key: str) -> Mapping[str, object]:
    value = entries.get(key)
    return value if isinstance(value, dict) else {}
