"""Whether a package sends messages at all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.distributions import target
from scaffold.model.contents.python_facts import paths_importing
from scaffold.model.install.reach import has_programs

if TYPE_CHECKING:
    from scaffold.model.package import Package

_MAY_SEND = lazy_re.compile(
    rb"(?i:publish|broadcast|\bcall(?:_async)?\(|send|serial|service|action|\bbag|spin)|Node\b"
)
"""Matches words without which Python code neither sends messages nor converts them."""


def sends_nothing(package: Package) -> bool:
    """Return whether messages are only containers for the data of a package's own programs.

    Their fields may have any value if only rclpy checks and converts them, when they are sent.

    Raises:
        ViewError: a file cannot be read.
    """
    if not target().fact("messages.has_check_fields"):
        return False  # setters always check values
    return package.remember("sends nothing", lambda: _sends_nothing(package))


def _sends_nothing(package: Package) -> bool:
    paths = package.python_files
    if not has_programs(package) or any(_MAY_SEND.search(package.data(path)) for path in paths):
        return False
    roots = {package.name, *(path.partition("/")[0].removesuffix(".py") for path in paths)}
    others = (user for user in package.workspace if user is not package)
    return not any(any(paths_importing(user, *roots)) for user in others)
