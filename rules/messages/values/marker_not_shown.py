"""MS030: markers have a visible color, a size, and a unique id."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.messages import MessageTypes
from scaffold.api.python import PythonModule, is_known

_MARKER = "visualization_msgs/msg/Marker"
_ADDING = frozenset({"Marker.ADD", "Marker.MODIFY", "0"})
_NODE = (
    "from rclpy.node import Node\nfrom visualization_msgs.msg import Marker, MarkerArray\n\n\n"
    "class Show(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('show')\n"
    "        self.publisher = self.create_publisher(MarkerArray, 'markers', 10)\n\n"
    "    def show(self, places):\n"
    "        array = MarkerArray()\n"
    "        for number, place in enumerate(places):\n"
    "            marker = Marker()\n"
    "            marker.header.frame_id = 'map'\n"
    "            marker.type = Marker.SPHERE\n"
    "            marker.id = {}\n"
    "            marker.pose.position = place\n"
    "            marker.scale.x = marker.scale.y = marker.scale.z = 0.1\n"
    "            marker.color.{} = 1.0\n"
    "            {}\n"
    "            array.markers.append(marker)\n"
    "        self.publisher.publish(array)\n"
)


class MarkerNotShown(MessageRule):
    """A marker has no alpha or no size, or all markers of a loop have the same id.

    **Why.** ``color.a`` and ``scale`` are 0 by default: RViz draws nothing. A marker replaces an
    earlier one with the same ``ns`` and ``id``: RViz only shows the last one.

    **Fix.** Set ``marker.color.a = 1.0``, ``marker.scale.x = 0.1`` and a unique ``marker.id``, such
    as the index of ``enumerate(...)``.

    **Source.** ``visualization_msgs/msg/Marker``; RViz User Guide, "Marker Display".
    """

    code = "MS030"
    name = "marker-not-shown"
    examples = (
        Example(
            "markers of a loop with color, namespace and unique ids",
            {"show.py": _NODE.format("number", "a", "marker.ns = 'a'")},
        ),
        Example(
            "empty marker of a test",
            {
                "test/test_show.py": "import pytest\n"
                "from visualization_msgs.msg import Marker\n\n\n"
                "def test_show(publisher):\n"
                "    marker = Marker()\n"
                "    publisher.publish(marker)\n"
            },
        ),
        Example(
            "namespace and id set in one assignment",
            {
                "show.py": _NODE.format("number", "a", "pass").replace(
                    "marker.id = number", "marker.ns, marker.id = 'a', number"
                )
            },
        ),
        Example(
            "function called in a loop: no alpha, same id",
            {
                "show.py": "from visualization_msgs.msg import Marker, MarkerArray\n\n\n"
                "def shown(place):\n"
                "    marker = Marker(ns='trees', id=1, type=Marker.CYLINDER)\n"
                "    marker.pose.position = place\n"
                "    marker.scale.x = marker.scale.y = marker.scale.z = 0.3\n"
                "    marker.color.g = 1.0\n"
                "    return marker\n\n\n"
                "def fill(array: MarkerArray, places):\n"
                "    for place in places:\n"
                "        array.markers.append(shown(place))\n"
            },
            "5:14: all markers of this loop have the id 1: RViz only shows the last one; use a "
            "unique id",
            "5:14: color.a is never set, so it is 0: RViz does not show this marker; set it to 1.0",
        ),
        Example(
            "function called in a list comprehension: same id",
            {
                "show.py": "from visualization_msgs.msg import Marker, MarkerArray\n\n\n"
                "def shown(place):\n"
                "    marker = Marker(type=Marker.SPHERE)\n"
                "    marker.pose.position = place\n"
                "    marker.scale.x = marker.scale.y = marker.scale.z = 0.3\n"
                "    marker.color.a = 1.0\n"
                "    return marker\n\n\n"
                "def all_of(places):\n"
                "    return MarkerArray(markers=[shown(place) for place in places])\n"
            },
            "5:14: all markers of this loop have the id 0: RViz only shows the last one; use a "
            "unique id",
        ),
        Example(
            "ColorRGBA without alpha",
            {
                "show.py": "from std_msgs.msg import ColorRGBA\n"
                "from visualization_msgs.msg import Marker\n\n"
                "RED = ColorRGBA(r=1.0)\nBLUE = ColorRGBA(b=1.0, a=1.0)\n"
                "MARKERS = [Marker(color=RED), Marker(color=BLUE)]\n"
            },
            "4:7: alpha of this color is 0 by default: RViz does not show it; add a=1.0",
        ),
        Example(
            "marker whose alpha is set by the caller",
            {
                "show.py": "from visualization_msgs.msg import Marker\n\n\n"
                "def shown(place):\n"
                "    marker = Marker()\n"
                "    marker.pose.position = place\n"
                "    return marker\n\n\n"
                "def fill(array, places):\n"
                "    for place in places:\n"
                "        marker = shown(place)\n"
                "        marker.color.a = 1.0\n"
                "        array.markers.append(marker)\n"
            },
        ),
        Example(
            "markers stored in a list and completed elsewhere",
            {
                "item.py": "from visualization_msgs.msg import Marker\n\n\n"
                "class Item:\n"
                "    def __init__(self, count):\n"
                "        self.parts = []\n"
                "        for _ in range(count):\n"
                "            marker = Marker()\n"
                "            marker.action = Marker.ADD\n"
                "            self.parts.append(marker)\n\n"
                "    def paint(self):\n"
                "        for number, marker in enumerate(self.parts):\n"
                "            marker.id = number\n"
                "            marker.color.a = 1.0\n",
                "shape.py": "from visualization_msgs.msg import Marker\n\n\n"
                "class Shape:\n"
                "    def __init__(self, count):\n"
                "        self.parts = []\n"
                "        for _ in range(count):\n"
                "            marker = Marker()\n"
                "            marker.action = Marker.ADD\n"
                "            self.parts.append(marker)\n\n"
                "    def get(self):\n"
                "        return self.parts\n",
            },
        ),
        Example(
            "marker passed to a method that may set the alpha",
            {"show.py": _NODE.format("number", "r", "self.paint(marker)")},
        ),
        Example(
            "marker with the action DELETE, marker with a unique namespace",
            {
                "show.py": _NODE.format("number", "r", "marker.action = Marker.DELETE"),
                "b.py": _NODE.format("0", "a", "marker.ns = f'place{number}'"),
            },
        ),
        Example(
            "marker without a scale",
            {
                "show.py": _NODE.format("number", "a", "marker.ns = 'a'").replace(
                    "marker.scale.x = marker.scale.y = marker.scale.z = 0.1",
                    "marker.lifetime.sec = 1",
                )
            },
            "13:22: scale is never set, so it is 0: RViz does not show this marker; set it",
        ),
        Example(
            "loop of markers without alpha, with the same id",
            {"show.py": _NODE.format("7", "r", "marker.action = Marker.ADD")},
            "13:22: all markers of this loop have the id 7: RViz only shows the last one; use a "
            "unique id",
            "13:22: color.a is never set, so it is 0: RViz does not show this marker; set it to "
            "1.0",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        if types.module.in_tests:
            return  # RViz shows no marker of a test
        for assignment in types.module.walk(ast.Assign):
            match assignment:
                case ast.Assign(targets=[ast.Name() as name], value=ast.Call(args=[]) as made):
                    class_ = types.class_of(made.func)
                    is_marker = class_ is not None and class_.name == _MARKER
                    if is_marker and all(word.arg for word in made.keywords):
                        for problem in _problems(types, assignment, name):
                            yield self.report(types.module.location(made), problem)
        for color in _transparent(types):
            message = "alpha of this color is 0 by default: RViz does not show it; add a=1.0"
            yield self.report(types.module.location(color), message)


def _transparent(types: MessageTypes) -> Iterator[ast.Call]:
    """Yield the colors created without alpha in a file with markers that never sets it."""
    if not types.module.mentions("Marker"):
        return
    for call in types.module.walk(ast.Call):
        words = {word.arg for word in call.keywords}
        if words and not words & {"a", None} and words <= {"r", "g", "b", "check_fields"}:
            class_ = types.class_of(call.func)
            is_set = any(isinstance(x.ctx, ast.Store) for x in types.module.index.attributes("a"))
            if class_ is not None and class_.name == "std_msgs/msg/ColorRGBA" and not is_set:
                yield call


def _problems(types: MessageTypes, made: ast.Assign, name: ast.Name) -> Iterator[str]:
    uses = _uses(types, name)
    if uses is None or not isinstance(made.value, ast.Call):
        return
    words = {word.arg or "": word.value for word in made.value.keywords}
    actions = {types.module.text(value) for value in _field_values(types, uses, words, "action")}
    fields = {types.module.text(use).partition(".")[2] for use in uses} | words.keys()
    if actions <= _ADDING and fields.isdisjoint(_COLORS):
        yield "color.a is never set, so it is 0: RViz does not show this marker; set it to 1.0"
    if actions <= _ADDING and not any(field.startswith("scale") for field in fields):
        yield "scale is never set, so it is 0: RViz does not show this marker; set it"
    loop = _loop_around(types, made)
    if loop is None or not actions <= _ADDING or _ends_early(loop):
        return
    if types.module.mentions("InteractiveMarker"):
        return  # RViz numbers the markers of a control itself
    ids, spaces = (list(_field_values(types, uses, words, key)) for key in ("id", "ns"))
    values = [types.file.evaluator.evaluate(value) for value in (*ids, *spaces)]
    if len(ids) <= 1 and len(spaces) <= 1 and all(map(is_known, values)):
        shown = f"the id {values[0]}" if ids else "the id 0"
        yield (
            f"all markers of this loop have {shown}: RViz only shows the last one; use a unique id"
        )


_COLORS = frozenset({"color", "color.a", "colors", "mesh_use_embedded_materials"})


def _uses(types: MessageTypes, name: ast.Name) -> Sequence[ast.Attribute] | None:
    """Return the used fields of a marker; ``None`` if it is used in any other way."""
    module = types.module
    if len(module.index.bindings_of(name)) != 1:
        return None
    result: list[ast.Attribute] = []
    is_sent = False
    for use in module.index.uses_of(name):
        if not isinstance(use.ctx, ast.Load):
            continue
        above = module.parent(use)
        match above:
            case ast.Attribute():
                field: ast.Attribute = above
                while isinstance(outer := module.parent(field), ast.Attribute):
                    field = outer
                if isinstance(outer, ast.Call) and outer.func is field:
                    field = above  # such as points.append()
                if isinstance(field.ctx, ast.Load) and above.attr == "color":
                    return None
                result.append(field)
            case _ if _is_sending(types, above, use):
                is_sent = True
            case _:
                return None
    return result if is_sent else None


def _is_sending(types: MessageTypes, node: ast.AST | None, use: ast.expr) -> bool:
    """Return whether a marker is appended, published, or returned to such code."""
    match node:
        case ast.Call(func=ast.Attribute(attr="append", value=kept), args=[only]):
            return only is use and not _may_be_completed(types, kept)
        case ast.Call(func=ast.Attribute(attr="publish"), args=[only]):
            return only is use
        case ast.Return():
            return bool(_calls_appended(types, node))
    return isinstance(node, ast.List)


def _may_be_completed(types: MessageTypes, kept: ast.expr) -> bool:
    """Return whether code of the file changes markers in a list later."""
    module = types.module
    name = module.text(kept)
    for use in module.walk(type(kept)):
        if not isinstance(use, ast.expr) or use is kept or module.text(use) != name:
            continue
        above = module.parent(use)
        match above:
            case ast.Return() if isinstance(kept, ast.Attribute):
                return True  # the list of an object that is passed on
            case ast.Subscript(value=value) if value is use:
                if isinstance(module.parent(above), ast.Attribute):
                    return True
        if any(_changes(loop) for loop in _loops_over(module, use)):
            return True
    return False


def _loops_over(module: PythonModule, items: ast.expr) -> Iterator[ast.For]:
    """Yield the loops over a list, also through ``enumerate`` or ``zip``."""
    above = module.parent(items)
    if isinstance(above, ast.Call) and items in above.args:
        items, above = above, module.parent(above)
    if isinstance(above, ast.For) and above.iter is items:
        yield above


def _changes(loop: ast.For) -> bool:
    """Return whether a loop sets fields of the elements that it iterates over."""
    names = {node.id for node in ast.walk(loop.target) if isinstance(node, ast.Name)}
    for node in ast.walk(loop):
        if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            start: ast.expr = node
            while isinstance(start, ast.Attribute):
                start = start.value
            if isinstance(start, ast.Name) and start.id in names:
                return True
    return False


def _calls_appended(types: MessageTypes, node: ast.AST) -> Sequence[ast.Call]:
    """Return the calls of the enclosing function if all results are appended or published."""
    module = types.module
    function = module.enclosing_function(node)
    if function is None or function.decorator_list:
        return ()
    uses = [*module.index.names(function.name), *module.index.attributes(function.name)]
    calls = [module.parent(use) for use in uses]
    for use, call in zip(uses, calls, strict=True):
        match module.parent(call) if isinstance(call, ast.Call) and call.func is use else None:
            case ast.Call(func=ast.Attribute(attr="append" | "publish"), args=[only]) if (
                only is call
            ):
                continue
            case ast.ListComp(elt=only) as listed if only is call and _is_filling(types, listed):
                continue
        return ()
    return [call for call in calls if isinstance(call, ast.Call)]


def _is_filling(types: MessageTypes, listed: ast.ListComp) -> bool:
    """Return whether a list of markers is put into a message unchanged."""
    match types.module.parent(listed):
        case ast.Assign(targets=[ast.Attribute(attr="markers")]) | ast.keyword(arg="markers"):
            return True
    return False


def _loop_around(types: MessageTypes, made: ast.Assign) -> ast.For | ast.ListComp | None:
    """Return the loop that creates a marker, directly or through the enclosing function."""
    calls = _calls_appended(types, made)
    places: list[ast.AST] = [made, *(calls if len(calls) == 1 else ())]
    above = (parent for place in places for parent in types.module.parents(place))
    return next((parent for parent in above if isinstance(parent, ast.For | ast.ListComp)), None)


def _field_values(
    types: MessageTypes,
    uses: Sequence[ast.Attribute],
    words: Mapping[str, ast.expr],
    field: str,
) -> Iterator[ast.expr]:
    """Yield the values assigned to a field, or passed for it."""
    if field in words:
        yield words[field]
    for use in uses:
        if use.attr == field and isinstance(use.ctx, ast.Store):
            yield _assigned(types, use)


def _assigned(types: MessageTypes, target: ast.Attribute) -> ast.expr:
    """Return the value assigned to a target, also in a tuple; the target if unknown."""
    match above := types.module.parent(target):
        case ast.Assign(value=value):
            return value
        case ast.Tuple(elts=targets):
            match types.module.parent(above):
                case ast.Assign(value=ast.Tuple(elts=values)) if len(values) == len(targets):
                    return values[targets.index(target)]
    return target


def _ends_early(loop: ast.AST) -> bool:
    return any(isinstance(node, ast.Break | ast.Return) for node in ast.walk(loop))
