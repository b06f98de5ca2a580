"""Default answers from the configuration, git and the login."""

from __future__ import annotations

import os
import re
from functools import cached_property

from scaffold import distributions
from scaffold.configuration.config import Config
from scaffold.generate.questions.questions import Given
from scaffold.record import NamedTuple

TABLE = "new"
"""The table of the configuration file: ``[new]`` with the names of questions as keys."""

LOGIN = "login"
"""The origin of answers guessed from the login name."""

DISTRO = "distro"
"""The question for the distributions that a package is for."""

_GIT_KEYS = {"maintainer_name": "user.name", "maintainer_email": "user.email"}


class User:
    """The identity of the user, from git and the login.

    Args:
        directory: Where the package is to be; a repository there may have its own git settings.
    """

    def __init__(self, directory: str) -> None:
        self.directory = directory
        self.guessed: list[str] = []
        """The questions answered from the login, for a note."""

    def answer(self, question: str) -> Given | None:
        """Return the answer to ``maintainer_name``, ``maintainer_email`` or ``distro``."""
        if question == DISTRO:
            return Given([distributions.target().name], "default")
        key = _GIT_KEYS.get(question)
        if key is None:
            return None
        value = self._git.get(key)
        if value:
            return Given(value, f"git config {key}")
        self.guessed.append(question)
        login = _login()
        return Given(login.name if question == "maintainer_name" else login.address, LOGIN)

    @cached_property
    def _git(self) -> dict[str, str]:
        """``user.name`` and ``user.email`` of git, if set."""
        import subprocess

        from scaffold.programs import git

        directory = os.path.abspath(self.directory)
        while not os.path.isdir(directory):
            directory = os.path.dirname(directory)
        words = ("config", "-z", "--get-regexp", r"^user\.(name|email)$")
        try:
            done = git.run(*words, directory=directory)
        except (OSError, subprocess.TimeoutExpired):
            return {}
        result: dict[str, str] = {}
        for entry in done.stdout.decode(errors="replace").split("\0"):
            key, _, value = entry.partition("\n")
            if value.strip():
                result[key] = value
        return result


def configured(config: Config) -> dict[str, Given]:
    """Return the table ``[new]`` of the configuration."""
    prefix = f"{TABLE}."
    return {
        key.removeprefix(prefix): Given(value.value, f"{value.origin}: [{TABLE}]")
        for key, value in config.values.items()
        if key.startswith(prefix)
    }


class _Login(NamedTuple):
    name: str
    address: str


def _login() -> _Login:
    """Return the name and the local address of the account, if valid in a manifest."""
    import pwd

    try:
        entry = pwd.getpwuid(os.getuid())
        login, name = entry.pw_name, re.sub(r'["\\]', "", entry.pw_gecos.partition(",")[0]).strip()
    except KeyError:
        login, name = f"user{os.getuid()}", ""
    local = re.sub(r"[^A-Za-z0-9_-]+", "-", login).strip("-") or "user"
    host = os.uname().nodename
    if not re.fullmatch(r"([a-zA-Z0-9-]+\.)+[a-zA-Z]{2,}", host) or len(host) > 40:  # noqa: PLR2004
        host = "localhost.localdomain"
    return _Login(name or login, f"{local}@{host}")
