"""MS003: message constructors get fields as keywords."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.distributions import target
from scaffold.api.interfaces import closest_word
from scaffold.api.messages import MessageClass, MessageTypes, is_error_expected

_PREFIX = "from std_msgs.msg import String\n\nmessage = String({})\n"


class MessageArgumentUnknown(MessageRule):
    """A message is constructed with a keyword that is not a field, or with positional arguments.

    **Why.** An unknown keyword is silently ignored: an empty message is published. Humble raises
    an ``AssertionError``, Lyrical a ``TypeError``. A positional argument raises ``TypeError``.

    **Fix.** Pass fields by name: ``String(data='hello')``.

    **Source.** ``rosidl_generator_py``, ``resource/_msg.py.em``: on Jazzy and Kilted keywords that
    are not fields are rejected only when ``ROS_PYTHON_CHECK_FIELDS`` is set.
    """

    code = "MS003"
    name = "message-argument-unknown"
    examples = (
        Example("keyword that is a field", {"talker.py": _PREFIX.format("data='hello'")}),
        Example(
            "keywords unpacked from a variable",
            {"talker.py": _PREFIX.format("**fields, check_fields=True")},
        ),
        Example(
            "arguments of the caller passed on with *args and **fields",
            {"talker.py": _PREFIX.format("*args, **fields")},
        ),
        Example(
            "function result unpacked into positional arguments",
            {
                "turn.py": "from geometry_msgs.msg import Quaternion\n"
                "from tf_transformations import quaternion_from_euler\n\n"
                "TURNED = Quaternion(*quaternion_from_euler(0.0, 0.0, 1.57))\n"
            },
            "4:21: geometry_msgs/msg/Quaternion takes only keyword arguments: TypeError; write "
            "x=...",
        ),
        Example(
            "misspelled field",
            {"talker.py": _PREFIX.format("dta='hello'")},
            "3:18: std_msgs/msg/String has no field 'dta': the value is silently dropped; did you "
            "mean 'data'? (definition: std_msgs 5.3.6 of ROS 2 Jazzy)",
        ),
        Example(
            "misspelled field on Humble",
            {"talker.py": _PREFIX.format("dta='hello'")},
            "3:18: std_msgs/msg/String has no field 'dta': AssertionError; did you mean 'data'? "
            "(definition: std_msgs 4.9.1 of ROS 2 Humble)",
            distro="humble",
        ),
        Example(
            "misspelled field on Lyrical",
            {"talker.py": _PREFIX.format("dta='hello'")},
            "3:18: std_msgs/msg/String has no field 'dta': TypeError; did you mean 'data'? "
            "(definition: std_msgs 5.9.2 of ROS 2 Lyrical)",
            distro="lyrical",
        ),
        Example(
            "check_fields on Humble, which does not support it",
            {"talker.py": _PREFIX.format("data='hello', check_fields=True")},
            "3:32: std_msgs/msg/String has no field 'check_fields': AssertionError; it has data "
            "(definition: std_msgs 4.9.1 of ROS 2 Humble)",
            distro="humble",
        ),
        Example(
            "misspelled field in an unpacked dictionary",
            {
                "talker.py": "from std_msgs.msg import String\n\n"
                "VALUES = {'data': 'hello', 'dta': 'you'}\n"
                "message = String(**VALUES)\n"
            },
            "4:18: std_msgs/msg/String has no field 'dta': the value is silently dropped; did you "
            "mean 'data'? (definition: std_msgs 5.3.6 of ROS 2 Jazzy)",
        ),
        Example(
            "positional argument",
            {"talker.py": _PREFIX.format("'hello'")},
            "3:18: std_msgs/msg/String takes only keyword arguments: TypeError; write data=...",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for call in types.module.walk(ast.Call):
            if not call.args and not call.keywords:
                continue
            owner = types.class_of(call.func)
            if owner is None or is_error_expected(types.module, call):
                continue
            for node, message in _flaws(types, owner, call):
                yield self.report(types.module.location(node), message)


def _flaws(
    types: MessageTypes, owner: MessageClass, call: ast.Call
) -> Iterator[tuple[ast.AST, str]]:
    has = [field.name for field in owner.section.fields]
    more = ["check_fields"] if target().fact("messages.has_check_fields") else []
    if call.args and not _may_be_empty(call.args[0]):
        example = f"; write {has[0]}=..." if has else ""
        yield call.args[0], f"{owner.name} takes only keyword arguments: TypeError{example}"
    for word in call.keywords:
        for name in _names_given(types, word):
            if name in {*has, *more}:
                continue
            hint = closest_word(name, has) or f"; it has {', '.join(has[:5]) or 'no fields'}"
            effect = target().fact("messages.unknown_keyword")
            message = f"{owner.name} has no field {name!r}: {effect}{hint}"
            yield word, f"{message} (definition: {owner.origin})"


def _names_given(types: MessageTypes, word: ast.keyword) -> Sequence[str]:
    """Return the name of a keyword, or those in the dictionary literal of ``**values``."""
    if word.arg is not None:
        return [word.arg]
    values = types.file.evaluator.single_value(word.value)
    removes = (f"del {types.module.text(word.value)}[", f"{types.module.text(word.value)}.pop(")
    if not isinstance(values, ast.Dict) or types.module.mentions(*removes):
        return []
    keys = [key.value for key in values.keys if isinstance(key, ast.Constant)]
    return [key for key in keys if isinstance(key, str)]


def _may_be_empty(given: ast.expr) -> bool:
    """Return whether an argument is ``*args``, which a function of the user passes on."""
    return isinstance(given, ast.Starred) and isinstance(given.value, ast.Name)
