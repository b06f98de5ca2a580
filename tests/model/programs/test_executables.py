"""Programs of a package, and their nodes."""

from __future__ import annotations

from scaffold.model.package import Package
from scaffold.model.programs.executables import nodes_of

FILES = {
    "package.xml": "<package><name>talker</name><export><build_type>ament_python</build_type>"
    "</export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(\n    name='talker',\n"
    "    entry_points={'console_scripts': ['talk = talker.talk:main']},\n)\n",
    "talker/talk.py": "from rclpy.node import Node\n\n\nclass Talker(Node):\n"
    "    def __init__(self):\n        super().__init__('talker')\n\n\ndef main():\n    Talker()\n",
}


def test_the_nodes_of_a_program_are_found_once() -> None:
    """Each of thousands of sections in a parameter file asks for them."""
    package = Package.of(FILES)
    result = nodes_of(package, "talk")
    assert [node.node_name for node in result] == ["talker"]
    assert nodes_of(package, "talk") is result
    assert not nodes_of(package, "other")
