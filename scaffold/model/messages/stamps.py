"""Messages that are published without a stamp or frame in their header."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress

from scaffold.model.messages.classes import MessageClass, class_named
from scaffold.model.messages.inference import MessageTypes
from scaffold.model.python.evaluation.returns import returned
from scaffold.record import NamedTuple

_HEADER = "std_msgs/msg/Header"
_MEASURED = ("sensor_msgs/msg/", "nav_msgs/msg/Odometry", "geometry_msgs/msg/TransformStamped")
"""Messages of a certain time. Zero is "now" in a trajectory, "the latest" in a pose or marker."""
_PLACED = frozenset(
    {f"nav_msgs/msg/{name}" for name in ("Path", "OccupancyGrid", "GridCells", "Odometry")}
    | {f"sensor_msgs/msg/{name}" for name in ("LaserScan", "PointCloud2")}
    | {"geometry_msgs/msg/PoseArray", "geometry_msgs/msg/PolygonStamped"}
    | {"geometry_msgs/msg/TransformStamped", "visualization_msgs/msg/Marker"}
)
"""Messages for RViz and tf2, which reject them without a frame."""
_POSITIONS = frozenset(
    {"nav_msgs/msg/Odometry", "geometry_msgs/msg/PointStamped", "geometry_msgs/msg/PoseArray"}
)
"""Messages that say where something is: their frame is never implied."""
_GOALS = {
    "goal_pose": "geometry_msgs/msg/PoseStamped",
    "initialpose": "geometry_msgs/msg/PoseWithCovarianceStamped",
}
"""Topics whose poses Nav2 rejects without a frame; on others, a frame may be implied."""
_TRANSFORM = "geometry_msgs/msg/TransformStamped"
"""Transforms of moving frames, where zero is as good as no stamp."""
_BRIDGED = {
    "cv2_to_imgmsg": "sensor_msgs.msg.Image",
    "cv2_to_compressed_imgmsg": "sensor_msgs.msg.CompressedImage",
}
"""Methods of ``CvBridge`` that create messages; the third argument is the header."""
_WITH_CHILD = frozenset({"nav_msgs/msg/Odometry", _TRANSFORM})
_NEEDED: Mapping[str, tuple[str, tuple[str, ...]]] = {
    "sensor_msgs/msg/LaserScan": ("ranges", ("range_max", "angle_increment")),
    "sensor_msgs/msg/Range": ("range", ("max_range",)),
    "sensor_msgs/msg/Image": ("data", ("height", "width", "encoding", "step")),
    "sensor_msgs/msg/CompressedImage": ("data", ("format",)),
    "sensor_msgs/msg/PointCloud2": ("data", ("width", "height", "fields", "point_step")),
    "nav_msgs/msg/OccupancyGrid": ("data", ("info", "info.resolution")),
}
"""Fields without which messages with other fields set are useless."""
_SENDS = frozenset({"publish", "sendTransform"})


class Unstamped(NamedTuple):
    """A message that is published with its default stamp, zero."""

    made: ast.Call
    message: MessageClass
    sent: ast.Call
    missing: str
    """The missing fields: ``stamp`` and ``frame_id`` of the header, or ``child_frame_id``."""


class _Doubt(Exception):  # noqa: N818  it is not an error, it ends a search
    """Other code may set the stamp."""


def unstamped(types: MessageTypes) -> Iterator[Unstamped]:
    """Yield the messages of a file that are published without a stamp, each once.

    Or without a frame. Only if the header has the other one: a node that leaves it unset does not
    use it.
    """
    seen: set[ast.Call] = set()
    for method, made, message, sent, source in _sent(types):
        if made in seen or not _has_header(message):
            continue
        try:
            given = _follow(types, made, source, message)
        except _Doubt:
            continue
        missing = _missing(message, given, _topic(types, method))
        if not given and _is_bridged(made) and _is_header_known(types, made):
            missing = "stamp frame_id"
        if missing:
            seen.add(made)
            yield Unstamped(made, message, sent, missing)


def _is_bridged(made: ast.Call) -> bool:
    return isinstance(made.func, ast.Attribute) and made.func.attr in _BRIDGED


def _is_header_known(types: MessageTypes, made: ast.Call) -> bool:
    """Return whether a function gets a header, or a message with one, for an image it makes."""
    function = types.module.enclosing_function(made)
    if not isinstance(function, ast.FunctionDef):
        return False
    parameters = [item.arg for item in function.args.args]
    if "header" in parameters:
        return True
    names = [use for name in parameters for use in types.module.index.names(name)]
    inside = [use for use in names if types.module.enclosing_function(use) is function]
    owners = [types.type_of(use) for use in inside]
    return any(owner is not None and owner.section.field("header") for owner in owners)


def childless(types: MessageTypes) -> Iterator[Unstamped]:
    """Yield the odometry and the transforms of a file that are sent without a child frame."""
    seen: set[ast.Call] = set()
    for method, made, message, sent, source in _sent(types):
        if made not in seen and message.name in _WITH_CHILD:
            with suppress(_Doubt):
                topic = _topic(types, method)
                if not _names_child(types, made, source, needs_twist="odom" not in topic):
                    seen.add(made)
                    yield Unstamped(made, message, sent, "child_frame_id")


def lacking(types: MessageTypes) -> Iterator[Unstamped]:
    """Yield messages that are sent with data but without a field that it needs.

    Each once, for the first such field.
    """
    seen: set[ast.Call] = set()
    for _, made, message, sent, source in _sent(types):
        if made in seen or message.name not in _NEEDED or made.args:
            continue
        data, needed = _NEEDED[message.name]
        with suppress(_Doubt):
            given = _fields(types, made, source)
            missing = [
                field
                for field in needed
                if given.isdisjoint({field, f"{field.partition('.')[0]}.*"})
            ]
            if data in given and missing:
                seen.add(made)
                yield Unstamped(made, message, sent, missing[0])


def _sent(
    types: MessageTypes,
) -> Iterator[tuple[ast.Attribute, ast.Call, MessageClass, ast.Call, ast.expr]]:
    """Yield the sent messages.

    Each with the method, the constructor call, its class, the call that sends, and what is sent or
    returned for it.
    """
    for sent, method in types.module.method_calls("publish", "sendTransform"):
        if len(sent.args) != 1:
            continue
        source = _returned_by(types, sent.args[0]) or sent.args[0]
        made = types.file.evaluator.single_value(source)
        if isinstance(made, ast.Call) and _is_sender(types, method):
            message = _message(types, made)
            if message is not None:
                yield method, made, message, sent, source


def _fields(types: MessageTypes, made: ast.Call, sent: ast.expr) -> set[str]:
    """Return the fields of a message that are set; raise `_Doubt` if other code may set them.

    Fields of a field have dotted names, such as ``info.width``; ``info.*`` if all may be set.
    """
    words = {word.arg for word in made.keywords}
    if None in words:
        raise _Doubt
    result = {name for word in words if word is not None for name in (word, f"{word}.*")}
    for use in _uses(types, made, sent) if sent is not made else ():
        match types.module.parent(use):
            case ast.Attribute(attr=field) as part:
                inner = types.module.parent(part)
                name = inner.attr if isinstance(inner, ast.Attribute) else "*"
                result |= {field, f"{field}.{name}"}
            case ast.Call(func=ast.Attribute(attr=name)) if name in _SENDS:
                pass
            case ast.Return():
                pass
            case _:
                raise _Doubt
    return result


def _names_child(types: MessageTypes, made: ast.Call, sent: ast.expr, *, needs_twist: bool) -> bool:
    """Return whether the child frame of a message is set; raise `_Doubt` if other code may set it.

    Odometry without a twist may be a pose alone, and need none.
    """
    words = {word.arg for word in made.keywords}
    if made.args or words & {"child_frame_id", None}:
        return True
    has_twist = not needs_twist or "twist" in words
    for use in _uses(types, made, sent) if sent is not made else ():
        match types.module.parent(use):
            case ast.Attribute(attr="child_frame_id", ctx=ast.Store()):
                return True
            case ast.Attribute(attr=field):
                has_twist = has_twist or field in {"twist", "transform"}
            case ast.Call(func=ast.Attribute(attr=name)) if name in _SENDS:
                pass
            case ast.Return():
                pass
            case _:
                raise _Doubt
    return not has_twist


def _topic(types: MessageTypes, method: ast.Attribute) -> str:
    """Return the topic of a publisher; empty if unknown."""
    made = types.file.evaluator.single_value(method.value)
    names = [publisher.name for publisher in types.file.publishers if publisher.call is made]
    return "".join(name for name in names[:1] if isinstance(name, str)).lstrip("/")


def _missing(message: MessageClass, given: frozenset[str], topic: str) -> str:
    """Return the fields that a header lacks, given the one that it has; empty if none.

    A position is of no use without both.
    """
    if not given and message.name in _POSITIONS:
        return "stamp frame_id"
    if given == {"frame_id"} and message.name.startswith(_MEASURED):
        return "stamp"
    is_placed = message.name in _PLACED or _GOALS.get(topic) == message.name
    return "frame_id" if given == {"stamp"} and is_placed else ""


def _returned_by(types: MessageTypes, sent: ast.expr) -> ast.expr | None:
    """Return the values returned by a function whose result is published directly."""
    value = types.file.evaluator.single_value(sent)
    callback = types.file.callback(value.func) if isinstance(value, ast.Call) else None
    function = callback.function if callback is not None else None
    if value is not sent or not isinstance(function, ast.FunctionDef) or function.decorator_list:
        return None
    same = [x for x in types.module.function_nodes if x.name == function.name]
    values = [statement.value for statement in returned(function)]
    return values[0] if len(values) == len(same) == 1 else None


def _message(types: MessageTypes, made: ast.Call) -> MessageClass | None:
    """Return the class of a created message: by its constructor, or by cv_bridge."""
    match made.func:
        case ast.Attribute(attr=name, value=bridge) if name in _BRIDGED:
            bridge = types.file.evaluator.single_value(bridge)
            names = (
                types.module.qualified_names(bridge.func) if isinstance(bridge, ast.Call) else ()
            )
            is_bridge = any(item.endswith("CvBridge") for item in names)
            return class_named(types.definitions, _BRIDGED[name]) if is_bridge else None
    return types.class_of(made.func)


def _is_sender(types: MessageTypes, method: ast.Attribute) -> bool:
    """Return whether a method certainly is that of a publisher or a transform broadcaster."""
    made = types.file.evaluator.single_value(method.value)
    if not isinstance(made, ast.Call):
        return False
    if method.attr == "sendTransform":
        names = types.module.qualified_names(made.func)
        return any(name.endswith(".TransformBroadcaster") for name in names)
    return any(publisher.call is made for publisher in types.file.publishers)


def _has_header(message: MessageClass) -> bool:
    names = {*_PLACED, *_POSITIONS, *_GOALS.values()}
    if not message.name.startswith(_MEASURED) and message.name not in names:
        return False
    field = message.section.field("header")
    return field is not None and field.type.full_name == _HEADER and not field.type.is_array


def _follow(
    types: MessageTypes, made: ast.Call, sent: ast.expr, message: MessageClass
) -> frozenset[str]:
    """Follow all uses of a message; raise `_Doubt` if other code may fill its header.

    Returns:
        The fields of the header that are set.
    """
    if made.args[2:] or any(isinstance(arg, ast.Starred) for arg in made.args):
        raise _Doubt
    headers = [word.value for word in made.keywords if word.arg in {"header", None}]
    given = [_expect_plain_header(types, value) for value in headers]
    if sent is not made:
        may_be_zero = message.name == _TRANSFORM
        uses = _uses(types, made, sent)
        given += [_expect_harmless(types, use, may_be_zero=may_be_zero) for use in uses]
    return frozenset().union(*given)


def _expect_plain_header(types: MessageTypes, node: ast.expr) -> frozenset[str]:
    """Accept a header constructed in place; return its fields."""
    class_ = types.class_of(node.func) if isinstance(node, ast.Call) else None
    if class_ is None or class_.name != _HEADER or not isinstance(node, ast.Call):
        raise _Doubt
    if node.args or any(word.arg is None for word in node.keywords):
        raise _Doubt
    return frozenset(word.arg for word in node.keywords if word.arg is not None)


def _uses(types: MessageTypes, made: ast.Call, sent: ast.expr) -> Sequence[ast.expr]:
    """Return the places where the variable or attribute with a message is read."""
    module = types.module
    if module.parent(made) is None or not isinstance(sent, ast.Name | ast.Attribute):
        raise _Doubt
    if isinstance(sent, ast.Attribute):
        # An attribute of this name may be of the same object anywhere.
        return [node for node in module.index.attributes(sent.attr) if _is_read(node)]
    if all(binding.value is not made for binding in module.index.bindings_of(sent)):
        raise _Doubt
    return [node for node in module.index.uses_of(sent) if _is_read(node)]


def _is_read(node: ast.Name | ast.Attribute) -> bool:
    return isinstance(node.ctx, ast.Load)


def _expect_harmless(types: MessageTypes, use: ast.expr, *, may_be_zero: bool) -> frozenset[str]:
    """Accept code that reads or sets fields or publishes the message; return set header fields."""
    match types.module.parent(use):
        case ast.Call(func=ast.Attribute(attr=name), args=[only]) if only is use:
            if name not in _SENDS:
                raise _Doubt
        case ast.Attribute(attr="header") as header:
            return _set_in_header(types, header, may_be_zero=may_be_zero)
        case ast.Attribute() | ast.FormattedValue() | ast.Return():
            return frozenset()
        case _:
            raise _Doubt
    return frozenset()


def _set_in_header(
    types: MessageTypes, header: ast.Attribute, *, may_be_zero: bool
) -> frozenset[str]:
    above = types.module.parent(header)
    if isinstance(header.ctx, ast.Store) and isinstance(above, ast.Assign):
        return _expect_plain_header(types, above.value)
    match above:
        case ast.Assign(targets=[ast.Attribute(attr="header", value=ast.Name() as other) as place]):
            uses = [use for use in types.module.index.uses_of(other) if use is not place.value]
            given = [
                _expect_harmless(types, use, may_be_zero=may_be_zero)
                for use in uses
                if _is_read(use)
            ]
            return frozenset().union(*given)  # both messages have the same header
    if not isinstance(above, ast.Attribute) or above.attr not in {"frame_id", "stamp"}:
        raise _Doubt
    assigned = types.module.parent(above)
    if may_be_zero and isinstance(assigned, ast.Assign) and _is_zero(types, assigned.value):
        return frozenset()
    if isinstance(above.ctx, ast.Store):
        return frozenset({above.attr})
    if above.attr == "stamp":
        raise _Doubt  # `header.stamp.sec = 5`
    return frozenset()


def _is_zero(types: MessageTypes, stamp: ast.expr) -> bool:
    """Return whether a stamp is ``Time()`` of messages, or ``Time().to_msg()`` of rclpy."""
    match stamp:
        case ast.Call(
            func=ast.Attribute(attr="to_msg", value=ast.Call(args=[], keywords=[]) as time)
        ):
            return types.module.qualified_name(time.func) == "rclpy.time.Time"
        case ast.Call(args=[], keywords=[]):
            return types.module.qualified_name(stamp.func) == "builtin_interfaces.msg.Time"
    return False
