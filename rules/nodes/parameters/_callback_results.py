"""Return values of parameter callbacks that rclpy rejects."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, TypeGuard

from scaffold.api.python import is_generator, may_end, returned
from scaffold.api.rclpy import CALLBACKS, message_made

if TYPE_CHECKING:
    from scaffold.api.rclpy import RclpyFile

_PRE = CALLBACKS[-1]
RESULT = "rcl_interfaces.msg.SetParametersResult"
_MESSAGE = r"\w+\.(?:msg|srv|action)\.\w+"
_REFUSED = "every change is rejected"


def wrong_value(method: str, file: RclpyFile, value: ast.expr | None) -> str:
    """Return the problem with the result of an added callback; empty if none."""
    return (_wrong_list if method == _PRE else _wrong_result)(file, value)


def _wrong_result(file: RclpyFile, value: ast.expr | None) -> str:
    """Return the problem with a value instead of a SetParametersResult; empty if none."""
    if value is None:
        return f"nothing, not a SetParametersResult: {_REFUSED}"
    fields = message_made(file.evaluator, _returned_by(file, value) or value, RESULT)
    if fields is not None:
        is_refusal = "successful" not in fields
        return f"a SetParametersResult without successful=True: {_REFUSED}" if is_refusal else ""
    value = file.evaluator.single_value(value)
    full = file.module.qualified_name(value.func if isinstance(value, ast.Call) else value) or ""
    problem = ""
    if isinstance(value, ast.Constant):
        problem = repr(value.value)
    elif isinstance(value, ast.List | ast.Tuple | ast.Dict):
        problem = f"a {type(value).__name__.lower()}"
    elif full == RESULT and not isinstance(value, ast.Call):
        return "the class SetParametersResult; instantiate it with successful=True"
    elif full != RESULT and re.fullmatch(_MESSAGE, full) and full[0] != ".":
        problem = f"a {full.rpartition('.')[2]}"
    elif isinstance(value, ast.Call) and (constants := _plain_results(file, value)):
        problem = f"the result of {file.module.text(value.func)}(), which is {constants}"
    return f"{problem}, not a SetParametersResult: {_REFUSED}" if problem else ""


def _returned_by(file: RclpyFile, value: ast.expr) -> ast.Call | None:
    """Return the call that a function of the file returns, and nothing else."""
    function = file.callback(value.func).function if isinstance(value, ast.Call) else None
    values = [item.value for item in returned(function)] if _is_plain(function) else []
    return values[0] if len(values) == 1 and isinstance(values[0], ast.Call) else None


def _is_plain(function: object) -> TypeGuard[ast.FunctionDef]:
    return isinstance(function, ast.FunctionDef) and not function.decorator_list


def _wrong_list(file: RclpyFile, value: ast.expr | None) -> str:
    """Return the problem with a value instead of a list of parameters; empty if none."""
    made = file.evaluator.single_value(value) if value is not None else None
    if made is None or (isinstance(made, ast.Constant) and made.value in {None, True, False}):
        return "nothing, not the list of parameters to set: TypeError"
    full = file.module.qualified_name(made.func) if isinstance(made, ast.Call) else None
    return "a SetParametersResult, not the list of parameters: TypeError" if full == RESULT else ""


def _plain_results(file: RclpyFile, call: ast.Call) -> str:
    """Return the results of a function of the file if they are constants; else empty."""
    function = file.callback(call.func).function
    if not isinstance(function, ast.FunctionDef) or function.decorator_list:
        return ""
    class_ = file.module.enclosing_class(function)
    if is_generator(function) or (class_ and len(file.related_classes(class_)) > 1):
        return ""
    values = [item.value for item in returned(function)]
    if not all(value is None or isinstance(value, ast.Constant) for value in values):
        return ""
    texts = ["None" if value is None else ast.unparse(value) for value in values]
    return " or ".join(dict.fromkeys([*texts, *(["None"] if may_end(function) else [])]))
