"""``python -m scaffold``."""

from __future__ import annotations

import sys

from scaffold.cli.main import main

sys.exit(main())
