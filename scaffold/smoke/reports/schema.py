"""Generates the JSON schema of the report from the types of ``shape``."""

from __future__ import annotations

from types import NoneType, UnionType
from typing import Any, Literal, get_args, get_origin, get_type_hints, is_typeddict

from scaffold.smoke.reports import shape

_PLAIN: dict[object, dict[str, Any]] = {
    str: {"type": "string"},
    int: {"type": "integer"},
    float: {"type": "number"},
    bool: {"type": "boolean"},
    NoneType: {"type": "null"},
    Any: {},
}


def schema() -> dict[str, Any]:
    """Return the schema; other fields are allowed, as new ones may come."""
    definitions: dict[str, Any] = {}
    reference = _schema_of(shape.Report, definitions)
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "The report of `ros2-scaffold smoke --format json`",
        **reference,
        "definitions": dict(sorted(definitions.items())),
    }


def _schema_of(kind: Any, definitions: dict[str, Any]) -> dict[str, Any]:  # noqa: ANN401  a type, of any form
    if is_typeddict(kind):
        return _definition(kind, definitions)
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is list:
        return {"type": "array", "items": _schema_of(arguments[0], definitions)}
    if origin is dict:
        return {"type": "object", "additionalProperties": _schema_of(arguments[1], definitions)}
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin is UnionType or arguments:
        return {"anyOf": [_schema_of(item, definitions) for item in arguments]}
    return _PLAIN[kind]


def _definition(kind: Any, definitions: dict[str, Any]) -> dict[str, Any]:  # noqa: ANN401  likewise
    name = kind.__name__
    if name not in definitions:
        definitions[name] = {}  # it may refer to itself
        definitions[name] = {
            "description": kind.__doc__,
            "type": "object",
            "required": sorted(kind.__required_keys__),
            "properties": {
                key: _schema_of(value, definitions) for key, value in get_type_hints(kind).items()
            },
        }
    return {"$ref": f"#/definitions/{name}"}
