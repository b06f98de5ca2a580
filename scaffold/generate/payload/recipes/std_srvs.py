"""Recipes for the services of std_srvs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import ServiceRecipe

SERVICES: dict[str, ServiceRecipe] = {
    "Empty": ServiceRecipe(
        summary="does something, without a result",
        request_log="an empty request",
        response_log="done",
    ),
    "SetBool": ServiceRecipe(
        summary="switches something on or off",
        request="request.data = self.count % 2 == 0  # on and off in turn",
        response="""
            response.success = True
            response.message = 'switched on' if request.data else 'switched off'
        """,
        request_log="{request.data}",
        response_log="{response.message}",
        checks=(
            "response.success",
            "response.message == ('switched on' if request.data else 'switched off')",
        ),
    ),
    "Trigger": ServiceRecipe(
        summary="starts something and reports whether it succeeded",
        response="""
            response.success = True
            response.message = f'started for the {self.count + 1}. time'
        """,
        request_log="an empty request",
        response_log="{response.message}",
        checks=("response.success", "response.message.startswith('started')"),
    ),
}
