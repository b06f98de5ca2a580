"""UR022: the links of a robot are a tree with one root."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.robot import Expansion, Part, is_known, robots

_ROBOT = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <link name="camera"/>\n'
    '  <joint name="axis" type="continuous">\n    <parent link="base_link"/>\n'
    '    <child link="wheel"/>\n  </joint>\n'
    '  <joint name="mount" type="fixed">\n    <parent link="{}"/>\n'
    '    <child link="{}"/>\n  </joint>\n</robot>\n'
)
_LOOP = (
    '<robot name="robot">\n  <link name="a"/>\n  <link name="b"/>\n'
    '  <joint name="ab" type="fixed">\n    <parent link="a"/>\n    <child link="b"/>\n  </joint>\n'
    '  <joint name="ba" type="fixed">\n    <parent link="b"/>\n    <child link="a"/>\n  </joint>\n'
    "</robot>\n"
)


class TreeBroken(Rule):
    """The links of a robot do not hang together as a tree: two roots, two parents, or a loop.

    **Why.** ``Two root links found: [base_link] and [camera]``: the parser of URDF refuses the
    whole file, and robot_state_publisher ends.

    **Fix.** Connect each link but the first to its parent, by one joint.

    **Source.** urdfdom, ``ModelInterface::initRoot``.
    """

    code = "UR022"
    name = "tree-broken"
    examples = (
        Example("a tree", {"robot.urdf": _ROBOT.format("base_link", "camera")}),
        Example(
            "two parents, and so two roots",
            {"robot.urdf": _ROBOT.format("camera", "wheel")},
            Report(
                "4:15",
                "no joint connects 'camera': urdfdom finds two roots, it and "
                "'base_link', and refuses the whole file",
            ),
            Report(
                "9:4", "link 'wheel' is the child of 'axis' and of 'mount': a link has one parent"
            ),
        ),
        Example(
            "a link without a joint",
            {"robot.urdf": _ROBOT.format("wheel", "wheel2")},
        ),
        Example(
            "a loop",
            {"robot.urdf": _LOOP},
            Report(
                "8:4",
                "joint 'ba' closes a loop: 'a' is above 'b' already, so no root "
                "leads to these links",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            if robot.file.is_robot and robot.is_complete:
                yield from self._check(package, robot)

    def _check(self, package: Package, robot: Expansion) -> Iterator[Diagnostic]:
        links = {part.get("name") or "": part for part in robot.root.all("link")}
        parents: dict[str, Part] = {}
        for joint in robot.root.all("joint"):
            child, parent = _end(joint, "child"), _end(joint, "parent")
            if child not in links or parent not in links or not is_known(child + parent):
                return  # another rule reports it, or it is not known
            other = parents.setdefault(child, joint)
            if other is joint or not (other.is_certain and joint.is_certain):
                continue
            if joint.file.package is package and other.get("name") != joint.get("name"):
                message = (
                    f"link {child!r} is the child of {other.get('name')!r} and of "
                    f"{joint.get('name')!r}: a link has one parent"
                )
                yield self.report(joint, message)
        if not all(map(is_known, links)):
            return
        roots = [part for name, part in links.items() if name not in parents and part.is_certain]
        for part in roots[1:]:
            if part.file.package is package:
                message = (
                    f"no joint connects {part.get('name')!r}: urdfdom finds two roots, it and "
                    f"{roots[0].get('name')!r}, and refuses the whole file"
                )
                yield self.report(part.at("name"), message)
        for joint in _loops(parents):
            if joint.file.package is package:
                message = (
                    f"joint {joint.get('name')!r} closes a loop: {_end(joint, 'child')!r} is above "
                    f"{_end(joint, 'parent')!r} already, so no root leads to these links"
                )
                yield self.report(joint, message)


def _loops(parents: Mapping[str, Part]) -> Iterator[Part]:
    """Yield a joint of each loop, the last one of the file."""
    done: set[str] = set()
    for start in parents:
        seen: list[str] = []
        link = start
        while link in parents and link not in done and link not in seen:
            seen.append(link)
            link = _end(parents[link], "parent")
        if link in seen:
            joints = [parents[item] for item in seen[seen.index(link) :]]
            if all(joint.is_certain for joint in joints):
                yield max(joints, key=lambda joint: joint.element.start)
        done.update(seen)


def _end(joint: Part, tag: str) -> str:
    """Return the link at an end of a joint."""
    end = joint.one(tag)
    return (end.get("link") if end is not None else None) or ""
