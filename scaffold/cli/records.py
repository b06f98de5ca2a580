"""What the records in packages say that they are for, after packages have moved."""

from __future__ import annotations

import json
import os
import re
from typing import TYPE_CHECKING

from scaffold.cli import distro
from scaffold.writing.transaction import RECORD

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.distributions import Distribution

_ANSWERS = re.compile(r'^  "answers": \{\n', re.MULTILINE)
_ANSWER = re.compile(rf'^    "{distro.ANSWER}": [^\n]*,\n', re.MULTILINE)


def move(directory: str, targets: Sequence[Distribution]) -> bool | None:
    """Write into the record of a package what it is for now.

    Args:
        directory: Of the package.
        targets: What it is for.

    Returns:
        Whether that is new; ``None`` for a package without a record.

    Raises:
        ScaffoldError: the package is being changed, or cannot be written.
    """
    from scaffold.cli import writing
    from scaffold.files.tree import DiskTree
    from scaffold.writing.plan import WritePlan

    before = distro.recorded(directory)
    if before is None:
        return None
    if before == [*targets]:
        return False
    with writing.held(directory, is_dry=False):
        with open(os.path.join(directory, RECORD), encoding="utf-8", newline="") as file:
            text = file.read()
        moved = with_answer(text, [target.name for target in targets])
        tree = DiskTree(directory)
        WritePlan.of(directory, {RECORD: moved.encode()}, tree=tree).write(force=True)
    return True


def with_answer(text: str, names: Sequence[str]) -> str:
    """Return a record with another answer; every other line stays as it is."""
    line = f"    {json.dumps(distro.ANSWER)}: {json.dumps([*names])},\n"
    old = _ANSWER.search(text)
    if old is None:  # of a version that did not ask
        return _ANSWERS.sub(lambda matched: matched[0] + line, text, count=1)
    return text[: old.start()] + line + _ANSWER.sub("", text[old.end() :])
