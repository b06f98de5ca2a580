"""Packages of a workspace find each other by name."""

from __future__ import annotations

from pathlib import Path

from scaffold.model.package import Package
from scaffold.model.workspace.workspace import Workspace

_LISTS = "project(msgs)\nrosidl_generate_interfaces(msgs msg/{}.msg)\n"


def test_the_closest_of_several_packages_of_a_name_is_meant(tmp_path: Path) -> None:
    workspace = Workspace[Package]()
    users = []
    for side, message in (("robot", "Beat"), ("server", "Map")):
        for name in ("msgs", "node"):
            directory = tmp_path / side / "src" / name
            directory.mkdir(parents=True)
            (directory / "package.xml").write_text(f"<package><name>{name}</name></package>\n")
            workspace.add(Package.at(directory, workspace))
        (directory.parent / "msgs" / "msg").mkdir()
        (directory.parent / "msgs" / "msg" / f"{message}.msg").write_text("float64 rate\n")
        (directory.parent / "msgs" / "CMakeLists.txt").write_text(_LISTS.format(message))
        users.append(workspace.near(str(directory)).by_name["node"])
    robot, server = users
    assert [Path(item.directory).parent.parent.name for item in users] == ["robot", "server"]
    for user, message in ((robot, "Beat"), (server, "Map")):
        package = user.workspace.get("msgs")
        assert package is not None
        assert Path(package.directory).parent == Path(user.directory).parent
        assert user.workspace.interfaces.names("msgs", "msg") == [message]
        assert {item.directory for item in user.workspace} == {user.directory, package.directory}
    assert not robot.workspace.is_hidden(robot)
    assert robot.workspace.is_hidden(server)
