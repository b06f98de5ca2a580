"""Recipes for the interfaces of example_interfaces, whose messages are those of std_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import ActionRecipe, Recipe, ServiceRecipe
from scaffold.generate.payload.recipes import std_msgs, std_srvs

RECIPES: dict[str, Recipe] = {
    **{
        name: item for name, item in std_msgs.RECIPES.items() if name not in {"ColorRGBA", "Header"}
    },
    "WString": std_msgs.RECIPES["String"],
}

SERVICES: dict[str, ServiceRecipe] = {
    **{name: std_srvs.SERVICES[name] for name in ("SetBool", "Trigger")},
    "AddTwoInts": ServiceRecipe(
        summary="adds two integers",
        request="""
            request.a = self.count
            request.b = 2
        """,
        response="response.sum = request.a + request.b",
        request_log="{request.a} + {request.b}",
        response_log="{response.sum}",
        checks=("response.sum == request.a + request.b",),
    ),
}

ACTIONS: dict[str, ActionRecipe] = {
    "Fibonacci": ActionRecipe(
        summary="computes the first numbers of the Fibonacci sequence",
        goal="goal.order = 10  # how many numbers after the first",
        refused="not 1 <= goal.order <= 46",  # int32 holds no more
        start="feedback.sequence = [0, 1]",
        steps="range(1, goal.order)",
        feedback="feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])",
        result="result.sequence = feedback.sequence",
        goal_log="order {goal.order}",
        feedback_log="{feedback.sequence[-1]}",
        result_log="{list(result.sequence)}",
        checks=(
            "len(result.sequence) == goal.order + 1",
            "result.sequence[-1] == result.sequence[-2] + result.sequence[-3]",
        ),
    ),
}
