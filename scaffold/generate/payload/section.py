"""Code that fills a section of a service or an action, such as its request."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from scaffold import lazy_re
from scaffold.generate.payload import enums, words
from scaffold.generate.payload.code import COUNTER, Block
from scaffold.generate.payload.imports import imports
from scaffold.generate.payload.lookup import Types
from scaffold.generate.payload.message import MAX_LINES, MAX_LOG, enumerated, is_short, joined
from scaffold.generate.payload.payloads import SectionPayload
from scaffold.generate.payload.walk import MAX_BRIEF, Walk
from scaffold.model.interfaces.syntax import Field, Section
from scaffold.model.interfaces.types import FLOATS, INTEGER_RANGES

STEPS = 10
"""The number of steps of an action with no field for it."""
_DONE = lazy_re.compile("(.*_)?(success|successful|succeeded|ok|accepted|done|completed|result)$")
_WHY = lazy_re.compile(
    "(.*_)?(answer|message|msg|reason|description|info|details|text|status_message)$"
)
_ERROR = lazy_re.compile("(?:^|_)(?:error|failure)(?:_|$)")
_NUMBERS = frozenset({*INTEGER_RANGES, *FLOATS}) - {"byte", "char"}


def by_recipe(
    types: Types, section: Section, code: str, log: str, checks: tuple[str, ...] = ()
) -> SectionPayload:
    """Return a section that a recipe fills."""
    block = Block()
    block.embed(code, section.name)
    return _payload(types, section, block.lines(), log, checks)


def asked(types: Types, section: Section) -> SectionPayload:
    """Return the section that a client sends: a request or a goal."""
    return _filled(types, section, {})


def answered(types: Types, section: Section, given: Sequence[Section]) -> SectionPayload:
    """Return the section that a server sends: a response or a result, computed from its input."""
    fields = tuple(item for item in section.fields if not _is_failure(section, item))
    values = {field.name: _computed_value(field, given) for field in fields}
    return _filled(types, section._replace(fields=fields), values)


def _is_failure(section: Section, field: Field) -> bool:
    """Return whether a field is an error code without a constant for success, which is 0."""
    if field.type.name not in INTEGER_RANGES or not _ERROR.search(field.name):
        return False
    return not any(enums.is_good(item) for item in enums.constants_of(section, field))


def reported(types: Types, section: Section) -> SectionPayload:
    """Return the code that publishes feedback at each step."""
    values = {field.name: _progress(field) for field in section.fields}
    return _filled(types, section, values, counter="step")


def _filled(
    types: Types, section: Section, values: Mapping[str, str | None], counter: str = COUNTER
) -> SectionPayload:
    """Fill the fields: given values first, then the others, in brief if there are many."""
    for brief in range(MAX_BRIEF + 1):
        block, walk = Block(counter=counter), Walk(types, section.name, brief=brief)
        checks: list[str] = []
        shown = walk.shown_fields(section, section.name)
        for field in shown:
            value = values.get(field.name)
            if value is None:
                target = f"{section.name}.{field.name}"
                walk.field(block, section, _owner(types, section), field, target)
            else:
                block.add(f"{section.name}.{field.name} = {value}")
                checks += _check(field, f"{section.name}.{field.name}", value)
        walk.say_rest(block, section, shown, section.name)
        if len(block.lines()) <= MAX_LINES:
            break
    log = joined(walk.logged) or _first_scalar(section)
    payload = _payload(types, section, block.lines(), log, [*checks, *walk.checks][:3])
    return payload._replace(constants=walk.constants, frame=walk.frame)


def _owner(types: Types, section: Section) -> str:
    """Return the class of a section."""
    return f"{types.own_name}.{section.name.capitalize()}"


def _computed_value(field: Field, given: Sequence[Section]) -> str | None:
    """Return the value of a field computed from other sections, if there is one."""
    for item in given:
        same = item.field(field.name)
        if same is not None and same.type == field.type:
            return f"{item.name}.{field.name}"
    if field.type.is_array:
        return None
    if field.type.name == "bool":
        return "True" if _DONE.match(field.name) else None
    if field.type.name == "string" and field.type.text_bound is None:
        return "''" if _ERROR.search(field.name) else "'done'" if _WHY.match(field.name) else None
    return _sum(field, given) if field.name in {"sum", "total"} else None


def _sum(field: Field, given: Sequence[Section]) -> str | None:
    """Return the sum of all input numbers of the field's type, if there are several."""
    numbers = [
        f"{section.name}.{item.name}"
        for section in given
        for item in section.fields
        if item.type == field.type and item.type.name in _NUMBERS
    ]
    return " + ".join(numbers) if len(numbers) > 1 else None


def _check(field: Field, target: str, value: str) -> list[str]:
    """Return an assertion about a field whose value does not depend on time."""
    if value == "True":
        return [target]
    is_own = "step" in value or value.startswith("feedback.")  # the other side does not know it
    if value == "''" or is_own:
        return []
    is_numpy = field.type.array_size and not field.type.is_upper_bound
    return [f"list({target}) == list({value})" if is_numpy else f"{target} == {value}"]


def _progress(field: Field) -> str | None:
    """Return the value of a feedback field that holds the progress."""
    if field.type.is_array or field.type.name not in _NUMBERS:
        return None
    is_float = field.type.name in FLOATS
    parts = set(words.split(field.name))
    if "percent" in parts or ("percentage" in parts and not is_float):
        return f"{100 // STEPS}.0 * step" if is_float else f"{100 // STEPS} * step"
    if parts & {"remaining", "left"}:
        return f"{STEPS}.0 - step" if is_float else f"{STEPS} - step"
    if is_float and parts & {"progress", "completion", "fraction", "percentage", "ratio"}:
        return f"step / {STEPS}"
    return None if is_float else "step"


def _first_scalar(section: Section) -> str:
    """Return a replacement field for the log; the length of an array if there is no number."""
    for field in section.fields:
        if field.type.is_primitive and not field.type.is_array:
            return f"{{{section.name}.{field.name}}}"
    lengths = (
        f"{{len({section.name}.{field.name})}} {words.phrase(field.name)}"
        for field in section.fields
        if field.type.is_array
    )
    return joined(lengths)


def _payload(
    types: Types, section: Section, lines: Sequence[str], log: str, checks: Iterable[str]
) -> SectionPayload:
    names = [words.phrase(field.name) for field in section.fields]
    log = log or (enumerated(names, "", MAX_LOG) if names else f"an empty {section.name}")
    packages, lines_of_imports = imports(types, [*lines, f"f'{log}'"])
    return SectionPayload(
        statements=tuple(lines),
        log=log,
        summary=enumerated(names, "", 60) if names else "",
        checks=tuple(filter(is_short, checks)),
        imports=lines_of_imports,
        packages=packages,
        is_stamped=any("self.frame_id" in line for line in lines),
        is_counted=any("self.count" in line for line in lines),
    )
