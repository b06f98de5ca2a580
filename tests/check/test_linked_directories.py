"""Links to directories, whose files are not among those of the package."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main


def test_installed_link_to_a_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "package.xml").write_text("<package format='3'><name>maps</name></package>\n")
    (tmp_path / "CMakeLists.txt").write_text(
        "project(maps)\ninstall(DIRECTORY config launch DESTINATION share/maps)\n"
    )
    (tmp_path / "sites" / "office").mkdir(parents=True)
    (tmp_path / "sites" / "office" / "map.yaml").write_text("resolution: 0.05\n")
    (tmp_path / "config").symlink_to("sites/office")
    (tmp_path / "launch").symlink_to("nowhere")
    main(["check", "--select", "CM011", "--format", "json"])
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    assert [item["message"].split(",")[0] for item in findings] == [
        "installs the directory launch/"
    ]


def test_import_of_a_module_in_a_linked_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "package.xml").write_text("<package format='3'><name>maps</name></package>\n")
    (tmp_path / "setup.py").write_text(
        "from setuptools import setup\n\nsetup(name='maps', packages=['maps', 'maps.sites'])\n"
    )
    (tmp_path / "maps").mkdir()
    (tmp_path / "maps" / "__init__.py").touch()
    (tmp_path / "maps" / "node.py").write_text(
        "from .sites.office import plan\nfrom .sites.garden import tree\n"
    )
    (tmp_path / "shared").mkdir()
    (tmp_path / "shared" / "office.py").write_text("plan = None\n")
    (tmp_path / "maps" / "sites").symlink_to("../shared")
    main(["check", "--select", "IM041", "--format", "json"])
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    assert [item["message"] for item in findings] == [
        "the package has no module 'maps.sites.garden': ModuleNotFoundError"
    ]
