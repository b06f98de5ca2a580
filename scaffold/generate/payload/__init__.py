"""Code and text with which generated nodes fill messages, services and actions.

Modules for services, actions and messages are imported on demand, because most packages need only
one of them.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

from scaffold.generate.payload.payloads import (
    ActionPayload,
    Payload,
    SectionPayload,
    ServicePayload,
)
from scaffold.model.interfaces.definitions import KINDS, Definitions
from scaffold.model.workspace.definitions import definitions_for

__all__ = [
    "ActionPayload",
    "Payload",
    "SectionPayload",
    "ServicePayload",
    "action",
    "definitions",
    "looked_for_once",
    "payload",
    "service",
]


def payload(text: str, interfaces: Definitions | None = None) -> Payload:
    """Return how to fill messages of a type.

    Args:
        text: ``package/msg/Name``, ``package/Name`` or a bare ``Name``.
        interfaces: Where to look; by default around the current directory.

    Raises:
        InputError: the type is not known or cannot be used; the message names the nearest
            ones, or the file and the line of what is wrong.
    """
    from scaffold.generate.payload.message import of_message

    return of_message(text, interfaces or definitions())


def service(text: str, interfaces: Definitions | None = None) -> ServicePayload:
    """Return how to call and serve services of a type; see `payload`."""
    from scaffold.generate.payload.services import of_service

    return of_service(text, interfaces or definitions())


def action(text: str, interfaces: Definitions | None = None) -> ActionPayload:
    """Return how to request and execute actions of a type; see `payload`."""
    from scaffold.generate.payload.actions import of_action

    return of_action(text, interfaces or definitions())


def definitions(directory: str = ".") -> Definitions:
    """Return the definitions of the surrounding workspace, the environment and the bundle."""
    real = os.path.realpath(directory)
    if _known is None:
        return _definitions(real)
    if real not in _known:
        _known[real] = _definitions(real)
    return _known[real]


_known: dict[str, Definitions] | None = None
"""Definitions by directory, inside of `looked_for_once`."""


@contextmanager
def looked_for_once() -> Iterator[None]:
    """Look up the definitions around a directory only once within the block."""
    global _known  # noqa: PLW0603  questions know nothing of each other
    _known = {}
    try:
        yield
    finally:
        _known = None


def _definitions(real: str) -> Definitions:
    from scaffold.files.disk import Disk
    from scaffold.model.discovery import colcon
    from scaffold.model.discovery.unchecked import MOST_DIRECTORIES
    from scaffold.model.package import Package
    from scaffold.model.workspace.workspace import Workspace

    workspace = Workspace[Package]()
    for package_directory in colcon.packages_around(Disk(), real, most=MOST_DIRECTORIES):
        if _has_interfaces(package_directory):
            workspace.add(Package.at(package_directory, workspace))
    return definitions_for(workspace)


def _has_interfaces(directory: str) -> bool:
    """Return whether a package may define interfaces, without reading its manifest."""
    return any(os.path.isdir(os.path.join(directory, kind)) for kind in KINDS)
