"""What the verdicts of ament's linters are made of."""

from __future__ import annotations

from scaffold.ament import copyright as notices
from scaffold.ament import xmllint
from scaffold.ament.copyright import REPOSITORY_FILES, copyright_use, departure, identify_file

__all__ = [
    "REPOSITORY_FILES",
    "copyright_use",
    "departure",
    "identify_file",
    "notices",
    "xmllint",
]
