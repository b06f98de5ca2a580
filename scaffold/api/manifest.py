"""package.xml: dependencies, values, conditions."""

from __future__ import annotations

from scaffold.model.contents import requirements
from scaffold.model.contents.build_requirements import is_installed_to_build
from scaffold.model.contents.declared import brought_by, declared
from scaffold.model.contents.package_name import name_used_elsewhere
from scaffold.model.contents.requirements import required_packages
from scaffold.model.discovery.declaring import declaring, way_back
from scaffold.model.discovery.pip import is_in_requirements
from scaffold.model.discovery.repos_files import is_fetched, is_included
from scaffold.model.manifest.conditions import (
    ConditionError,
    Constant,
    constants,
    holds,
    is_never_true,
    misspelled,
)
from scaffold.model.manifest.manifest import Manifest
from scaffold.model.manifest.placeholders import is_placeholder, is_placeholder_address
from scaffold.model.manifest.spdx import similar_license, spdx_of

__all__ = [
    "ConditionError",
    "Constant",
    "Manifest",
    "brought_by",
    "constants",
    "declared",
    "declaring",
    "holds",
    "is_fetched",
    "is_in_requirements",
    "is_included",
    "is_installed_to_build",
    "is_never_true",
    "is_placeholder",
    "is_placeholder_address",
    "misspelled",
    "name_used_elsewhere",
    "required_packages",
    "requirements",
    "similar_license",
    "spdx_of",
    "way_back",
]
