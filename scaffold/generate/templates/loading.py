"""Loads templates from content directories: manifests, questions and files."""

from __future__ import annotations

import marshal
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from scaffold.errors import ContentError
from scaffold.files import cache
from scaffold.files.disk import digest, stamp
from scaffold.generate import yaml_file
from scaffold.generate.templates import licenses, reserved
from scaffold.generate.templates.template import (
    BASE,
    DEPEND_KINDS,
    FOLDERS,
    MANIFEST,
    PARTS,
    Question,
    Role,
    Template,
    of_role,
)

_KEYS: Mapping[str, type[Any]] = {
    "summary": str,
    "questions": dict,
    "section": str,
    "executable_name": str,
    "parameter_file": str,
    "definition": str,
    "build_types": list,
    "depends": dict,
    "groups": list,
    "installs": list,
    "tests": list,
    "alone": bool,
    "include": dict,
    "executable": list,
    "repository": list,
    "notes": dict,
    "examples": dict,
}
_INNER: Mapping[str, Any] = {
    "build_types": str,
    "depends": list,
    "groups": str,
    "installs": str,
    "tests": str,
    "include": (str, bool),
    "executable": str,
    "notes": str,
    "examples": dict,
}
"""The types of the items of a value."""
_WORDS: Mapping[object, str] = {
    str: "string",
    dict: "mapping",
    list: "list",
    bool: "flag",
    (str, bool): "string",
}
_SECTIONS = {
    Role.NODE: "other nodes",
    Role.INTERFACE: "interfaces",
    Role.PROGRAM: "C++ programs",
    Role.EXTRA: "extras",
}
_DEFINITIONS = frozenset({"msg", "srv", "action"})
_QUESTION_KEYS = frozenset(
    {"type", "help", "default", "choices", "positional", "metavar", "direction"}
)
_DIRECTIONS = ("published", "subscribed")


def load(roots: Sequence[str]) -> dict[str, Template]:
    """Return the templates of the content directories by name.

    Raises:
        ContentError: a manifest is invalid, a template is not in the folder of a role, or two
            templates have different questions with one name.
    """
    places: dict[str, tuple[str, Role]] = {}
    overrides: dict[str, list[str]] = {}
    for root in roots:
        own = _places(root)
        places |= own
        overrides |= {name: [] for name in own}
        for name, directory in _overrides(root, places):
            overrides[name].append(directory)
    manifests = _manifests([places[name][0] for name in sorted(places)])
    templates = {
        name: _load_one(name, *places[name], manifest)._replace(overrides=overrides[name])
        for name, manifest in zip(sorted(places), manifests, strict=True)
    }
    if templates[BASE].role is not Role.PACKAGE if BASE in templates else True:
        raise ContentError(f"no template {BASE!r} for every package in {', '.join(roots)}")
    reserved.refuse_shadowing(templates, BASE, MANIFEST)
    _refuse_ambiguous_questions(templates)
    license_names = licenses.names(roots)
    return {
        name: _with_choices(template, templates, license_names)
        for name, template in templates.items()
    }


def _places(root: str) -> dict[str, tuple[str, Role]]:
    """Return the directories of the templates in a content directory, and their roles."""
    result: dict[str, tuple[str, Role]] = {}
    for folder in sorted(os.listdir(root)):
        place = os.path.join(root, folder)
        if folder == BASE and os.path.isfile(os.path.join(place, MANIFEST)):
            result[BASE] = place, Role.PACKAGE
            continue
        if os.path.isfile(os.path.join(place, MANIFEST)):
            raise ContentError(f"{place}: a template must be in {', '.join(FOLDERS)}")
        for name in _templates(place):
            directory = os.path.join(place, name)
            if folder not in FOLDERS:
                raise ContentError(f"{directory}: a template must be in {', '.join(FOLDERS)}")
            if name in result:
                raise ContentError(f"{directory}: {result[name][0]} has the same name")
            result[name] = directory, FOLDERS[folder]
    return result


def _overrides(root: str, places: Mapping[str, tuple[str, Role]]) -> Iterator[tuple[str, str]]:
    """Yield the templates with overridden files in a directory, and the place of these files.

    Raises:
        ContentError: it has files of an unknown template.
    """
    for folder in sorted(os.listdir(root)):
        place = os.path.join(root, folder)
        if folder.startswith(("_", ".")) or not os.path.isdir(place):
            continue
        if folder == BASE:
            if not os.path.isfile(os.path.join(place, MANIFEST)):
                yield BASE, place
            continue
        if folder not in FOLDERS:
            raise ContentError(f"{place}: templates are in {BASE} and {', '.join(FOLDERS)}")
        for name in sorted(os.listdir(place)):
            directory = os.path.join(place, name)
            is_shared = name.startswith(("_", ".")) or not os.path.isdir(directory)
            if is_shared or os.path.isfile(os.path.join(directory, MANIFEST)):
                continue
            if places.get(name, ("", None))[1] is not FOLDERS[folder]:
                raise ContentError(
                    f"{directory}: has no {MANIFEST}, and there is no {name!r} to override"
                )
            yield name, directory


def _templates(place: str) -> Iterator[str]:
    """Yield the names of the template directories in a folder."""
    if os.path.isdir(place):
        for name in sorted(os.listdir(place)):
            if os.path.isfile(os.path.join(place, name, MANIFEST)):
                yield name


def _manifests(directories: Sequence[str]) -> list[dict[str, Any]]:
    """Return the manifests of templates, from the cache if no file has changed."""
    paths = [os.path.join(directory, MANIFEST) for directory in directories]
    stamps = "\n".join(f"{path} {stamp(path)}" for path in paths)
    head = b"scaffold-manifests-3\n" + digest(os.fsencode(stamps)).encode()
    kept = cache.directory("manifests")
    place = os.path.join(kept, digest(os.fsencode("\n".join(paths)))) if kept else ""
    data = cache.read_sealed(place, head) if kept else None
    if data is not None:
        result: list[dict[str, Any]] = marshal.loads(data)  # noqa: S302  own files
        return result
    made = [_manifest(path) for path in paths]
    if kept and cache.write_sealed(place, head, marshal.dumps(made)):
        cache.trim(kept, _MAX_KEPT)
    return made


_MAX_KEPT = 16
"""The maximum number of cached sets of content directories."""


def _load_one(name: str, directory: str, role: Role, manifest: Mapping[str, Any]) -> Template:
    path = os.path.join(directory, MANIFEST)
    for kind, depends in manifest.get("depends", {}).items():
        if kind not in DEPEND_KINDS or not all(isinstance(text, str) for text in depends):
            kinds = ", ".join(DEPEND_KINDS)
            raise ContentError(f"{path}: depends must map {kinds} to lists of names")
    asked = manifest.get("questions", {}).items()
    result = Template(
        name=name,
        directory=directory,
        role=role,
        summary=manifest["summary"],
        section=manifest.get("section", _SECTIONS.get(role, "")),
        questions=tuple(_question(path, key, value) for key, value in asked),
        executable_name=manifest.get("executable_name", "{{ node.name }}"),
        parameter_file=manifest.get("parameter_file", ""),
        definition=manifest.get("definition", ""),
        build_types=manifest.get("build_types", []),
        depends=manifest.get("depends", {}),
        groups=manifest.get("groups", []),
        installs=manifest.get("installs", []),
        tests=manifest.get("tests", []),
        is_alone=manifest.get("alone", False),
        include=manifest.get("include", {}),
        executable=manifest.get("executable", []),
        repository=manifest.get("repository", []),
        notes=manifest.get("notes", {}),
        examples=manifest.get("examples", {}),
    )
    if (role is Role.INTERFACE) is not (result.definition in _DEFINITIONS):
        raise ContentError(
            f"{path}: interfaces, and no others, have definition: msg, srv or action"
        )
    if role in PARTS and result.name_question not in [
        question.name for question in result.questions
    ]:
        raise ContentError(f"{path}: the questions must have {result.name_question}")
    return result


def _manifest(path: str) -> dict[str, Any]:
    """Parse a manifest and validate its keys and the types of its values."""
    manifest = yaml_file.read(path, ContentError)
    if not isinstance(manifest, dict):
        raise ContentError(f"{path}: must be a mapping with the keys {', '.join(_KEYS)}")
    for key, value in manifest.items():
        if key not in _KEYS:
            raise ContentError(f"{path}: unknown key {key!r}; the keys are {', '.join(_KEYS)}")
        if not isinstance(value, _KEYS[key]):
            raise ContentError(f"{path}: {key} must be a {_WORDS[_KEYS[key]]}")
        _refuse_others(path, key, value)
    if "summary" not in manifest:
        raise ContentError(f"{path}: the key 'summary' is missing")
    return manifest


def _refuse_others(path: str, key: str, value: object) -> None:
    """Raise if a list or a mapping has an item of the wrong type for its key."""
    inside: Iterable[object] = value if isinstance(value, list) else ()
    if isinstance(value, dict):
        inside = value.values()
    for inner in inside:
        if not isinstance(inner, _INNER.get(key, object)):
            whole, part = _WORDS[_KEYS[key]], _WORDS[_INNER[key]]
            raise ContentError(f"{path}: {key} must be a {whole} of {part}s, not {inner!r}")


def _question(path: str, name: str, entry: object) -> Question:
    from scaffold.generate.questions.answer_types import TYPES

    if not name.isidentifier() or not isinstance(entry, dict) or "help" not in entry:
        raise ContentError(f"{path}: the question {name!r} must be a mapping with the key 'help'")
    unknown = sorted(set(entry) - _QUESTION_KEYS)
    if unknown:
        keys = ", ".join(sorted(_QUESTION_KEYS))
        raise ContentError(f"{path}: {name} has an unknown key {unknown[0]!r}; the keys are {keys}")
    for key in ("help", "metavar"):
        if not isinstance(entry.get(key, ""), str):
            raise ContentError(f"{path}: {key} of {name} must be a string")
    kind = entry.get("type", "text")
    if not isinstance(kind, str) or kind not in TYPES:
        raise ContentError(f"{path}: {name} has the unknown type {kind!r}; {', '.join(TYPES)}")
    choices = entry.get("choices", [])
    if not isinstance(choices, str | list):
        raise ContentError(f"{path}: {name} must have a list of choices, or a role")
    direction = entry.get("direction", "")
    if direction and (kind != "topic" or direction not in _DIRECTIONS):
        wanted = " or ".join(_DIRECTIONS)
        raise ContentError(f"{path}: direction of {name} must be {wanted}, and its type topic")
    return Question(
        name=name,
        type=kind,
        help=entry["help"],
        default=entry.get("default"),
        choices=(f"role:{choices}",) if isinstance(choices, str) else tuple(map(str, choices)),
        is_positional=bool(entry.get("positional", False)),
        metavar=entry.get("metavar"),
        direction=direction,
    )


def _with_choices(
    template: Template, templates: Mapping[str, Template], known_licenses: tuple[str, ...]
) -> Template:
    """Replace ``choices: <role>`` by the templates of that role, and likewise for licenses."""
    questions = []
    for question in template.questions:
        choices = question.choices
        if choices and choices[0].startswith("role:"):
            try:
                choices = of_role(templates, Role(choices[0].removeprefix("role:")))
            except ValueError:
                path = os.path.join(template.directory, MANIFEST)
                message = f"{path}: {question.name} must have a list of choices, or a role"
                raise ContentError(message) from None
        if question.type == "license":
            choices = known_licenses
        questions.append(question._replace(choices=choices))
    return template._replace(questions=tuple(questions))


def _refuse_ambiguous_questions(templates: Mapping[str, Template]) -> None:
    """Raise if templates with a common question differ in its type or choices."""
    seen: dict[str, tuple[Question, str]] = {}
    for template in templates.values():
        for question in template.questions:
            first, where = seen.setdefault(question.name, (question, template.directory))
            if (first.type, first.is_positional) != (question.type, question.is_positional):
                raise ContentError(
                    f"{os.path.join(template.directory, MANIFEST)}: {question.name} has the type "
                    f"{question.type}, but {first.type} in {os.path.join(where, MANIFEST)}"
                )
