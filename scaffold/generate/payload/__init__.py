"""What generated nodes put into messages, services and actions: code, checks, words."""

from __future__ import annotations

import os

from scaffold.generate.payload.action import of_action
from scaffold.generate.payload.message import of_message
from scaffold.generate.payload.payloads import (
    ActionPayload,
    Payload,
    SectionPayload,
    ServicePayload,
)
from scaffold.generate.payload.service import of_service
from scaffold.model.interfaces import KINDS, Definitions

__all__ = [
    "ActionPayload",
    "Payload",
    "SectionPayload",
    "ServicePayload",
    "action",
    "definitions",
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
    return of_message(text, interfaces or definitions())


def service(text: str, interfaces: Definitions | None = None) -> ServicePayload:
    """Return how to ask and answer services of a type; see `payload`."""
    return of_service(text, interfaces or definitions())


def action(text: str, interfaces: Definitions | None = None) -> ActionPayload:
    """Return how to ask for and work on actions of a type; see `payload`."""
    return of_action(text, interfaces or definitions())


def definitions(directory: str = ".") -> Definitions:
    """Return the definitions of the workspace around a directory, installed ones, common ones."""
    from scaffold.errors import InputError
    from scaffold.generate import place
    from scaffold.model import discovery
    from scaffold.model.workspace import Workspace

    top = place.workspace(directory)
    if top is None:
        return Definitions.around()
    try:
        targets = list(discovery.find([os.path.join(top, place.SOURCES)]))
    except InputError:  # none yet
        return Definitions.around()
    packages = [target.package for target in targets if _has_interfaces(target.package.directory)]
    return Definitions.around(Workspace(packages))


def _has_interfaces(directory: str) -> bool:
    """Tell whether a package may define interfaces, without reading its manifest."""
    return any(os.path.isdir(os.path.join(directory, kind)) for kind in KINDS)
