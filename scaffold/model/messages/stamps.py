"""Messages that are created and published, and whose stamp is certainly never set."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.model.messages.inference import MessageClass, MessageTypes
from scaffold.model.python.returns import returned
from scaffold.record import NamedTuple

_HEADER = "std_msgs/msg/Header"
_MEASURED = ("sensor_msgs/msg/", "nav_msgs/msg/Odometry", "geometry_msgs/msg/TransformStamped")
"""What is of a certain time. Zero means "now" in a trajectory, "the latest" in a pose or marker."""
_TRANSFORM = "geometry_msgs/msg/TransformStamped"
"""Of a moving frame: zero is as good as no stamp there, and "the latest" in other messages."""
_BRIDGED = {
    "cv2_to_imgmsg": "sensor_msgs.msg.Image",
    "cv2_to_compressed_imgmsg": "sensor_msgs.msg.CompressedImage",
}
"""The methods of ``CvBridge`` that make messages; the third argument is the header."""
_SENDS = frozenset({"publish", "sendTransform"})


class Unstamped(NamedTuple):
    """A message that leaves the node with the stamp it was made with: zero."""

    made: ast.Call
    message: MessageClass
    sent: ast.Call


class _Doubt(Exception):  # noqa: N818  it is not an error, it ends a search
    """Something else may set the stamp."""


def unstamped(types: MessageTypes) -> Iterator[Unstamped]:
    """Yield the messages of a file that are published without a stamp, each once.

    Only measurements whose header says in which frame they are: who leaves the whole header alone
    does not use it.
    """
    seen: set[ast.Call] = set()
    index = types.module.index
    for method in [*index.attributes("publish"), *index.attributes("sendTransform")]:
        sent = types.module.parent(method)
        if not isinstance(sent, ast.Call) or sent.func is not method or len(sent.args) != 1:
            continue
        source = _returned_by(types, sent.args[0]) or sent.args[0]
        made = types.facts.evaluator.single_value(source)
        if not isinstance(made, ast.Call) or made in seen or not _is_sender(types, method):
            continue
        message = _message(types, made)
        if message is None or not _has_header(message):
            continue
        try:
            has_frame = _follow(types, made, source, message)
        except _Doubt:
            continue
        if has_frame:
            seen.add(made)
            yield Unstamped(made, message, sent)


def _returned_by(types: MessageTypes, sent: ast.expr) -> ast.expr | None:
    """Return what a function of the file returns whose result is published at once."""
    value = types.facts.evaluator.single_value(sent)
    callback = types.facts.callback(value.func) if isinstance(value, ast.Call) else None
    function = callback.function if callback is not None else None
    if value is not sent or not isinstance(function, ast.FunctionDef) or function.decorator_list:
        return None
    same = [x for x in types.module.function_nodes if x.name == function.name]
    values = [statement.value for statement in returned(function)]
    return values[0] if len(values) == len(same) == 1 else None


def _message(types: MessageTypes, made: ast.Call) -> MessageClass | None:
    """Return what a call makes: its class is called, or cv_bridge turns an image into it."""
    match made.func:
        case ast.Attribute(attr=name, value=bridge) if name in _BRIDGED:
            bridge = types.facts.evaluator.single_value(bridge)
            names = (
                types.module.qualified_names(bridge.func) if isinstance(bridge, ast.Call) else ()
            )
            is_bridge = any(item.endswith("CvBridge") for item in names)
            return types.class_named(_BRIDGED[name]) if is_bridge else None
    return types.class_of(made.func)


def _is_sender(types: MessageTypes, method: ast.Attribute) -> bool:
    """Tell whether a method certainly is that of a publisher, or of a broadcaster of transforms."""
    made = types.facts.evaluator.single_value(method.value)
    if not isinstance(made, ast.Call):
        return False
    if method.attr == "sendTransform":
        names = types.module.qualified_names(made.func)
        return any(name.endswith(".TransformBroadcaster") for name in names)
    return any(publisher.call is made for publisher in types.facts.publishers)


def _has_header(message: MessageClass) -> bool:
    if not message.name.startswith(_MEASURED):
        return False
    field = message.section.field("header")
    return field is not None and field.type.full_name == _HEADER and not field.type.is_array


def _follow(types: MessageTypes, made: ast.Call, sent: ast.expr, message: MessageClass) -> bool:
    """Look at all that is done with a message; doubt if anything may set its stamp.

    Returns:
        Whether its frame is set.
    """
    if made.args[2:] or any(isinstance(arg, ast.Starred) for arg in made.args):
        raise _Doubt
    headers = [word.value for word in made.keywords if word.arg in {"header", None}]
    frames = [_expect_plain_header(types, value) for value in headers]
    if sent is not made:
        may_be_zero = message.name == _TRANSFORM
        uses = _uses(types, made, sent)
        frames += [_expect_harmless(types, use, may_be_zero=may_be_zero) for use in uses]
    return any(frames)


def _expect_plain_header(types: MessageTypes, node: ast.expr) -> bool:
    """Accept a header that is made on the spot and not given a stamp; tell if it has a frame."""
    class_ = types.class_of(node.func) if isinstance(node, ast.Call) else None
    if class_ is None or class_.name != _HEADER or not isinstance(node, ast.Call):
        raise _Doubt
    if node.args or any(word.arg in {"stamp", None} for word in node.keywords):
        raise _Doubt
    return bool(node.keywords)


def _uses(types: MessageTypes, made: ast.Call, sent: ast.expr) -> Sequence[ast.expr]:
    """Return where the variable or attribute is read that holds a message."""
    module = types.module
    if module.parent(made) is None or not isinstance(sent, ast.Name | ast.Attribute):
        raise _Doubt
    if isinstance(sent, ast.Attribute):
        # An attribute of this name may belong to the same object wherever it is.
        return [node for node in module.index.attributes(sent.attr) if _is_read(node)]
    scope = module.index.lookup(sent.id, sent)
    result = [
        node
        for node in module.index.names(sent.id)
        if _is_read(node) and module.index.lookup(node.id, node) == scope
    ]
    if scope is None or all(binding.value is not made for binding in scope[1]):
        raise _Doubt
    return result


def _is_read(node: ast.Name | ast.Attribute) -> bool:
    return isinstance(node.ctx, ast.Load)


def _expect_harmless(types: MessageTypes, use: ast.expr, *, may_be_zero: bool) -> bool:
    """Accept what reads or sets other fields or publishes the message; tell if it sets a frame."""
    match types.module.parent(use):
        case ast.Call(func=ast.Attribute(attr=name), args=[only]) if only is use:
            if name not in _SENDS:
                raise _Doubt
        case ast.Attribute(attr="header") as header:
            return _expect_harmless_header(types, header, may_be_zero=may_be_zero)
        case ast.Attribute() | ast.FormattedValue() | ast.Return():
            return False
        case _:
            raise _Doubt
    return False


def _expect_harmless_header(
    types: MessageTypes, header: ast.Attribute, *, may_be_zero: bool
) -> bool:
    above = types.module.parent(header)
    if isinstance(header.ctx, ast.Store) and isinstance(above, ast.Assign):
        return _expect_plain_header(types, above.value)
    assigned = types.module.parent(above) if isinstance(above, ast.Attribute) else None
    if may_be_zero and isinstance(assigned, ast.Assign) and _is_zero(types, assigned.value):
        return False
    if not isinstance(above, ast.Attribute) or above.attr != "frame_id":
        raise _Doubt
    return isinstance(above.ctx, ast.Store)


def _is_zero(types: MessageTypes, stamp: ast.expr) -> bool:
    """Tell whether a stamp is ``Time()`` of messages, or ``Time().to_msg()`` of rclpy."""
    match stamp:
        case ast.Call(
            func=ast.Attribute(attr="to_msg", value=ast.Call(args=[], keywords=[]) as time)
        ):
            return types.module.qualified_name(time.func) == "rclpy.time.Time"
        case ast.Call(args=[], keywords=[]):
            return types.module.qualified_name(stamp.func) == "builtin_interfaces.msg.Time"
    return False
