"""Whether files of the workspace start what a parameter file configures, going by their text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress

from scaffold.api import Package, ViewError
from scaffold.api.formats import without_comments
from scaffold.api.parameters import parameter_paths

_STARTING = (".py", ".xml", ".launch", ".yaml", ".yml", ".sh", ".cpp", ".hpp", ".xacro")
"""Ends of the names of files that may start a controller."""
_LAUNCHING = (".py", ".xml", ".launch", ".yaml", ".yml", ".sh", ".md", ".rst")
"""Ends of the names of files that start Nav2, or tell people how to."""
_NODES = (".py", ".cc", ".cpp", ".hpp")
_LAUNCH = b"generate_launch_description"
_NAV2 = (b"nav2_bringup", b"RewrittenYaml")
_WITHOUT_SERVERS = b"localization_launch"
_WITH_SERVERS = re.compile(rb"nav\w{0,40}[._]launch|bringup_launch|simulation_launch")
"""Matches the names of launch files that start the servers of Nav2."""


def is_named_in_code(package: Package, controller: str) -> bool:
    """Return whether code of the workspace names a controller, perhaps to start it."""
    return any(_texts_with(package, controller.encode(), _STARTING))


def is_used_by_nodes(package: Package, topic: str) -> bool:
    """Return whether code of the workspace other than launch files names a topic."""
    texts = _texts_with(package, topic.encode(), _NODES)
    return any(_LAUNCH not in data for data in texts)


def is_server_started(package: Package, server: str) -> bool:
    """Return whether a server of Nav2 may be started: unless the workspace only localizes."""
    if not any(_texts_with(package, _WITHOUT_SERVERS, _LAUNCHING)):
        return True
    name = server.encode()
    return any(
        name in data or _WITH_SERVERS.search(data) for data in _texts_with(package, b"", _LAUNCHING)
    )


def is_of_nav2(package: Package) -> bool:
    """Return whether the workspace starts Nav2, whose launch files rewrite parameter files."""
    return any(data for word in _NAV2 for data in _texts_with(package, word, _LAUNCHING))


def _texts_with(package: Package, word: bytes, endings: tuple[str, ...]) -> Iterator[bytes]:
    """Yield the files with a word outside of comments, except parameter files."""
    for other in package.workspace:
        configured = parameter_paths(other)
        for path in other.files:
            if path.endswith(endings) and path not in configured:
                with suppress(ViewError):
                    data = other.data(path)
                    if word in data and word in (code := without_comments(data)):
                        yield code
