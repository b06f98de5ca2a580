"""Write the table of docs/configuration.md and the JSON schema from the keys of the configuration.

``python scripts/document_configuration.py [DIRECTORY]``; ``make docs`` calls it. The directory has
the page already: only the text between its two markers is written.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

from scaffold.configuration import keys

DOCS = Path(__file__).parent.parent / "docs"
BEGIN = "<!-- written by `make docs` from scaffold/configuration/keys.py -->\n"
END = "<!-- until here -->\n"


def main(directory: Path) -> int:
    """Write both files."""
    page = directory / "configuration.md"
    before, _, rest = page.read_text().partition(BEGIN)
    _, _, after = rest.partition(END)
    page.write_text("".join([before, BEGIN, *_table(), END, after]))
    schema = json.dumps(keys.schema(), indent=2) + "\n"
    (directory / "ros2-scaffold.schema.json").write_text(schema)
    return 0


def _table() -> Iterator[str]:
    yield "| key | value | default | what it does |\n|---|---|---|---|\n"
    for key in keys.KEYS:
        default = json.dumps(key.default)
        yield f"| `{key.path}` | {key.kind.noun} | `{default}` | {key.summary} |\n"
    yield f"| `{keys.ANSWERS}.…` | text, numbers, lists | | {keys.ANSWERS_SUMMARY} |\n"


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if sys.argv[1:] else DOCS))
