"""Findings of the type checker, and the exact names in its messages."""

from __future__ import annotations

from scaffold.types.finding import TypeFinding
from scaffold.types.python_modules import later_modules
from scaffold.types.stubs.marks import MARK, MARKED, full_name, short_name
from scaffold.types.stubs.members import (
    has_call,
    is_kind_of,
    keywords,
    members,
    module_names,
    modules_with,
    overload_problem,
    own_members,
    parameters,
)
from scaffold.types.wording import (
    class_in,
    class_itself,
    elements_misfit,
    in_words,
    is_certain,
    is_certain_misfit,
    is_function,
    name_of,
    unlike,
    with_article,
)

__all__ = [
    "MARK",
    "MARKED",
    "TypeFinding",
    "class_in",
    "class_itself",
    "elements_misfit",
    "full_name",
    "has_call",
    "in_words",
    "is_certain",
    "is_certain_misfit",
    "is_function",
    "is_kind_of",
    "keywords",
    "later_modules",
    "members",
    "module_names",
    "modules_with",
    "name_of",
    "overload_problem",
    "own_members",
    "parameters",
    "short_name",
    "unlike",
    "with_article",
]
