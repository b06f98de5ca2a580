"""ND048: service callbacks return the response."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.messages import MessageTypes
from scaffold.api.python import FunctionNode, is_generator, may_end, returned, value_set_before
from scaffold.api.rclpy import Service

_NODE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.create_service(Trigger, 'report', self.report)\n\n"
    "    def report(self, request, response):\n"
    "        response.success = True\n"
    "{}"
)
_OTHER = (
    "        return self.filled(response)\n\n"
    "    def filled(self, response):\n        response.success = True\n{}"
)


class ResponseNotReturned(MessageRule):
    """A service callback returns nothing, or another value than the response.

    **Why.** rclpy raises ``TypeError`` in ``send_response`` at the first request: the node dies,
    and the client waits forever.

    **Fix.** End the callback with ``return response``, on every path.

    **Source.** ``rclpy/service.py``, ``Service.send_response``.
    """

    code = "ND048"
    name = "response-not-returned"
    examples = (
        Example("returned", {"server.py": _NODE.format("        return response\n")}),
        Example(
            "a new one that is filled, an empty one",
            {
                "a.py": _NODE.format(
                    "        response = Trigger.Response()\n        response.success = False\n"
                    "        return response\n"
                ),
                "b.py": _NODE.format("        return Trigger.Response(success=True)\n"),
                "server.py": _NODE.format("        return Trigger.Response()\n"),
            },
            Report(
                "server.py:12:9", "returns a new response: what was set in the given one is lost"
            ),
        ),
        Example(
            "the result of a method, and of one that returns nothing",
            {
                "a.py": _NODE.format(_OTHER.format("        return response\n")),
                "b.py": _NODE.format(_OTHER.format("")),
            },
            Report(
                "b.py:12:9",
                "returns nothing from filled(), not the response (service of line 8): TypeError",
            ),
        ),
        Example(
            "nothing",
            {"server.py": _NODE.format("")},
            Report("10:9", "report() does not return the response (service of line 8): TypeError"),
        ),
        Example(
            "on one path only, and a bool",
            {
                "server.py": _NODE.format(
                    "        if request is None:\n            return True\n"
                    "        for _ in range(3):\n            return response\n"
                )
            },
            Report(
                "10:9",
                "report() does not return the response on every path (service of "
                "line 8): TypeError",
            ),
            Report("13:13", "returns a bool, not the response (service of line 8): TypeError"),
        ),
        Example(
            "a field of the response",
            {"server.py": _NODE.format("        return response.success\n")},
            Report(
                "12:9",
                "returns the field response.success, not the response (service of "
                "line 8): TypeError",
            ),
        ),
        Example(
            "the request",
            {"server.py": _NODE.format("        return Trigger.Request()\n")},
            Report(
                "12:9",
                "returns std_srvs/srv/Trigger.Request, not the response (service of "
                "line 8): TypeError",
            ),
        ),
        Example(
            "the class instead of the response",
            {
                "server.py": _NODE.format(
                    "        response = Trigger.Response\n        return response\n"
                )
            },
            Report(
                "13:9",
                "returns the class std_srvs/srv/Trigger.Response, not the response "
                "(service of line 8): TypeError",
            ),
        ),
        Example(
            "a response of its own is filled, and the given one returned",
            {
                "server.py": _NODE.format(
                    "        answer = Trigger.Response()\n        answer.success = True\n"
                    "        return response\n"
                ).replace("        response.success = True\n", "")
            },
            Report(
                "11:18", "returns the given response as it came: what was set in this one is lost"
            ),
        ),
        Example(
            "a dict",
            {"server.py": _NODE.format("        return {'success': True}\n")},
            Report("12:9", "returns a dict, not the response (service of line 8): TypeError"),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        seen: set[FunctionNode] = set()
        for service in types.facts.services:
            callback = service.callback
            function = callback.function if callback else None
            if function is None or isinstance(function, ast.Lambda) or function in seen:
                continue
            if callback and (callback.is_called or function.decorator_list):
                continue
            seen.add(function)
            yield from self._check(types, service, function)

    def _check(
        self, types: MessageTypes, service: Service, function: FunctionNode
    ) -> Iterator[Diagnostic]:
        module = types.module
        if is_generator(function):
            return
        service_line = f"(service of line {service.location.line}): TypeError"
        if may_end(function):
            never = " on every path" if returned(function) else ""
            message = f"{function.name}() does not return the response{never} {service_line}"
            yield self.report(module.name_location(function), message)
        for statement in returned(function):
            value = value_set_before(function, statement) or statement.value
            wrong = _wrong(types, service, value)
            is_last = statement is function.body[-1]
            filled = _filled_instead(types, service, function) if is_last and not wrong else None
            if filled is not None and _is_untouched(types, function, statement.value):
                message = "returns the given response as it came: what was set in this one is lost"
                yield self.report(module.location(filled), message)
            if not wrong and is_last and _is_new(types, function, statement.value):
                message = "returns a new response: what was set in the given one is lost"
                yield self.report(module.location(statement), message)
            if wrong:
                message = f"returns {wrong}, not the response {service_line}"
                yield self.report(module.location(statement), message)


def _is_new(types: MessageTypes, function: FunctionNode, value: ast.expr | None) -> bool:
    """Tell whether an empty response is made, although fields of the given one were set."""
    if not isinstance(value, ast.Call) or value.args or value.keywords:
        return False
    given = function.args.args[-1].arg if function.args.args else ""
    return types.type_of(value) is not None and any(
        isinstance(node.ctx, ast.Store)
        and isinstance(node.value, ast.Name)
        and node.value.id == given
        for node in types.module.below(function, ast.Attribute)
    )


def _filled_instead(
    types: MessageTypes, service: Service, function: FunctionNode
) -> ast.Call | None:
    """Return where a response is made whose fields are set, and that nothing else is done with."""
    module = types.module
    for assigned in module.below(function, ast.Assign):
        match assigned:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Call(args=[]) as made):
                owner = types.type_of(made)
                uses = [
                    module.parent(use)
                    for use in module.below(function, ast.Name)
                    if use.id == name and isinstance(use.ctx, ast.Load)
                ]
                if owner is None or owner.name != f"{service.interface}.Response" or not uses:
                    continue
                if all(isinstance(x, ast.Attribute) and isinstance(x.ctx, ast.Store) for x in uses):
                    return made
    return None


def _is_untouched(types: MessageTypes, function: FunctionNode, value: ast.expr | None) -> bool:
    """Tell whether a value is the given response, and nothing else is done with that."""
    given = function.args.args[-1].arg if function.args.args else ""
    uses = [x for x in types.module.below(function, ast.Name) if x.id == given]
    return bool(given) and uses == [value]


def _returns_nothing(function: ast.FunctionDef) -> bool:
    """Tell whether a function has no result: neither an empty body nor one that raises."""
    is_plain = not function.decorator_list and not is_generator(function)
    does_something = any(
        isinstance(node, ast.Assign | ast.Attribute) for node in ast.walk(function)
    )
    return is_plain and does_something and may_end(function) and not returned(function)


def _plain(types: MessageTypes, value: ast.expr) -> str:
    """Describe a returned value that is no message, whatever its type; empty for others."""
    match value:
        case ast.Constant(value=constant):
            return "None" if constant is None else f"a {type(constant).__name__}"
        case ast.Dict() | ast.List() | ast.Tuple() | ast.Set():
            return f"a {type(value).__name__.lower()}"
        case ast.Call(func=func):
            called = types.facts.callback(func).function
            if isinstance(called, ast.FunctionDef) and _returns_nothing(called):
                return f"nothing from {called.name}()"
    return ""


def _wrong(types: MessageTypes, service: Service, value: ast.expr | None) -> str:
    """Describe a returned value that is certainly not the response; empty for others."""
    if value is None:
        return "nothing"
    plain = _plain(types, value)
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
