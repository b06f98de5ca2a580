"""MS003: the arguments of a message are its fields."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.interfaces import nearest_word
from scaffold.api.messages import MessageClass, MessageTypes

_PREFIX = "from std_msgs.msg import String\n\nmessage = String({})\n"


class MessageArgumentUnknown(MessageRule):
    """A message is made with a keyword that is no field, or without keywords.

    **Why.** An unknown keyword is ignored without a word: an empty message is published. An
    argument without a keyword is a ``TypeError``.

    **Fix.** Write ``field=value`` with the fields of the definition.

    **Source.** ``rosidl_generator_py``, ``resource/_msg.py.em``: keywords that are no fields are
    refused only when ``ROS_PYTHON_CHECK_FIELDS`` is set.
    """

    code = "MS003"
    name = "message-argument-unknown"
    examples = (
        Example("a field", {"talker.py": _PREFIX.format("data='hello'")}),
        Example("nobody knows which", {"talker.py": _PREFIX.format("**fields, check_fields=True")}),
        Example(
            "misspelt",
            {"talker.py": _PREFIX.format("dta='hello'")},
            reports=(
                Report(
                    "talker.py:3:18",
                    "std_msgs/msg/String has no field 'dta', so this value is dropped "
                    "without a word; did you mean 'data'? (definition: std_msgs 5.3.6 "
                    "of ROS 2 Jazzy)",
                ),
            ),
        ),
        Example(
            "without a keyword",
            {"talker.py": _PREFIX.format("'hello'")},
            reports=(
                Report(
                    "talker.py:3:18",
                    "std_msgs/msg/String takes its fields as keywords only, as in data=...",
                ),
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for call in types.module.walk(ast.Call):
            if not call.args and not call.keywords:
                continue
            owner = types.class_of(call.func)
            if owner is None or types.is_tolerated(call):
                continue
            for node, said in _flaws(owner, call):
                yield self.report(types.module.location(node), said)


def _flaws(owner: MessageClass, call: ast.Call) -> Iterator[tuple[ast.AST, str]]:
    has = [field.name for field in owner.section.fields]
    if call.args and not isinstance(call.args[0], ast.Starred):
        example = f", as in {has[0]}=..." if has else ""
        yield call.args[0], f"{owner.name} takes its fields as keywords only{example}"
    for word in call.keywords:
        if word.arg is not None and word.arg not in {*has, "check_fields"}:
            hint = nearest_word(word.arg, has) or f"; it has {', '.join(has[:5]) or 'no fields'}"
            said = (
                f"{owner.name} has no field {word.arg!r}, so this value is dropped without a "
                f"word{hint} (definition: {owner.origin})"
            )
            yield word, said
