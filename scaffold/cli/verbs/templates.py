"""``ros2-scaffold templates [list | test] [DIR]``."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from scaffold.cli import flags, terminal

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from scaffold.generate.draft import Draft
    from scaffold.generate.examples import Example, Tried
    from scaffold.generate.templates.template import Template
    from scaffold.model.package import Package

ACTIONS = ("list", "test", "copy")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.add_argument(
        "action",
        nargs="?",
        choices=ACTIONS,
        default="list",
        help="list the templates (default); test them: render their examples and check the "
        "packages with every rule; or copy a template as a starting point (copy NAME DIR), or "
        "one of its files (copy NAME/FILE DIR)",
    )
    words = parser.add_argument(
        "words",
        nargs="*",
        metavar="DIR",
        help="a directory with your own templates/ (default: all templates)",
    )
    words.completer = _complete  # type: ignore[attr-defined]  # argcomplete
    parser.add_argument("--name", metavar="NAME", default="", help="name of the copy")
    place = parser.add_argument("--content", metavar="DIR", help="the same as DIR")
    place.completer = flags.offer_directories  # type: ignore[attr-defined]  # argcomplete
    parser.add_argument("--build", action="store_true", help="also build the packages with colcon")


def _complete(prefix: str, parsed_args: argparse.Namespace, **_: object) -> list[str]:
    """Complete the templates to copy, and directories."""
    from scaffold.configuration import content
    from scaffold.generate.templates import loading

    if parsed_args.action == "copy" and not parsed_args.words:
        return [*loading.load(content.roots("templates"))]
    return flags.offer_directories(prefix)


def run(options: argparse.Namespace) -> int:
    """List templates, or test them."""
    from scaffold.cli import settings
    from scaffold.configuration import content
    from scaffold.errors import InputError
    from scaffold.generate.templates import loading

    if options.action == "copy":
        return _copy(options)
    if len(options.words) > 1:
        raise InputError(f"{options.words[1]!r}: only one directory can be named")
    options.directory = options.words[0] if options.words else options.content
    own = _template_roots(options.directory)
    options.directory = own[0] if own else None
    roots = content.roots("templates", (*settings.load().content, *own))
    templates = loading.load(roots)
    if options.directory is not None:
        within = os.path.realpath(options.directory) + os.sep
        templates_of = [
            name
            for name, item in templates.items()
            if any(os.path.realpath(place).startswith(within) for place in item.directories)
        ]
    else:
        templates_of = list(templates)
    if options.action == "list":
        terminal.show(_listed(templates, templates_of))
        return 0
    return _test(options, roots, templates, templates_of)


def _copy(options: argparse.Namespace) -> int:
    from scaffold.cli import settings
    from scaffold.cli.exit_codes import CLEAN
    from scaffold.configuration import content
    from scaffold.errors import InputError
    from scaffold.generate.templates import copying, loading

    words = [*options.words, *([options.content] if options.content else [])]
    if len(words) != 2:  # noqa: PLR2004  NAME and DIR
        raise InputError("write it as: ros2-scaffold templates copy NAME DIR")
    templates = loading.load(content.roots("templates", settings.load().content))
    terminal.show(copying.copy(templates, words[0], words[1], options.name))
    return CLEAN


def _template_roots(directory: str | None) -> tuple[str, ...]:
    from scaffold.configuration import content, git_content
    from scaffold.errors import InputError

    if directory is None:
        return ()
    if content.is_url(directory):
        return (git_content.resolve(directory).directory,)
    if not os.path.isdir(os.path.join(directory, "templates")):
        raise InputError(f"{directory}: it has no directory 'templates'")
    return (directory,)


def _listed(templates: Mapping[str, Template], names: Sequence[str]) -> str:
    from scaffold.generate import parts
    from scaffold.generate.templates.template import Role

    width = max(map(len, names), default=0)
    chosen = {name: templates[name] for name in names}
    groups = [
        (role.value.replace("_", " "), [name for name in names if templates[name].role is role])
        for role in (Role.PACKAGE, Role.BUILD_TYPE)
    ]
    lines: list[str] = []
    for heading, group in (*groups, *parts.sections(chosen).items()):
        if group:
            lines += ["", f"{heading}:"]
            lines += [f"    {name:{width}}  {templates[name].summary}" for name in group]
    return "\n".join(lines[1:])


def _test(
    options: argparse.Namespace,
    roots: Sequence[str],
    templates: Mapping[str, Template],
    names: Sequence[str],
) -> int:
    """Print the result of each example; return 1 if one fails or there is none."""
    from scaffold.check.rules import registry
    from scaffold.cli.exit_codes import CLEAN, FINDINGS
    from scaffold.configuration import content
    from scaffold.generate import examples
    from scaffold.generate.templates.template import BASE

    rules = registry.load(content.roots("rules"))
    if BASE in names:  # it has no examples, as it is in all packages
        usual = next(item for item in templates[BASE].questions if item.name == "node_kind")
        names = [*dict.fromkeys([*names, str(usual.default)])]
    tried: list[Tried] = []
    for attempt in examples.check(names, roots, templates, rules):
        tried.append(attempt)
        outcome = "failed" if attempt.defects else "ok"
        terminal.show(f"{attempt.example.template}: {attempt.example.title}: {outcome}")
        for defect in attempt.defects:
            terminal.show(f"    {defect}")
    failed = sum(bool(item.defects) for item in tried)
    if options.build:
        failed += _build(tried)
    without = sorted(set(names) - {item.example.template for item in tried} - {BASE})
    for name in without:
        terminal.note(f"{name} has no examples: it was not tested")
    terminal.show(f"{len(tried)} examples, {failed} failed")
    return FINDINGS if failed or not tried else CLEAN


def _build(tried: Sequence[Tried]) -> int:
    """Build the rendered packages; return the number of failures."""
    import tempfile

    from scaffold.smoke.building.only_build import only_build

    failed = 0
    for together in _build_rounds(tried):
        with tempfile.TemporaryDirectory(prefix="ros2-scaffold-templates-") as directory:
            packages = [_write(made, directory) for _, made in together.values()]
            for name, built in only_build(packages).items():
                example, _ = together[name]
                failed += not built.ok
                state = "built" if built.ok else "does not build"
                terminal.show(f"{example.template}: {example.title}: {state}")
                for line in () if built.ok else built.errors:
                    terminal.show(f"    {line}")
    return failed


def _build_rounds(tried: Sequence[Tried]) -> list[dict[str, tuple[Example, Draft]]]:
    """Split the packages into rounds, as colcon cannot build two of one name together."""
    rounds: list[dict[str, tuple[Example, Draft]]] = []
    for item in tried:
        if item.made is None:
            continue
        if all(item.made.name in together for together in rounds):
            rounds.append({})
        free = next(together for together in rounds if item.made.name not in together)
        free[item.made.name] = (item.example, item.made)
    return rounds


def _write(made: Draft, directory: str) -> Package:
    from scaffold.model.package import Package
    from scaffold.writing.plan import WritePlan

    place = os.path.join(directory, made.name)
    WritePlan.of(place, made.rendered.files, executable=made.rendered.executable).write()
    return Package.at(place)
