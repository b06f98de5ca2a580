"""Adds a node to the launch file of a package."""

from __future__ import annotations

import ast
import re

from scaffold.check.diagnostic import Edit
from scaffold.generate.edit.addition import Addition, ByHand, Outcome, Program, spliced
from scaffold.model import setup_edit
from scaffold.model.launch_py import FUNCTION, LaunchCall, LaunchFile, returns
from scaffold.model.python_module import PythonModule
from scaffold.model.setup_edit import Block
from scaffold.model.source import Source

_MARKUP = {
    ".xml": '<node pkg="{}" exec="{}"/>',
    ".yaml": "- node: {{pkg: {}, exec: {}}}",
    ".yml": "- node: {{pkg: {}, exec: {}}}",
}


def add_to_launch(source: Source, addition: Addition) -> Outcome:
    """Start a node in a launch file that starts nodes of its package already.

    Raises:
        ViewError: the file cannot be parsed.
    """
    program = addition.program
    if program is None or not program.is_node:
        return Outcome(source)
    ending = source.path[source.path.rfind(".") :]
    if ending in _MARKUP:
        return _markup(source, _MARKUP[ending], addition.package, program)
    launch = LaunchFile(PythonModule.parse(source), addition.package)
    own = [call for call in launch.find("Node") if launch.text(call, "package") == addition.package]
    if not own or any(launch.text(call, "executable") == program.name for call in own):
        return Outcome(source)
    edit = _edit(launch, own, program)
    if edit is not None:
        changed = spliced(source, [edit])
        if _starts(changed, addition.package, program):
            return Outcome(changed)
    line = f"Node(package='{addition.package}', executable='{program.name}'),"
    reason = "it does not return LaunchDescription([...]) with the nodes written out in the list"
    return Outcome(source, (ByHand(source.path, line, reason, is_needed=False),))


def _markup(source: Source, form: str, package: str, program: Program) -> Outcome:
    """Leave a launch file in XML or YAML to the user, if it starts nodes of the package."""
    starts = re.search(rf"""\bpkg(=["']|: *["']?){re.escape(package)}\b""", source.text)
    if starts is None or re.search(rf"\b{re.escape(program.name)}\b", source.text):
        return Outcome(source)
    line = form.format(package, program.name)
    reason = "only launch files in Python are edited"
    return Outcome(source, (ByHand(source.path, line, reason, is_needed=False),))


def _starts(source: Source, package: str, program: Program) -> bool:
    launch = LaunchFile(PythonModule.parse(source), package)
    return any(
        launch.text(call, "package") == package and launch.text(call, "executable") == program.name
        for call in launch.find("Node")
    )


def _edit(launch: LaunchFile, own: list[LaunchCall], program: Program) -> Edit | None:
    entities = _entities(launch)
    if entities is None:
        return None
    like = [call for call in own if call.call in entities.elts]
    if not like:
        return None
    return setup_edit.append_item(
        launch.module, entities, entities.elts, _node(launch, like[-1], program)
    )


def _entities(launch: LaunchFile) -> ast.List | None:
    """Return the list in the one ``return LaunchDescription([...])``."""
    function = launch.module.functions.get(FUNCTION)
    if function is None:
        return None
    found, _ = returns(function.node)
    call = launch.call_of(found[0].value) if len(found) == 1 else None
    if call is None or call.kind != "LaunchDescription":
        return None
    entities = call.given.get("initial_entities")
    return entities if isinstance(entities, ast.List) else None


def _node(launch: LaunchFile, like: LaunchCall, program: Program) -> str | Block:
    """Return a node written like another one, with its package and its output."""
    module = launch.module
    package = module.text(like.given["package"])
    texts = [module.text(node) for node in like.given.values()]
    quote = next((text[0] for text in texts if text[0] in {"'", '"'}), "'")
    words = [f"package={package}", f"executable={quote}{program.name}{quote}"]
    if "output" in like.given:
        words.append(f"output={module.text(like.given['output'])}")
    name = module.text(like.call.func)
    if "\n" in module.text(like.call):
        return Block(f"{name}(", ")", tuple(words))
    return f"{name}({', '.join(words)})"
