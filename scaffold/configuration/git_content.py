"""Content that is a revision of a git repository: ``URL@REV``.

A repository is fetched only if the user trusts its address. Fetched content is kept in the user's
cache: cached tags and commits need no network, branches are fetched each time.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import tempfile
from functools import cache

from scaffold import lazy_re
from scaffold.configuration import trust
from scaffold.errors import ConfigError
from scaffold.files import cache as kept
from scaffold.files.disk import digest
from scaffold.programs import git, git_tree
from scaffold.record import NamedTuple

_URL = lazy_re.compile(r"(\w+://[^/]*/.+|[^@/\s]+@[^:/\s]+:.+)@([^@:]+)")
"""The URL up to the last '@'; an earlier one may precede a host."""
_REVISION = lazy_re.compile(r"\w[\w./+-]*", re.ASCII)
_COMMIT = lazy_re.compile(r"[0-9a-f]{7,64}")
_MAX_NAMED = 8
"""The maximum number of tags and branches in an error."""


class Revision(NamedTuple):
    """A commit of a repository."""

    url: str
    name: str
    """The name given by the user: a tag, a branch or a commit."""
    commit: str
    directory: str
    """The directory of its files."""


def split(text: str) -> tuple[str, str]:
    """Return the address and the name of the revision.

    Raises:
        ConfigError: the revision is missing or invalid.
    """
    match = _URL.fullmatch(text)
    if match is None:
        raise ConfigError(f"{text}: add a tag, a branch or a commit, such as {text}@v1.0")
    url, name = match.groups()
    if not _REVISION.fullmatch(name) or ".." in name:
        raise ConfigError(f"{text}: {name!r} is not the name of a tag, a branch or a commit")
    return url, name


@cache
def resolve(text: str) -> Revision:
    """Return a revision with its files, fetched if necessary.

    Raises:
        ConfigError: the address is not trusted or cannot be fetched, or has no such revision.
    """
    url, name = split(text)
    if not trust.is_trusted_url(url):
        raise ConfigError(
            f"{url}: not trusted: its content would run with your permissions; review it, then "
            "run: "
            f"ros2-scaffold trust {url}"
        )
    top = kept.directory("content")
    if top is None:
        raise ConfigError(f"{url}: no cache to fetch it to; see docs/configuration.md")
    place = os.path.join(top, digest(os.fsencode(url)))
    mirror = os.path.join(place, "mirror.git")
    commit = _fixed(mirror, name)
    if commit is None:
        _fetch(url, mirror)
        commit = _fixed(mirror, name) or _commit(mirror, f"refs/heads/{name}")
    if commit is None:
        raise ConfigError(f"{url}: has no tag, branch or commit {name!r}{_names(mirror)}")
    directory = os.path.join(place, commit)
    if not os.path.isdir(directory):
        _export(url, mirror, commit, directory)
    return Revision(url, name, commit, directory)


def _fixed(mirror: str, name: str) -> str | None:
    """Return the commit of a tag or a commit, neither of which changes."""
    if not os.path.isdir(mirror):
        return None
    tagged = _commit(mirror, f"refs/tags/{name}")
    return tagged or (_commit(mirror, name) if _COMMIT.fullmatch(name) else None)


def _commit(mirror: str, name: str) -> str | None:
    words = ("rev-parse", "--verify", "--quiet", "--end-of-options", f"{name}^{{commit}}")
    done = git.run("--git-dir=.", *words, directory=mirror)
    return os.fsdecode(done.stdout.strip()) if done.returncode == 0 else None


def _names(mirror: str) -> str:
    """Return the existing revisions, newest first, for an error."""
    words = ("for-each-ref", "--sort=-creatordate", "--format=%(refname:short)")
    done = git.run("--git-dir=.", *words, "refs/tags", "refs/heads", directory=mirror)
    names = done.stdout.decode(errors="replace").split()
    return f"; it has {', '.join(names[:_MAX_NAMED])}" if names else "; it is empty"


def _fetch(url: str, mirror: str) -> None:
    """Fetch all tags and branches, but nothing else, such as pull requests."""
    try:
        os.makedirs(mirror, mode=0o700, exist_ok=True)
        done = git.run("init", "--quiet", "--bare", ".", directory=mirror)
        if done.returncode == 0:
            done = git.fetch(url, mirror)
    except FileNotFoundError:
        raise ConfigError(f"{url}: git is not installed") from None
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ConfigError(f"{url}: cannot be fetched: {error}") from error
    if done.returncode != 0:
        lines = done.stderr.decode(errors="replace").splitlines() or ["git failed"]
        reason = next((line for line in lines if line.startswith(("fatal:", "ERROR"))), lines[-1])
        raise ConfigError(
            f"{url}: cannot be fetched: {reason.removeprefix('fatal: ')}; tags and commits that "
            "were fetched before need no network"
        )


def _export(url: str, mirror: str, commit: str, directory: str) -> None:
    """Write the files of a commit, without symlinks, which could lead anywhere."""
    try:
        aside = tempfile.mkdtemp(dir=os.path.dirname(directory))
        try:
            git_tree.Objects(mirror, commit, url).export(aside, with_links=False)
            os.rename(aside, directory)
        except OSError:
            shutil.rmtree(aside, ignore_errors=True)
            if not os.path.isdir(directory):  # otherwise another process was faster
                raise
    except OSError as error:
        raise ConfigError(f"{url}: {error.strerror}: {error.filename}") from error
