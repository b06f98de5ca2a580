"""Validates names of packages, nodes and topics, and derives names from them."""

from __future__ import annotations

import builtins
import errno
import os
import re
import signal
import sys
from collections.abc import Sequence
from keyword import iskeyword

from scaffold.errors import InputError

MAX_LENGTH = 48
"""Maximum length of package and node names, as a CMake line with two of them is limited to 140."""
MAX_TOPIC = 64
"""Limit on a fully qualified topic, which is on one line with its type."""
MAX_FRAME = 40
"""Limit on a coordinate frame, which is on one line with its parameter."""

_NAME = r"[a-z][a-z0-9]*(_[a-z0-9]+)*"
_CMAKE_TARGETS = frozenset(
    {"all", "clean", "depend", "edit_cache", "help", "install", "list_install_components"}
    | {"package", "package_source", "preinstall", "rebuild_cache", "test", "uninstall"}
)
_DIRECTORIES = frozenset(
    {"action", "build", "config", "doc", "docs", "include", "launch", "log", "msg", "resource"}
    | {"scripts", "share", "src", "srv", "tests", "urdf", "worlds"}
)
_PYTHON_PACKAGES = frozenset(
    {"argcomplete", "attr", "attrs", "bloom", "catkin_pkg", "colcon_core", "coverage"}
    | {"cryptography", "distro", "distutils", "docutils", "em", "flake8", "hypothesis"}
    | {"iniconfig", "lark", "lxml", "markupsafe", "matplotlib", "mccabe", "mypy", "netifaces"}
    | {"numpy", "pip", "pkg_resources", "pluggy", "pycodestyle", "pycparser", "pydocstyle"}
    | {"pyflakes", "pygments", "pyparsing", "pytest", "requests", "rosdep2", "rosdistro"}
    | {"rospkg", "scipy", "setuptools", "six", "snowballstemmer", "urllib3", "vcstool"}
    | {"wheel", "yaml"}
)
"""Modules that colcon, the linters and ROS import, besides those that rosdep knows."""
_TEST_MODULES = frozenset({"conftest", "copyright", "flake8", "pep257", "setup", "xmllint"})
_IMPORTED_CLASSES = frozenset(
    {"ActionClient", "ActionServer", "CancelResponse", "Event", "ExternalShutdownException"}
    | {"FloatingPointRange", "Future", "GoalResponse", "GoalStatus", "IntegerRange"}
    | {"InvalidParameterValueException", "LifecycleNode", "MultiThreadedExecutor", "Node"}
    | {"ParameterDescriptor", "ParameterException", "SetParametersResult"}
    | {"SignalHandlerOptions", "TransitionCallbackReturn"}
)
"""Classes that the modules of all kinds of nodes may import."""
_C_MACROS = frozenset({"BUFSIZ", "EOF", "INFINITY", "NAN", "NULL"})
"""Macros of headers included by generated code, besides the names of errors and signals."""
_RESERVED_TOPICS = frozenset({"/rosout", "/parameter_events"})


def package_name(text: str) -> str:
    """Return the name of a new package.

    Raises:
        InputError: REP 144, Python or CMake forbids it, or another package has it.
    """
    _check_form(text, "package name", at_least=2)
    reason = _why_taken(text)
    if reason:
        raise InputError(f"the package name {text!r} {reason}; choose another one")
    return text


def _why_taken(name: str) -> str:
    from scaffold.model.catalog import ROS_PACKAGES

    prefix = _installed(name)
    reasons = (
        (iskeyword(name), "is a keyword of Python"),
        (name in _CMAKE_TARGETS, "is the name of a CMake target"),
        (name in _DIRECTORIES, "is the name of a directory in workspaces and packages"),
        (name in sys.stdlib_module_names, "is a module of the Python standard library"),
        (name in ROS_PACKAGES or name == "ros", "is an existing ROS package"),
        (_is_python_package(name), "is an existing Python package"),
        (prefix is not None, f"is a package installed in {prefix}"),
    )
    return next((reason for applies, reason in reasons if applies), "")


def _is_python_package(name: str) -> bool:
    from scaffold.model.catalog import keys_of_module

    return name in _PYTHON_PACKAGES or bool(keys_of_module(name))


def _installed(name: str) -> str | None:
    """Return the prefix of the sourced environment that has a package."""
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        marker = os.path.join(prefix, "share", "ament_index", "resource_index", "packages", name)
        if prefix and os.path.exists(marker):
            return prefix
    return None


def node_name(text: str) -> str:
    """Return the name of a new node, which is also that of its module and executable.

    Raises:
        InputError: ROS or Python forbids it, or the module would shadow another one.
    """
    _check_form(text, "node name")
    if iskeyword(text):
        raise InputError(f"the node name {text!r} is a keyword of Python; choose another one")
    if text in sys.stdlib_module_names or _is_python_package(text):
        raise InputError(f"the node name {text!r} would shadow the Python module {text}")
    if text in _TEST_MODULES or text.startswith("test_") or text.endswith("_test"):
        raise InputError(f"the node name {text!r} is the name of a test file for pytest")
    return text


def _check_form(text: str, kind: str, *, at_least: int = 1) -> None:
    if re.fullmatch(_NAME, text) and at_least <= len(text) <= MAX_LENGTH:
        return
    if not at_least <= len(text) <= MAX_LENGTH:
        raise InputError(
            f"the {kind} {_shortened(text)!r} has {len(text)} character{'s' * (len(text) != 1)}; "
            f"it must have {at_least} to {MAX_LENGTH}"
        )
    better = _repaired(text)
    hint = f", such as {better}" if re.fullmatch(_NAME, better) and len(better) > 1 else ""
    raise InputError(
        f"the {kind} {text!r} must be lower-case words of letters and digits joined by single "
        f"underscores, starting with a letter{hint}"
    )


def _repaired(text: str) -> str:
    """Return the valid name that the user probably meant."""
    words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", text)
    return re.sub(r"[^a-z0-9]+", "_", words.lower()).strip("_").lstrip("0123456789_")


def _shortened(text: str) -> str:
    return text if len(text) <= MAX_LENGTH else text[: MAX_LENGTH - 3] + "..."


def interface_name(text: str) -> str:
    """Return the name of a new message, service or action.

    Raises:
        InputError: the parsers of ROS reject it.
    """
    if re.fullmatch(r"[A-Z][A-Za-z0-9]*", text) and len(text) <= MAX_LENGTH:
        if iskeyword(text):
            raise InputError(f"the interface name {text!r} is a keyword of Python")
        if text in _C_MACROS or hasattr(errno, text) or hasattr(signal.Signals, text):
            raise InputError(f"the interface name {text!r} is a macro of C; choose another one")
        return text
    better = "".join(word[:1].upper() + word[1:] for word in re.findall("[A-Za-z0-9]+", text))
    hint = f", such as {better}" if re.fullmatch(r"[A-Z][A-Za-z0-9]{0,47}", better) else ""
    raise InputError(
        f"the interface name {_shortened(text)!r} must be CamelCase, with letters and digits "
        f"only, {MAX_LENGTH} characters at most{hint}"
    )


def header_name(interface: str) -> str:
    """Return the base name of the files generated for an interface."""
    words = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", interface)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", words).lower()


def program_name(text: str) -> str:
    """Return the name of a new C++ program: its source, its target and its executable.

    Raises:
        InputError: it is invalid, or CMake has a target of that name.
    """
    _check_form(text, "program name")
    if text in _CMAKE_TARGETS:
        raise InputError(f"the program name {text!r} is the name of a CMake target")
    return text


def topic(text: str, kind: str = "topic") -> str:
    """Return the name of a topic, service or action.

    It is relative, absolute (``/x``) or private (``~/x``).

    Raises:
        InputError: ROS forbids it.
    """
    plain = text.removeprefix("~/") if text.startswith("~") else text.removeprefix("/")
    if len(text) > MAX_TOPIC:
        raise InputError(
            f"the {kind} {_shortened(text)!r} has {len(text)} characters; the limit is {MAX_TOPIC}"
        )
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*", plain):
        raise InputError(
            f"the {kind} {text!r} must be words of letters, digits and underscores joined by '/', "
            "none starting with a digit, such as battery/voltage"
        )
    if "__" in text:
        raise InputError(f"the {kind} {text!r} has a double underscore, which ROS reserves")
    if resolve(text, "node") in _RESERVED_TOPICS:
        raise InputError(f"the {kind} {text!r} is used by ROS itself")
    return text


def frame(text: str) -> str:
    """Return the name of a coordinate frame.

    Raises:
        InputError: tf2 rejects it, or tools could not refer to it.
    """
    if len(text) > MAX_FRAME:
        raise InputError(
            f"the frame {_shortened(text)!r} has {len(text)} characters; the limit is {MAX_FRAME}"
        )
    if text.startswith("/"):
        raise InputError(f"the frame {text!r} starts with '/', which tf2 rejects")
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z0-9_]+)*", text):
        raise InputError(
            f"the frame {text!r} must be words of letters, digits and underscores joined by '/', "
            "the first not starting with a digit, such as base_link"
        )
    return text


def resolve(name: str, node: str) -> str:
    """Return the absolute name of a topic in a node that runs without a namespace."""
    if name.startswith("~/"):
        return f"/{node}/{name[2:]}"
    return name if name.startswith("/") else f"/{name}"


_LIKE_DIGITS = {"I", "O"}
"""Names of classes that flake8 rejects (E742): they look like 1 and 0."""


def class_name(node: str, taken: Sequence[str] = ()) -> str:
    """Return the class name of a node, distinct from the classes that it uses."""
    name = "".join(word[0].upper() + word[1:] for word in node.split("_"))
    # `None` and `True` are keywords, `ValueError` a class that the module may mean.
    is_taken = name in _IMPORTED_CLASSES or name in taken or hasattr(builtins, name)
    return f"{name}Node" if is_taken or name in _LIKE_DIGITS else name


def dependency(text: str) -> str:
    """Return the name of a package or a rosdep key.

    Raises:
        InputError: it cannot be one.
    """
    if re.fullmatch(r"[A-Za-z][A-Za-z0-9_.+-]*", text) and len(text) <= MAX_LENGTH:
        _refuse_index_name(text)
        return text
    raise InputError(
        f"the dependency {_shortened(text)!r} is not the name of a package or a rosdep key"
    )


def _refuse_index_name(text: str) -> None:
    """Raise if a name is that of the Python package index and the rosdep key differs."""
    from scaffold.model.catalog import keys_of_module, module_of_key

    module = module_of_key(text)
    if module is not None:
        raise InputError(f"rosdep has no key {text!r}; its key is {keys_of_module(module)[0]}")
