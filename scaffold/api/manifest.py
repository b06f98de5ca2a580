"""package.xml: dependencies, values, conditions."""

from __future__ import annotations

from scaffold.model.manifest import edit as manifest_edit
from scaffold.model.manifest import requirements
from scaffold.model.manifest.conditions import ConditionError, holds
from scaffold.model.manifest.manifest import Manifest, XmlModel
from scaffold.model.manifest.package_name import other_name
from scaffold.model.manifest.placeholders import is_placeholder, is_placeholder_address
from scaffold.model.manifest.requirements import declared, needs
from scaffold.model.manifest.spdx import spdx_of
from scaffold.model.manifest.structure import (
    FORMATS,
    GROUPS,
    LIMITS,
    REQUIRED,
    Misplaced,
    Structure,
    Unknown,
    collapse,
    structure,
)
from scaffold.model.manifest.values import (
    CONDITION,
    EMAIL,
    GROUP_CONDITION,
    LIMIT,
    NAME,
    URL_TYPES,
    VERSION,
    fits,
    is_uri,
)

__all__ = [
    "CONDITION",
    "EMAIL",
    "FORMATS",
    "GROUPS",
    "GROUP_CONDITION",
    "LIMIT",
    "LIMITS",
    "NAME",
    "REQUIRED",
    "URL_TYPES",
    "VERSION",
    "ConditionError",
    "Manifest",
    "Misplaced",
    "Structure",
    "Unknown",
    "XmlModel",
    "collapse",
    "declared",
    "fits",
    "holds",
    "is_placeholder",
    "is_placeholder_address",
    "is_uri",
    "manifest_edit",
    "needs",
    "other_name",
    "requirements",
    "spdx_of",
    "structure",
]
