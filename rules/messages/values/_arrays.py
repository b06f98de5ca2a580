"""Fields that are arrays or plain values, and what does not work with them."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api.interfaces import FLOATS, INTEGER_RANGES, FieldType
from scaffold.api.messages import MessageTypes, kind_of_field
from scaffold.api.python import argument_of

_NUMBERS = frozenset({"float", "int"})
KINDS: dict[str, type] = {"bool": bool, "float": float, "int": int, "str": str}
"""The Python types of plain fields."""
_OF_NUMPY = frozenset({"min", "max", "mean", "sum", "std", "shape", "size", "astype", "reshape"})
"""Attributes that only NumPy arrays have."""
_TAKING_OTHERS: Mapping[str, str] = {
    "numpy.fromstring": "TypeError; use numpy.frombuffer()",
    "cv2.imdecode": "cv2.error; use numpy.frombuffer({}, numpy.uint8)",
}
"""Functions that do not accept an ``array.array``, with the alternative."""
_CLOUD = "sensor_msgs_py.point_cloud2.read_points"
_COLUMNS = 2
_CALCULATING = ("mean", "average", "median", "std", "sum", "linalg.norm", "dot")
_IN_COLOR = frozenset({"bgr8", "rgb8", "bgra8", "rgba8", "bgr16", "rgb16", "8UC3"})
_IN_GRAY = frozenset({"mono8", "mono16", "32FC1", "16UC1", "8UC1"})


def problems(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield unsupported uses of fields, with the reason."""
    yield from _arrays_as_numbers(types)
    yield from _fields_in_arithmetic(types)
    yield from _arrays_given(types)
    yield from _written_as_json(types)
    yield from _columns_of_clouds(types)
    yield from _elements_indexed(types)
    yield from _shapes_unpacked(types)
    yield from _clouds_calculated(types)
    yield from _shapes_swapped(types)


def _arrays_as_numbers(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield uses of array and float fields that only integers support."""
    module = types.module
    for call in module.walk(ast.Call):
        match call:
            case ast.Call(func=ast.Name(id="range" | "float" | "int" as name), args=[value]):
                type_ = types.field_type_of(value)
                if type_ is None or module.index.lookup(name, call) is not None:
                    continue
                text = module.text(value)
                if type_.is_array and (name == "range" or type_.array_size is None):
                    use = f"use len({text})" if name == "range" else "use one of its elements"
                    yield call, f"{text} is an array, not a number: TypeError; {use}"
                elif name == "range" and kind_of_field(type_) in {"float", "str"}:
                    yield call, f"{text} is a {kind_of_field(type_)}, not an integer: TypeError"
    for node in module.walk(ast.Compare):
        type_ = types.field_type_of(node.left)
        is_order = isinstance(node.ops[0], ast.Lt | ast.LtE | ast.Gt | ast.GtE)
        is_array = type_ is not None and type_.is_array and type_.array_size is None
        if is_array and is_order and len(node.ops) == 1:
            text = module.text(node.left)
            if isinstance(types.file.evaluator.evaluate(node.comparators[0]), int | float):
                yield node, f"{text} is an array, not a number: TypeError; compare its elements"


def _fields_in_arithmetic(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield sums of a string and a number, and arithmetic with arrays as in NumPy."""
    module, evaluate = types.module, types.file.evaluator.evaluate
    for node in module.walk(ast.BinOp):
        for field, other in ((node.left, node.right), (node.right, node.left)):
            type_ = types.field_type_of(field)
            if type_ is None:
                continue
            value = evaluate(other)
            is_text = isinstance(value, str) or isinstance(other, ast.JoinedStr)
            if isinstance(node.op, ast.Add) and is_text and kind_of_field(type_) in _NUMBERS:
                text = module.text(field)
                yield (
                    node,
                    (
                        f"{text} is a number, which cannot be added to a str: TypeError; use an "
                        f"f-string"
                    ),
                )
            is_float = isinstance(value, float) or (
                isinstance(value, int) and not isinstance(node.op, ast.Mult)
            )
            if is_float and _is_plain_array(type_):
                text = module.text(field)
                yield (
                    node,
                    (
                        f"{text} is an array.array, not a NumPy array: TypeError; use "
                        f"numpy.array({text})"
                    ),
                )
    for attribute in module.walk(ast.Attribute):
        if attribute.attr in _OF_NUMPY and _is_plain_array(types.field_type_of(attribute.value)):
            text = module.text(attribute.value)
            message = f"{text} is an array.array, not a NumPy array: it has no {attribute.attr!r}"
            yield attribute, f"{message}: AttributeError; use numpy.array({text})"


def _is_plain_array(type_: FieldType | None) -> bool:
    """Return whether a field is an ``array.array``; fixed-size fields are NumPy arrays."""
    return (
        type_ is not None
        and type_.is_array
        and type_.array_size is None
        and (type_.name in FLOATS or type_.name in INTEGER_RANGES)
    )


def _arrays_given(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield arrays passed to functions of libraries that need their own type."""
    for call in types.module.calls_of(*_TAKING_OTHERS):
        advice = _TAKING_OTHERS[types.module.qualified_name(call.func) or ""]
        if call.args and _is_plain_array(types.field_type_of(call.args[0])):
            text, name = types.module.text(call.args[0]), types.module.text(call.func)
            yield call, f"{name}() does not accept {text}, an array.array: {advice.format(text)}"


def _written_as_json(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield the messages and arrays in dictionaries and lists that are written as JSON."""
    module = types.module
    for call in module.calls_of("json.dump", "json.dumps"):
        if call.args and {word.arg for word in call.keywords} <= {"indent", "sort_keys"}:
            for value in _contents(types, call.args[0]):
                is_array = _is_plain_array(types.field_type_of(value))
                owner = types.type_of(value)
                if is_array or owner is not None:
                    text = module.text(value)
                    what = f"a {owner.name}" if owner is not None else "an array.array"
                    hint = "its fields" if owner is not None else f"list({text})"
                    yield value, f"JSON cannot contain {text}, {what}: TypeError; write {hint}"


def _contents(types: MessageTypes, node: ast.expr) -> Iterator[ast.expr]:
    """Yield the innermost values of a dictionary or list."""
    value = types.file.evaluator.single_value(node)
    match value:
        case ast.Dict(values=parts) | ast.List(elts=parts) | ast.Tuple(elts=parts):
            for part in parts:
                yield from _contents(types, part)
        case _:
            yield node


def _columns_of_clouds(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield column accesses to points with named fields: ``read_points(msg)[:, 2]``."""
    for index in types.module.walk(ast.Subscript):
        match index.slice:
            case ast.Tuple(elts=elements) if len(elements) == _COLUMNS:
                made = types.file.evaluator.single_value(index.value)
                if isinstance(made, ast.Call) and _is_flat_cloud(types, made):
                    message = "read_points() returns an array with one dimension, whose fields have"
                    hint = "write ['x'], or use read_points_numpy()"
                    yield index, f"{message} names: IndexError; {hint}"


def _elements_indexed(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield elements of flat arrays that are used as rows: ``grid.data[y][x]``."""
    for index in types.module.walk(ast.Subscript):
        match index.value:
            case ast.Subscript(value=array, slice=row) if not isinstance(row, ast.Slice):
                type_ = types.field_type_of(array)
                if type_ is None or kind_of_field(types.field_type_of(index.value)) not in {
                    "int",
                    "float",
                }:
                    continue
                text = types.module.text(array)
                message = f"{text} is one array, row by row, whose elements are numbers: TypeError"
                yield index, f"{message}; write {text}[row * width + column]"


def _clouds_calculated(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield arrays of structured points passed to NumPy functions that need plain numbers."""
    for name in _CALCULATING:
        for call in types.module.calls_of(f"numpy.{name}"):
            made = types.file.evaluator.single_value(call.args[0]) if call.args else None
            if isinstance(made, ast.Call) and _is_flat_cloud(types, made):
                message = f"{name}() cannot use structured points: TypeError"
                yield call.args[0], f"{message}; use read_points_numpy()"


def _is_flat_cloud(types: MessageTypes, made: ast.Call) -> bool:
    is_cloud = types.module.qualified_name(made.func) == _CLOUD
    words = {word.arg for word in made.keywords}
    return is_cloud and words.isdisjoint({"reshape_organized_cloud", None}) and not made.args[4:]


def _shapes_unpacked(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield shapes of images of cv_bridge that are unpacked into too many or too few names."""
    for assigned in types.module.walk(ast.Assign):
        match assigned:
            case ast.Assign(
                targets=[ast.Tuple(elts=names)],
                value=ast.Attribute(attr="shape", value=image) as shape,
            ) if not any(isinstance(name, ast.Starred) for name in names):
                encoding = _encoding(types, image)
                text = types.module.text(shape)
                if encoding in _IN_COLOR and len(names) != len(("rows", "columns", "channels")):
                    problem = f"{text} has three values for {encoding}: ValueError"
                    yield shape, f"{problem}; write {text}[:2] for rows and columns"
                elif encoding in _IN_GRAY and len(names) != _COLUMNS:
                    yield shape, f"{text} has two values for {encoding}: ValueError"


def _encoding(types: MessageTypes, image: ast.expr) -> object:
    """Return the encoding of an image that cv_bridge just created, also in a method."""
    made: ast.expr | None = types.file.evaluator.single_value(image)
    if isinstance(made, ast.Call):
        function = types.file.callback(made.func).function
        if isinstance(function, ast.FunctionDef):
            last = function.body[-1]
            made = last.value if isinstance(last, ast.Return) else None
    match made:
        case ast.Call(func=ast.Attribute(attr="imgmsg_to_cv2")):
            given = argument_of(made, "desired_encoding", 1)
            return types.file.evaluator.evaluate(given) if given is not None else None
    return None


def _shapes_swapped(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield shapes for the data of an image or a map with the width first."""
    for call in types.module.walk(ast.Call):
        match call:
            case ast.Call(func=ast.Attribute(attr="reshape", value=data), args=args, keywords=[]):
                shape = args[0].elts if len(args) == 1 and isinstance(args[0], ast.Tuple) else args
            case _:
                continue
        match shape:
            case [
                ast.Attribute(attr="width", value=first),
                ast.Attribute(attr="height", value=second),
                *_,
            ] if types.module.text(first) == types.module.text(second):
                made = types.file.evaluator.single_value(data)
                message = types.module.text(first).removesuffix(".info")
                if f"{message}.data" in types.module.text(made):
                    text = types.module.text(first)
                    yield call, f"the shape is (rows, columns); write {text}.height, {text}.width"
