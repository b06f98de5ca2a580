"""Templates: directories with a ``template.yaml`` and ``*.jinja`` files.

A package is rendered from layers: the package template, the build type, its parts (nodes,
interfaces, programs) and its extras. The name of a directory is the name of the template, and its
parent directory is the role; a later content directory overrides templates with the same name.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Any

from scaffold.record import NamedTuple

MANIFEST = "template.yaml"
ENDING = ".jinja"
MAX_BYTES = 1_000_000
"""The size limit of template and answers files; typical ones have a few kB."""
BASE = "package"
"""The template that every package is built on."""
DEPEND_KINDS = ("buildtool", "build", "build_export", "depend", "exec", "test")
"""The kinds of dependencies that a template may declare; ``depend`` is the tag of that name."""


class Role(Enum):
    """The role of a template."""

    PACKAGE = "package"
    """Files that every package has."""
    BUILD_TYPE = "build_type"
    """Files of a build system; its name is the build type in package.xml."""
    NODE = "node"
    """A Python node and its test; rendered once for each node."""
    INTERFACE = "interface"
    """A definition of a message, a service or an action; rendered once for each."""
    PROGRAM = "program"
    """A C++ program; rendered once for each."""
    EXTRA = "extra"
    """An optional addition: a launch file, a CI workflow."""


FOLDERS = {
    "build_types": Role.BUILD_TYPE,
    "nodes": Role.NODE,
    "interfaces": Role.INTERFACE,
    "programs": Role.PROGRAM,
    "extras": Role.EXTRA,
}
"""The directories of the roles; ``package`` is itself the template of every package."""
PARTS = (Role.NODE, Role.INTERFACE, Role.PROGRAM)
"""The roles of parts; the value of the role is the variable in the templates."""


class Question(NamedTuple):
    """A question of a template."""

    name: str
    type: str
    """One of `scaffold.generate.questions.answer_types.TYPES`."""
    help: str
    default: Any
    """A value, or a Jinja text over the other answers; ``None`` when there is none."""
    choices: tuple[str, ...]
    is_positional: bool
    metavar: str | None
    direction: str = ""
    """Of a topic: ``published`` or ``subscribed``; empty if that is not known."""


class Template(NamedTuple):
    """A template as declared by its ``template.yaml``."""

    name: str
    directory: str
    role: Role
    summary: str
    section: str
    """The heading in lists of templates."""
    questions: tuple[Question, ...]
    executable_name: str
    """Of a build type: the name of a node for ``ros2 run``, a Jinja text over ``node``."""
    parameter_file: str
    """Of a node with parameters: its parameter file, a Jinja text over ``node``."""
    definition: str
    """Of an interface: the directory and the ending of its file, ``msg``, ``srv`` or ``action``."""
    build_types: Sequence[str]
    """The supported build types; all if empty."""
    depends: Mapping[str, Sequence[str]]
    """Dependencies by kind: Jinja templates of names separated by spaces."""
    groups: Sequence[str]
    """Groups that the package becomes a member of, in package.xml."""
    installs: Sequence[str]
    """Directories that are installed to ``share/<package>``."""
    tests: Sequence[str]
    """The tests of an extra; those of nodes follow from their names."""
    is_alone: bool
    """Whether a package may consist of the extra, without any part."""
    include: Mapping[str, str]
    """Conditions (Jinja expressions) by path pattern; a file without one is always written."""
    executable: Sequence[str]
    """Path patterns of files with executable bits."""
    repository: Sequence[str]
    """Path patterns of files that tools only read at the top of a git repository."""
    notes: Mapping[str, str]
    """The purposes of files, by path pattern."""
    examples: Mapping[str, Mapping[str, Any]]
    """Answers by title: tests, and documentation."""
    overrides: Sequence[str] = ()
    """Directories with files that override its own; a later one wins."""

    @property
    def directories(self) -> list[str]:
        """The directories of its files, in order of precedence."""
        return [*reversed(self.overrides), self.directory]

    @property
    def needs_nodes(self) -> bool:
        """Whether it has nothing to write for a package without nodes."""
        return self.include.get("*") == "nodes"

    @property
    def name_question(self) -> str:
        """The question for the name of a part: ``node_name``, ``interface_name`` ..."""
        return f"{self.role.value}_name"


def of_role(templates: Mapping[str, Template], role: Role) -> tuple[str, ...]:
    """Return the names of the templates of a role."""
    return tuple(name for name, template in templates.items() if template.role is role)
