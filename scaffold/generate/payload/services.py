"""Code of nodes that call services, and of those that answer them."""

from __future__ import annotations

from scaffold.generate.payload import lookup, recipe, section
from scaffold.generate.payload.payloads import ServicePayload
from scaffold.model.interfaces.definitions import Definitions


def of_service(text: str, interfaces: Definitions) -> ServicePayload:
    """Return how to call and serve services of a type.

    Raises:
        InputError: the type is not known or cannot be used.
    """
    types = lookup.find(text, "srv", interfaces)
    own = types.interface
    known_recipe = recipe.find_service(own.full_name)
    if known_recipe is None:
        request = section.asked(types, own.request)
        response = section.answered(types, own.response, [own.request])
        summary = f"answers {own.name} requests"
    else:
        request = section.by_recipe(
            types, own.request, known_recipe.request, known_recipe.request_log
        )
        response = section.by_recipe(
            types,
            own.response,
            known_recipe.response,
            known_recipe.response_log,
            known_recipe.checks,
        )
        summary = known_recipe.summary
    return ServicePayload(
        own.package, types.own_name, summary, request, response, service=types.own_alias
    )
