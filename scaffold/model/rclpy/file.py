"""The rclpy view of a Python file: nodes, entities, and how they are run."""

from __future__ import annotations

import ast
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from typing import Any

from scaffold.model import reads
from scaffold.model.python.evaluation.values import UNKNOWN, same
from scaffold.model.python.module import PythonModule
from scaffold.model.python.scopes import FunctionNode
from scaffold.model.rclpy.class_relations import ClassRelations
from scaffold.model.rclpy.creation import NODE_METHODS, Creation
from scaffold.model.rclpy.entities import (
    ActionClient,
    ActionServer,
    AnyEntity,
    Callback,
    Client,
    Endpoint,
    Entity,
    Parameter,
    ParameterRead,
    Publisher,
    Service,
    Subscription,
    Synchronizer,
    Timer,
)
from scaffold.model.rclpy.evaluation.evaluator import NodeEvaluator
from scaffold.model.rclpy.nodes import NodeClass, NodeDefinition, NodeObject
from scaffold.model.rclpy.own_modules import Modules, OwnModules, View
from scaffold.model.rclpy.parameters.declarations import Declarations
from scaffold.model.rclpy.running import callbacks as node_callbacks
from scaffold.model.rclpy.running.init_and_spin import RclpyCall, rclpy_calls
from scaffold.source import ViewError

__all__ = [
    "NODE_CLASSES",
    "Modules",
    "NodeClass",
    "NodeDefinition",
    "NodeObject",
    "RclpyFile",
    "rclpy_file",
]

NODE_CLASSES = frozenset(
    {"rclpy.node.Node", "rclpy.Node", "rclpy.create_node"}
    | {"rclpy.lifecycle.LifecycleNode", "rclpy.lifecycle.Node"}
    | {"rclpy.lifecycle.node.LifecycleNode"}
)

MAX_BASES = 40
"""The maximum depth of inheritance; real code has less."""


def rclpy_file(modules: Modules, path: str) -> RclpyFile:
    """Return the rclpy view of a Python file; raises ViewError."""
    return modules.remember(("nodes", path), lambda: RclpyFile(modules.module(path), modules))


def _entities(kind: type[AnyEntity]) -> cached_property[Sequence[AnyEntity]]:
    """Return the property of a file with what it creates of a kind."""
    return cached_property(lambda file: [item for item in file.entities if isinstance(item, kind)])


class RclpyFile:
    """The rclpy code of one file.

    Args:
        module: The parsed file.
        modules: The package, where base classes are looked up; ``None`` for a file alone.
    """

    def __init__(self, module: PythonModule, modules: Modules | None = None) -> None:
        self.module = module
        self.modules = modules
        self._reads = reads.current()
        self._own = OwnModules(module, modules)
        self.related_classes = ClassRelations(module).related
        """Returns a class with the bases and descendants it has in the file."""
        self.evaluator = NodeEvaluator(
            module, self._default_of, self.related_classes, self._own.constant
        )
        self.declarations = Declarations(module, self.evaluator, self.owner_of, self.method_of)
        self._results: dict[object, Any] = {}
        self._creation = Creation(self)
        self._owners: dict[ast.expr, NodeDefinition | None] = {}
        self._callbacks: dict[ast.expr, Callback] = {}
        self._base_depth = 0

    def remember(self, key: object, build: Callable[[], View]) -> View:
        """Return the result of ``build``, which is called once per key; see `remembered`."""
        if key not in self._results:
            self._results[key] = build()
        result: View = self._results[key]
        return result

    @cached_property
    def uses_rclpy(self) -> bool:
        """Whether the file imports rclpy."""
        return "rclpy" in self.module.imports_by_root

    # -- nodes

    @cached_property
    def classes(self) -> Sequence[NodeClass]:
        """The node classes, in the order of the text."""
        return [
            node_class
            for node in self.module.walk(ast.ClassDef)
            if (node_class := self.node_class(node)) is not None
        ]

    @cached_property
    def objects(self) -> Sequence[NodeObject]:
        """The nodes without a class of their own, in the order of the text."""
        node_objects: list[NodeObject] = []
        for call in self.module.walk(ast.Call):
            if not self.is_node_class(call.func):
                continue
            attribute, variable = self._creation.target(call)
            name = variable or attribute or ""
            item = NodeObject(self, name, self.module.location(call.func), call)
            item.is_lifecycle = _is_lifecycle(self.module.qualified_names(call.func))
            node_objects.append(item)
        return node_objects

    @property
    def nodes(self) -> Sequence[NodeDefinition]:
        """Node classes, then objects."""
        return [*self.classes, *self.objects]

    @cached_property
    def _classes_by_node(self) -> dict[ast.ClassDef, NodeClass | None]:
        return {}

    def node_class(self, node: ast.ClassDef) -> NodeClass | None:
        """Return the view of a class if it inherits from Node of rclpy."""
        classes = self._classes_by_node
        if node not in classes:
            classes[node] = None  # ends the recursion of a class that inherits from itself
            self._base_depth += 1
            classes[node] = self._new_node_class(node) if self._base_depth <= MAX_BASES else None
            self._base_depth -= 1
        return classes[node]

    def is_node_class(self, node: ast.expr) -> bool:
        """Return whether an expression is a node class of rclpy, or a factory of one."""
        return not NODE_CLASSES.isdisjoint(self.module.qualified_names(node))

    def _new_node_class(self, node: ast.ClassDef) -> NodeClass | None:
        for position, expression in enumerate(node.bases):
            names = self.module.qualified_names(expression)
            base = None
            if NODE_CLASSES.isdisjoint(names):
                base = self._base_class(expression, names)
                if base is None or base.depth > MAX_BASES:
                    continue
            result = NodeClass(self, node, base)
            result.base_index = position
            result.is_lifecycle = base.is_lifecycle if base else _is_lifecycle(names)
            return result
        return None

    def _base_class(self, expression: ast.expr, names: frozenset[str]) -> NodeClass | None:
        if not names and isinstance(expression, ast.Name):
            class_ = self.module.index.only_node(expression)
            if isinstance(class_, ast.ClassDef):
                return self.node_class(class_)
        for name in names:
            module, _, class_name = name.rpartition(".")
            file = self._file_of(module)
            found_class = file.module.classes.get(class_name) if file else None
            if file and found_class:
                return file.node_class(found_class.node)
        return None

    def _file_of(self, module: str) -> RclpyFile | None:
        """Return the view of another module of the package."""
        path = next(self._own.paths_of(module), None)
        if self.modules is None or path is None:
            return None
        with suppress(ViewError), reads.recorded(self._reads):
            # The analysis of the other file is cached here.
            return rclpy_file(self.modules, path)
        return None

    def definition_of(self, node: ast.expr) -> tuple[RclpyFile, ast.FunctionDef | ast.expr] | None:
        """Return the function or constant value of a name in the package, with its file.

        A name that is bound more than once has none.
        """
        callback = self.callback(node)
        if isinstance(callback.function, ast.FunctionDef):
            return self, callback.function
        owner = self.owner_of(node.value) if isinstance(node, ast.Attribute) else None
        while isinstance(node, ast.Attribute) and isinstance(owner, NodeClass):
            method = owner.methods.get(node.attr)
            if isinstance(method, ast.FunctionDef):
                return owner.file, method
            owner = owner.base
        if isinstance(node, ast.Attribute) and owner is None:
            method_found = self._method_of_object(node)
            if method_found is not None:
                return method_found
        module, _, name = (self.module.qualified_name(node) or "").rpartition(".")
        file = self._file_of(module)
        bindings = file.module.index.bindings(file.module.tree).get(name, ()) if file else ()
        if file is None or len(bindings) != 1:
            return None
        definition = bindings[0].node
        if isinstance(definition, ast.FunctionDef):
            return file, definition
        return (file, bindings[0].value) if bindings[0].value is not None else None

    def _method_of_object(self, node: ast.Attribute) -> tuple[RclpyFile, ast.FunctionDef] | None:
        """Return the method of an object that the package has the class of, with its file."""
        origins = self.evaluator.origins(node.value)
        classes = {
            self.module.qualified_name(made.func) or self.module.text(made.func)
            if isinstance(made, ast.Call)
            else ""
            for made in origins
        }
        module, _, name = (classes.pop() if len(classes) == 1 else "").rpartition(".")
        file: RclpyFile | None = self._file_of(module) if module else self
        class_ = file.module.classes.get(name) if file else None
        if file is None or class_ is None:
            return None
        bindings = file.module.index.bindings(class_.node).get(node.attr, ())
        method = bindings[0].node if len(bindings) == 1 else None
        return (file, method) if isinstance(method, ast.FunctionDef) else None

    def is_own_module(self, module: str) -> bool:
        """Return whether a dotted name is another module of the package."""
        return next(self._own.paths_of(module), None) is not None

    def owner_of(self, node: ast.expr) -> NodeDefinition | None:
        """Return the node that an expression such as ``self`` refers to."""
        if node not in self._owners:
            self._owners[node] = self._find_owner(node)
        return self._owners[node]

    def _find_owner(self, node: ast.expr) -> NodeDefinition | None:
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

    def method_of(self, call: ast.Call) -> ast.Attribute | None:
        """Return the called method, also through ``declare = self.declare_parameter``."""
        func: ast.expr | None = call.func
        if isinstance(func, ast.Name) and func.id in self._method_variables:
            func = self.evaluator.single_value(func)
        return func if isinstance(func, ast.Attribute) else None

    @cached_property
    def _method_variables(self) -> frozenset[str]:
        """The variables that store a method of a node."""
        return frozenset(
            target.id
            for method in NODE_METHODS
            for node in self.module.index.attributes(method)
            if isinstance(assignment := self.module.parent(node), ast.Assign)
            for target in assignment.targets
            if isinstance(target, ast.Name)
        )

    def defines(self, node: ast.ClassDef, method: str, depth: int = MAX_BASES) -> bool:
        """Return whether a class, or a base class in the package, defines a method."""
        if method in self.module.index.bindings(node):
            return True
        for expression in node.bases if depth else ():
            for file, base in self._classes_named(expression):
                if base is not node and file.defines(base, method, depth - 1):
                    return True
        return False

    def _classes_named(self, expression: ast.expr) -> Iterator[tuple[RclpyFile, ast.ClassDef]]:
        """Yield the classes of the package that an expression may refer to."""
        for binding in self.module.index.bindings_of(expression):
            if isinstance(binding.node, ast.ClassDef):
                yield self, binding.node
        for name in self.module.qualified_names(expression):
            module, _, class_name = name.rpartition(".")
            file = self._file_of(module)
            class_ = file.module.classes.get(class_name) if file else None
            if file and class_:
                yield file, class_.node

    def parameter_of(self, node: ast.expr | None) -> ast.arg | None:
        """Return the function parameter of a name."""
        bound = self.module.index.only_node(node)
        return bound if isinstance(bound, ast.arg) else None

    # -- entities

    def stored_in(self, call: ast.Call) -> tuple[str | None, str | None]:
        """Return the attribute of ``self`` and the variable that a call's result is stored in."""
        return self._creation.target(call)

    @cached_property
    def entities(self) -> Sequence[Entity]:
        """Everything created, in the order of the text."""
        return list(self._creation.entities())

    publishers = _entities(Publisher)
    """All publishers, also those of unknown nodes."""
    subscriptions = _entities(Subscription)
    """All subscriptions."""
    services = _entities(Service)
    """All services."""
    clients = _entities(Client)
    """All service clients."""
    action_servers = _entities(ActionServer)
    """All action servers."""
    action_clients = _entities(ActionClient)
    """All action clients."""
    endpoints = _entities(Endpoint)
    """Publishers, subscriptions, services, clients, action servers and clients."""
    timers = _entities(Timer)
    """All timers."""
    parameters = _entities(Parameter)
    """All declared parameters."""
    parameter_reads = _entities(ParameterRead)
    """All reads of parameters by name."""

    def interface(self, node: ast.expr) -> str | None:
        """Return the interface type that an expression names: ``std_msgs/msg/String``."""
        name = self.module.qualified_name(self.evaluator.single_value(node))
        parts = name.split(".") if name else []
        kinds = [part for part in parts[1:-1] if part in {"msg", "srv", "action"}]
        if not kinds or not parts[0] or not parts[-1][:1].isupper():
            return None
        module = ".".join(parts[:2])
        if self._file_of(module) is not None or self._own.is_of_neighbor(module):
            return None  # a Python module named action
        return f"{parts[0]}/{kinds[0]}/{parts[-1]}"

    def is_conditional(self, node: ast.AST) -> bool:
        """Return whether a node is under a condition or in a loop of its function."""
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

    def callback(self, node: ast.expr) -> Callback:
        """Return the callback of an expression."""
        if node not in self._callbacks:
            self._callbacks[node] = node_callbacks.resolve(self, node)
        return self._callbacks[node]

    @cached_property
    def callbacks(self) -> Sequence[tuple[Entity, Callback]]:
        """The callbacks of timers, subscriptions, services and actions."""
        return [
            (entity, callback) for entity in self.entities for callback in _callbacks_of(entity)
        ]

    @cached_property
    def inherited_callbacks(self) -> Sequence[tuple[Entity, Callback]]:
        """The methods that replace a callback which a base class in another file registers."""
        return [
            found
            for node in self.classes
            if node.base is not None and node.base.file is not self
            for found in node_callbacks.replaced(node, node.base)
        ]

    synchronizers = _entities(Synchronizer)
    """The message synchronizers."""

    def calls_in(self, function: FunctionNode | ast.Lambda) -> Sequence[ast.Call]:
        """Return the calls in the body of a function, except those of functions inside."""
        return self._calls_by_function.get(function, ())

    @cached_property
    def _calls_by_function(self) -> Mapping[ast.AST | None, Sequence[ast.Call]]:
        result: dict[ast.AST | None, list[ast.Call]] = {}
        for call in self.module.walk(ast.Call):
            result.setdefault(self.function_of(call), []).append(call)
        return result

    def function_of(self, node: ast.AST) -> FunctionNode | ast.Lambda | None:
        """Return the function whose body contains a node."""
        return node_callbacks.function_of(self, node)

    def reached(
        self, function: FunctionNode | ast.Lambda, skipped: Container[ast.AST] = ()
    ) -> Sequence[FunctionNode | ast.Lambda]:
        """Return a function and what it calls in the same file, without the skipped ones."""
        return node_callbacks.reached(self, function, skipped)

    # -- parameters

    def _default_of(self, receiver: ast.expr, name: str) -> object:
        """Return the default on which all declarations of a parameter agree."""
        owner = self.owner_of(receiver)
        nodes = self.declarations.values_of(owner, name)
        base = owner.base if isinstance(owner, NodeClass) else None
        if not nodes and base is not None:
            declared = base.parameters if base.file is not self else ()
            inherited = [item.default for item in declared if item.name == name]
            return inherited[0] if len(inherited) == 1 else UNKNOWN
        values = [self.evaluator.evaluate(node) for node in nodes]
        return values[0] if values and all(same(value, values[0]) for value in values) else UNKNOWN

    # -- execution

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
        return list(rclpy_calls(self.evaluator))


def _callbacks_of(entity: Entity) -> Sequence[Callback]:
    if isinstance(entity, Synchronizer):
        return entity.callbacks
    callback = entity.callback if isinstance(entity, Timer | Endpoint) else None
    return [callback] if callback is not None else []


def _is_lifecycle(names: frozenset[str]) -> bool:
    return any("lifecycle" in name for name in names)
