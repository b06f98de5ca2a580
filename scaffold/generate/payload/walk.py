"""Fills a message field by field, guided by names, types and constants."""

from __future__ import annotations

import re
from collections.abc import Sequence
from textwrap import dedent

from scaffold.generate.payload import elements, enums, recipe, words
from scaffold.generate.payload.code import COUNT, NOW, WIDTH, Block, is_now
from scaffold.generate.payload.lookup import DURATION, HEADER, TIME, VECTOR, Types
from scaffold.generate.payload.recipe import FRAME, Recipe
from scaffold.model.interfaces.syntax import Constant, Field, Section
from scaffold.model.interfaces.types import FLOATS, INTEGER_RANGES, TEXTS, FieldType

WRAPPERS = ("std_msgs", "example_interfaces")
"""Packages of messages with a single primitive value."""


class Walk:
    """Fills the messages of one interface.

    Args:
        types: The interface.
        root: The variable that is filled.
        changing: Whether fields that would be constant change as well.
        brief: 0 to fill all fields; higher, to fill fewer of them, the most telling ones.
    """

    def __init__(self, types: Types, root: str, *, changing: bool = False, brief: int = 0) -> None:
        self._types = types
        self._root = root
        self._changing = changing
        self._limits = _BRIEF[brief - 1] if brief else ()
        self._stamped: list[str] = []
        self.checks: list[str] = []
        """Expressions that are true for the root."""
        self._frames: list[str] = []
        self._constants: dict[str, str] = {}
        self._shown: list[str] = []
        self._spare: list[str] = []

    @property
    def logged(self) -> list[str]:
        """Replacement fields of an f-string for changing values, the most telling first."""
        return self._shown or self._spare

    @property
    def frame(self) -> str:
        """The frame of the filled values, preferably that of a sensor."""
        result = [item for item in self._frames if item not in {"", FRAME}]
        return next((item for item in result if item != "map"), result[0] if result else FRAME)

    def _is_root(self, target: str) -> bool:
        """Return whether a target is the root or a part of it, and not a local name."""
        return target.partition(".")[0] == self._root

    @property
    def constants(self) -> tuple[str, ...]:
        """Lines of the module with constants of the statements."""
        return tuple(f"{name} = {value}" for name, value in self._constants.items())

    def fill(self, block: Block, section: Section, owner: str, target: str) -> None:
        """Add statements that fill the fields of a section.

        Args:
            block: Where to.
            section: The fields.
            owner: The class with the constants, as code.
            target: The expression to fill, as code.
        """
        shown = self.shown_fields(section, target)
        for field in shown:
            self.field(block, section, owner, field, f"{target}.{field.name}")
        self.say_rest(block, section, shown, target)

    def shown_fields(self, section: Section, target: str) -> list[Field]:
        """Return the fields of a section that are filled: the most telling ones if brief."""
        wanted = [field for field in section.fields if field.default is None or self._changing]
        if not self._limits:
            return wanted
        depth = target.count(".") + (not self._is_root(target))
        return telling(section, wanted, self._limits[min(depth, len(self._limits) - 1)])

    def say_rest(self, block: Block, section: Section, shown: Sequence[Field], target: str) -> None:
        """Add a comment that not all fields of the root are filled."""
        left = len(section.fields) - len(shown)
        if self._limits and left and target == self._root:
            are = "field keeps its default" if left == 1 else f"{left} fields keep their defaults"
            block.add(f"# the other {are}")

    def message(self, block: Block, full_name: str, target: str) -> None:
        """Add statements that fill a message."""
        section = self._types.message(full_name)
        known_recipe = recipe.find(full_name)
        if full_name == TIME and target != self._root:
            block.add(f"{target} = {NOW}")
            self._show(f"{target}.sec", "", " s", last=True)
            self._expect(f"{target}.sec", "{} > 0")
        elif full_name == HEADER and target != self._root:
            self._header(block, target)
        elif known_recipe is not None and _fits(known_recipe, section):
            header = section.field("header")
            if header is not None and header.type.full_name == HEADER:
                self._header(block, f"{target}.header", has_frame=bool(known_recipe.frame))
            code = self._types.renamed(self._with_constants(known_recipe, target), full_name)
            block.embed(code, _local_name(block, target, code))
            self._frames.append(known_recipe.frame)
            checks = tuple(self._types.renamed(check, full_name) for check in known_recipe.checks)
            self._judge(known_recipe._replace(checks=checks), target)
        else:
            self.fill(block, section, self._types.class_name(full_name), target)

    def _judge(self, known_recipe: Recipe, target: str) -> None:
        """Use the descriptions of a recipe for the root."""
        if self._is_root(target):
            if known_recipe.log:
                self._spare.append(re.sub(r"\bmsg\.", f"{target}.", known_recipe.log))
            for check in known_recipe.checks[:1]:
                self.checks.append(re.sub(r"\bmessage\.", f"{target}.", check))

    def _with_constants(self, known_recipe: Recipe, target: str) -> str:
        """Define the constants of a recipe and return its code.

        A constant whose name is taken is prefixed with the name of the target.
        """
        code = known_recipe.code
        for line in dedent(known_recipe.constants).strip().splitlines():
            name, _, value = line.partition(" = ")
            if self._constants.setdefault(name, value) != value:
                new = f"{target.rpartition('.')[2].upper()}_{name}"
                self._constants[new] = value
                code = re.sub(rf"\b{name}\b", new, code)
        return code

    def _header(self, block: Block, target: str, *, has_frame: bool = True) -> None:
        """Fill a header; the header of an element is copied from the root."""
        if self._stamped:
            first = self._stamped[0]
            if "." in target:
                block.add(f"{target} = {first}")
            else:  # an element: another name for it would not fill it
                block.add(f"{target}.stamp = {first}.stamp")
                block.add(f"{target}.frame_id = self.frame_id")
            return
        if self._is_root(target) and has_frame:
            self._stamped.append(target)
            self.checks.append(is_now(f"{target}.stamp"))
        block.add(f"{target}.stamp = {NOW}")
        if has_frame:
            block.add(f"{target}.frame_id = self.frame_id")

    # -- fields

    def field(self, block: Block, section: Section, owner: str, field: Field, target: str) -> None:
        """Add statements that fill one field of a section, as `fill` does for all."""
        self._fill_field(block, section, owner, field, target)
        if self._changing and any(COUNT in text for text in block.texts()):
            self._changing = False  # one that changes is enough

    def _fill_field(
        self, block: Block, section: Section, owner: str, field: Field, target: str
    ) -> None:
        if field.type.is_array:
            self._array(block, field, target)
        elif field.type.full_name == DURATION:
            block.add(f"{target}.sec = {COUNT} % 10 + 1" if self._changing else f"{target}.sec = 1")
        elif not field.type.is_primitive:
            self._nested(block, field, target)
        elif options := enums.constants_of(section, field):
            value = self._enum(block, field, options, owner)
            block.add(f"{target} = {value}", comment_of(field, ""))
            if COUNT in value:
                self._show(target, "")
            elif owner.partition(".")[0] == self._types.own_name:
                self._expect(target, f"{{}} == {value}")
        else:
            self._scalar(block, field, target)

    def _nested(self, block: Block, field: Field, target: str) -> None:
        quantity = words.quantity(field.name)
        if field.type.full_name == VECTOR and quantity is not words.NUMBER:
            for axis in "xy":
                block.add(
                    f"{target}.{axis} = {quantity.expression}", comment_of(field, quantity.unit)
                )
            self._expect(f"{target}.x", quantity.check("{}"))
            self._show(f"{target}.x", ":.2f")
        elif wrapped := self._wrapped(field):
            self._scalar(block, wrapped, f"{target}.data")
        else:
            self.message(block, field.type.full_name, target)

    def _wrapped(self, field: Field) -> Field | None:
        """Return the only field of a wrapper such as std_msgs/Float64, with the outer name."""
        fields = self._types.message(field.type.full_name).fields
        if field.type.package not in WRAPPERS or [item.name for item in fields] != ["data"]:
            return None
        data = fields[0]
        return field._replace(type=data.type) if data.type.is_primitive else None

    def _enum(self, block: Block, field: Field, options: Sequence[Constant], owner: str) -> str:
        if self._changing and len(options) > 1:
            names = [f"{owner}.{option.name}" for option in options[: elements.ELEMENTS]]
            every = block.define(f"every_{field.name}", f"[{', '.join(names)}]")
            return f"{every}[{COUNT} % {len(names)}]"
        return f"{owner}.{enums.telling(options, field).name}"

    def _scalar(self, block: Block, field: Field, target: str) -> None:
        """Fill a field of a primitive type that has no constants."""
        name, type_ = field.name, field.type
        if type_.name in FLOATS:
            quantity = words.quantity(name)
            block.add(f"{target} = {quantity.expression}", comment_of(field, quantity.unit))
            self._expect(target, quantity.check("{}"))
            self._show(target, ":.2f" if quantity.swing >= _COARSE else "")
            return
        if type_.name == "bool":
            value = f"{COUNT} % 2 == 0"
            value = "True" if words.is_true(name) and not self._changing else value
        elif type_.name == "byte":
            value = "b'\\x01'" if words.is_true(name) else f"bytes([{COUNT} % 256])"
        elif type_.name in INTEGER_RANGES:
            value = self._integer(name, type_)
            if value == words.TIMESTAMP:
                value += words.per_unit(name, field.comment)
        else:
            value = self._text(name, type_)
        block.add(f"{target} = {value}", comment_of(field, ""))
        if COUNT in value:
            self._show(target, "")
            if type_.name in TEXTS:
                self._expect(target, "{}")
        elif "self." not in value:
            self._expect(target, "{}" if value == "True" else f"{{}} == {value}")

    def _integer(self, name: str, type_: FieldType) -> str:
        constant = words.whole(name)
        limit = INTEGER_RANGES[type_.name][1]
        if constant is not None and constant <= limit and not self._changing:
            return str(constant)
        if limit >= INTEGER_RANGES["int64"][1]:
            return words.TIMESTAMP if "timestamp" in name else COUNT
        return f"{COUNT} % {1000 if limit >= 1000 else 100}"  # noqa: PLR2004  round numbers

    def _text(self, name: str, type_: FieldType) -> str:
        if name.endswith("frame_id") and type_.text_bound is None:
            return "self.frame_id" if name == "frame_id" else "'base_link'"
        constant = words.text(name)
        fits = constant is not None and len(constant) <= (type_.text_bound or len(constant))
        if constant is None or not fits or self._changing:
            return words.counting_text(name, type_.text_bound)
        return f"'{constant}'"

    def _expect(self, target: str, check: str) -> None:
        if self._is_root(target):
            self.checks.append(check.format(target))

    def _show(self, target: str, form: str, behind: str = "", *, last: bool = False) -> None:
        """Record a log text; ``last``: only to be used if there is nothing better."""
        if self._is_root(target.removeprefix("len(")):
            (self._spare if last else self._shown).append(f"{{{target}{form}}}{behind}")

    # -- arrays

    def _array(self, block: Block, field: Field, target: str) -> None:
        type_ = field.type
        size = type_.array_size or elements.ELEMENTS
        if type_.is_upper_bound:
            size = min(size, elements.ELEMENTS)
        if not type_.is_primitive:
            self._messages(block, field, target, size)
        elif "covariance" in field.name and size in _DIAGONALS and type_.name in FLOATS:
            block.add(f"{target}[::{_DIAGONALS[size]}] = 0.01", "the diagonal")
        else:
            value, unit = self._elements(field, size)
            block.add(f"{target} = {value}", comment_of(field, unit))
        if type_.array_size is None or type_.is_upper_bound or not type_.is_primitive:
            self._expect(target, f"len({{}}) == {size}")
        self._show(f"len({target})", "", f" {words.phrase(field.name)}", last=True)

    def _elements(self, field: Field, size: int) -> tuple[str, str]:
        """Return the elements of an array of a primitive type as code, and their unit."""
        element = field.type.element
        name = elements.singular(field.name)
        if element.name in FLOATS:
            quantity = words.quantity(name)
            return elements.several(quantity.expression, size), quantity.unit
        if element.name == "bool":
            return elements.several(f"{COUNT} % 2 == 0", size), ""
        if element.name == "byte":
            return f"[bytes([({COUNT} + index) % 256]) for index in range({size})]", ""
        if element.name in INTEGER_RANGES:
            return f"[({COUNT} + index) % 100 for index in range({size})]", ""
        if self._changing:
            text = words.counting_text(name, element.text_bound)
            text = text.replace(COUNT, f"({COUNT} + index)" if "%" in text else f"{COUNT} + index")
            return f"[{text} for index in range({size})]", ""
        texts = [f"'{text}'" for text in elements.numbered(name, size, element.text_bound)]
        return f"[{', '.join(texts)}]", ""

    def _messages(self, block: Block, field: Field, target: str, size: int) -> None:
        """Fill an array of messages with different elements."""
        full_name = field.type.full_name
        name = elements.variable(field)
        if full_name in {TIME, DURATION}:
            value = NOW if full_name == TIME else f"{field.type.name}(sec=1)"
            block.add(f"{target} = {elements.several(value, size)}")
            return
        if field.type.array_size and not field.type.is_upper_bound:
            if block.is_loop:
                self.message(block, full_name, f"{target}[0]")
                return
            head = f"for count, {name} in enumerate({target}, {COUNT}):"
            body = block.loop(head, f"for {name} in {target}:")
            self.message(body, full_name, name)
            return
        if block.is_loop:  # one element each is enough
            size = 1
        head = f"for count in range({COUNT}, {COUNT} + {size}):"
        body = block.loop(head, f"for _ in range({size}):") if size > 1 else block
        value = f"{self._types.class_name(full_name)}()"
        name = body.define(name, value)
        self.message(body, full_name, name)
        body.add(f"{target}.append({name})")


def _fits(known_recipe: Recipe, section: Section) -> bool:
    """Return whether a message has the fields of a recipe; on another distribution it may not."""
    fields = {field.name for field in section.fields}
    return {*re.findall(r"\bmsg\.([a-z]\w*)", known_recipe.code)} <= fields


def _local_name(block: Block, target: str, code: str) -> str:
    """Return a local name for a deeply nested target, if the code uses it often."""
    owner, _, name = target.rpartition(".")
    lines = [line.strip() for line in code.splitlines()]
    longest = max((len(line) + line.count("msg.") * len(target) for line in lines), default=0)
    is_often = "." in owner and code.count("msg.") >= _OFTEN
    if not (is_often or ("." in target and longest > WIDTH)):
        return target
    short = elements.shortened(name)
    for local in (short, f"{elements.shortened(owner.rpartition('.')[2])}_{short}"):
        is_used = re.search(rf"(?<![.\w]){local}\b", code) or block.local(local)
        if elements.is_free(local) and not is_used:
            return block.define(local, target)
    return target


_OFTEN = 4
_DIAGONALS = {4: 3, 9: 4, 16: 5, 36: 7}
"""The stride of the diagonal of a square matrix, by its number of elements."""
_COARSE = 0.1
"""The amplitude below which a quantity is not logged, as two decimals would hide it."""
_BRIEF = ((12, 4, 2), (10, 3, 1), (8, 2, 1), (6, 2, 1), (5, 1, 1), (3, 1, 1))
"""The number of fields filled by level of brevity, for the root and for nested messages."""
MAX_BRIEF = len(_BRIEF)
"""The highest level of brevity."""


def telling(section: Section, fields: Sequence[Field], count: int) -> list[Field]:
    """Return the most telling fields by name and type, in their order."""

    def rank(field: Field) -> int:
        if not field.type.is_primitive:
            return 2 if field.type.is_array else 1
        if field.type.is_array:
            return 1
        is_quantity = words.quantity(field.name) is not words.NUMBER
        return 0 if is_quantity or enums.constants_of(section, field) else 1

    chosen = sorted(fields, key=rank)[:count]
    return [field for field in fields if field in chosen]


def comment_of(field: Field, unit: str) -> str:
    """Return the comment for a field: that of its definition if short, or its unit."""
    own = " ".join(field.comment.split())
    if own and len(own) <= _SHORT and own.isascii() and own.isprintable() and "noqa" not in own:
        return own
    return unit


_SHORT = 40
