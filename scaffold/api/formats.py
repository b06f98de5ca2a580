"""XML and YAML documents with source locations."""

from __future__ import annotations

from scaffold import toml
from scaffold.formats import xml_reader
from scaffold.formats import yaml as yaml_tree
from scaffold.formats.hash_comments import without_comments
from scaffold.formats.xml import Attribute, Element
from scaffold.formats.yaml import Mapping, Scalar, Sequence, YamlNode

__all__ = [
    "Attribute",
    "Element",
    "Mapping",
    "Scalar",
    "Sequence",
    "YamlNode",
    "toml",
    "without_comments",
    "xml_reader",
    "yaml_tree",
]
