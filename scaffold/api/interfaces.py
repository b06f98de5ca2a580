"""Definitions of messages, services and actions."""

from __future__ import annotations

from scaffold.model.contents.interface_files import (
    interface_files,
    is_commented_out,
    names_used_in_code,
    problems,
    ungenerated_candidates,
)
from scaffold.model.interfaces.definitions import KINDS, Definitions, closest_word
from scaffold.model.interfaces.reserved_names import (
    reserved,
)
from scaffold.model.interfaces.syntax import SECTIONS, ProblemKind
from scaffold.model.interfaces.types import FLOATS, INTEGER_RANGES, TEXTS, FieldType

__all__ = [
    "FLOATS",
    "INTEGER_RANGES",
    "KINDS",
    "SECTIONS",
    "TEXTS",
    "Definitions",
    "FieldType",
    "ProblemKind",
    "closest_word",
    "interface_files",
    "is_commented_out",
    "names_used_in_code",
    "problems",
    "reserved",
    "ungenerated_candidates",
]
