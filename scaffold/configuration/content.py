"""Where rules and templates are: in the wheel, in a checkout, in the user's own directories."""

from __future__ import annotations

import os

from scaffold.errors import ConfigError

TYPE_CHECKING = False  # the one of typing is slow to import, and every start needs this module
if TYPE_CHECKING:
    from collections.abc import Sequence

_KINDS = ("rules", "templates")
_HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def built_in() -> str:
    """Return the directory that holds ``rules/`` and ``templates/`` of this installation."""
    packaged = os.path.join(_HERE, "_content")
    return packaged if os.path.isdir(packaged) else os.path.dirname(_HERE)


def roots(kind: str, own: Sequence[str] = ()) -> list[str]:
    """Return the directories of ``kind`` (``rules`` or ``templates``).

    The built-in one comes first; a later one may add to it, and templates may override.

    Args:
        kind: The name of the directory.
        own: Content directories of the user, each with the same layout as the built-in one.

    Raises:
        ConfigError: one of the user's is no directory, or holds nothing of any kind.
    """
    for base in own:
        if not os.path.isdir(base):
            raise ConfigError(f"{base}: no such directory; --content or the configuration names it")
        if not any(os.path.isdir(os.path.join(base, name)) for name in _KINDS):
            name = os.path.basename(os.path.abspath(base))
            hint = "; name the directory above it" if name in _KINDS else ""
            raise ConfigError(f"{base}: has no directory 'rules' or 'templates'{hint}")
    candidates = [os.path.join(base, kind) for base in (built_in(), *own)]
    return [path for path in candidates if os.path.isdir(path)]
