"""Renames classes in stubs so that messages contain their exact module.

A type checker prints only the last component of a class name: ``Node`` may be that of rclpy, of
launch or of the user. In the stubs for it, ``class Node`` of ``rclpy.node`` is renamed to
``Node·rclpy·node``, followed by ``Node = Node·rclpy·node``. Then ``Node·rclpy·node`` in a message
is exactly that class.
"""

from __future__ import annotations

import re

from scaffold import lazy_re

MARK = "\u00b7"
"""Valid in Python identifiers, but not used in practice."""
MARKED = rf"[^\W\d]\w*(?:{MARK}\w+)+"
"""Matches a marked name."""


def mark(text: str, module: str) -> str:
    """Return a stub with marked classes and module-level functions.

    Fields of messages become properties, which they are at run time: a message about a property
    names the class. The text is processed line by line, because parsing all stubs is too slow.

    Args:
        text: The stub, formatted as by scripts/make_stubs.py and the interface renderer.
        module: The dotted name of the module.
    """
    where = module.split(".")
    is_interface = re.fullmatch(r"\w+\.(?:msg|srv|action)\._\w+", module) is not None
    result: list[str] = []
    open_: list[tuple[int, str, str]] = []
    functions: dict[str, str] = {}
    for line in text.split("\n"):
        bare = line.lstrip(" ")
        indent = len(line) - len(bare)
        if bare and bare[0] not in ")]}":
            while open_ and open_[-1][0] >= indent:
                result.append(_alias(*open_.pop()))
        definition = _DEFINITION.match(bare)
        if definition is not None:
            keyword, name = definition.groups()
            inside = [item[1] for item in open_]
            marked = MARK.join([name, *where, *inside])
            if keyword == "class":
                open_.append((indent, name, marked))
                line = f"{line[:indent]}class {marked}{bare[definition.end() :]}"  # noqa: PLW2901
            elif not open_ and not name.startswith("__"):
                functions[name] = marked
                line = f"{keyword} {marked}{bare[definition.end() :]}"  # noqa: PLW2901
        elif is_interface and open_ and (field := _FIELD.fullmatch(line)) is not None:
            line = _PROPERTY.format(*field.groups())  # noqa: PLW2901
        result.append(line)
    result += [_alias(*item) for item in reversed(open_)]
    result += [_alias(0, *item) for item in functions.items()]
    head = ["from builtins import property as _property"] if is_interface else []
    return "\n".join([*head, *result, ""])


_DEFINITION = lazy_re.compile(r"(class|def|async def) ([^\W\d]\w*)")
_FIELD = lazy_re.compile(r"( +)(\w+): ((?!Final|ClassVar|TypeAlias)[^=]+[^=,])")
_PROPERTY = (
    "{0}@_property\n{0}def {1}(self) -> {2}: ...\n"
    "{0}@{1}.setter\n{0}def {1}(self, value: {2}) -> None: ..."
)


def _alias(indent: int, name: str, marked: str) -> str:
    return f"{' ' * indent}{name} = {marked}"


def full_name(marked: str) -> str:
    """Return the dotted name of a marked name, as used in code.

    Private modules are left out, ``std_msgs.msg.String``, and the parts of services and
    actions are attributes: ``std_srvs.srv.Trigger.Request``.
    """
    _, *where = marked.split(MARK)
    return ".".join([*(part for part in where if not part.startswith("_")), short_name(marked)])


def short_name(marked: str) -> str:
    """Return a marked name as used after its import: ``String``, ``Trigger.Request``."""
    name, *where = marked.split(MARK)
    return _PART.sub(r".\1", name) if where[1:2] in (["srv"], ["action"]) else name


_PART = lazy_re.compile("_(Request|Response|Goal|Result|Feedback)$")
