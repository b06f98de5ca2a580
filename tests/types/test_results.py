"""Inferred return annotations of functions whose result does not depend on arguments."""

from __future__ import annotations

import pytest

from scaffold.types.rewriting.results import plain_result


@pytest.mark.parametrize(
    ("body", "type_"),
    [
        ("    return Pose(x=1.0)  # the origin\n", "Pose"),
        ("    pose = msg.Pose()\n    pose.x = 1.0\n    return pose\n", "msg.Pose"),
        ("    return Pose(\n        x=f(1),\n    )\n", "Pose"),
        ("    if given: return None\n    return Pose()\n", "Pose"),
        ("    return self.x, f(1, 2)\n", "tuple[_Ros2Any, _Ros2Any]"),
        ("    return self.tf_buffer.lookup_transform(a, b, c)\n", "_Ros2TransformStamped"),
        ("    now = self.get_clock().now()\n    return now\n", "_Ros2Time"),
        ("    return given.get_clock().now()\n", "_Ros2Time"),
        ("    return self.get_clock().now().to_msg()\n", "_Ros2Stamp"),
        (
            "    return (self.x,\n            'a, b', [1, 2])\n",
            f"tuple[{'_Ros2Any, ' * 2}_Ros2Any]",
        ),
    ],
)
def test_inferred_result_types(body: str, type_: str) -> None:
    assert plain_result("(self, given)", body) == type_


@pytest.mark.parametrize(
    "body",
    [
        "    return self.x\n",
        "    return Pose().x\n",
        "    return Pose() or given\n",
        "    return given\n",
        "    return *given, 1\n",
        "    if given:\n        return 1, 2\n    return 1, 2, 3\n",
        "    if given:\n        return Pose()\n    return given\n",
        "    pose = Pose()\n    pose = f(pose)\n    return pose\n",
        "    pose = Pose()\n    for pose in given:\n        pass\n    return pose\n",
        "    pose, other = Pose(), 1\n    return pose\n",
        "    yield Pose()\n    return Pose()\n",
        "    def inner():\n        return Pose()\n    return inner\n",
        "    return (Pose(), 1)[0]\n",
    ],
)
def test_results_without_inferred_type(body: str) -> None:
    assert plain_result("(self, given)", body) == ""
