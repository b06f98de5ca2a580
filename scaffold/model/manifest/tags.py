"""The dependency tags of package.xml, and the dependency types they declare."""

from __future__ import annotations

PURPOSES: dict[str, frozenset[str]] = {
    "buildtool_depend": frozenset({"build"}),
    "buildtool_export_depend": frozenset({"build_export"}),
    "build_depend": frozenset({"build"}),
    "build_export_depend": frozenset({"build_export"}),
    "run_depend": frozenset({"build_export", "run"}),
    "exec_depend": frozenset({"run"}),
    "depend": frozenset({"build", "build_export", "run"}),
    "doc_depend": frozenset({"doc"}),
    "test_depend": frozenset({"test"}),
}
"""When a dependency of each tag is needed: to build, to build against, to run, to test."""
DEPENDENCY_TAGS = tuple(PURPOSES)
"""The tags of dependencies on packages, in customary order."""
