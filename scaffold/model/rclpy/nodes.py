"""The nodes that a file creates: subclasses of Node, and node objects."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.given_arguments import argument_of, given_argument
from scaffold.model.python.evaluation.values import UNKNOWN, Unknown
from scaffold.model.rclpy.entities import (
    ActionClient,
    ActionServer,
    AnyEntity,
    Client,
    Parameter,
    ParameterRead,
    Publisher,
    Service,
    Subscription,
    Timer,
)

if TYPE_CHECKING:
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.file import RclpyFile
    from scaffold.source import Location


def _own_entities(kind: type[AnyEntity]) -> cached_property[Sequence[AnyEntity]]:
    """Return the property of a node with what it creates of a kind, its base classes aside."""
    return cached_property(
        lambda node: [
            item
            for item in node.file.entities
            if item.owner is node and type(item) is kind and isinstance(item, kind)
        ]
    )


class NodeDefinition:
    """A node created by the code: with its own class, or as an object."""

    def __init__(self, file: RclpyFile, name: str, location: Location) -> None:
        self.file = file
        self.name = name
        """Of the class, or of the variable."""
        self.location = location
        self.is_lifecycle = False

    publishers = _own_entities(Publisher)
    """Its publishers, without those of base classes."""
    subscriptions = _own_entities(Subscription)
    """Its subscriptions."""
    services = _own_entities(Service)
    """The services it offers."""
    clients = _own_entities(Client)
    """The services it calls."""
    action_servers = _own_entities(ActionServer)
    """The actions it offers."""
    action_clients = _own_entities(ActionClient)
    """The actions it calls."""
    timers = _own_entities(Timer)
    """Its timers."""
    parameters = _own_entities(Parameter)
    """The parameters it declares."""
    parameter_reads = _own_entities(ParameterRead)
    """Its parameter reads."""
    # -- arguments of its constructor

    @cached_property
    def constructor_call(self) -> ast.Call | None:
        """The call of the constructor of rclpy's Node."""
        return None

    @cached_property
    def node_name_node(self) -> ast.expr | None:
        """The expression that is the node's name."""
        return self._constructor_argument("node_name", 0)

    @cached_property
    def node_name(self) -> str | Unknown:
        """The name given to rclpy's Node; remapping may change it."""
        return self.file.evaluator.text(self.node_name_node)

    @cached_property
    def node_name_location(self) -> Location:
        """The location of the node's name, or of the node without one."""
        node = self.node_name_node
        return self.file.module.location(node) if node else self.location

    @cached_property
    def namespace(self) -> str | Unknown | None:
        """The namespace given to rclpy's Node."""
        node = self._constructor_argument("namespace", None)
        return self.file.evaluator.text(node) if node else None

    @cached_property
    def declares_automatically(self) -> bool:
        """Whether undeclared parameters may be used."""
        for name in (
            "allow_undeclared_parameters",
            "automatically_declare_parameters_from_overrides",
        ):
            node = self._constructor_argument(name, None)
            if node is not None and self.file.evaluator.evaluate(node) is not False:
                return True
        call = self.constructor_call
        return call is not None and any(word.arg is None for word in call.keywords)

    @cached_property
    def is_declared_by_overrides(self) -> bool:
        """Whether rclpy certainly declares each parameter override."""
        node = self._constructor_argument("automatically_declare_parameters_from_overrides", None)
        return node is not None and self.file.evaluator.evaluate(node) is True

    def _constructor_argument(self, name: str, position: int | None) -> ast.expr | None:
        call = self.constructor_call
        return argument_of(call, name, position) if call is not None else None


class NodeObject(NodeDefinition):
    """A node without its own class: ``node = rclpy.create_node('talker')``."""

    def __init__(self, file: RclpyFile, name: str, location: Location, call: ast.Call) -> None:
        super().__init__(file, name, location)
        self._call = call

    @cached_property
    def constructor_call(self) -> ast.Call | None:
        """The call that creates it."""
        return self._call


class NodeClass(NodeDefinition):
    """A class that inherits from rclpy's Node; its location is its name."""

    def __init__(self, file: RclpyFile, node: ast.ClassDef, base: NodeClass | None) -> None:
        super().__init__(file, node.name, file.module.name_location(node))
        self.node = node
        self.base = base
        """The base class, if that is a node class of the same package."""
        self.depth: int = base.depth + 1 if base else 1
        """The number of classes between it and rclpy's Node."""
        self.base_index = 0
        """The index of the base class that makes it a node."""

    @cached_property
    def methods(self) -> Mapping[str, FunctionNode]:
        """The methods it defines itself, the last of a name."""
        result: dict[str, FunctionNode] = {}
        for name, bindings in self.file.module.index.bindings(self.node).items():
            for binding in bindings:
                if isinstance(binding.node, ast.FunctionDef | ast.AsyncFunctionDef):
                    result[name] = binding.node
        return result

    def method(self, name: str) -> FunctionNode | None:
        """Return a method, also of a base class in the same file."""
        owner: NodeClass | None = self
        while owner is not None and owner.file is self.file:
            if name in owner.methods:
                return owner.methods[name]
            owner = owner.base
        return None

    @cached_property
    def constructor(self) -> FunctionNode | None:
        """Its own ``__init__``."""
        return self.methods.get("__init__")

    @cached_property
    def super_init(self) -> ast.Call | None:
        """The call of ``super().__init__`` or ``Node.__init__`` in its constructor.

        Else the first call of any ``__init__``: it may be a class that calls Node's.
        """
        if self.constructor is None:
            return None
        others: list[ast.Call] = []
        for call in self.file.calls_in(self.constructor):
            if isinstance(call.func, ast.Attribute) and call.func.attr == "__init__":
                if _is_super(call) or self._is_base(call.func.value):
                    return call
                others.append(call)
        return others[0] if others else None

    def _is_base(self, node: ast.expr) -> bool:
        class_ = self.file.evaluator.named_class(node)
        is_own = self.base is not None and class_ is self.base.node
        return is_own or self.file.is_node_class(node)

    @property
    def calls_super_init(self) -> bool:
        """Whether the constructor of the base class is run, also by inheritance."""
        return self.constructor is None or self.super_init is not None

    @cached_property
    def is_made_later(self) -> bool:
        """Whether a method other than the constructor calls that of the base class."""
        for name, method in self.methods.items():
            for call in self.file.calls_in(method) if name != "__init__" else ():
                match call.func:
                    case ast.Attribute(attr="__init__", value=value):
                        if _is_super(call) or self._is_base(value):
                            return True
        return False

    @cached_property
    def constructor_call(self) -> ast.Call | None:
        """The call of the base class's constructor, without the ``self`` of ``Node.__init__``."""
        call = self.super_init
        if call is None:
            return None
        if _is_super(call):
            return call if self._comes_first else None
        return ast.Call(func=call.func, args=call.args[1:], keywords=call.keywords)

    @property
    def _comes_first(self) -> bool:
        """Whether ``super().__init__`` is the constructor of the node, not of a mixin."""
        for base in self.node.bases[: self.base_index]:
            class_ = self.file.evaluator.named_class(base)
            if class_ is None or "__init__" in self.file.module.index.bindings(class_):
                return False
        return True

    @cached_property
    def node_name(self) -> str | Unknown:
        """The name given to rclpy's Node, by this class or by all code that instantiates it."""
        if self.constructor is None:
            return self.base.node_name if self.base else UNKNOWN
        node, file = self.name_given(None, self.file)
        return file.evaluator.text(node)

    def name_given(
        self, call: ast.Call | None, caller: RclpyFile
    ) -> tuple[ast.expr | None, RclpyFile]:
        """Return the expression of the node name if ``call`` reaches the constructor."""
        constructor = self.constructor
        if constructor is None:
            if self.base is not None:
                return self.base.name_given(call, caller)
            return (call.args[0] if call and call.args else None), caller
        node, file = self.node_name_node, self.file
        inner = self.constructor_call
        if self.base is not None:
            node, file = self.base.name_given(inner, self.file) if inner else (None, file)
        parameter = file.parameter_of(node) if file is self.file else None
        if call is None or parameter is None:
            return node, file
        return given_argument(constructor, call, parameter, is_method=True), caller


def _is_super(call: ast.Call) -> bool:
    match call.func:
        case ast.Attribute(value=ast.Call(func=ast.Name(id="super"))):
            return True
        case _:
            return False
