"""Code of nodes that send goals, and of those that execute them."""

from __future__ import annotations

from scaffold.generate.payload import lookup, recipe, section
from scaffold.generate.payload.code import Block
from scaffold.generate.payload.lookup import Types
from scaffold.generate.payload.payloads import ActionPayload
from scaffold.generate.payload.recipe import ActionRecipe
from scaffold.model.interfaces.definitions import Definitions, Interface

_FIBONACCI = "example_interfaces/action/Fibonacci"


def of_action(text: str, interfaces: Definitions) -> ActionPayload:
    """Return how to request and how to execute actions of a type.

    Raises:
        InputError: the type is not known or cannot be used.
    """
    types = lookup.find(text, "action", interfaces)
    known_recipe = recipe.find_action(types.interface.full_name) or _recipe_of_copy(types.interface)
    return _by_recipe(types, known_recipe) if known_recipe else _by_fields(types)


def _recipe_of_copy(interface: Interface) -> ActionRecipe | None:
    """Return the recipe of Fibonacci for one of its many copies in other packages."""
    parts = (interface.goal, interface.result, interface.feedback)
    names = [[field.name for field in part.fields] for part in parts]
    fibonacci = recipe.find_action(_FIBONACCI)
    if fibonacci is None or interface.name != "Fibonacci" or names[:2] != [["order"], ["sequence"]]:
        return None
    if names[2] == ["sequence"]:
        return fibonacci
    if names[2] != ["partial_sequence"]:
        return None
    old, new = "feedback.sequence", "feedback.partial_sequence"
    return fibonacci._replace(
        start=fibonacci.start.replace(old, new),
        feedback=fibonacci.feedback.replace(old, new),
        feedback_log=fibonacci.feedback_log.replace(old, new),
        result=fibonacci.result.replace(old, new),
    )


def _by_recipe(types: Types, action_recipe: ActionRecipe) -> ActionPayload:
    own = types.interface
    start = Block()
    start.embed(action_recipe.start, "feedback")
    return ActionPayload(
        package=own.package,
        name=types.own_name,
        action=types.own_alias,
        summary=action_recipe.summary,
        goal=section.by_recipe(types, own.goal, action_recipe.goal, action_recipe.goal_log),
        refused=action_recipe.refused,
        start=tuple(start.lines()),
        steps=action_recipe.steps,
        feedback=section.by_recipe(
            types, own.feedback, action_recipe.feedback, action_recipe.feedback_log
        ),
        result=section.by_recipe(
            types, own.result, action_recipe.result, action_recipe.result_log, action_recipe.checks
        ),
    )


def _by_fields(types: Types) -> ActionPayload:
    own = types.interface
    return ActionPayload(
        package=own.package,
        name=types.own_name,
        action=types.own_alias,
        summary=f"executes {own.name} goals in {section.STEPS} steps",
        goal=section.asked(types, own.goal),
        refused="",
        start=(),
        steps=f"range(1, {section.STEPS + 1})",
        feedback=section.reported(types, own.feedback),
        result=section.answered(types, own.result, [own.feedback, own.goal]),
    )
