"""Adds a node to the launch file of a package."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from scaffold.edits import Edit
from scaffold.generate.edit.addition import Addition, ByHand, Outcome, Program, spliced
from scaffold.model.launch.calls import LaunchCall
from scaffold.model.launch.python_file import FUNCTION, LaunchFile
from scaffold.model.python.evaluation.returns import returned
from scaffold.model.python.module import PythonModule
from scaffold.model.setup_py import edit as setup_edit
from scaffold.model.setup_py.edit import Block
from scaffold.source import Source

_MARKUP = {
    ".xml": '<node pkg="{}" exec="{}"/>',
    ".yaml": "- node: {{pkg: {}, exec: {}}}",
    ".yml": "- node: {{pkg: {}, exec: {}}}",
}

_NOT_CLEAR = "it is not clear where its LaunchDescription is filled"
_NO_NODE = "it starts no node of {} that shows how"


def add_to_launch(source: Source, addition: Addition) -> Outcome:
    """Add a node to a launch file that starts nodes of the package already.

    It is left to the user where no edit is safe.

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
    if any(launch.text(call, "executable") == program.name for call in own):
        return Outcome(source)
    edits = _edits(launch, own, program) if own else []
    if edits:
        changed = spliced(source, edits)
        if _starts(changed, addition.package, program):
            return Outcome(changed)
    line = f"Node(package='{addition.package}', executable='{program.name}'),"
    reason = _NOT_CLEAR if own else _NO_NODE.format(addition.package)
    return Outcome(source, (ByHand(source.path, line, reason, is_needed=False),))


def _markup(source: Source, form: str, package: str, program: Program) -> Outcome:
    """Leave a launch file in XML or YAML to the user."""
    starts = re.search(rf"""\bpkg(=["']|: *["']?){re.escape(package)}\b""", source.text)
    if starts and re.search(rf"\b{re.escape(program.name)}\b", source.text):
        return Outcome(source)
    line = form.format(package, program.name)
    reason = "only Python launch files can be edited"
    return Outcome(source, (ByHand(source.path, line, reason, is_needed=False),))


def _starts(source: Source, package: str, program: Program) -> bool:
    launch = LaunchFile(PythonModule.parse(source), package)
    return any(
        launch.text(call, "package") == package and launch.text(call, "executable") == program.name
        for call in launch.find("Node")
    )


class _Description(NamedTuple):
    """How a launch file builds its LaunchDescription in the body of its function."""

    assigned: Mapping[ast.expr, tuple[str, ast.stmt]]
    """Assignments of local variables."""
    entities: ast.List | None
    """The list passed to ``LaunchDescription``."""
    variable: str
    """Its variable; empty if it is returned directly."""
    added: Sequence[tuple[ast.stmt, ast.expr]]
    """Arguments of ``add_action``, with their statements."""

    @property
    def actions(self) -> list[ast.expr]:
        """What is started, in order."""
        listed = self.entities.elts if self.entities is not None else []
        return [*listed, *(action for _, action in self.added)]


def _edits(launch: LaunchFile, own: list[LaunchCall], program: Program) -> list[Edit]:
    """Return the edits that start a node like the last one: inline, or with a variable."""
    description = _description(launch)
    if description is None or not description.actions:
        return []
    written = [call for call in own if call.call in description.actions]
    if written:
        return [_action(launch, description, _node(launch, written[-1], program))]
    named = [call for call in own if call.call in description.assigned]
    stem = re.sub(r"\W", "_", program.name.removesuffix(".py"))
    name = f"{stem}_node"
    if not named or re.search(rf"\b{name}\b", launch.module.source.text):
        return []
    node = _node(launch, named[-1], program)
    _, statement = description.assigned[named[-1].call]
    assignment = _insert_below(launch, statement, _wrapped(f"{name} = ", node, ""))
    return [assignment, _action(launch, description, name)]


def _description(launch: LaunchFile) -> _Description | None:
    function = launch.module.functions.get(FUNCTION)
    statements = returned(function.node) if function is not None else []
    if function is None or len(statements) != 1:
        return None
    body, value = function.node.body, statements[0].value
    assigned = {
        statement.value: (target.id, statement)
        for statement in body
        if isinstance(statement, ast.Assign)
        for target in statement.targets[:1]
        if isinstance(target, ast.Name) and len(statement.targets) == 1
    }
    variable = value.id if isinstance(value, ast.Name) else ""
    values = [item for item, (name, _) in assigned.items() if name == variable]
    call = launch.call_of(values[0] if len(values) == 1 else value)
    if call is None or call.kind != "LaunchDescription":
        return None
    entities = call.given.get("initial_entities")
    return _Description(
        assigned,
        entities if isinstance(entities, ast.List) else None,
        variable,
        list(_added(body, variable)),
    )


def _added(body: Sequence[ast.stmt], variable: str) -> Iterator[tuple[ast.stmt, ast.expr]]:
    for statement in body:
        match statement:
            case ast.Expr(
                value=ast.Call(
                    func=ast.Attribute(value=ast.Name(id=name), attr="add_action"), args=[action]
                )
            ) if name == variable:
                yield statement, action


def _action(launch: LaunchFile, description: _Description, action: str | Block) -> Edit:
    """Return the edit that appends an action."""
    entities = description.entities
    if entities is None or description.added:
        call = _wrapped(f"{description.variable}.add_action(", action, ")")
        return _insert_below(launch, description.added[-1][0], call)
    return setup_edit.append_item(launch.module, entities, entities.elts, action)


def _wrapped(opening: str, node: str | Block, closing: str) -> str | Block:
    if isinstance(node, str):
        return f"{opening}{node}{closing}"
    return Block(f"{opening}{node.opening}", f"{node.closing}{closing}", node.items)


def _insert_below(launch: LaunchFile, statement: ast.stmt, added: str | Block) -> Edit:
    """Return the edit that adds a statement below another one."""
    source = launch.module.source
    line = source.lines[statement.lineno - 1]
    indent = line[: len(line) - len(line.lstrip())]
    number = statement.end_lineno or statement.lineno
    at = source.offset(number) + len(source.lines[number - 1])
    text = added if isinstance(added, str) else added.render(indent, source.newline)
    gap = source.newline if isinstance(added, Block) and _is_apart(source, number) else ""
    return Edit(source.path, at, at, f"{gap}{source.newline}{indent}{text}")


def _is_apart(source: Source, number: int) -> bool:
    """Return whether a blank line follows a line, by its number from 1."""
    return number < len(source.lines) and not source.lines[number].strip()


def _shared(module: PythonModule, key: str, value: ast.expr) -> str:
    """Return the part of an argument of a node that applies to another node; empty if none does."""
    match key, value:
        case "parameters", ast.List(elts=items):
            shared = [module.text(item) for item in items if _is_clock_setting(item)]
            return f"[{', '.join(shared)}]" if shared else ""
        case "arguments", ast.List(
            elts=[ast.Constant("--ros-args"), ast.Constant("--log-level"), _]
        ):
            return module.text(value)
        case (("parameters" | "arguments"), _):
            return ""
    return module.text(value)


def _is_clock_setting(item: ast.expr) -> bool:
    """Return whether a dictionary of parameters sets only ``use_sim_time``."""
    return isinstance(item, ast.Dict) and all(
        isinstance(key, ast.Constant) and key.value == "use_sim_time" for key in item.keys
    )


def _node(launch: LaunchFile, like: LaunchCall, program: Program) -> str | Block:
    """Return a node formatted like another one, with what applies to all nodes of the file."""
    module = launch.module
    package = module.text(like.given["package"])
    texts = [module.text(node) for node in like.given.values()]
    quote = next((text[0] for text in texts if text[0] in {"'", '"'}), "'")
    words = [f"package={package}", f"executable={quote}{program.name}{quote}"]
    words += [
        f"{key}={text}"
        for key in ("namespace", "parameters", "arguments", "output")
        if key in like.given and (text := _shared(module, key, like.given[key]))
    ]
    name = module.text(like.call.func)
    if "\n" in module.text(like.call):
        return Block(f"{name}(", ")", tuple(words))
    return f"{name}({', '.join(words)})"
