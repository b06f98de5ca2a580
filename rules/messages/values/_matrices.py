"""Rows and columns of images, maps and matrices that are taken the wrong way."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api.messages import MessageTypes

Flaw = tuple[ast.expr, str]
"""The place and the problem."""
_WIDTHS = frozenset(
    {("nav_msgs/msg/MapMetaData", "width"), ("sensor_msgs/msg/Image", "width")}
    | {("sensor_msgs/msg/CameraInfo", "width")}
)
_TURNED = (".T", "transpose", "swapaxes", "rot90", "'F'", '"F"', "moveaxis")
"""Words in code that transposes its arrays."""
_SIZES = {36: 6, 9: 3}
"""The numbers of rows of the matrices in messages, by the numbers of elements."""
_ACROSS = frozenset({"w", "width", "cols", "columns", "img_w", "img_width", "image_width"})
_DOWN = frozenset({"h", "height", "rows", "img_h", "img_height", "image_height"})
_MAX_ARRAYS = 20
"""The maximum number of arrays to trace an array through."""
_SHAPED = re.compile(
    r"\.shape = |reshape\(w"
    r"|(?:zeros|ones|full|empty|reshape)\(\(\s{0,9}(?:self\.)?(?:w\b|\w{0,20}(?:width|cols)\b)"
)
"""Matches code that creates arrays with the width first."""


def flaws(types: MessageTypes) -> Iterator[Flaw]:
    """Yield swapped widths and heights, shapes with the width first, and variances in a row."""
    module = types.module
    is_across = _SHAPED.search(module.source.text) is not None
    for item in () if is_across else types.assigned:
        key = (item.owner.name, item.field.name)
        if key in _WIDTHS and _is_height(types, item.holder, item.value):
            text = module.text(item.value).rpartition("[")[0]
            yield item.value, f"{text}[0] is the number of rows, the height; width is {text}[1]"
    for call in module.walk(ast.Call):
        turned = _turned_shape(types, call)
        if turned:
            yield call.args[0], f"an image or a map has rows first: write reshape({turned})"
    for assigned in module.walk(ast.Assign):
        image = _turned_image(assigned)
        if image and not is_across and not _is_transposed(types, image):
            message = "a shape has the height first: write height, width = ....shape[:2]"
            yield assigned.targets[0], message
        count = _first_row(types, assigned)
        if count:
            message = (
                f"this fills the first row of the matrix; the variances are on its diagonal: "
                f"write [{count + 1} * {module.text(_index(assigned.targets[0]))}]"
            )
            yield assigned.targets[0], message


def _is_height(types: MessageTypes, holder: ast.expr, width: ast.expr) -> bool:
    """Return whether ``width`` is ``shape[0]`` and ``height`` is ``shape[1]`` of an array."""
    module = types.module
    function = module.enclosing_function(holder)
    match width:
        case ast.Subscript(value=ast.Attribute(attr="shape"), slice=ast.Constant(value=0)) if (
            function is not None and not any(word in module.text(function) for word in _TURNED)
        ):
            rows = module.text(width.value)
            return any(
                item.field.name == "height"
                and module.text(item.holder) == module.text(holder)
                and module.text(item.value) == f"{rows}[1]"
                for item in types.assigned
                if module.enclosing_function(item.holder) is function
            )
    return False


def _index(target: ast.expr) -> ast.expr:
    return target.slice if isinstance(target, ast.Subscript) else target


def _first_row(types: MessageTypes, assigned: ast.Assign) -> int:
    """Return the number of rows of a covariance if a loop fills the first row; otherwise 0."""
    match assigned:
        case ast.Assign(targets=[ast.Subscript(value=matrix, slice=ast.Name(id=name))]):
            rows = _SIZES.get(_elements_of(types, matrix), 0)
            loop = types.module.parent(assigned)
            match loop:
                case ast.For(
                    target=ast.Name(id=counter), iter=ast.Call(func=ast.Name("range"), args=[end])
                ) if counter == name and types.file.evaluator.evaluate(end) == rows:
                    return rows
    return 0


def _elements_of(types: MessageTypes, matrix: ast.expr) -> int:
    """Return the number of elements of a covariance: a field, or a list with such a name."""
    match matrix:
        case ast.Attribute(attr=name) if name.endswith("covariance"):
            type_ = types.field_type_of(matrix)
            return (type_.array_size or 0) if type_ is not None else 0
        case ast.Name(id=name) if "cov" in name:
            match types.file.evaluator.single_value(matrix):
                case ast.BinOp(left=ast.List(elts=[_]), op=ast.Mult(), right=count):
                    number = types.file.evaluator.evaluate(count)
                    return number if isinstance(number, int) else 0
    return 0


def _turned_shape(types: MessageTypes, call: ast.Call) -> str:
    """Return the right shape if data of a message is reshaped with the width first."""
    module = types.module
    if not isinstance(call.func, ast.Attribute) or call.func.attr != "reshape":
        return ""
    shape = call.args[0].elts if call.args and isinstance(call.args[0], ast.Tuple) else call.args
    match [types.file.evaluator.single_value(item) for item in shape[:2]]:
        case [
            ast.Attribute(attr="width", value=first),
            ast.Attribute(attr="height", value=second),
        ] if module.text(first) == module.text(second) and _has_rows(types, first):
            function = module.enclosing_function(call)
            text = module.text(function or module.tree)
            if any(word in text for word in _TURNED):
                return ""
            if any(word.arg == "order" for word in call.keywords):
                return ""
            words = [module.text(item) for item in (shape[1], shape[0], *shape[2:])]
            return ", ".join(words)
    return ""


def _has_rows(types: MessageTypes, message: ast.expr) -> bool:
    """Return whether the data of a message is in rows by its definition."""
    type_ = types.type_of(message)
    if type_ is None and isinstance(message, ast.Name):
        for binding in types.module.index.bindings_of(message):
            annotation = getattr(binding.node, "annotation", None)
            type_ = types.class_of(annotation) if annotation is not None else None
    return type_ is not None and (type_.name, "width") in _WIDTHS


def _turned_image(assigned: ast.Assign) -> ast.expr | None:
    """Return the image whose height and width are swapped when its shape is read."""
    match assigned:
        case ast.Assign(
            targets=[ast.Tuple(elts=[ast.Name(id=first), ast.Name(id=second), *_])],
            value=ast.Attribute(attr="shape", value=image)
            | ast.Subscript(value=ast.Attribute(attr="shape", value=image)),
        ):
            return image if first in _ACROSS and second in _DOWN else None
    return None


def _is_transposed(types: MessageTypes, image: ast.expr) -> bool:
    """Return whether an array, or its origin, is transposed."""
    pending = [image]
    for array in pending:
        if any(word in types.module.text(array) for word in _TURNED):
            return True
        match array:
            case ast.Subscript(value=whole) | ast.Call(func=ast.Attribute(value=whole)):
                pending.append(whole)
            case ast.Name() | ast.Attribute() if len(pending) < _MAX_ARRAYS:
                pending += types.file.evaluator.values(array)
    return False
