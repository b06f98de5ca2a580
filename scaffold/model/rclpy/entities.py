"""The entities that rclpy code creates: publishers, timers, parameters and others."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeVar

from scaffold.model.python.evaluation.values import Unknown
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.python.module import PythonModule
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.nodes import NodeDefinition
    from scaffold.model.rclpy.parameters.declarations import Declaration
    from scaffold.model.rclpy.parameters.descriptors import Descriptor
    from scaffold.model.rclpy.topics.qos import Qos
    from scaffold.source import Location


class Argument(NamedTuple):
    """An argument of a call, by the name of its parameter."""

    name: str
    node: ast.expr
    value: object
    """The value; ``UNKNOWN`` if not constant."""
    location: Location


class Callback(NamedTuple):
    """An expression passed as a callback."""

    node: ast.expr | FunctionNode
    """The expression; the definition if a base class in another file passes the method."""
    name: str | None
    """The name of the method or function; ``None`` for a lambda or if unknown."""
    function: FunctionNode | ast.Lambda | None
    """Its definition, if it is in the same file."""
    module: PythonModule
    """The file that passes it."""
    is_called: bool
    """Whether it is called instead of passed: ``self.on_timer()``."""
    is_bound: bool
    """Whether it is a bound method, called without ``self``."""
    is_partial: bool = False
    """Whether it is wrapped in ``functools.partial``, with some arguments given."""

    @property
    def location(self) -> Location:
        """The location of the passed expression."""
        return self.module.location(self.node)


class Created(NamedTuple):
    """The common fields of all objects created by a call."""

    call: ast.Call
    location: Location
    """The whole call."""
    owner: NodeDefinition | None
    """The node that creates it, if known."""
    attribute: str | None
    """The attribute of ``self`` that stores it."""
    variable: str | None
    """The variable that stores it."""
    function: FunctionNode | None
    """The function that creates it."""
    arguments: Mapping[str, Argument]
    """Given arguments by the name of the parameter."""
    has_unknown_arguments: bool
    """There is a ``*`` or ``**``: more arguments may be given."""
    is_conditional: bool
    """Whether it is created under a condition or in a loop."""


class Entity:
    """An object created by a node."""

    def __init__(self, created: Created) -> None:
        self.created = created
        self.call = created.call
        self.location = created.location
        self.owner = created.owner
        self.attribute = created.attribute
        self.variable = created.variable
        self.function = created.function
        self.arguments = created.arguments
        self.has_unknown_arguments = created.has_unknown_arguments
        self.is_conditional = created.is_conditional

    def argument(self, name: str) -> Argument | None:
        """Return an argument by the name of its parameter."""
        return self.arguments.get(name)


AnyEntity = TypeVar("AnyEntity", bound=Entity)


class Endpoint(Entity):
    """An entity with a name and an interface type: a publisher, a service and so on."""

    type_parameter = "msg_type"
    name_parameter = "topic"

    def __init__(
        self,
        created: Created,
        *,
        interface: str | None,
        name: str | Unknown,
        from_parameters: frozenset[str] = frozenset(),
        qos: Qos | None = None,
        callback: Callback | None = None,
    ) -> None:
        super().__init__(created)
        self.interface = interface
        """``std_msgs/msg/String``; ``None`` if that is unknown."""
        self.name = name
        """The name as written, neither expanded nor remapped."""
        self.from_parameters = from_parameters
        """The parameters whose defaults give the name."""
        self.qos = qos
        """The quality of service; ``None`` if not given."""
        self.callback = callback

    @property
    def from_parameter(self) -> str | None:
        """The only parameter whose default is the name."""
        return next(iter(self.from_parameters)) if len(self.from_parameters) == 1 else None

    @property
    def type_argument(self) -> Argument | None:
        """The argument that is the interface type."""
        return self.argument(self.type_parameter)

    @property
    def name_argument(self) -> Argument | None:
        """The argument that is the name."""
        return self.argument(self.name_parameter)


class Publisher(Endpoint):
    """``create_publisher``."""

    is_lifecycle = False

    @property
    def message_type(self) -> str | None:
        """``std_msgs/msg/String``; ``None`` if that is unknown."""
        return self.interface

    @property
    def topic(self) -> str | Unknown:
        """The topic as written."""
        return self.name


class Subscription(Endpoint):
    """``create_subscription``."""

    @property
    def message_type(self) -> str | None:
        """``std_msgs/msg/String``; ``None`` if that is unknown."""
        return self.interface

    @property
    def topic(self) -> str | Unknown:
        """The topic as written."""
        return self.name


class Synchronizer(Entity):
    """``message_filters.TimeSynchronizer(...)``, or its approximate kind."""

    def __init__(
        self,
        created: Created,
        *,
        inputs: Sequence[Endpoint | None] | None,
        callbacks: Sequence[Callback],
    ) -> None:
        super().__init__(created)
        self.inputs = inputs
        """The inputs, ``None`` for unknown subscriptions; ``None`` if unknown."""
        self.callbacks = callbacks
        """The callbacks passed to ``registerCallback``."""


class Service(Endpoint):
    """``create_service``."""

    type_parameter = "srv_type"
    name_parameter = "srv_name"


class Client(Endpoint):
    """``create_client``."""

    type_parameter = "srv_type"
    name_parameter = "srv_name"


class ActionServer(Endpoint):
    """``ActionServer(...)``; the callback is the one that executes goals."""

    type_parameter = "action_type"
    name_parameter = "action_name"


class ActionClient(Endpoint):
    """``ActionClient(...)``."""

    type_parameter = "action_type"
    name_parameter = "action_name"


class Timer(Entity):
    """``create_timer``."""

    def __init__(
        self,
        created: Created,
        *,
        period: float | Unknown,
        from_parameters: frozenset[str],
        callback: Callback | None,
    ) -> None:
        super().__init__(created)
        self.period = period
        """In seconds."""
        self.from_parameters = from_parameters
        """The parameters whose defaults give the period."""
        self.callback = callback


class Parameter(Entity):
    """``declare_parameter``, or one entry of ``declare_parameters``."""

    def __init__(
        self,
        created: Created,
        given: Declaration,
        *,
        name: str | Unknown,
        name_location: Location,
        default: object,
        declared_type: str | None,
        descriptor: Descriptor | None,
    ) -> None:
        super().__init__(created)
        self.name = name
        """The name, with the namespace of ``declare_parameters``."""
        self.name_node = given.name
        self.name_location = name_location
        self.default = default
        """The value; ``UNKNOWN`` also if none is given."""
        self.default_node = given.value
        """The expression of the default; ``None`` if not given."""
        self.declared_type = declared_type
        """The type, if given instead of a default: ``Parameter.Type.DOUBLE``."""
        self.descriptor_node = given.descriptor
        """The expression of the descriptor; ``None`` if not given."""
        self.descriptor = descriptor
        """The descriptor; ``None`` if unknown."""

    @property
    def type(self) -> str | None:
        """The ROS type: ``double``, ``string_array`` ...; ``None`` if that is unknown.

        An empty list is a ``byte_array`` for rclpy.
        """
        return self.declared_type or parameter_type(self.default)


class ParameterRead(Entity):
    """``get_parameter``, ``get_parameter_or``, ``has_parameter`` ..."""

    def __init__(self, created: Created, *, method: str, name: str | Unknown) -> None:
        super().__init__(created)
        self.method = method
        self.name = name


_SCALARS: Mapping[type, str] = {bool: "bool", int: "integer", float: "double", str: "string"}


def parameter_type(value: object) -> str | None:
    """Return the ROS type of a parameter value for rclpy."""
    if isinstance(value, list | tuple):
        kinds = {_SCALARS.get(type(item)) for item in value}
        if not kinds:
            return "byte_array"
        kind = kinds.pop()
        return f"{kind}_array" if kind and not kinds else None
    return _SCALARS.get(type(value))
