"""Binds the attributes and blocks of a macro call to the parameters of the macro."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.model.robot.expressions import Value, unknown
from scaffold.model.robot.xacro.scopes import Block, Frame, Macro, Scope

if TYPE_CHECKING:
    from scaffold.formats.xml import Element
    from scaffold.model.robot.xacro.problems import Problems
    from scaffold.model.robot.xacro.values import Values


class Calls:
    """Binds calls to their macros.

    Args:
        values: Evaluates the arguments.
        problems: Receives the invalid calls.
    """

    def __init__(self, values: Values, problems: Problems) -> None:
        self._values = values
        self._problems = problems

    def bind(self, name: str, macro: Macro, element: Element, frame: Frame) -> Scope | None:
        """Return the parameters of a call; ``None`` if it is invalid."""
        scope = Scope(macro.scope or frame.scope)
        parameters = tuple(item for item in macro.parameters if not item.startswith("*"))
        given = element.attributes
        if element.tag == "xacro:call":
            given.pop("macro", None)
        before = len(self._problems.misfits)
        for attribute in given.values():
            if attribute.name in macro.parameters:
                scope.values[attribute.name] = self._values.literal(
                    attribute.value,
                    frame,
                    lambda at=attribute: at.location,  # type: ignore[misc]
                )
            elif ":" not in attribute.name and attribute.name != "xmlns":
                place = attribute._replace(location=attribute.name_location)
                self._problems.misfit(
                    "unknown", name, attribute.name, frame.file, place, parameters
                )
        self._bind_blocks(name, macro, element, frame, scope)
        for parameter, default in macro.parameters.items():
            if parameter in scope.values or parameter.startswith("*"):
                continue
            value = self._default(parameter, default, macro, frame)
            if value is None:
                self._problems.misfit("missing", name, parameter, frame.file, element, parameters)
            else:
                scope.values[parameter] = value
        return scope if len(self._problems.misfits) == before else None

    def _bind_blocks(
        self, name: str, macro: Macro, element: Element, frame: Frame, scope: Scope
    ) -> None:
        blocks = element.children
        wanted = [item for item in macro.parameters if item.startswith("*")]
        if any(block.tag.startswith("xacro:") for block in blocks):
            self._problems.is_partial = self._problems.is_partial or len(blocks) != len(wanted)
        elif len(blocks) < len(wanted):
            missing = wanted[len(blocks)].lstrip("*")
            self._problems.misfit("block missing", name, missing, frame.file, element)
        elif len(blocks) > len(wanted):
            extra = blocks[len(wanted)]
            self._problems.misfit("block unused", name, extra.tag, frame.file, extra)
        for parameter in wanted:
            if blocks:
                block, *blocks = blocks
                is_content = parameter.startswith("**")
                scope.values[parameter] = Block(block, frame, is_content)
            else:
                scope.values[parameter.lstrip("*")] = unknown(parameter)

    def _default(
        self,
        name: str,
        default: tuple[bool, str | None] | None,
        macro: Macro,
        frame: Frame,
    ) -> Value | None:
        if default is None:
            return None
        is_forwarded, text = default
        if is_forwarded:
            scope = frame.scope.find(name)
            if scope is not None:
                return self._values.resolved(name, scope, frame)
        if text is None:
            return unknown(name) if is_forwarded and self._problems.is_open else None
        return self._values.literal(text, frame, lambda: macro.element.name_location)
