"""Names that questions may not have, because they would shadow template variables."""

from __future__ import annotations

import os
from collections.abc import Mapping

from scaffold.errors import ContentError

TYPE_CHECKING = False  # that of typing is slow to import
if TYPE_CHECKING:
    from scaffold.generate.templates.template import Template

_FLAGS = frozenset(
    {
        *("answers", "content", "destination_directory", "diff", "dry_run"),
        *("force", "help", "launch", "package_directory"),
    }
)
"""The names of the options of `new` and `add`."""
_VARIABLES = frozenset(
    {
        *("contents", "contributing_text", "date", "depends", "groups", "has_license", "header"),
        *("interface", "interfaces", "is_added", "license_text", "node", "nodes", "program"),
        *("programs", "share_directories", "subdirectory", "target", "tests", "tutorial"),
        *("class_name", "executable", "file", "has_parameters", "module", "parameter_file"),
        *("has", "imports", "kind", "name", "summary", "type", "version", "year"),
        *("h", "entry", "templates", "verb", "command_line"),  # of the command line
    }
)
"""Variables of templates besides answers, and attributes of parts besides answers."""


def refuse_shadowing(templates: Mapping[str, Template], base: str, manifest: str) -> None:
    """Raise ContentError if the name of a question is reserved.

    Args:
        templates: All templates.
        base: The name of the template that every package is built on.
        manifest: The name of the file with the questions.
    """
    owners = {item.name: base for item in templates[base].questions}
    of_parts: dict[str, str] = {}
    for template in templates.values():
        is_part = template.name_question in {item.name for item in template.questions}
        for question in template.questions:
            name = question.name
            if name in _FLAGS or name in _VARIABLES:
                taken_by = (
                    f"the option --{name.replace('_', '-')}" if name in _FLAGS else "a variable"
                )
                _refuse(template, manifest, name, f"{taken_by} of ours")
            if template.name != base and owners.get(name) == base:
                _refuse(template, manifest, name, f"the question of {base}")
            if is_part:
                of_parts.setdefault(name, template.name)
    for template in templates.values():
        is_part = template.name_question in {item.name for item in template.questions}
        for question in template.questions if not is_part else ():
            if question.name in of_parts:
                of = f"the question of {of_parts[question.name]}"
                _refuse(template, manifest, question.name, of)


def _refuse(template: Template, manifest: str, name: str, taken_by: str) -> None:
    path = os.path.join(template.directory, manifest)
    raise ContentError(f"{path}: the question {name!r} shadows {taken_by}; rename it")
