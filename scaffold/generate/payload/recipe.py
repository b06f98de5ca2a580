"""Recipes: how to fill common messages with realistic values."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from scaffold.generate.payload import conventions
from scaffold.record import NamedTuple

FRAME = "base_link"
"""The frame of messages without a convention."""


class Recipe(NamedTuple):
    """How to fill one message: the body of the method that publishes it.

    A ``header`` is filled without being mentioned; what the code uses is imported by itself.
    Names of other messages and of ``math`` and ``struct`` may be used.
    """

    summary: str
    """As in `Payload.summary`."""
    code: str = ""
    """Lines that fill ``msg``."""
    constants: str = ""
    """Lines of the module."""
    log: str = ""
    """As in `Payload.log`; empty: the fields that change."""
    checks: tuple[str, ...] = ()
    """As in `Payload.checks`."""
    frame: str = FRAME
    """The default of the parameter ``frame_id``, where there is no convention for the type;
    empty: the header has a time only."""


def find(full_name: str) -> Recipe | None:
    """Return the recipe of a message by ``package/msg/Name``; ``None`` if there is none."""
    recipe: Recipe | None = _lookup(full_name, "RECIPES")
    frame = conventions.of_message(full_name).frame
    return recipe._replace(frame=frame) if recipe is not None and frame else recipe


class ServiceRecipe(NamedTuple):
    """How to call and answer a service."""

    summary: str
    """What it does, as in `ServicePayload.summary`."""
    request: str = ""
    """Lines that fill ``request``."""
    response: str = ""
    """Lines that fill ``response`` from ``request``."""
    request_log: str = ""
    response_log: str = ""
    checks: tuple[str, ...] = ()
    """Expressions that are true of ``response`` for a ``request``."""


class ActionRecipe(NamedTuple):
    """How to send a goal of an action and execute it."""

    summary: str
    """What it does, as in `ActionPayload.summary`."""
    goal: str
    """Lines that fill ``goal``."""
    refused: str
    """As in `ActionPayload.refused`."""
    start: str
    """Lines that prepare ``feedback``."""
    steps: str
    """As in `ActionPayload.steps`."""
    feedback: str
    """Lines that bring ``feedback`` up to date."""
    result: str
    """Lines that fill ``result``."""
    goal_log: str
    feedback_log: str
    result_log: str
    checks: tuple[str, ...]
    """Expressions that are true of ``result`` for a ``goal``."""


def find_service(full_name: str) -> ServiceRecipe | None:
    """Return the recipe of a service by ``package/srv/Name``; ``None`` if there is none."""
    recipe: ServiceRecipe | None = _lookup(full_name, "SERVICES")
    return recipe


def find_action(full_name: str) -> ActionRecipe | None:
    """Return the recipe of an action by ``package/action/Name``; ``None`` if there is none."""
    recipe: ActionRecipe | None = _lookup(full_name, "ACTIONS")
    return recipe


def _lookup(full_name: str, table: str) -> Any:  # noqa: ANN401  of the type that the table has
    package, _, name = full_name.split("/")
    module = f"{__package__}.recipes.{package}"
    if find_spec(module) is None:
        return None
    return getattr(import_module(module), table, {}).get(name)
