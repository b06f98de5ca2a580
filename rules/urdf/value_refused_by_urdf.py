"""UR011: the values in URDF are such that its parser takes them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Package, Report, Rule, closest_name
from scaffold.api.robot import is_known, urdf_parts

_ROBOT = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel">\n    <visual>\n'
    "      <geometry><{}/></geometry>\n    </visual>\n  </link>\n"
    '  <joint name="axis" type="{}">\n    <parent link="base_link"/>\n    <child link="wheel"/>\n'
    '    <origin xyz="{}"/>\n  </joint>\n</robot>\n'
)
_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
_SHAPES = ("box", "cylinder", "sphere", "mesh", "capsule")
_COUNTS: Mapping[tuple[str, str], int] = {
    ("origin", "xyz"): 3,
    ("origin", "rpy"): 3,
    ("axis", "xyz"): 3,
    ("box", "size"): 3,
    ("mesh", "scale"): 3,
    ("color", "rgba"): 4,
    ("cylinder", "radius"): 1,
    ("cylinder", "length"): 1,
    ("sphere", "radius"): 1,
    ("mass", "value"): 1,
    ("limit", "lower"): 1,
    ("limit", "upper"): 1,
    ("limit", "effort"): 1,
    ("limit", "velocity"): 1,
    **{("inertia", name): 1 for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")},
}
"""How many numbers an attribute holds."""


class ValueRefusedByUrdf(Rule):
    """A joint type, a shape or a number in URDF is not one that its parser knows.

    **Why.** It refuses the whole file, ``Joint [axis] has no known type [continous]``, and
    robot_state_publisher ends.

    **Fix.** Joints are ``revolute``, ``continuous``, ``prismatic``, ``fixed``, ``floating`` or
    ``planar``; numbers are separated by spaces.

    **Source.** urdfdom, ``joint.cpp``, ``link.cpp`` and ``pose.cpp``.
    """

    code = "UR011"
    name = "value-refused-by-urdf"
    examples = (
        Example(
            "as they are",
            {"robot.urdf": _ROBOT.format('sphere radius="0.1"', "continuous", "0 0.1 -1e-3")},
        ),
        Example(
            "a joint type misspelt; of Gazebo",
            {
                "a.urdf": _ROBOT.format('sphere radius="0.1"', "continous", "0 0 0"),
                "b.urdf": _ROBOT.format('sphere radius="0.1"', "ball", "0 0 0"),
            },
            Report(
                "a.urdf:8:28",
                "unknown joint type 'continous': urdfdom refuses the whole file; "
                "closest: 'continuous'",
            ),
            Report(
                "b.urdf:8:28",
                "unknown joint type 'ball': urdfdom refuses the whole file; known: "
                "revolute, continuous, prismatic, fixed, floating, planar",
            ),
        ),
        Example(
            "a shape of its own; commas; too few",
            {
                "a.urdf": _ROBOT.format('cube size="1 1 1"', "fixed", "0, 0, 0"),
                "b.urdf": _ROBOT.format('box size="1 1"', "fixed", "0 0 0"),
            },
            Report(
                "a.urdf:5:18",
                "unknown shape <cube>: urdfdom refuses the whole file; known: box, "
                "cylinder, sphere, mesh",
            ),
            Report(
                "a.urdf:11:18",
                "xyz is '0, 0, 0', but must be 3 numbers with spaces between: "
                "urdfdom refuses the whole file",
            ),
            Report(
                "b.urdf:5:28",
                "size is '1 1', but must be 3 numbers with spaces between: urdfdom "
                "refuses the whole file",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for part in urdf_parts(package):
            holder = part.holder.tag if part.holder is not None else ""
            type_ = part.get("type") if (holder, part.tag) == ("robot", "joint") else None
            if type_ is not None and is_known(type_) and type_ not in _TYPES:
                closest = closest_name(package, type_.lower(), _TYPES, 0.7)
                hint = f"closest: {closest!r}" if closest else f"known: {', '.join(_TYPES)}"
                message = f"unknown joint type {type_!r}: urdfdom refuses the whole file; {hint}"
                yield self.report(part.at("type"), message)
            if holder == "geometry" and part.tag not in _SHAPES and ":" not in part.tag:
                message = (
                    f"unknown shape <{part.tag}>: urdfdom refuses the whole file; "
                    "known: box, cylinder, sphere, mesh"
                )
                yield self.report(part, message)
            for name, value in part.attributes.items():
                count = _COUNTS.get((part.tag, name))
                if count and is_known(value) and not _fits(value, count):
                    numbers = "a number" if count == 1 else f"{count} numbers with spaces between"
                    message = (
                        f"{name} is {value!r}, but must be {numbers}: urdfdom refuses the "
                        "whole file"
                    )
                    yield self.report(part.at(name), message)


def _fits(value: str, count: int) -> bool:
    """Tell whether a text holds so many numbers."""
    words = value.split()
    try:
        return len([float(word) for word in words]) == count
    except ValueError:
        return False
