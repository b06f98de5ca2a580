"""The directories with rules and templates: wheel, checkout, and the user's own."""

from __future__ import annotations

import os

from scaffold.errors import ConfigError

TYPE_CHECKING = False  # the one of typing is slow to import, and every start needs this module
if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.configuration.git_content import Revision

_KINDS = ("rules", "templates")
_revisions: dict[str, Revision] = {}
"""The revisions used by this run, by directory."""
_HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def built_in() -> str:
    """Return the directory of ``rules/`` and ``templates/`` in this installation."""
    packaged = os.path.join(_HERE, "_content")
    return packaged if os.path.isdir(packaged) else os.path.dirname(_HERE)


def is_url(text: str) -> bool:
    """Return whether content is in a remote git repository: ``URL@REV``."""
    host, colon, _ = text.partition(":")
    return "://" in text or bool(colon and "@" in host and "/" not in host)


def _directory(base: str) -> str:
    if not is_url(base):
        return base
    from scaffold.configuration import git_content

    revision = git_content.resolve(base)
    _revisions[revision.directory] = revision
    return revision.directory


def revisions(roots: Sequence[str]) -> list[Revision]:
    """Return the git revisions of content directories."""
    return [
        revision
        for directory, revision in _revisions.items()
        if any(root.startswith(os.path.join(directory, "")) for root in roots)
    ]


def roots(kind: str, own: Sequence[str] = ()) -> list[str]:
    """Return the directories of ``kind`` (``rules`` or ``templates``).

    The built-in one comes first; a later one may add to it, and templates may override.

    Args:
        kind: The name of the directory.
        own: Content directories of the user, each with the same layout as the built-in one, or
            revisions of git repositories.

    Raises:
        ConfigError: a directory of the user does not exist or has no content; a repository
            is not trusted, cannot be fetched, or has no such revision.
    """
    own = [_directory(base) for base in own]
    for base in own:
        if not os.path.isdir(base):
            raise ConfigError(
                f"{base}: no such directory, but --content or the configuration names it"
            )
        if not any(os.path.isdir(os.path.join(base, name)) for name in _KINDS):
            name = os.path.basename(os.path.abspath(base))
            hint = "; use the parent directory" if name in _KINDS else ""
            raise ConfigError(f"{base}: has no directory 'rules' or 'templates'{hint}")
    candidates = [os.path.join(base, kind) for base in (built_in(), *own)]
    return [path for path in candidates if os.path.isdir(path)]
