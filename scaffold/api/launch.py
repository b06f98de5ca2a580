"""Launch files in Python, XML and YAML."""

from __future__ import annotations

from scaffold.formats.xml import Attribute
from scaffold.model.launch.actions import (
    CALLBACKS,
    HANDLERS,
    Entity,
    describe,
    entities,
    function_of,
)
from scaffold.model.launch.calls import LaunchCall
from scaffold.model.launch.evaluation.conditions_in_markup import substitution_words
from scaffold.model.launch.evaluation.configurations import (
    BY_LAUNCH,
    is_named_elsewhere,
    may_be_set_elsewhere,
    set_names,
)
from scaffold.model.launch.evaluation.evaluator import SHARE
from scaffold.model.launch.evaluation.module_paths import NamedPath
from scaffold.model.launch.evaluation.share_paths import (
    has_similar_file,
    is_given_as_parameters,
    is_left_to_the_user,
    missing_in,
    named_paths,
    why_missing,
)
from scaffold.model.launch.files import DATA_DIRECTORIES, data_files, is_named, launch_files
from scaffold.model.launch.includes import (
    Given,
    Included,
    given_arguments,
    included,
    included_at,
)
from scaffold.model.launch.markup_file import (
    MarkupElement,
    MarkupFile,
    MarkupNode,
    is_known,
    markup_files,
    markup_paths,
)
from scaffold.model.launch.python_file import FUNCTION, NODES, LaunchFile, launch_paths
from scaffold.model.launch.signatures import ACTIONS, signature
from scaffold.model.launch.started.command_lines import (
    PROGRAM,
    UNSAID,
    CommandLine,
    Word,
    command_lines,
    processes,
    start_of_value,
    static_transforms,
)
from scaffold.model.launch.started.nodes import (
    GivenParameter,
    StartedNode,
    code_of,
    consumers,
    parameter_items,
    parameters_given,
    started_nodes,
)
from scaffold.model.launch.started.parameter_files import (
    is_loaded,
    is_only_loaded,
    node_names,
    nodes_for,
    use_of,
    values_in_files,
)
from scaffold.model.launch.started.references import Reference, exists, meant_package, package_uses
from scaffold.model.launch.started.remappings import (
    Remapped,
    names_of,
)
from scaffold.model.launch.unused.unlaunched import is_never_used, is_unread
from scaffold.model.launch.unused.unread_arguments import is_of_unread_argument, unread_arguments

__all__ = [
    "ACTIONS",
    "BY_LAUNCH",
    "CALLBACKS",
    "DATA_DIRECTORIES",
    "FUNCTION",
    "HANDLERS",
    "NODES",
    "PROGRAM",
    "SHARE",
    "UNSAID",
    "Attribute",
    "CommandLine",
    "Entity",
    "Given",
    "GivenParameter",
    "Included",
    "LaunchCall",
    "LaunchFile",
    "MarkupElement",
    "MarkupFile",
    "MarkupNode",
    "NamedPath",
    "Reference",
    "Remapped",
    "StartedNode",
    "Word",
    "code_of",
    "command_lines",
    "consumers",
    "data_files",
    "describe",
    "entities",
    "exists",
    "function_of",
    "given_arguments",
    "has_similar_file",
    "included",
    "included_at",
    "is_given_as_parameters",
    "is_known",
    "is_left_to_the_user",
    "is_loaded",
    "is_named",
    "is_named_elsewhere",
    "is_never_used",
    "is_of_unread_argument",
    "is_only_loaded",
    "is_unread",
    "launch_files",
    "launch_paths",
    "markup_files",
    "markup_paths",
    "may_be_set_elsewhere",
    "meant_package",
    "missing_in",
    "named_paths",
    "names_of",
    "node_names",
    "nodes_for",
    "package_uses",
    "parameter_items",
    "parameters_given",
    "processes",
    "set_names",
    "signature",
    "start_of_value",
    "started_nodes",
    "static_transforms",
    "substitution_words",
    "unread_arguments",
    "use_of",
    "values_in_files",
    "why_missing",
]
