"""What attributes are read from, and which of them it has; for TY003."""

from __future__ import annotations

import ast
import re

from scaffold.api import Package, fact
from scaffold.api.messages import MessageTypes
from scaffold.api.rclpy import is_read_in_full, rclpy_file
from scaffold.api.types import (
    MARKED,
    TypeFinding,
    class_in,
    class_itself,
    full_name,
    members,
    module_names,
    own_members,
    with_article,
)

_OF_WINDOWS = frozenset({"msvcrt", "winreg", "winsound"})
"""Modules that are empty on Linux, and only used on Windows."""
_BASES = frozenset(
    {
        "launch.action.Action",
        "launch.event.Event",
        "launch.launch_description_entity.LaunchDescriptionEntity",
        "launch.substitution.Substitution",
    }
)
"""Classes without direct instances: only derived classes are used."""
_INTERFACE = re.compile(r"\w+\.(?:srv|action)\.[A-Za-z0-9]+")
"""A service or an action: only its parts have instances."""
MESSAGE = re.compile(r"(?!rclpy\.)(?P<package>\w+)\.(?P<kind>msg|srv|action)\.(?P<name>[\w.]+)")
"""Matches a message, or a part of a service or an action."""
_ARRAY = "numpy.ndarray"
_EXECUTOR = "rclpy.executors.Executor"
_AROUND_FEEDBACK = frozenset({"feedback", "goal_id"})
"""The fields of the message passed to feedback callbacks."""
_PLAIN = frozenset({"str", "int", "float", "bool", "bytes"})
CONTAINER = re.compile(r"(dict|list|set|array)\[")
"""Matches the type of a container with any elements."""
COROUTINE = "a coroutine"
FUNCTION = "a function"
TUPLE = "a tuple"
_MAKING = re.compile(rf"\(\) -> {MARKED}(?:\[.*\])?")
"""Matches a method stored in an attribute that returns a ROS object."""
METHOD = re.compile(rf"bound method ({MARKED})(?:\[.*\])?\.(\w+)\(.*")
"""Matches an uncalled method."""

_SETTING = (b"setattr(", b"__dict__", b"vars(", b"patch(", b"patch.object(")
"""Calls that set attributes whose names are strings."""
_STORE = (
    r"BEFORE\.NAME\b\s*(?::[^=\n]+)?=[^=]"
    r"|(?m:^[\w.\[\], \t*(]{1,200}\.NAME\b[ \t]*,[\w.\[\], \t*)]{0,200}=(?!=))"
    r"|\b(?:for|as)[ \t]+[\w., \t]{0,80}\.NAME\b"
)
"""Matches statements that set an attribute: assignments, also of tuples, and loops."""


def known_owner(
    finding: TypeFinding, node: ast.Attribute, owner: str
) -> tuple[str, frozenset[str]] | None:
    """Return the name and members of the owner of a missing attribute; ``None`` if uncertain."""
    container = CONTAINER.match(owner)
    if container is not None and owner.endswith("]"):
        is_replaced = _is_set_elsewhere(finding.package, node.value)
        is_given = isinstance(finding.module.index.only_node(node.value), ast.arg)
        is_replaced = is_replaced or is_given  # and annotated, which nothing enforces
        if container[1] == "array":
            types = MessageTypes.of(finding.package, finding.path)
            is_replaced = is_replaced or types.field_type_of(node.value) is not None  # see MS023
        return None if is_replaced else (with_article(container[1]), frozenset())
    if owner in _PLAIN and _may_be_of_enum(finding.package, node):
        return None
    return _plain(node, owner) or _of_ros(finding, node, owner)


def _is_set_elsewhere(package: Package, node: ast.expr) -> bool:
    """Return whether an attribute may be set in a way that the type checker does not recognize."""
    return isinstance(node, ast.Attribute) and any(
        _sets(package, path, node.attr, r"(?<!\bself)") for path in package.python_files
    )


def _may_be_of_enum(package: Package, node: ast.Attribute) -> bool:
    """Return whether a value is of a class with a base, which may be an enum of a library.

    The type checker sees the plain value if it does not find the base.
    """
    match node:
        case ast.Attribute(attr="name" | "value", value=ast.Attribute(value=ast.Name(id=name))):
            return any(
                _has_base(other, path, name)
                for other in package.workspace
                for path in other.python_files
            )
    return False


@fact
def _has_base(package: Package, path: str, class_: str) -> bool:
    pattern = rf"class {class_}\((?!\s*(?:object\b|\)))"
    return re.search(pattern.encode(), package.data(path)) is not None


def _plain(node: ast.Attribute, owner: str) -> tuple[str, frozenset[str]] | None:
    """Return the name of a method, or the type of a plain value, whose attribute is read."""
    method = METHOD.fullmatch(owner) if isinstance(node.ctx, ast.Load) else None
    if method is not None:
        return f"{full_name(method[1])}.{method[2]}", frozenset()
    if _MAKING.fullmatch(owner) and isinstance(node.ctx, ast.Load):
        return FUNCTION, frozenset()
    if owner.startswith("tuple[") and isinstance(node.ctx, ast.Load):
        return TUPLE, frozenset()
    if owner.startswith("CoroutineType["):
        return COROUTINE, frozenset()
    return (with_article(owner), frozenset()) if owner in _PLAIN else None


def _of_ros(
    finding: TypeFinding, node: ast.Attribute, owner: str
) -> tuple[str, frozenset[str]] | None:
    name, package = node.attr, finding.package
    if finding.message.startswith("Module"):
        return None if owner in _OF_WINDOWS else (owner, module_names(package, owner))
    if re.fullmatch(r"\w+", owner) is not None:  # it has no mark
        return _of_workspace(finding, node, owner)
    class_ = _class_of_object(owner) or class_itself(owner)
    shown = full_name(class_) if class_ else ""
    if not class_ or _is_of_message_around(shown, name) or _is_default_of_field(shown, name):
        return None
    if shown == _EXECUTOR and _is_set(package, "executor"):
        return None  # ND013 reports that something else is assigned
    is_settable = not isinstance(node.ctx, ast.Load) or _is_set(package, name)
    if is_settable and not is_closed(shown) and name not in _of_contents(package, owner):
        return None  # an object of rclpy takes any attribute
    return shown, members(package, class_)


def _of_workspace(
    finding: TypeFinding, node: ast.Attribute, owner: str
) -> tuple[str, frozenset[str]] | None:
    is_inside = is_of_self(finding, node)
    if (is_inside and _is_of_node(finding, owner)) or _is_set(finding.package, node.attr):
        return None  # ND046 reports attributes of nodes
    return owner, own_members(finding.package, owner, is_inside=is_inside)


def is_of_self(finding: TypeFinding, node: ast.Attribute) -> bool:
    """Return whether an attribute is read from ``self`` in a class of the workspace."""
    is_of_workspace = finding.match(r"Object of type `\w+` has no .+") is not None
    return is_of_workspace and finding.module.text(node.value) == "self"


def _is_of_node(finding: TypeFinding, class_: str) -> bool:
    """Return whether a class of the file is a node whose bases are all in its package."""
    classes = rclpy_file(finding.package, finding.path).classes
    return any(node.name == class_ and is_read_in_full(node) for node in classes)


def _of_contents(package: Package, owner: str) -> frozenset[str]:
    """Return the fields of the messages that a future or a goal handle holds."""
    held = re.findall(MARKED, owner.partition("[")[2])
    return frozenset[str]().union(*(members(package, class_) for class_ in held))


def _class_of_object(owner: str) -> str | None:
    """Return the class of an object; ``None`` for a class that has no instances."""
    class_ = class_in(owner)
    shown = full_name(class_) if class_ else ""
    return None if shown in _BASES or _INTERFACE.fullmatch(shown) else class_


def is_closed(shown: str) -> bool:
    """Return whether objects of a class only allow the attributes that the class defines."""
    return shown == _ARRAY or MESSAGE.fullmatch(shown) is not None


def _is_of_message_around(shown: str, name: str) -> bool:
    """Return whether the annotation of a callback names the feedback for the message around it."""
    return shown.endswith(".Feedback") and name in _AROUND_FEEDBACK


def _is_default_of_field(shown: str, name: str) -> bool:
    """Return whether an attribute of a message class is the default value of a field."""
    return name.endswith("__DEFAULT") and MESSAGE.fullmatch(shown) is not None


def cause(shown: str) -> str:
    """Return the common cause of wrong fields of one message, as in MS002."""
    matched = MESSAGE.fullmatch(shown)
    if matched is None:
        return ""
    return f"fields of {matched['package']}/{matched['kind']}/{matched['name']}"


def without_none(owner: str) -> str:
    """Return a type without ``None``, the initial value of an attribute."""
    return " | ".join(part for part in owner.split(" | ") if part != "None") or owner


def _is_set(package: Package, name: str) -> bool:
    """Return whether any code of the workspace may set an attribute of this name."""
    return _is_set_in(package, name) or any(_is_set_in(other, name) for other in package.workspace)


@fact
def _is_set_in(package: Package, name: str) -> bool:
    return any(_sets(package, path, name) for path in package.python_files)


@fact
def _sets(package: Package, path: str, name: str, before: str = "") -> bool:
    data = package.data(path)
    if name.encode() not in data:
        return False
    if any(word in data for word in _SETTING) and re.search(rf"[\"'.]{name}[\"']".encode(), data):
        return True
    pattern = _STORE.replace("NAME", name).replace("BEFORE", before)
    return f".{name}".encode() in data and re.search(pattern.encode(), data) is not None
