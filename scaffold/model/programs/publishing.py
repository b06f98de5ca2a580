"""The calls that publish with a publisher, and the rates at which timers cause them."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.model.python.evaluation.attributes import Store
from scaffold.model.python.evaluation.values import Unknown, is_none_literal
from scaffold.model.python.scopes import FunctionNode
from scaffold.model.rclpy.entities import Callback, Entity, Publisher, Timer
from scaffold.model.rclpy.file import RclpyFile

_HARMLESS = frozenset(
    {
        "topic",
        "topic_name",
        "get_subscription_count",
        "msg_type",
        "qos_profile",
        "handle",
        "destroy",
    }
    | {"is_ready", "is_canceled", "time_since_last_call", "time_until_next_call"}
    | {"timer_period_ns", "clock", "callback_group"}
)
"""Methods of publishers and timers without effects."""

_MAX_CALLS = 4
"""The maximum number of functions between a timer and a publishing call."""


class _Doubt(Exception):  # noqa: N818  it is not an error, it ends a search
    """Other code may publish as well."""


def publish_calls(file: RclpyFile, publisher: Publisher) -> Sequence[ast.Call] | None:
    """Return the calls that publish; ``None`` if other code gets the publisher."""
    try:
        return list(_uses(file, publisher, "publish"))
    except _Doubt:
        return None


def publish_rates(
    file: RclpyFile, publisher: Publisher, *, may_leave: bool = False
) -> Sequence[float] | None:
    """Return the rates in Hz whose sum is the rate of a publisher.

    Known if only callbacks of timers publish, directly or through other functions of the
    file, under no condition, and nothing stops or changes the timers. Else ``None``; without any
    rate, it publishes at the start or never.

    Args:
        file: The file.
        publisher: The publisher.
        may_leave: Whether callbacks may return or raise before they publish.
    """
    if publisher.is_conditional or publisher.is_lifecycle:
        return None
    try:
        return [
            _rate(file, timer)
            for call in _uses(file, publisher, "publish")
            for timer in _timers_behind(file, call, 0, may_leave=may_leave)
        ]
    except _Doubt:
        return None


def ticks_always(file: RclpyFile, timer: Timer) -> bool:
    """Return whether a timer certainly runs from the start of its node to the end."""
    try:
        _expect_ticking(file, timer)
    except _Doubt:
        return False
    return True


def _rate(file: RclpyFile, timer: Timer) -> float:
    if isinstance(timer.period, Unknown) or timer.period <= 0:
        raise _Doubt
    _expect_ticking(file, timer)
    return 1 / timer.period


def _expect_ticking(file: RclpyFile, timer: Timer) -> None:
    autostart = timer.argument("autostart")
    if timer.is_conditional or timer.has_unknown_arguments:
        raise _Doubt
    if autostart and autostart.value is not True:
        raise _Doubt
    if timer.argument("clock") or _may_be_held_up(file, timer):
        raise _Doubt
    if not _runs_once(file, timer.function):
        raise _Doubt
    if timer.attribute or timer.variable:
        list(_uses(file, timer, ""))


def _may_be_held_up(file: RclpyFile, timer: Timer) -> bool:
    """Return whether a timer is in an unknown callback group."""
    group = timer.argument("callback_group")
    if group is None:
        return False
    made = file.evaluator.single_value(group.node)
    names = file.module.qualified_names(made.func) if isinstance(made, ast.Call) else ()
    return not any(name.startswith("rclpy.callback_groups.") for name in names)


def _runs_once(file: RclpyFile, function: FunctionNode | None) -> bool:
    """Return whether a function is run once per node: constructor, its helper, or main."""
    for _ in range(_MAX_CALLS):
        if function is None or function.name == "__init__":
            return True
        is_method = isinstance(file.module.parent(function), ast.ClassDef)
        references = list(_references(file, function))
        if not is_method:
            return len(references) <= 1
        if len(references) != 1 or not _is_certain_call(file, references[0]):
            return False
        function = file.module.enclosing_function(references[0])
    return False


# -- uses


def _uses(file: RclpyFile, entity: Entity, method: str) -> Iterator[ast.Call]:
    """Yield the calls of a method of a stored object; raise `_Doubt` if it is passed elsewhere."""
    module = file.module
    for node in _stored_references(file, entity):
        parent = module.parent(node)
        above = module.parent(parent) if parent else None
        if isinstance(parent, ast.Attribute):
            is_called = isinstance(above, ast.Call) and above.func is parent
            if is_called and parent.attr == method and isinstance(above, ast.Call):
                yield above
            elif parent.attr not in _HARMLESS:
                raise _Doubt
        elif not isinstance(parent, ast.If | ast.Compare | ast.BoolOp | ast.Expr):
            raise _Doubt


def _stored_references(file: RclpyFile, entity: Entity) -> Iterator[ast.expr]:
    """Yield the places where the attribute and the variable of a stored object are read."""
    if not entity.attribute and not entity.variable:
        raise _Doubt
    if entity.attribute:
        yield from _attribute_references(file, entity, entity.attribute)
    if entity.variable:
        for node in file.module.index.names(entity.variable):
            if not isinstance(node.ctx, ast.Load):
                continue
            bindings = file.module.index.bindings_of(node)
            if any(binding.value is entity.call for binding in bindings):
                if len(bindings) > 1:
                    raise _Doubt
                yield node


def _attribute_references(
    file: RclpyFile, entity: Entity, attribute: str
) -> Iterator[ast.Attribute]:
    function = entity.function
    class_ = file.module.enclosing_class(function) if function else None
    if class_ is None:
        raise _Doubt
    family = file.related_classes(class_)
    for store in file.evaluator.stores(attribute):
        other = store.class_ is None or store.class_ in family
        if other and store.value is not entity.call and not _is_placeholder(store, entity):
            raise _Doubt
    for node in file.module.index.attributes(attribute):
        if isinstance(node.ctx, ast.Load):
            holder = file.evaluator.self_class(node.value)
            if holder is None or holder in family:
                yield node


def _is_placeholder(store: Store, entity: Entity) -> bool:
    """Return whether an attribute is None until it is set further down."""
    return is_none_literal(store.value) and store.node.lineno < entity.call.lineno


def _timers_behind(
    file: RclpyFile, call: ast.AST, depth: int, *, may_leave: bool
) -> Iterator[Timer]:
    """Yield a timer for every path to a call; raise `_Doubt` for other paths."""
    module = file.module
    function = file.function_of(call)
    if depth > _MAX_CALLS or function is None:
        raise _Doubt
    if _is_conditional(file, call, function) or not (may_leave or _gets_to(file, call, function)):
        raise _Doubt
    if not isinstance(function, ast.Lambda) and function.name == "__init__":
        return  # once, at the start
    references = list(_references(file, function))
    if not references or len(references) > _MAX_CALLS:
        raise _Doubt
    for reference in references:
        timer = _timer_with(file, reference)
        if timer is not None:
            yield timer
            continue
        caller = module.call_with(reference)
        if caller is None:
            raise _Doubt
        yield from _timers_behind(file, caller, depth + 1, may_leave=may_leave)


def _timer_with(file: RclpyFile, reference: ast.expr) -> Timer | None:
    for timer in file.timers:
        callback = timer.callback
        if callback and not callback.is_called and _innermost(callback) is reference:
            return timer
    return None


def _innermost(callback: Callback) -> ast.AST:
    """Return the function inside ``partial(partial(function, ...), ...)``."""
    node = callback.node
    while isinstance(node, ast.Call) and node.args:
        node = node.args[0]
    return node


def _references(file: RclpyFile, function: FunctionNode | ast.Lambda) -> Iterator[ast.expr]:
    """Yield the uses of a function; raise `_Doubt` if another one has the same name."""
    if isinstance(function, ast.Lambda):
        yield function
    elif isinstance(file.module.parent(function), ast.ClassDef):
        yield from _method_references(file, function)
    else:
        yield from _function_references(file, function)


def _method_references(file: RclpyFile, function: FunctionNode) -> Iterator[ast.expr]:
    index, class_ = file.module.index, file.module.enclosing_class(function)
    family = file.related_classes(class_) if class_ else ()
    name = function.name
    same = [binding for member in family for binding in index.bindings(member).get(name, ())]
    if len(same) != 1:
        raise _Doubt
    for node in index.attributes(name):
        holder = file.evaluator.self_class(node.value)
        if holder is None or holder in family:
            yield node


def _function_references(file: RclpyFile, function: FunctionNode) -> Iterator[ast.expr]:
    for name in file.module.index.names(function.name):
        if isinstance(name.ctx, ast.Load):
            bindings = file.module.index.bindings_of(name)
            if any(binding.node is function for binding in bindings):
                if len(bindings) > 1:
                    raise _Doubt
                yield name


def _is_certain_call(file: RclpyFile, reference: ast.expr) -> bool:
    call, function = file.module.call_with(reference), file.function_of(reference)
    return call is not None and function is not None and _is_certain(file, call, function)


def _is_certain(file: RclpyFile, node: ast.AST, function: FunctionNode | ast.Lambda) -> bool:
    """Return whether a node is run exactly once per call of its function."""
    return not _is_conditional(file, node, function) and _gets_to(file, node, function)


def _is_conditional(file: RclpyFile, node: ast.AST, function: FunctionNode | ast.Lambda) -> bool:
    """Return whether a node is inside of a statement that may skip or repeat it."""
    child = node
    for parent in file.module.parents(node):
        if parent is function:
            break
        match parent:
            case ast.If() | ast.For() | ast.While() | ast.AsyncFor() | ast.IfExp():
                return True
            case ast.ExceptHandler() | ast.match_case() | ast.comprehension() | ast.Assert():
                return True
            case ast.ListComp() | ast.SetComp() | ast.DictComp() | ast.GeneratorExp():
                return True
            case ast.BoolOp(values=[first, *_]) if child is not first:
                return True
            case ast.Try(body=[first, *_], handlers=[_, *_]) if child is not first:
                return True
        child = parent
    return False


def _gets_to(file: RclpyFile, node: ast.AST, function: FunctionNode | ast.Lambda) -> bool:
    """Return whether a function cannot be left before a node."""
    return not any(
        file.function_of(leaving) is function and _is_before(leaving, node)
        for kind in (ast.Return, ast.Raise, ast.Yield)
        for leaving in file.module.walk(kind)
    )


def _is_before(first: ast.AST, second: ast.AST) -> bool:
    return getattr(first, "lineno", 0) < getattr(second, "lineno", 0)
