"""Python files: names, scopes, calls, and static evaluation."""

from __future__ import annotations

from scaffold.model.contents.python_facts import (
    Exports,
    exports_of,
    imports_by_path,
    paths_importing,
    rospack_lookups,
)
from scaffold.model.python.conditions.guards import (
    Condition,
    all_conditions,
    caught_around,
    conditions_on,
    is_expected,
    is_guarded_by,
    is_handled,
    values_asked,
)
from scaffold.model.python.conditions.handlers import last_name
from scaffold.model.python.evaluation.given_arguments import (
    argument_of,
    arguments_for,
    given_argument,
)
from scaffold.model.python.evaluation.literals import joined_names
from scaffold.model.python.evaluation.returns import (
    is_generator,
    may_end,
    may_end_with_items,
    returned,
    value_set_before,
)
from scaffold.model.python.evaluation.values import (
    UNKNOWN,
    Glob,
    PathValue,
    Unknown,
    is_known,
    is_none_literal,
    kind_of,
)
from scaffold.model.python.imports import Import
from scaffold.model.python.module import PythonModule
from scaffold.model.python.scopes import FunctionNode

__all__ = [
    "UNKNOWN",
    "Condition",
    "Exports",
    "FunctionNode",
    "Glob",
    "Import",
    "PathValue",
    "PythonModule",
    "Unknown",
    "all_conditions",
    "argument_of",
    "arguments_for",
    "caught_around",
    "conditions_on",
    "exports_of",
    "given_argument",
    "imports_by_path",
    "is_expected",
    "is_generator",
    "is_guarded_by",
    "is_handled",
    "is_known",
    "is_none_literal",
    "joined_names",
    "kind_of",
    "last_name",
    "may_end",
    "may_end_with_items",
    "paths_importing",
    "returned",
    "rospack_lookups",
    "value_set_before",
    "values_asked",
]
