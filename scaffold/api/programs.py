"""The programs of a package: executables, entry points, threads, executors."""

from __future__ import annotations

from scaffold.model.programs.blocking import (
    Executed,
    Phases,
    Waits,
    blocks_node,
    client_at,
    client_of,
    in_callbacks,
    in_constructors,
    in_helpers,
    in_tasks,
    may_run_meanwhile,
    phases_of,
    waits_alone,
    waits_in,
)
from scaffold.model.programs.entry_points import (
    Execution,
    entry_points_of,
    execution_of,
    imported_paths,
)
from scaffold.model.programs.executables import programs_of
from scaffold.model.programs.known_nodes import KnownNode
from scaffold.model.programs.publishing import publish_calls
from scaffold.model.programs.threads import (
    names_callback_group,
    names_other_executor,
    share_group,
    spins_elsewhere,
    spins_in_one_thread,
)
from scaffold.model.programs.topics import (
    NamedEndpoint,
    is_named_in_compiled_code,
    is_private,
    is_remapped,
    named_endpoints,
    one_sided,
    services_of,
    topics_of,
)

__all__ = [
    "Executed",
    "Execution",
    "KnownNode",
    "NamedEndpoint",
    "Phases",
    "Waits",
    "blocks_node",
    "client_at",
    "client_of",
    "entry_points_of",
    "execution_of",
    "imported_paths",
    "in_callbacks",
    "in_constructors",
    "in_helpers",
    "in_tasks",
    "is_named_in_compiled_code",
    "is_private",
    "is_remapped",
    "may_run_meanwhile",
    "named_endpoints",
    "names_callback_group",
    "names_other_executor",
    "one_sided",
    "phases_of",
    "programs_of",
    "publish_calls",
    "services_of",
    "share_group",
    "spins_elsewhere",
    "spins_in_one_thread",
    "topics_of",
    "waits_alone",
    "waits_in",
]
