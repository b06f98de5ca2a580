"""What the rclpy code of a Python file says: nodes, what they create, how they are run."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import Protocol

from scaffold.errors import ViewError
from scaffold.model.node_entities import (
    ActionClient,
    ActionServer,
    Argument,
    Callback,
    Client,
    Created,
    Endpoint,
    Entity,
    Parameter,
    ParameterRead,
    Publisher,
    RclpyCall,
    Service,
    Subscription,
    Timer,
)
from scaffold.model.node_values import NOTE, NodeEvaluator, given_argument
from scaffold.model.python_module import PythonModule
from scaffold.model.scopes import FunctionNode
from scaffold.model.source import Location
from scaffold.model.values import UNKNOWN, Unknown

NODE_CLASSES = frozenset(
    {"rclpy.node.Node", "rclpy.Node", "rclpy.create_node"}
    | {"rclpy.lifecycle.LifecycleNode", "rclpy.lifecycle.Node"}
    | {"rclpy.lifecycle.node.LifecycleNode"}
)

_QOS = ("msg_type", "topic", "qos_profile")
_SIGNATURES: Mapping[str, tuple[str, ...]] = {
    "create_publisher": _QOS,
    "create_lifecycle_publisher": _QOS,
    "create_subscription": ("msg_type", "topic", "callback", "qos_profile"),
    "create_service": ("srv_type", "srv_name", "callback"),
    "create_client": ("srv_type", "srv_name"),
    "create_timer": ("timer_period_sec", "callback", "callback_group", "clock", "autostart"),
    "declare_parameter": ("name", "value", "descriptor", "ignore_override"),
    "declare_parameters": ("namespace", "parameters", "ignore_override"),
    "get_parameter": ("name",),
    "get_parameter_or": ("name", "alternative_value"),
    "has_parameter": ("name",),
    "get_parameter_type": ("name",),
    "ActionServer": ("node", "action_type", "action_name", "execute_callback"),
    "ActionClient": ("node", "action_type", "action_name"),
}
_DECLARES = frozenset({"declare_parameter", "declare_parameters"})
_READS = frozenset({"get_parameter", "get_parameter_or", "has_parameter", "get_parameter_type"})
_ENDPOINTS: Mapping[str, type[Endpoint]] = {
    "create_publisher": Publisher,
    "create_lifecycle_publisher": Publisher,
    "create_subscription": Subscription,
    "create_service": Service,
    "create_client": Client,
    "ActionServer": ActionServer,
    "ActionClient": ActionClient,
}
_ACTIONS = {
    f"rclpy.action.{module}{kind}": kind
    for kind in ("ActionServer", "ActionClient")
    for module in ("", "server.", "client.")
}
_RUNS = frozenset({"init", "spin", "spin_once", "spin_until_future_complete"})
_RUNS |= {"shutdown", "try_shutdown"}
_EXECUTORS = frozenset(
    f"rclpy.executors.{kind}Executor" for kind in ("SingleThreaded", "MultiThreaded")
) | {"rclpy.experimental.EventsExecutor"}
_MAX_BASES = 8


class Modules(Protocol):
    """Where the other modules of a package come from; a ``Package`` is one."""

    def has(self, path: str) -> bool:
        """Tell whether a file exists."""

    def module(self, path: str) -> PythonModule:
        """Return a parsed Python file; raises ViewError."""

    def node_facts(self, path: str) -> NodeFacts:
        """Return what the rclpy code of a file says; raises ViewError."""


class NodeOwner:
    """A node as the code makes it: of a class of its own, or an object."""

    def __init__(self, facts: NodeFacts, name: str, location: Location) -> None:
        self.facts = facts
        self.name = name
        """Of the class, or of the variable."""
        self.location = location
        self.is_lifecycle = False

    def _own(self, kind: type[Entity]) -> list[Entity]:
        return [item for item in self.facts.entities if item.owner is self and type(item) is kind]

    @cached_property
    def publishers(self) -> Sequence[Publisher]:
        """What it publishes, those of base classes not included."""
        return [item for item in self._own(Publisher) if isinstance(item, Publisher)]

    @cached_property
    def subscriptions(self) -> Sequence[Subscription]:
        """What it subscribes to."""
        return [item for item in self._own(Subscription) if isinstance(item, Subscription)]

    @cached_property
    def services(self) -> Sequence[Service]:
        """The services it offers."""
        return [item for item in self._own(Service) if isinstance(item, Service)]

    @cached_property
    def clients(self) -> Sequence[Client]:
        """The services it calls."""
        return [item for item in self._own(Client) if isinstance(item, Client)]

    @cached_property
    def action_servers(self) -> Sequence[ActionServer]:
        """The actions it offers."""
        return [item for item in self._own(ActionServer) if isinstance(item, ActionServer)]

    @cached_property
    def action_clients(self) -> Sequence[ActionClient]:
        """The actions it calls."""
        return [item for item in self._own(ActionClient) if isinstance(item, ActionClient)]

    @cached_property
    def timers(self) -> Sequence[Timer]:
        """Its timers."""
        return [item for item in self._own(Timer) if isinstance(item, Timer)]

    @cached_property
    def parameters(self) -> Sequence[Parameter]:
        """The parameters it declares."""
        return [item for item in self._own(Parameter) if isinstance(item, Parameter)]

    @cached_property
    def parameter_reads(self) -> Sequence[ParameterRead]:
        """Where it reads parameters."""
        return [item for item in self._own(ParameterRead) if isinstance(item, ParameterRead)]

    # -- what its constructor is given

    @cached_property
    def constructor_call(self) -> ast.Call | None:
        """The call that reaches the constructor of rclpy's Node."""
        return None

    @cached_property
    def node_name_node(self) -> ast.expr | None:
        """The expression that is the node's name."""
        return self._constructor_argument("node_name", 0)

    @cached_property
    def node_name(self) -> str | Unknown:
        """The name given to rclpy's Node; remapping may change it."""
        return self.facts.evaluator.text(self.node_name_node)

    @cached_property
    def node_name_location(self) -> Location:
        """The place of the node's name; without one, of the node."""
        node = self.node_name_node
        return self.facts.module.location(node) if node else self.location

    @cached_property
    def namespace(self) -> str | Unknown | None:
        """The namespace given to rclpy's Node."""
        node = self._constructor_argument("namespace", None)
        return self.facts.evaluator.text(node) if node else None

    @cached_property
    def declares_automatically(self) -> bool:
        """Whether parameters may be used that nobody declares here."""
        for name in (
            "allow_undeclared_parameters",
            "automatically_declare_parameters_from_overrides",
        ):
            node = self._constructor_argument(name, None)
            if node is not None and self.facts.evaluator.evaluate(node) is not False:
                return True
        call = self.constructor_call
        return call is not None and any(word.arg is None for word in call.keywords)

    def _constructor_argument(self, name: str, position: int | None) -> ast.expr | None:
        call = self.constructor_call
        if call is None:
            return None
        for word in call.keywords:
            if word.arg == name:
                return word.value
        args = call.args
        if position is not None and len(args) > position:
            given = args[: position + 1]
            return None if any(isinstance(arg, ast.Starred) for arg in given) else args[position]
        return None


class NodeObject(NodeOwner):
    """A node without a class of its own: ``node = rclpy.create_node('talker')``."""

    def __init__(self, facts: NodeFacts, name: str, location: Location, call: ast.Call) -> None:
        super().__init__(facts, name, location)
        self._call = call

    @cached_property
    def constructor_call(self) -> ast.Call | None:
        """The call that makes it."""
        return self._call


class NodeClass(NodeOwner):
    """A class that inherits from rclpy's Node; its location is its name."""

    def __init__(self, facts: NodeFacts, node: ast.ClassDef, base: NodeClass | None) -> None:
        super().__init__(facts, node.name, facts.module.name_location(node))
        self.node = node
        self.base = base
        """The base class, if that is a node class of the same package."""

    @cached_property
    def methods(self) -> Mapping[str, FunctionNode]:
        """The methods it defines itself, the last of a name."""
        found: dict[str, FunctionNode] = {}
        for name, bindings in self.facts.module.index.bindings(self.node).items():
            for binding in bindings:
                if isinstance(binding.node, ast.FunctionDef | ast.AsyncFunctionDef):
                    found[name] = binding.node
        return found

    def method(self, name: str) -> FunctionNode | None:
        """Return a method, also of a base class in the same file."""
        owner: NodeClass | None = self
        while owner is not None and owner.facts is self.facts:
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
        """The first call of ``super().__init__`` or ``Node.__init__`` in its constructor."""
        if self.constructor is None:
            return None
        for call in self.facts.calls_in(self.constructor):
            if isinstance(call.func, ast.Attribute) and call.func.attr == "__init__":
                return call
        return None

    @property
    def calls_super_init(self) -> bool:
        """Whether the base class's constructor is run; so without an own constructor."""
        return self.constructor is None or self.super_init is not None

    @cached_property
    def constructor_call(self) -> ast.Call | None:
        """The call of the base class's constructor, without the ``self`` of ``Node.__init__``."""
        call = self.super_init
        if call is None:
            return None
        match call.func:
            case ast.Attribute(value=ast.Call(func=ast.Name(id="super"))):
                return call
            case _:
                return ast.Call(func=call.func, args=call.args[1:], keywords=call.keywords)

    @cached_property
    def node_name(self) -> str | Unknown:
        """The name given to rclpy's Node, by this class or by all that make objects of it."""
        if self.constructor is None:
            return self.base.node_name if self.base else UNKNOWN
        node, facts = self._name_given(None, self.facts)
        return facts.evaluator.text(node)

    def _name_given(
        self, call: ast.Call | None, caller: NodeFacts
    ) -> tuple[ast.expr | None, NodeFacts]:
        """Return the expression that names the node when ``call`` reaches the constructor."""
        constructor = self.constructor
        if constructor is None:
            if self.base is not None:
                return self.base._name_given(call, caller)
            return (call.args[0] if call and call.args else None), caller
        node, facts = self.node_name_node, self.facts
        inner = self.constructor_call
        if self.base is not None:
            node, facts = self.base._name_given(inner, self.facts) if inner else (None, facts)
        parameter = facts.parameter_of(node) if facts is self.facts else None
        if call is None or parameter is None:
            return node, facts
        return given_argument(constructor, call, parameter, is_method=True), caller


class NodeFacts:
    """Everything that the rclpy code of one file says."""

    def __init__(self, module: PythonModule, modules: Modules | None = None) -> None:
        self.module = module
        self._modules = modules
        self.evaluator = NodeEvaluator(module, self._default_of, self.related_classes)
        self._indexing_parameters = False

    @classmethod
    def of(cls, module: PythonModule, modules: Modules | None = None) -> NodeFacts:
        """Return the view of a parsed file; base classes are looked up in ``modules``."""
        return cls(module, modules)

    @cached_property
    def uses_rclpy(self) -> bool:
        """Whether the file imports rclpy."""
        return "rclpy" in self.module.imports_by_root

    # -- nodes

    @cached_property
    def classes(self) -> Sequence[NodeClass]:
        """The node classes, in the order of the text."""
        return [
            found
            for node in self.module.walk(ast.ClassDef)
            if (found := self.node_class(node)) is not None
        ]

    @cached_property
    def objects(self) -> Sequence[NodeObject]:
        """The nodes without a class of their own, in the order of the text."""
        found: list[NodeObject] = []
        for call in self.module.walk(ast.Call):
            if NODE_CLASSES.isdisjoint(self.module.qualified_names(call.func)):
                continue
            attribute, variable = self._target(call)
            name = variable or attribute or ""
            item = NodeObject(self, name, self.module.location(call.func), call)
            item.is_lifecycle = "ifecycle" in (self.module.qualified_name(call.func) or "")
            found.append(item)
        return found

    @property
    def nodes(self) -> Sequence[NodeOwner]:
        """Node classes, then objects."""
        return [*self.classes, *self.objects]

    @cached_property
    def _classes_by_node(self) -> dict[ast.ClassDef, NodeClass | None]:
        return {}

    def node_class(self, node: ast.ClassDef) -> NodeClass | None:
        """Return the view of a class if it inherits from rclpy's Node."""
        known = self._classes_by_node
        if node not in known:
            known[node] = None  # ends the recursion of a class that inherits from itself
            known[node] = self._new_node_class(node)
        return known[node]

    def _new_node_class(self, node: ast.ClassDef) -> NodeClass | None:
        for expression in node.bases:
            names = self.module.qualified_names(expression)
            if not NODE_CLASSES.isdisjoint(names):
                found = NodeClass(self, node, None)
                found.is_lifecycle = any("ifecycle" in name for name in names)
                return found
            base = self._base_class(expression, names)
            if base is not None:
                found = NodeClass(self, node, base)
                found.is_lifecycle = base.is_lifecycle
                return found
        return None

    def _base_class(self, expression: ast.expr, names: frozenset[str]) -> NodeClass | None:
        if not names and isinstance(expression, ast.Name):
            found = self.module.index.lookup(expression.id, expression)
            nodes = [binding.node for binding in found[1]] if found else []
            if len(nodes) == 1 and isinstance(nodes[0], ast.ClassDef):
                return self.node_class(nodes[0])
        for name in names:
            module, _, class_name = name.rpartition(".")
            facts = self._facts_of(module)
            found_class = facts.module.classes.get(class_name) if facts else None
            if facts and found_class:
                return facts.node_class(found_class.node)
        return None

    def _facts_of(self, module: str) -> NodeFacts | None:
        """Return the facts of another module of the package."""
        if self._modules is None or not module:
            return None
        for path in _module_paths(self.module.path, module):
            if path != self.module.path and self._modules.has(path):
                try:
                    return self._modules.node_facts(path)
                except ViewError:
                    return None
        return None

    def related_classes(self, node: ast.ClassDef) -> Sequence[ast.ClassDef]:
        """Return a class with the bases and direct descendants it has in the file."""
        related = [node]
        bases = self._local_bases
        pending = [node]
        while pending:
            for base in bases.get(pending.pop(), ()):
                if base not in related:
                    related.append(base)
                    pending.append(base)
        for other in self.module.walk(ast.ClassDef):
            if other not in related and node in bases.get(other, ()):
                related.append(other)
        return related

    @cached_property
    def _local_bases(self) -> Mapping[ast.ClassDef, Sequence[ast.ClassDef]]:
        found: dict[ast.ClassDef, list[ast.ClassDef]] = {}
        for node in self.module.walk(ast.ClassDef):
            for expression in node.bases:
                if isinstance(expression, ast.Name):
                    bound = self.module.index.lookup(expression.id, expression)
                    for binding in bound[1] if bound else ():
                        if isinstance(binding.node, ast.ClassDef):
                            found.setdefault(node, []).append(binding.node)
        return found

    def owner_of(self, node: ast.expr) -> NodeOwner | None:
        """Return the node that an expression such as ``self`` stands for."""
        class_ = self.evaluator.self_class(node)
        if class_ is not None:
            return self.node_class(class_)
        call = self.evaluator.single_value(node)
        if isinstance(call, ast.Call):
            for item in self.objects:
                if item.constructor_call is call:
                    return item
            return self._base_class(call.func, self.module.qualified_names(call.func))
        return None

    def parameter_of(self, node: ast.expr | None) -> ast.arg | None:
        """Return the function parameter that an expression is the name of."""
        if isinstance(node, ast.Name):
            found = self.module.index.lookup(node.id, node)
            if found and len(found[1]) == 1 and isinstance(found[1][0].node, ast.arg):
                return found[1][0].node
        return None

    # -- what is created

    @cached_property
    def entities(self) -> Sequence[Entity]:
        """Everything created, in the order of the text."""
        found: list[Entity] = []
        for call in self.module.walk(ast.Call):
            method = self._creating_method(call)
            if method is not None:
                found.extend(self._created_by(call, method))
        return found

    @cached_property
    def publishers(self) -> Sequence[Publisher]:
        """All publishers, also those of nodes that are not known."""
        return [item for item in self.entities if isinstance(item, Publisher)]

    @cached_property
    def subscriptions(self) -> Sequence[Subscription]:
        """All subscriptions."""
        return [item for item in self.entities if isinstance(item, Subscription)]

    @cached_property
    def services(self) -> Sequence[Service]:
        """All services."""
        return [item for item in self.entities if isinstance(item, Service)]

    @cached_property
    def clients(self) -> Sequence[Client]:
        """All service clients."""
        return [item for item in self.entities if isinstance(item, Client)]

    @cached_property
    def action_servers(self) -> Sequence[ActionServer]:
        """All action servers."""
        return [item for item in self.entities if isinstance(item, ActionServer)]

    @cached_property
    def action_clients(self) -> Sequence[ActionClient]:
        """All action clients."""
        return [item for item in self.entities if isinstance(item, ActionClient)]

    @cached_property
    def endpoints(self) -> Sequence[Endpoint]:
        """Publishers, subscriptions, services, clients, action servers and clients."""
        return [item for item in self.entities if isinstance(item, Endpoint)]

    @cached_property
    def timers(self) -> Sequence[Timer]:
        """All timers."""
        return [item for item in self.entities if isinstance(item, Timer)]

    @cached_property
    def parameters(self) -> Sequence[Parameter]:
        """All declared parameters."""
        return [item for item in self.entities if isinstance(item, Parameter)]

    @cached_property
    def parameter_reads(self) -> Sequence[ParameterRead]:
        """All places where parameters are read by name."""
        return [item for item in self.entities if isinstance(item, ParameterRead)]

    def _creating_method(self, call: ast.Call) -> str | None:
        func = call.func
        if isinstance(func, ast.Attribute) and func.attr in _SIGNATURES and func.attr[0].islower():
            if not NODE_CLASSES.isdisjoint(self.module.qualified_names(func.value)):
                return None  # Node.create_publisher(self, ...): an override passes on its own
            is_known = self.uses_rclpy or self.owner_of(func.value) is not None
            return func.attr if is_known else None
        for name in self.module.qualified_names(call.func):
            if name in _ACTIONS:
                return _ACTIONS[name]
        return None

    def _created_by(self, call: ast.Call, method: str) -> Iterator[Entity]:
        created = self._created(call, method)
        evaluator = self.evaluator
        if method in _ENDPOINTS:
            yield self._endpoint(created, method)
        elif method == "create_timer":
            period = created.arguments.get("timer_period_sec")
            value, notes = evaluator.trace(period.node if period else None)
            yield Timer(
                created,
                period=value if isinstance(value, int | float) else UNKNOWN,
                from_parameters=_parameters_in(notes),
                callback=self._callback_argument(created, "callback"),
            )
        elif method in _READS:
            name = created.arguments.get("name")
            text = evaluator.text(name.node) if name else UNKNOWN
            yield ParameterRead(created, method=method, name=text)
        else:
            yield from self._declared(created, method)

    def _endpoint(self, created: Created, method: str) -> Endpoint:
        kind = _ENDPOINTS[method]
        type_ = created.arguments.get(kind.type_parameter)
        name = created.arguments.get(kind.name_parameter)
        text, notes = self.evaluator.trace(name.node if name else None)
        qos = created.arguments.get("qos_profile")
        parameters = _parameters_in(notes)
        made = kind(
            created,
            interface=self.interface(type_.node) if type_ else None,
            name=text if isinstance(text, str) else UNKNOWN,
            from_parameter=next(iter(parameters)) if len(parameters) == 1 else None,
            qos=self.evaluator.qos(qos.node) if qos else None,
            callback=self._callback_argument(
                created, "execute_callback" if kind is ActionServer else "callback"
            ),
        )
        if isinstance(made, Publisher):
            made.is_lifecycle = method == "create_lifecycle_publisher"
        return made

    def _created(self, call: ast.Call, method: str) -> Created:
        arguments: dict[str, Argument] = {}
        unknown = False
        for parameter, arg in zip(_SIGNATURES[method], call.args, strict=False):
            if isinstance(arg, ast.Starred):
                unknown = True
                break
            arguments[parameter] = self._argument(parameter, arg)
        for word in call.keywords:
            if word.arg is None:
                unknown = True
            else:
                arguments[word.arg] = self._argument(word.arg, word.value)
        attribute, variable = self._target(call)
        if isinstance(call.func, ast.Attribute) and method not in _ACTIONS.values():
            owner = self.owner_of(call.func.value)
        else:
            owner = self.owner_of(arguments["node"].node) if "node" in arguments else None
        return Created(
            call,
            self.module.location(call),
            owner,
            attribute,
            variable,
            self.module.enclosing_function(call),
            arguments,
            unknown,
            self.is_conditional(call),
        )

    def _argument(self, name: str, node: ast.expr) -> Argument:
        return Argument(name, node, self.evaluator.evaluate(node), self.module.location(node))

    def _target(self, call: ast.Call) -> tuple[str | None, str | None]:
        """Return the attribute of ``self`` and the variable that a call's result is stored in."""
        attribute: str | None = None
        variable: str | None = None
        parent = self.module.parent(call)
        targets: Sequence[ast.expr] = ()
        if isinstance(parent, ast.Assign):
            targets = parent.targets
        elif isinstance(parent, ast.AnnAssign | ast.NamedExpr):
            targets = [parent.target]
        for target in targets:
            if isinstance(target, ast.Attribute) and self.evaluator.self_class(target.value):
                attribute = target.attr
            elif isinstance(target, ast.Name):
                variable = target.id
        return attribute, variable

    def interface(self, node: ast.expr) -> str | None:
        """Return the interface type that an expression names: ``std_msgs/msg/String``."""
        name = self.module.qualified_name(self.evaluator.single_value(node))
        parts = name.split(".") if name else []
        kinds = [part for part in parts[1:-1] if part in {"msg", "srv", "action"}]
        if not kinds or not parts[0] or not parts[-1][:1].isupper():
            return None
        return f"{parts[0]}/{kinds[0]}/{parts[-1]}"

    def is_conditional(self, node: ast.AST) -> bool:
        """Tell whether a node stands under a condition or in a loop of its function."""
        for parent in self.module.parents(node):
            if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
                return isinstance(parent, ast.Lambda)
            if isinstance(parent, ast.If | ast.For | ast.While | ast.AsyncFor | ast.IfExp):
                return not (isinstance(parent, ast.If) and parent is self.module.main_guard_node)
            if isinstance(parent, ast.ExceptHandler | ast.match_case | ast.comprehension):
                return True
            if isinstance(parent, ast.ListComp | ast.DictComp | ast.GeneratorExp | ast.SetComp):
                return True
        return False

    # -- callbacks

    def _callback_argument(self, created: Created, name: str) -> Callback | None:
        argument = created.arguments.get(name)
        return self.callback(argument.node) if argument else None

    def callback(self, node: ast.expr) -> Callback:
        """Return what an expression stands for as a callback."""
        at = self.module.location(node)
        if isinstance(node, ast.Call):
            if self.module.qualified_name(node.func) == "functools.partial" and node.args:
                inner = self.callback(node.args[0])
                return inner._replace(node=node, location=at, is_partial=True)
            inner = self.callback(node.func)
            is_called = inner.function is not None and not _returns_function(inner.function)
            return inner._replace(node=node, location=at, is_called=is_called, function=None)
        if isinstance(node, ast.Lambda):
            return Callback(node, None, node, at, is_called=False, is_bound=False)
        if isinstance(node, ast.Attribute):
            owner = self.owner_of(node.value)
            method = owner.method(node.attr) if isinstance(owner, NodeClass) else None
            if method is None:
                class_ = self.evaluator.self_class(node.value)
                method = self._method_of(class_, node.attr) if class_ else None
            is_bound = method is not None and not _is_static_method(method)
            return Callback(node, node.attr, method, at, is_called=False, is_bound=is_bound)
        if isinstance(node, ast.Name):
            found = self.module.index.lookup(node.id, node)
            nodes = [binding.node for binding in found[1]] if found else []
            function = nodes[0] if len(nodes) == 1 else None
            if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
                function = None
            return Callback(node, node.id, function, at, is_called=False, is_bound=False)
        return Callback(node, None, None, at, is_called=False, is_bound=False)

    def _method_of(self, class_: ast.ClassDef, name: str) -> FunctionNode | None:
        for member in self.related_classes(class_):
            for binding in self.module.index.bindings(member).get(name, ()):
                if isinstance(binding.node, ast.FunctionDef | ast.AsyncFunctionDef):
                    return binding.node
        return None

    @cached_property
    def callbacks(self) -> Sequence[tuple[Entity, Callback]]:
        """What the executor calls: callbacks of timers, subscriptions, services and actions."""
        return [
            (entity, entity.callback)
            for entity in self.entities
            if isinstance(entity, Timer | Endpoint) and entity.callback is not None
        ]

    def calls_in(self, function: FunctionNode | ast.Lambda) -> Sequence[ast.Call]:
        """Return the calls in the body of a function, those of functions inside left out."""
        return [call for call in self.module.walk(ast.Call) if self.function_of(call) is function]

    def function_of(self, node: ast.AST) -> FunctionNode | ast.Lambda | None:
        """Return the function whose body a node stands in."""
        child = node
        for parent in self.module.parents(node):
            if isinstance(parent, ast.Lambda):
                return parent
            if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef) and isinstance(
                child, ast.stmt
            ):
                return parent
            child = parent
        return None

    def reached(self, function: FunctionNode | ast.Lambda) -> Sequence[FunctionNode | ast.Lambda]:
        """Return a function and what it calls in the same file: methods of self, functions."""
        found: list[FunctionNode | ast.Lambda] = [function]
        for current in found:
            for call in self.calls_in(current):
                called = self.callback(call.func).function
                if called is not None and called not in found:
                    found.append(called)
        return found

    # -- parameters

    def _declared(self, created: Created, method: str) -> Iterator[Parameter]:
        for prefix, name, value in self._declarations_in(created.call, method):
            yield self._parameter(created, prefix, name, value)

    def _declarations_in(
        self, call: ast.Call, method: str
    ) -> Iterator[tuple[str | Unknown, ast.expr | None, ast.expr | None]]:
        """Yield prefix, name and default of the parameters that a call declares."""
        given = dict(zip(_SIGNATURES[method], call.args, strict=False))
        given.update({word.arg: word.value for word in call.keywords if word.arg})
        if method == "declare_parameter":
            yield "", given.get("name"), given.get("value")
            return
        prefix = self.evaluator.text(given["namespace"]) if "namespace" in given else ""
        listed = given.get("parameters")
        for item in self.evaluator.elements(listed).items if listed else ():
            if isinstance(item.node, ast.Tuple | ast.List) and item.node.elts:
                name, *rest = item.node.elts
                yield prefix, name, rest[0] if rest else None
            else:
                yield UNKNOWN, None, None

    def _full_name(self, prefix: str | Unknown, name: ast.expr | None) -> str | Unknown:
        text = self.evaluator.text(name)
        if text is UNKNOWN or prefix is UNKNOWN:
            return UNKNOWN
        return f"{prefix}.{text}" if prefix else text

    def _parameter(
        self,
        created: Created,
        prefix: str | Unknown,
        name: ast.expr | None,
        value: ast.expr | None,
    ) -> Parameter:
        return Parameter(
            created,
            name=self._full_name(prefix, name),
            name_node=name,
            name_location=self.module.location(name) if name else created.location,
            default=self.evaluator.evaluate(value),
            default_node=value,
        )

    def _default_of(self, receiver: ast.expr, name: str) -> object:
        """Return the default that all declarations of a parameter agree on."""
        owner = self.owner_of(receiver)
        nodes = [
            value
            for declarer, declared, value in self._declarations
            if declared == name and (declarer is owner or owner is None or declarer is None)
        ]
        if not nodes and isinstance(owner, NodeClass) and owner.base is not None:
            base = owner.base
            return UNKNOWN if base.facts is self else base.facts.default_in(base, name)
        values = [self.evaluator.evaluate(node) for node in nodes]
        return values[0] if values and all(value == values[0] for value in values) else UNKNOWN

    def default_in(self, owner: NodeClass, name: str) -> object:
        """Return the default of a parameter that a class declares."""
        values = [item.default for item in owner.parameters if item.name == name]
        return values[0] if len(values) == 1 else UNKNOWN

    @property
    def _declarations(self) -> Sequence[tuple[NodeOwner | None, str, ast.expr | None]]:
        """Owner, name and default of the declared parameters whose names are plain to see."""
        if self._indexing_parameters:
            self.evaluator.cut()
            return ()
        return self._declaration_index

    @cached_property
    def _declaration_index(self) -> Sequence[tuple[NodeOwner | None, str, ast.expr | None]]:
        self._indexing_parameters = True
        found: list[tuple[NodeOwner | None, str, ast.expr | None]] = []
        for call in self.module.walk(ast.Call):
            func = call.func
            if isinstance(func, ast.Attribute) and func.attr in _DECLARES:
                owner = self.owner_of(func.value)
                for prefix, name, value in self._declarations_in(call, func.attr):
                    text = self._full_name(prefix, name)
                    if isinstance(text, str):
                        found.append((owner, text, value))
        self._indexing_parameters = False
        return found

    # -- how it is run

    @cached_property
    def init_calls(self) -> Sequence[RclpyCall]:
        """The calls of ``rclpy.init``."""
        return [call for call in self.rclpy_calls if call.name == "init"]

    @cached_property
    def spin_calls(self) -> Sequence[RclpyCall]:
        """The calls that run callbacks: ``rclpy.spin...``, ``executor.spin...``."""
        return [call for call in self.rclpy_calls if "spin" in call.name]

    @cached_property
    def shutdown_calls(self) -> Sequence[RclpyCall]:
        """The calls of ``rclpy.shutdown`` and ``rclpy.try_shutdown``."""
        return [call for call in self.rclpy_calls if call.name in {"shutdown", "try_shutdown"}]

    @cached_property
    def rclpy_calls(self) -> Sequence[RclpyCall]:
        """The calls that start, run or end rclpy, in the order of the text."""
        found: list[RclpyCall] = []
        for call in self.module.walk(ast.Call):
            name = self._run_name(call)
            if name is not None:
                found.append(self._rclpy_call(call, name))
        return found

    def _run_name(self, call: ast.Call) -> str | None:
        for name in self.module.qualified_names(call.func):
            root, _, function = name.rpartition(".")
            if function in _RUNS and root in {"rclpy", "rclpy.utilities"}:
                return function
        func = call.func
        if isinstance(func, ast.Attribute) and func.attr in _RUNS and self._is_executor(func.value):
            return f"executor.{func.attr}"
        return None

    def _is_executor(self, node: ast.expr) -> bool:
        value = self.evaluator.single_value(node)
        if value is node and isinstance(node, ast.Name):
            value = self._entered(node) or node
        if not isinstance(value, ast.Call):
            return False
        return not _EXECUTORS.isdisjoint(self.module.qualified_names(value.func))

    def _entered(self, node: ast.Name) -> ast.expr | None:
        """Return what ``with ... as name`` is entered with."""
        found = self.module.index.lookup(node.id, node)
        for binding in found[1] if found else ():
            parent = self.module.parent(binding.node)
            if isinstance(parent, ast.withitem):
                return parent.context_expr
        return None

    def _rclpy_call(self, call: ast.Call, name: str) -> RclpyCall:
        handlers: set[str] = set()
        in_finally = in_handler = asks_ok = in_with = False
        child: ast.AST = call
        for parent in self.module.parents(call):
            match parent:
                case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.Lambda():
                    break
                case ast.Try() if child in parent.body:
                    handlers.update(self._caught(parent))
                case ast.Try() if child in parent.finalbody:
                    in_finally = True
                case ast.ExceptHandler():
                    in_handler = True
                case ast.If(test=test):
                    asks_ok = asks_ok or self._asks_ok(test)
                case ast.With(items=items):
                    in_with = in_with or any(self._enters_init(item) for item in items)
                    handlers.update(*(self._suppressed(item) for item in items))
            child = parent
        return RclpyCall(
            name,
            call,
            self.module.location(call),
            self.module.enclosing_function(call),
            frozenset(handlers),
            in_finally,
            in_handler,
            asks_ok,
            in_with,
        )

    def _caught(self, node: ast.Try) -> Iterator[str]:
        for handler in node.handlers:
            if handler.type is None:
                yield "BaseException"
            else:
                yield from self._exceptions(handler.type)

    def _exceptions(self, node: ast.expr) -> Iterator[str]:
        node = self.evaluator.single_value(node)
        if isinstance(node, ast.Tuple):
            for item in node.elts:
                yield from self._exceptions(item)
        else:
            yield from self.module.qualified_names(node)

    def _suppressed(self, item: ast.withitem) -> Iterator[str]:
        call = item.context_expr
        if not isinstance(call, ast.Call):
            return
        if self.module.qualified_name(call.func) == "contextlib.suppress":
            for arg in call.args:
                yield from self._exceptions(arg)

    def _enters_init(self, item: ast.withitem) -> bool:
        call = item.context_expr
        return isinstance(call, ast.Call) and self.module.qualified_name(call.func) == "rclpy.init"

    def _asks_ok(self, test: ast.expr) -> bool:
        return any(
            isinstance(node, ast.Call) and self.module.qualified_name(node.func) == "rclpy.ok"
            for node in ast.walk(test)
        )


def _parameters_in(notes: frozenset[str]) -> frozenset[str]:
    return frozenset(note.removeprefix(NOTE) for note in notes if note.startswith(NOTE))


def _is_static_method(function: FunctionNode) -> bool:
    return any(
        isinstance(decorator, ast.Name) and decorator.id == "staticmethod"
        for decorator in function.decorator_list
    )


def _returns_function(function: FunctionNode | ast.Lambda) -> bool:
    """Tell whether calling a function may give another function: it returns something."""
    if isinstance(function, ast.Lambda):
        return True
    return any(
        isinstance(node, ast.Return) and node.value is not None for node in ast.walk(function)
    )


def _module_paths(path: str, module: str) -> Iterator[str]:
    """Yield the files that a module seen from a file may be in."""
    directory = path.rpartition("/")[0]
    if module.startswith("."):
        name = module.lstrip(".")
        for _ in range(len(module) - len(name) - 1):
            directory = directory.rpartition("/")[0]
        bases = [directory]
    else:
        name = module
        bases = ["", "src", directory]
    for base in dict.fromkeys(bases):
        stem = "/".join(part for part in (base, *name.split(".")) if part)
        yield f"{stem}.py"
        yield f"{stem}/__init__.py"
