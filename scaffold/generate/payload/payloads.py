"""The template variables for an interface: code that fills it, and descriptions."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterable
from typing import Any

from scaffold import lazy_re
from scaffold.generate.payload import conventions, effects
from scaffold.generate.payload.effects import Effects
from scaffold.generate.payload.processing import PROCESSES, Process
from scaffold.generate.questions.names import header_name
from scaffold.model.interfaces.types import FLOATS, INTEGER_RANGES
from scaffold.record import NamedTuple

_PERIOD = lazy_re.compile(r"(msg\.(scan_time)) = [\d.]+")
"""An assignment of the conventional period of messages."""


class Payload(NamedTuple):
    """Code that fills a message, and assertions about it for a test."""

    package: str
    name: str
    """The class name of the message in code."""
    imports: tuple[str, ...]
    """Import statements of the node, including that of the message."""
    statements: tuple[str, ...]
    """Lines of a method, without its indentation; they fill ``msg``.

    They may use ``self.count`` (messages so far), ``self.frame_id`` and ``self.get_clock()``.
    """
    log: str
    """The inside of an f-string in single quotes, such as ``{msg.data}``; short for large
    messages, and without braces only for empty ones."""
    summary: str
    """A description of the content, lower case and without a period."""
    checks: tuple[str, ...]
    """Python expressions that are true for every received ``message``."""
    is_stamped: bool
    """Whether it has a frame, which the node takes from its parameter ``frame_id``."""
    is_counted: bool
    """Whether the statements use ``self.count``."""
    packages: tuple[str, ...]
    """The packages that the imports need, in alphabetical order."""
    interface_packages: tuple[str, ...] = ()
    """The packages that define messages; a receiving node needs no others."""
    frame: str = "base_link"
    """The default of the parameter ``frame_id``."""
    constants: tuple[str, ...] = ()
    """Lines of the module, such as ``WIDTH = 64  # pixels``."""
    is_changing: bool = True
    """Whether consecutive messages differ; empty ones cannot."""
    message: str = ""
    """The name of the message, if ``name`` is another one."""

    @property
    def type(self) -> str:
        """The full name, as ``ros2 topic info`` shows it."""
        return f"{self.package}/msg/{self.message or self.name}"

    @property
    def topic(self) -> str:
        """The conventional topic name for these messages."""
        return conventions.of_message(self.type).topic

    @property
    def rate(self) -> float:
        """The conventional rate in messages per second."""
        return conventions.of_message(self.type).rate

    def offered(self, topic: str) -> str:
        """Return the conventional quality of service of publishers on a topic."""
        return conventions.of_topic(self.type, topic).offered

    def requested(self, topic: str) -> str:
        """Return the conventional quality of service of subscriptions on a topic."""
        return conventions.of_topic(self.type, topic).requested

    @property
    def period(self) -> str:
        """The field with the time from one message to the next; empty if there is none."""
        fields = [match[2] for line in self.statements if (match := _PERIOD.match(line))]
        return fields[0] if fields else ""

    def statements_at(self, rate: str) -> list[str]:
        """Return the statements of a node that publishes at a rate, an expression."""
        return [_PERIOD.sub(rf"\1 = 1.0 / {rate}", line) for line in self.statements]

    @property
    def effects(self) -> Effects:
        """What the statements do to the fields."""
        return effects.of_statements(self.statements, "msg")

    def processed(self, published: Payload) -> Process | None:
        """Return how to compute messages of another type from these; ``None`` if unknown."""
        return _process(self, published)

    @property
    def check_imports(self) -> tuple[str, ...]:
        """Import statements that the checks need."""
        return _needed(self.imports, self.checks)

    @property
    def class_names(self) -> tuple[str, ...]:
        """What the imports call the messages: a node's class has another name."""
        return _class_names(self.imports)

    @property
    def log_received(self) -> str:
        """The same as ``log`` for any received message, whose arrays may be empty."""
        arrays = dict.fromkeys(re.findall(r"(?<![\w.])msg\.([\w.]+)\[", self.log))
        if not arrays:
            return self.log
        return ", ".join(f"{path.rpartition('.')[2]}: {{len(msg.{path})}}" for path in arrays)

    @property
    def import_line(self) -> str:
        """The import of the message alone."""
        return _import(f"{self.package}.msg", self.message, self.name)


class SectionPayload(NamedTuple):
    """Code that fills a section of a service or an action, and assertions about it."""

    statements: tuple[str, ...]
    """Lines of a method, without its indentation; they fill the variable of the section's name:
    ``request``, ``response``, ``goal``, ``feedback`` or ``result``. Empty if there are no
    fields. They may use ``self.count``, ``self.frame_id`` and ``self.get_clock()``."""
    log: str
    """The inside of an f-string in single quotes, such as ``{response.sum}``; without braces
    (then it is not an f-string) if there are no fields."""
    summary: str
    """A description to follow "the request holds"; empty if there are no fields."""
    checks: tuple[str, ...]
    """Python expressions that are true for it, with the same variables as the statements."""
    imports: tuple[str, ...] = ()
    """Import statements that the statements need, except the one of the interface."""
    packages: tuple[str, ...] = ()
    """The interface packages that the imports need, in alphabetical order."""
    is_stamped: bool = False
    """Whether the statements use ``self.frame_id``."""
    is_counted: bool = False
    """Whether the statements use ``self.count``."""
    constants: tuple[str, ...] = ()
    """Lines of the module that the statements need, such as ``WIDTH = 64  # pixels``."""
    frame: str = "base_link"
    """The default of the parameter ``frame_id``."""

    @property
    def check_imports(self) -> tuple[str, ...]:
        """Import statements that the checks need, except the one of the interface."""
        return _needed(self.imports, self.checks)

    @property
    def period(self) -> str:
        """The field with the time from one message to the next; empty if there is none."""
        fields = [match[2] for line in self.statements if (match := _PERIOD.match(line))]
        return fields[0] if fields else ""

    def statements_at(self, rate: str) -> list[str]:
        """Return the statements of a node that publishes at a rate, an expression."""
        return [_PERIOD.sub(rf"\1 = 1.0 / {rate}", line) for line in self.statements]

    @property
    def effects(self) -> Effects:
        """What the statements do to the fields."""
        target = self.statements[0].partition(".")[0] if self.statements else ""
        return effects.of_statements(self.statements, target)

    @property
    def example(self) -> str:
        """The constants among the fields as YAML, for a command line: ``{order: 10}``."""
        return _yaml(_constants(self.statements))


class ServicePayload(NamedTuple):
    """Code that fills the request of a service, and code that answers it."""

    package: str
    name: str
    summary: str
    """What the service does, to be read after "a service that", such as ``adds two integers``."""
    request: SectionPayload
    """Filled by the client: ``request``; ``self.count`` is the number of requests so far."""
    response: SectionPayload
    """Filled by the server from ``request``: ``response``; the checks may use both.
    ``self.count`` is the number of requests answered so far."""
    service: str = ""
    """The name of the service, if ``name`` is another one."""

    @property
    def type(self) -> str:
        """The full name, as ``ros2 service type`` shows it."""
        return f"{self.package}/srv/{self.service or self.name}"

    @property
    def usual_name(self) -> str:
        """The usual name of a service of the type."""
        return header_name(self.service or self.name)

    @property
    def import_line(self) -> str:
        """The import of the service alone."""
        return _import(f"{self.package}.srv", self.service, self.name)

    @property
    def class_names(self) -> tuple[str, ...]:
        """What the imports call the interfaces: a node's class has another name."""
        return _class_names((self.import_line, *self.request.imports, *self.response.imports))

    @property
    def packages(self) -> tuple[str, ...]:
        """All interface packages that server and client need, in alphabetical order."""
        return _union([(self.package,), self.request.packages, self.response.packages])


class ActionPayload(NamedTuple):
    """Code that fills the goal of an action, and code that executes it.

    A server accepts a ``goal`` unless ``refused``, runs the statements of ``start`` once, then
    those of ``feedback`` for each ``step`` in ``steps`` and publishes it, and at the end those
    of ``result``::

        feedback = Fibonacci.Feedback()
        feedback.sequence = [0, 1]              # start
        for step in range(1, goal.order):       # steps
            ...                                 # feedback.statements
            goal_handle.publish_feedback(feedback)
        result = Fibonacci.Result()
        result.sequence = feedback.sequence     # result.statements
    """

    package: str
    name: str
    summary: str
    """What the action does, to be read after "an action that", such as ``computes ...``."""
    goal: SectionPayload
    """Filled by the client: ``goal``; ``self.count`` is the number of goals so far."""
    refused: str
    """An expression that is true for an invalid ``goal``; empty if all are valid."""
    start: tuple[str, ...]
    """Lines that prepare ``feedback`` from ``goal`` before the first step."""
    steps: str
    """What the server loops over, such as ``range(1, goal.order)``; it may use ``goal``."""
    feedback: SectionPayload
    """Filled by the server at each step: ``feedback``, from ``goal`` and the number ``step``."""
    result: SectionPayload
    """Filled by the server at the end: ``result``, from ``goal`` and ``feedback``; the checks
    may use ``goal`` and ``result``."""
    action: str = ""
    """The name of the action, if ``name`` is another one."""

    @property
    def frame(self) -> str:
        """The frame of the feedback, or of the result if only that has one."""
        return (self.feedback if self.feedback.is_stamped else self.result).frame

    @property
    def type(self) -> str:
        """The full name, as ``ros2 action type`` shows it."""
        return f"{self.package}/action/{self.action or self.name}"

    @property
    def usual_name(self) -> str:
        """The usual name of an action of the type."""
        return header_name(self.action or self.name)

    @property
    def import_line(self) -> str:
        """The import of the action alone."""
        return _import(f"{self.package}.action", self.action, self.name)

    @property
    def class_names(self) -> tuple[str, ...]:
        """What the imports call the interfaces: a node's class has another name."""
        sections = (self.goal, self.feedback, self.result)
        return _class_names(
            (self.import_line, *(line for section in sections for line in section.imports))
        )

    @property
    def packages(self) -> tuple[str, ...]:
        """All interface packages that server and client need, in alphabetical order."""
        sections = (self.goal, self.feedback, self.result)
        return _union([(self.package,), *(section.packages for section in sections)])


def _constants(statements: Iterable[str]) -> dict[str, Any]:
    """Return the fields set to constants by statements such as ``goal.order = 10``."""
    fields: dict[str, Any] = {}
    for statement in statements:
        match = re.match(r"\w+\.([a-z][\w.]*) = (.+?)(?:  # .*)?$", statement)
        if match is None:
            continue
        try:
            value = ast.literal_eval(match[2])
        except (ValueError, SyntaxError):
            continue
        *way, last = match[1].split(".")
        inner = fields
        for name in way:
            inner = inner.setdefault(name, {})
        inner[last] = value
    return fields


def _yaml(value: object) -> str:
    """Return a value as YAML on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{name}: {_yaml(item)}" for name, item in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_yaml, value)) + "]"
    return json.dumps(value) if isinstance(value, bool | int | float | str) else str(value)


def _import(module: str, interface: str, name: str) -> str:
    """Return the import of an interface, with an alias if its name in code differs."""
    return f"from {module} import " + (f"{interface} as {name}" if interface else name)


def _needed(imports: Iterable[str], checks: Iterable[str]) -> tuple[str, ...]:
    """Return imports of the names used by expressions, one name each."""
    imports = [*imports, "import struct", "import time"]
    used = set(re.findall(r"(?<![.\w'])[A-Za-z]\w*", " ".join(checks)))
    parts = (line.partition("import ") for line in imports)
    return tuple(
        f"{head}{word}{name}"
        for head, word, names in parts
        for name in names.split(", ")
        if name.rpartition(" as ")[2] in used
    )


def _class_names(imports: Iterable[str]) -> tuple[str, ...]:
    words = re.findall(r"\w+", " ".join(imports))
    return tuple(dict.fromkeys(word for word in words if word[0].isupper()))


def _union(groups: Iterable[tuple[str, ...]]) -> tuple[str, ...]:
    return tuple(sorted({name for group in groups for name in group}))


def _process(received: Payload, published: Payload) -> Process | None:
    """Return how to compute messages of one type from those of another; ``None`` if unknown."""
    process = PROCESSES.get((_short(received.type), _short(published.type)))
    return process or _of_values(received, published)


def _short(full_name: str) -> str:
    return full_name.replace("/msg/", "/")


def _of_values(received: Payload, published: Payload) -> Process | None:
    """Return how to compute the value of a std_msgs message from any other message."""
    package, name = published.package, published.message or published.name
    if package != "std_msgs" or received.type == published.type:
        return None
    if name == "String" and "{" in received.log_received:
        text = re.sub(r"\bmsg\b", "received", received.log_received)
        item = re.sub(r"\bmsg\b", "item", received.log_received)
        return Process(
            "the received value as text",
            f"msg.data = f'{text}'",
            f"message.data == f'{item}'",
        )
    kind = name.lower()
    is_value = received.package == "std_msgs" and _is_number(received.message or received.name)
    if kind in FLOATS and is_value:
        return Process(
            "the number received as a float",
            "msg.data = float(received.data)",
            "message.data == pytest.approx(item.data)",
        )
    return None


def _is_number(name: str) -> bool:
    return name.lower() in {*FLOATS, *INTEGER_RANGES} - {"byte", "char"}
