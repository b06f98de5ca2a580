"""Parameters: what nodes declare and what YAML files set."""

from __future__ import annotations

from scaffold.model.parameters.declared import (
    Declared,
    DeclaredParameter,
    declared_alone,
    declared_by,
    has_always,
    own_nodes,
    place_of,
)
from scaffold.model.parameters.files import (
    KEY,
    Entry,
    Misplaced,
    ParameterFile,
    Section,
    mistake,
    mixed,
    number_of,
    parameter_file,
    parameter_files,
    parameter_paths,
    scalar_type,
    value_type,
)
from scaffold.model.parameters.topic_names import is_named_in_launch_files, keeps_default_name
from scaffold.model.parameters.types import a_type, agreed_type, narrow_default

__all__ = [
    "KEY",
    "Declared",
    "DeclaredParameter",
    "Entry",
    "Misplaced",
    "ParameterFile",
    "Section",
    "a_type",
    "agreed_type",
    "declared_alone",
    "declared_by",
    "has_always",
    "is_named_in_launch_files",
    "keeps_default_name",
    "mistake",
    "mixed",
    "narrow_default",
    "number_of",
    "own_nodes",
    "parameter_file",
    "parameter_files",
    "parameter_paths",
    "place_of",
    "scalar_type",
    "value_type",
]
