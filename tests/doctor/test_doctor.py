"""``doctor`` on environments broken in ways that beginners often run into."""

from __future__ import annotations

import json
import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.diagnostic import Severity
from scaffold.doctor import checks, report, shell
from scaffold.doctor.environments import environments
from scaffold.doctor.machine import Machine
from tests.smoke.smoke_packages import ONCE, python_package
from tests.smoke.smoke_runs import NEEDS_ROS

INDEX = "share/ament_index/resource_index"


def touch(path: Path, text: str = "") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def program(path: Path) -> None:
    touch(path).chmod(0o755)


def installation(root: Path, name: str = "jazzy", *packages: str) -> Path:
    """Write a minimal ROS 2 installation; return its prefix."""
    prefix = root / "ros" / name
    touch(prefix / "setup.bash", "echo sourced >&2; exit 1\n")
    for package in ("rclpy", *packages):
        touch(prefix / INDEX / "packages" / package)
    touch(prefix / INDEX / "rmw_typesupport" / "rmw_fastrtps_cpp")
    return prefix


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Return a directory with programs, a loopback network and an empty current directory."""
    program(tmp_path / "bin" / "python3.12")
    (tmp_path / "bin" / "python3").symlink_to("python3.12")
    program(tmp_path / "bin" / "colcon")
    touch(tmp_path / "net" / "lo" / "flags", "0x1009\n")
    (tmp_path / "home").mkdir()
    return tmp_path


def machine(root: Path, *directory: Path, **variables: str) -> Machine:
    return Machine(
        variables={"PATH": str(root / "bin"), "HOME": str(root / "home"), **variables},
        installed=str(root / "ros"),
        own_prefix=str(root / "own"),
        directory=str(*directory or [root / "home"]),
        network=str(root / "net"),
    )


def sourced(prefix: Path, **more: str) -> Mapping[str, str]:
    paths = {"AMENT_PREFIX_PATH": str(prefix), "ROS_DISTRO": prefix.name}
    return {**paths, "PYTHONPATH": str(prefix / "lib/python3.12/site-packages"), **more}


def assert_command(fix: str) -> None:
    """Fail unless a fix is a command that can be pasted into a shell."""
    bash = ["bash", "--norc", "-c"]
    words = shlex.split(fix, comments=True)
    assert subprocess.run(["bash", "-n", "-c", fix], check=False).returncode == 0
    known = {"sudo", "conda", "ros2", "colcon"}
    is_builtin = subprocess.run([*bash, f"type -t {words[0]}"], capture_output=True, check=False)
    assert words[0] in known or is_builtin.returncode == 0, fix


def found(seen: Machine) -> dict[str, tuple[str, str, str]]:
    result = {}
    for name, finding in checks.run(seen):
        assert name not in result, "two findings of one check"
        assert_command(finding.fix)
        result[name] = (finding.severity.value, finding.message, finding.fix)
    return result


def test_sourced_installation_has_no_findings(root: Path) -> None:
    seen = machine(root, **sourced(installation(root)))
    assert found(seen) == {}
    assert [item.taken for item in environments(seen)] == [True, False, False]
    assert report.is_ok(environments(seen), [])


def test_installation_that_is_not_sourced(root: Path) -> None:
    prefix = installation(root)
    seen = machine(root, SHELL="/usr/bin/zsh")
    assert found(seen) == {
        "not-sourced": (
            "warning",
            f"ROS 2 is installed in {prefix}, but not sourced: `ros2` and `import rclpy` fail",
            f"source {prefix}/setup.zsh",
        )
    }
    assert [item.taken for item in environments(seen)] == [False, True, False]


def test_two_distributions_in_one_shell(root: Path) -> None:
    jazzy, humble = installation(root), installation(root, "humble")
    variables = dict(sourced(jazzy, ROS_DISTRO="humble"))
    variables["PYTHONPATH"] += f":{humble}/lib/python3.12/site-packages"
    every = [finding for _, finding in checks.run(machine(root, **variables))]
    assert [finding.severity for finding in every] == [Severity.ERROR, Severity.ERROR]
    assert every[0].message == (
        "two distributions are sourced in one shell: humble in PYTHONPATH; jazzy in "
        "AMENT_PREFIX_PATH, PYTHONPATH; their libraries are incompatible"
    )
    assert every[1].message == "ROS_DISTRO is 'humble', but AMENT_PREFIX_PATH contains jazzy"


def test_workspace_that_was_built_with_another_distribution(root: Path) -> None:
    top = workspace(root)
    chain = f'COLCON_CURRENT_PREFIX="{root}/ros/humble"\n_colcon_prefix_chain_sh_source_script x\n'
    touch(top / "install" / "setup.sh", chain)
    severity, message, fix = found(machine(root, top, **sourced(installation(root))))[
        "mixed-distributions"
    ]
    assert severity == "error"
    assert message == (f"{top}/install was built with humble, which its setup files source")
    assert fix == f"cd {top} && rm -r build install && colcon build"


@pytest.mark.parametrize(
    ("name", "variables", "severity", "message", "fix"),
    [
        (
            "rmw-missing",
            {"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"},
            "error",
            (
                "RMW_IMPLEMENTATION is 'rmw_cyclonedds_cpp', which is not installed: `import "
                "rclpy` fails; installed: rmw_fastrtps_cpp"
            ),
            "sudo apt install ros-jazzy-rmw-cyclonedds-cpp  # or: unset RMW_IMPLEMENTATION",
        ),
        (
            "domain-id",
            {"ROS_DOMAIN_ID": "233"},
            "error",
            "ROS_DOMAIN_ID is '233': no node starts; use a number from 0 to 232",
            "export ROS_DOMAIN_ID=0",
        ),
        (
            "domain-id",
            {"ROS_DOMAIN_ID": "five"},
            "error",
            "ROS_DOMAIN_ID is 'five': no node starts; use a number from 0 to 232",
            "export ROS_DOMAIN_ID=0",
        ),
        (
            "domain-id",
            {"ROS_DOMAIN_ID": "150"},
            "warning",
            "ROS_DOMAIN_ID is 150: its ports may be in use by other programs",
            "export ROS_DOMAIN_ID=48  # a number from 0 to 101",
        ),
        (
            "discovery",
            {"ROS_LOCALHOST_ONLY": "1"},
            "warning",
            "ROS_LOCALHOST_ONLY is deprecated in jazzy",
            "unset ROS_LOCALHOST_ONLY; export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST",
        ),
        (
            "discovery",
            {"ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF"},
            "warning",
            (
                "ROS_AUTOMATIC_DISCOVERY_RANGE is 'OFF': nodes do not find each other, not even on "
                "this machine"
            ),
            "unset ROS_AUTOMATIC_DISCOVERY_RANGE",
        ),
        (
            "discovery",
            {"ROS_AUTOMATIC_DISCOVERY_RANGE": "lan"},
            "warning",
            "ROS_AUTOMATIC_DISCOVERY_RANGE is 'lan', which counts as LOCALHOST",
            "export ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET  # or LOCALHOST, OFF, SYSTEM_DEFAULT",
        ),
    ],
)
def test_invalid_environment_variable(
    root: Path, name: str, variables: dict[str, str], severity: str, message: str, fix: str
) -> None:
    seen = machine(root, **sourced(installation(root), **variables))
    assert found(seen) == {name: (severity, message, fix)}


def test_fix_for_unknown_middleware_is_to_unset_the_variable(root: Path) -> None:
    seen = machine(root, **sourced(installation(root), RMW_IMPLEMENTATION="rmw_cyclone"))
    assert found(seen)["rmw-missing"][2] == "unset RMW_IMPLEMENTATION"


def test_localhost_only_is_right_in_humble(root: Path) -> None:
    prefix = installation(root, "humble")
    assert found(machine(root, **sourced(prefix, ROS_LOCALHOST_ONLY="1"))) == {}
    reach = sourced(prefix, ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST")
    assert found(machine(root, **reach))["discovery"][1] == (
        "humble ignores ROS_AUTOMATIC_DISCOVERY_RANGE"
    )


@pytest.mark.parametrize(
    ("flags", "rmw", "severity", "fix"),
    [
        ("0x8", "rmw_fastrtps_cpp", "error", "sudo ip link set lo up"),
        ("0x9", "rmw_fastrtps_cpp", "info", "sudo ip link set lo multicast on"),
        ("0x9", "rmw_cyclonedds_cpp", "warning", "sudo ip link set lo multicast on"),
    ],
)
def test_loopback_network_problems(
    root: Path, flags: str, rmw: str, severity: str, fix: str
) -> None:
    prefix = installation(root)
    touch(prefix / INDEX / "rmw_typesupport" / rmw)
    touch(root / "net" / "lo" / "flags", flags)
    result = found(machine(root, **sourced(prefix, RMW_IMPLEMENTATION=rmw)))
    assert (result["loopback"][0], result["loopback"][2]) == (severity, fix)


def test_missing_colcon(root: Path) -> None:
    (root / "bin" / "colcon").unlink()
    seen = machine(root, **sourced(installation(root)))
    assert found(seen)["colcon-missing"][2] == "sudo apt install python3-colcon-common-extensions"
    first = environments(seen)[0]
    assert (first.is_usable, [item.what for item in first.missing]) == (False, ["colcon"])
    text = "\n".join(report.text(environments(seen), []))
    assert "    colcon is missing: sudo apt install python3-colcon-common-extensions" in text
    assert "error: no ROS 2 environment can build and run packages; install one of these" in text


def test_colcon_of_sourced_wheels_is_not_on_path(root: Path) -> None:
    (root / "bin" / "colcon").unlink()
    wheels = root / "venv"
    touch(wheels / INDEX / "packages" / "rclpy")
    program(wheels / "bin" / "colcon")
    variables = {"AMENT_PREFIX_PATH": str(wheels), "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"}
    result = found(machine(root, **variables))
    assert result["colcon-missing"][2] == f"export PATH={wheels}/bin:$PATH"
    assert result["rmw-missing"][2] == "unset RMW_IMPLEMENTATION"


def test_package_that_shadows_another(root: Path) -> None:
    prefix = installation(root, "jazzy", "std_msgs")
    overlay = root / "ws" / "install" / "std_msgs"
    touch(overlay / INDEX / "packages" / "std_msgs")
    variables = dict(sourced(prefix))
    variables["AMENT_PREFIX_PATH"] = f"{overlay}:{prefix}"
    severity, message, _ = found(machine(root, **variables))["shadowed-packages"]
    assert (severity, message) == ("info", f"'std_msgs' in {overlay} shadows the one in {prefix}")


def test_removed_installation_is_still_on_the_path(root: Path) -> None:
    gone = root / "ros" / "iron"
    severity, message, fix = found(machine(root, AMENT_PREFIX_PATH=str(gone)))["prefix-gone"]
    assert (severity, fix.startswith(f"grep -n {gone} ~/.bashrc")) == ("error", True)
    assert (
        message == f"AMENT_PREFIX_PATH contains {gone}, which does not exist: no package is found"
    )
    variables = sourced(installation(root))
    both = {**variables, "AMENT_PREFIX_PATH": f"{variables['AMENT_PREFIX_PATH']}:{gone}"}
    severity, message, _ = found(machine(root, **both))["prefix-gone"]
    assert (severity, message.endswith(": nothing in it is found")) == ("warning", True)


@pytest.mark.parametrize(("isolated", "is_found"), [("false", True), ("true", False)])
def test_virtual_environment_without_system_packages(
    root: Path, isolated: str, *, is_found: bool
) -> None:
    active = root / "venv"
    touch(active / "pyvenv.cfg", f"version = 3.12.3\ninclude-system-site-packages = {isolated}\n")
    result = found(machine(root, **sourced(installation(root), VIRTUAL_ENV=str(active))))
    assert ("virtual-environment" in result) == is_found


def test_active_conda_environment(root: Path) -> None:
    result = found(machine(root, **sourced(installation(root), CONDA_PREFIX="/opt/conda")))
    assert result["virtual-environment"][2] == "conda deactivate"


@pytest.mark.parametrize("version", ["3.10", "3.12"])
def test_modules_of_another_python(root: Path, version: str) -> None:
    path = f"{root}/ros/jazzy/lib/python{version}/site-packages"
    result = found(machine(root, **sourced(installation(root), PYTHONPATH=path)))
    if version == "3.12":
        assert result == {}
        return
    severity, message, _ = result["python-versions"]
    assert severity == "error"
    assert message.startswith(f"PYTHONPATH names {path}, but python3 is 3.12 ({root}/bin/python3)")


# -- workspaces


def workspace(root: Path, *names: str) -> Path:
    """Write a workspace with packages that look built."""
    top = root / "ws"
    touch(top / "install" / ".colcon_install_layout", "isolated\n")
    (top / "src").mkdir(exist_ok=True)
    for name in names:
        touch(top / "src" / name / "package.xml", f"<package><name>{name}</name></package>")
        touch(top / "install" / name / "share" / name / "package.xml")
    return top


def test_removed_or_renamed_package_is_still_installed(root: Path) -> None:
    top = workspace(root, "talker", "old_name")
    shutil.rmtree(top / "src" / "old_name")
    result = found(machine(root, top, **sourced(installation(root))))
    assert result == {
        "stale-install": (
            "warning",
            (
                f"'old_name' is installed in {top}/install, but no longer in src: `ros2 run` "
                "still finds it"
            ),
            f"rm -r {top}/build/old_name {top}/install/old_name",
        )
    }


def test_duplicate_package(root: Path) -> None:
    top = workspace(root, "talker")
    shutil.copytree(top / "src" / "talker", top / "src" / "copy")
    severity, message, _ = found(machine(root, top, **sourced(installation(root))))["stale-install"]
    assert severity == "error"
    assert message.startswith("two packages are called 'talker': ")


def test_sourced_workspace_is_examined(root: Path) -> None:
    top = workspace(root, "talker")
    touch(top / "src" / "new" / "package.xml", "<package><name>new</name></package>")
    prefix = installation(root)
    variables = dict(sourced(prefix))
    variables["AMENT_PREFIX_PATH"] = f"{top}/install/talker:{prefix}"
    assert found(machine(root, **variables))["stale-install"][:2] == ("info", "'new' is not built")


@pytest.mark.build
@NEEDS_ROS
@pytest.mark.parametrize("flags", [[], ["--symlink-install"]])
def test_sources_newer_than_the_build(root: Path, flags: list[str]) -> None:
    top = root / "ws"
    package = python_package(top / "src", "demo", {"once": ONCE})
    colcon = os.path.join(os.path.dirname(sys.executable), "colcon")
    variables = {**os.environ, "AMENT_PREFIX_PATH": sys.prefix}
    subprocess.run([colcon, "build", *flags], cwd=top, env=variables, check=True)
    seen = machine(root, top, **sourced(installation(root)))
    assert found(seen) == {}
    later = os.stat(top / "install").st_mtime + 1000
    os.utime(package / "demo" / "once.py", (later, later))
    assert ("stale-install" in found(machine(root, top))) == (not flags)
    os.utime(package / "setup.py", (later, later))
    assert found(machine(root, top))["stale-install"][1] in (
        "src/demo/setup.py has changed since 'demo' was built: the old code runs",
        "src/demo/demo/once.py has changed since 'demo' was built: the old code runs",
    )


# -- shells


@pytest.mark.parametrize("name", shell.SHELLS)
def test_shell_lines_set_up_the_environment(root: Path, name: str) -> None:
    interpreter = shutil.which(name)
    if interpreter is None:
        pytest.skip(f"no {name}")
    top = workspace(root)
    hostile = root / "it's $(touch made) a `ws`"
    top.rename(hostile)
    touch(installation(root) / f"setup.{name}", "export IS_SOURCED=yes\n")
    touch(hostile / "install" / f"local_setup.{name}", "export IS_LOCAL=yes\n")
    start = touch(root / "start", "\n".join(shell.lines(machine(root, hostile), name)) + "\n")
    shown = "functions" if name == "fish" else "alias"
    bare = {"bash": ["--norc", "--noprofile"], "zsh": ["-f"], "fish": ["--no-config"]}[name]
    done = subprocess.run(
        [interpreter, *bare, "-c", f"source {start}; {shown} build; env"],
        env={"PATH": "/usr/bin:/bin", "HOME": str(root / "home")},
        cwd=root,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""
    assert "colcon build" in done.stdout
    assert not (root / "made").exists()
    if name != "fish":
        assert "IS_SOURCED=yes" in done.stdout
        assert "IS_LOCAL=yes" in done.stdout


# -- the command line


def test_json_holds_environments_and_findings(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_DOMAIN_ID", "999\x1b")
    assert main(["doctor", "--format", "json"]) == 1
    data = json.loads(capsys.readouterr().out)
    assert (data["schema_version"], data["ok"]) == (1, False)
    assert [item["kind"] for item in data["environments"]][::2] == ["sourced", "wheels"]
    assert "domain-id" in [item["name"] for item in data["findings"]]
    assert main(["doctor"]) == 1
    text = capsys.readouterr().out
    assert "error: ROS_DOMAIN_ID is '999\\x1b'" in text
    assert text.endswith(("problems\n", "1 problem\n"))


def test_shell_lines_go_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor", "--shell", "bash"]) == 0
    assert "alias build=" in capsys.readouterr().out
