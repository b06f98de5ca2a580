"""Values that callbacks of services and action servers return and that are certainly wrong."""

from __future__ import annotations

import ast

from scaffold.api.messages import MessageTypes, ValueTypes
from scaffold.api.python import is_generator, may_end, returned
from scaffold.api.rclpy import ActionServer, Service
from scaffold.api.types import with_article

ANSWERS = {"goal_callback": "GoalResponse", "cancel_callback": "CancelResponse"}
"""The enumerations whose values callbacks of an action server return, by its parameter."""


def wrong_for_action(
    types: MessageTypes, server: ActionServer, value: ast.expr | None, answer: str
) -> str:
    """Describe a returned value that is certainly wrong; empty for others."""
    if value is None:
        return "nothing"
    if isinstance(value, ast.Constant):
        return repr(value.value)
    if answer:
        return _wrong_answer(types, value, answer)
    if isinstance(value, ast.Attribute) and types.class_of(value) is not None:
        return f"the class {types.module.text(value)}"
    message = types.type_of(value)
    if message is None or types.definitions.find(server.interface or "") is None:
        return ""
    return "" if message.name == f"{server.interface}.Result" else message.name


def _wrong_answer(types: MessageTypes, value: ast.expr, answer: str) -> str:
    """Describe a returned value that is certainly not an answer to a goal."""
    kind = "bool" if isinstance(value, ast.Compare) else ValueTypes(types).of(value)
    if kind is not None:
        return with_article(kind)
    name = types.module.qualified_name(value) or ""
    other = next((x for x in ANSWERS.values() if f".{x}." in name), answer)
    return "" if other == answer else f"a {other}"


def _returns_nothing(function: ast.FunctionDef) -> bool:
    """Return whether a function returns nothing, and is neither empty nor raises."""
    is_plain = not function.decorator_list and not is_generator(function)
    does_something = any(
        isinstance(node, ast.Assign | ast.Attribute) for node in ast.walk(function)
    )
    return is_plain and does_something and may_end(function) and not returned(function)


def _not_a_message(types: MessageTypes, value: ast.expr) -> str:
    """Describe a returned value that is certainly not a message; empty for others."""
    match value:
        case ast.Constant(value=constant):
            return "None" if constant is None else f"a {type(constant).__name__}"
        case ast.Dict() | ast.List() | ast.Tuple() | ast.Set():
            return f"a {type(value).__name__.lower()}"
        case ast.Call(func=func):
            called = types.file.callback(func).function
            if isinstance(called, ast.FunctionDef) and _returns_nothing(called):
                return f"nothing from {called.name}()"
    return ""


def wrong_response(types: MessageTypes, service: Service, value: ast.expr | None) -> str:
    """Describe a returned value that is certainly not the response; empty for others."""
    if value is None:
        return "nothing"
    plain = _not_a_message(types, value)
    if plain:
        return plain
    field = types.field_type_of(value)
    if field is not None and (field.is_primitive or field.is_array):
        return f"the field {types.module.text(value)}"
    owner = types.type_of(value)
    if owner is not None and service.interface and owner.name != f"{service.interface}.Response":
        return owner.name
    class_ = types.class_of(value) if isinstance(value, ast.Name | ast.Attribute) else None
    return f"the class {class_.name}" if class_ else ""
