"""What the verdicts of ament's linters are made of."""

from __future__ import annotations

from scaffold.ament import copyright as notices
from scaffold.ament import lint_cmake, xmllint
from scaffold.ament.copyright import REPOSITORY_FILES, copyright_use, departure, identify_file
from scaffold.ament.lint_cmake import Finding

__all__ = [
    "REPOSITORY_FILES",
    "Finding",
    "copyright_use",
    "departure",
    "identify_file",
    "lint_cmake",
    "notices",
    "xmllint",
]
