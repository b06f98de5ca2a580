"""ND102: strings with variables in braces are f-strings."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Severity
from scaffold.api.interfaces import TEXTS
from scaffold.api.messages import MessageTypes
from scaffold.api.rclpy import RclpyFile, log_calls

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def tell(self, text):\n"
    "        self.get_logger().info({})\n"
)
_FIELD = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def tell(self, count):\n"
    "        message = String()\n"
    "        message.data = {}\n"
    "        return {}\n"
)
_FILLED = frozenset({"format", "format_map", "replace"})


class LogFPrefixMissing(RclpyRule):
    """A log message or a string field has a variable in braces, but no ``f`` prefix.

    **Why.** The braces are logged or sent literally: ``heard {text}``.

    **Fix.** Write ``f'heard {text}'``.

    **Source.** Python documentation, "Formatted string literals"; ``RUF027`` of ruff.
    """

    code = "ND102"
    name = "log-f-prefix-missing"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("an f-string", {"talker.py": _NODE.format("f'heard {text}'")}),
        Example("braces around no variable", {"talker.py": _NODE.format("'heard {number}'")}),
        Example(
            "a missing f prefix",
            {"talker.py": _NODE.format("'heard {text}'")},
            "6:32: {text} is logged literally: the string has no f prefix",
        ),
        Example(
            "a missing f prefix in a field",
            {"talker.py": _FIELD.format("'{count:03d} heard'", "String(data='{count} heard')")},
            "8:24: {count} is sent literally: the string has no f prefix",
            "9:28: {count} is sent literally: the string has no f prefix",
        ),
        Example("an f-string in a field", {"talker.py": _FIELD.format("f'{count}'", "message")}),
        Example(
            "a template that is formatted later",
            {
                "talker.py": _FIELD.format(
                    "'{count} heard'", "String(data=message.data.format(count=count))"
                )
            },
        ),
        Example(
            "doubled braces, and JSON",
            {"talker.py": _FIELD.format("'{{count}}'", """String(data='{"count": {count}}')""")},
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self.check_file(file)
        if file.module.in_tests:
            return
        for item in MessageTypes.of(package, file.module.path).assigned:
            match item.value:
                case ast.Constant(value=str(text)) if item.field.type.name in TEXTS:
                    name = _variable(file, item.value, text)
                    if name and not _is_filled(file, item.field.name):
                        message = f"{{{name}}} is sent literally: the string has no f prefix"
                        yield self.report(file.module.location(item.value), message)

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in log_calls(file):
            text = call.args[0] if call.args else None
            if isinstance(text, ast.Constant) and isinstance(text.value, str):
                name = _variable(file, text, text.value)
                if name:
                    message = f"{{{name}}} is logged literally: the string has no f prefix"
                    yield self.report(file.module.location(text), message)


def _variable(file: RclpyFile, node: ast.Constant, text: str) -> str:
    """Return the first variable, or attribute of one, in the braces of a text."""
    for name in re.findall(r"(?<!\{)\{((?:self\.)?[a-z_]\w*(?:\.\w+)*)(?::[^{}]*)?\}(?!\})", text):
        if _is_bound(file, node, name.partition(".")[0]):
            return str(name)
    return ""


def _is_bound(file: RclpyFile, at: ast.Constant, name: str) -> bool:
    probe = ast.Name(id=name, ctx=ast.Load())
    for node in file.module.index.names(name):
        if file.module.enclosing_function(node) is file.module.enclosing_function(at):
            probe = node
            break
    else:
        function = file.module.enclosing_function(at)
        arguments = function.args.args if function else []
        return any(argument.arg == name for argument in arguments)
    return file.module.index.lookup(probe.id, probe) is not None


def _is_filled(file: RclpyFile, field: str) -> bool:
    """Return whether the braces in a field are filled in after it is set."""
    return any(
        isinstance(node.value, ast.Attribute) and node.value.attr == field
        for name in _FILLED
        for node in file.module.index.attributes(name)
    )
