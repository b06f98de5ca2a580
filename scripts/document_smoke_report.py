"""Write the JSON schema of the report of ``smoke``.

``python scripts/document_smoke_report.py [DIRECTORY]``; ``make docs`` calls it.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

from scaffold.smoke.reports.schema import schema

DOCS = Path(__file__).parent.parent / "docs"


def main(directory: Path) -> int:
    """Write the schema to a directory."""
    text = json.dumps(schema(), indent=2) + "\n"
    (directory / "smoke-report.schema.json").write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if sys.argv[1:] else DOCS))
