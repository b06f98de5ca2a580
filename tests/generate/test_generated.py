"""Generated packages, tested with the real tools: linters, colcon, middleware, signals."""

from __future__ import annotations

import ast
import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from itertools import cycle, islice, product
from pathlib import Path
from textwrap import dedent
from typing import NamedTuple

import pytest
from lxml import etree

from scaffold.check.rules import registry
from scaffold.check.selection import Selection
from scaffold.check.session import Session
from scaffold.configuration import content
from scaffold.generate import draft
from scaffold.generate.questions import answer_types, names, qos
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import licenses, loading, template
from scaffold.generate.templates.template import Role
from scaffold.model.discovery import targets
from scaffold.smoke import environment
from scaffold.smoke.isolation import domain
from scaffold.writing.plan import WritePlan
from tests import PATIENCE, oracles
from tests.oracles import needs_system_linter

ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)
BUILD_TYPES = ("ament_cmake", "ament_python")
COMMENTS = ("brief", "tutorial")
TYPES = (
    *("Bool", "Byte", "Char", "Float32", "Float64", "Header", "String"),
    *(f"{sign}Int{bits}" for sign in ("", "U") for bits in (8, 16, 32, 64)),
)
"""Of std_msgs."""
KINDS = template.of_role(TEMPLATES, Role.NODE)
QUALITIES = (*qos.NAMES, "best_effort,depth=5,deadline=0.5,lifespan=2")
AVAILABLE = {"service": "std_srvs/srv/SetBool", "action": "test_msgs/action/Fibonacci"}
"""By the type of a question an interface that is installed where the tests run."""
HOSTILE = 'It\'s "a" & <b> {{ package }} {% x %} ${HOME} \\ `id` ' + "long " * 40

needs_ros = pytest.mark.skipif(
    find_spec("rclpy") is None and not Path("/opt/ros").exists(),
    reason="no ROS 2: install the extra 'ros' of this project",
)


def write(destination: Path, **answers: object) -> Path:
    """Write a package as `new` does; return its directory."""
    given = {
        "maintainer_name": "Seán O'Brien",
        "maintainer_email": "sean@example.com",
        **answers,
    }
    asked = {name: Given(value, name) for name, value in given.items()}
    made = draft.draft(ROOTS, TEMPLATES, asked, User(str(destination)))
    directory = destination / made.name
    plan = WritePlan.of(directory, made.rendered.files, executable=made.rendered.executable)
    plan.write()
    return directory


def available(kind: str) -> dict[str, object]:
    """Return answers for a kind of node whose default interfaces may not be installed."""
    questions = TEMPLATES[kind].questions
    return {
        question.name: AVAILABLE[question.type]
        for question in questions
        if question.type in AVAILABLE
    }


@pytest.fixture(scope="module")
def combinations(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write every combination of answers, cycling through licenses and qualities of service."""
    root = tmp_path_factory.mktemp("combinations")
    known = licenses.names(ROOTS)
    more = zip(cycle(known), cycle(QUALITIES), cycle(("", HOSTILE)), strict=False)
    published = product(BUILD_TYPES, COMMENTS, ["publisher"], TYPES)
    others = product(BUILD_TYPES, COMMENTS, [kind for kind in KINDS if kind != "publisher"])
    for (build_type, comments, kind, name), (license_, quality, description) in zip(
        [*published, *((*item, name) for item, name in zip(others, cycle(TYPES), strict=False))],
        more,
        strict=False,
    ):
        write(
            root,
            package=f"{build_type[6:]}_{comments}_{name if kind == 'publisher' else kind}".lower(),
            build_type=build_type,
            comments=comments,
            node_kind=kind,
            message_type=f"std_msgs/msg/{name}",
            license=license_,
            qos=quality,
            **({"description": description} if description else {}),
        )
    for build_type, kind in product(BUILD_TYPES, KINDS):
        write(root, **longest_answers(build_type, kind))
    return root


def longest_answers(build_type: str, kind: str) -> dict[str, object]:
    """Return answers of maximum length."""
    graph_names = {
        question.name: question.name[0] * (names.MAX_TOPIC - 1)
        for question in TEMPLATES[kind].questions
        if question.type in {"topic", "service_name", "action_name"}
    }
    frames = {
        question.name: question.name[0] * names.MAX_FRAME
        for question in TEMPLATES[kind].questions
        if question.type == "frame"
    }
    return {
        "package": f"{build_type[6]}_{kind}_{'x' * names.MAX_LENGTH}"[: names.MAX_LENGTH],
        "node_kind": kind,
        "node_name": "n" * names.MAX_LENGTH,
        "build_type": build_type,
        "comments": "tutorial",
        **graph_names,
        **frames,
        "message_type": "std_msgs/msg/Float64",
        "qos": "action_status_default",
        "license": "BSL-1.0",
        "description": "word " * 200 + "w" * 300,
        "maintainer_name": "M" * answer_types.MAX_PERSON,
        "maintainer_email": "m" * (answer_types.MAX_PERSON - 12) + "@example.com",
    }


# -- linters


def test_ament_flake8(combinations: Path) -> None:
    assert oracles.ament_flake8(combinations) == set()


def test_ament_pep257(combinations: Path) -> None:
    assert oracles.ament_pep257(combinations) == set()


@needs_system_linter("ament_copyright")
def test_ament_copyright(combinations: Path) -> None:
    assert oracles.ament_copyright(combinations) == set()


@needs_system_linter("ament_copyright")
@pytest.mark.parametrize("license_", licenses.names(ROOTS))
def test_ament_copyright_knows_the_text_of_each_license(license_: str, tmp_path: Path) -> None:
    directory = write(tmp_path, package="talker", license=license_)
    (directory / ".git").mkdir()  # the root of a repository needs LICENSE and CONTRIBUTING.md
    assert {finding.path for finding in oracles.ament_copyright(directory)} == {"CONTRIBUTING.md"}


@needs_system_linter("ament_lint_cmake")
def test_ament_lint_cmake(combinations: Path) -> None:
    assert oracles.ament_lint_cmake(combinations) == set()


@needs_system_linter("ament_xmllint")
def test_ament_xmllint(combinations: Path) -> None:
    assert oracles.ament_xmllint(combinations) == set()


def test_check_has_no_findings(combinations: Path) -> None:
    session = Session(registry.load(content.roots("rules")), Selection())
    results = list(session.run(targets.find([str(combinations)])))
    assert len(results) == len(os.listdir(combinations)) > len(BUILD_TYPES) * len(KINDS)
    assert [finding for result in results for finding in result.diagnostics] == []


@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # of catkin_pkg and docutils
def test_catkin_pkg_reads_the_changelog(combinations: Path) -> None:
    tag = pytest.importorskip("catkin_pkg.cli.tag_changelog")
    changelog = pytest.importorskip("catkin_pkg.changelog")
    for directory in islice(combinations.iterdir(), 4):
        text = (directory / "CHANGELOG.rst").read_text()
        label = tag.get_forthcoming_label(text)
        assert label == "Forthcoming"
        released = tag.rename_section(text, label, "0.1.0 (2025-10-09)")
        result = changelog.populate_changelog_from_rst(changelog.Changelog("x"), released)
        assert [version for version, _, _ in result.foreach_version()] == ["0.1.0"]


# -- colcon


class Workspace(NamedTuple):
    """A workspace, and the ROS 2 environment to build it with."""

    root: Path
    ros: environment.Environment

    def colcon(self, *arguments: str, **more: str) -> subprocess.CompletedProcess[str]:
        variables = {**self.ros.variables, **more}
        variables.pop("PYTHONDONTWRITEBYTECODE", None)  # setuptools would warn of it
        return subprocess.run(
            [self.ros.colcon, *arguments],
            cwd=self.root,
            env=variables,
            capture_output=True,
            text=True,
            check=False,
        )

    def log(self, verb: str, package: str, name: str) -> str:
        return (self.root / "log" / f"latest_{verb}" / package / name).read_text()


def missing_libraries(kind: str) -> list[str]:
    """Return the libraries that a template needs and that are not installed."""
    needed = [name for name in TEMPLATES[kind].depends.get("exec", ()) if "{" not in name]
    if Path("/opt/ros").exists():
        return []
    return [name for name in needed if find_spec(name.removeprefix("python3-")) is None]


NOT_INSTALLED = sorted(
    {name for kind in (*KINDS, "description") for name in missing_libraries(kind)}
)
MORE_KINDS = [{"kind": kind} for kind in KINDS if missing_libraries(kind)]
"""They are built, and tested where their libraries are installed."""
ALL_KINDS = [
    *({"kind": kind, **available(kind)} for kind in KINDS if not missing_libraries(kind)),
    {"kind": "subscriber", "name": "second", "topic": "~/input", "qos": "latched,deadline=0.5"},
]
SOME_KINDS = ALL_KINDS[::4]
"""Their tests are the same for both build types, and take minutes."""
BUILT: Mapping[str, Mapping[str, object]] = {
    "cmake_string": {"license": "Apache-2.0"},
    "cmake_float": {
        "message_type": "std_msgs/Float32",
        "comments": "tutorial",
        "license": "BSD-3-Clause",
        "qos": "sensor_data",
        "node_name": "sine",
        "topic": "~/sine",
        "description": HOSTILE,
        "dependencies": ["sensor_msgs"],
    },
    "cmake_header": {
        "message_type": "std_msgs/Header",
        "license": "MIT",
        "qos": "action_status_default",
        "rate": 100,
    },
    "python_bool": {"message_type": "std_msgs/Bool", "comments": "tutorial", "qos": 1},
    "python_byte": {
        "message_type": "std_msgs/Byte",
        "license": "GPL-3.0-or-later",
        "topic": "/absolute/name",
        "description": HOSTILE,
    },
    "python_int": {"message_type": "std_msgs/UInt8", "license": "BSL-1.0", "rate": 0.5},
    "cmake_kinds": {"add": ALL_KINDS, "comments": "tutorial", "license": "BSD-2-Clause"},
    "python_kinds": {"add": SOME_KINDS, "license": "LGPL-3.0-only"},
    "cmake_description": {"add": [], "extras": ["description"]},
    "python_description": {"add": [], "extras": ["description"]},
    **({"cmake_more": {"add": MORE_KINDS}} if MORE_KINDS else {}),
}
TESTED = [
    *("cmake_float", "cmake_kinds", "python_bool", "python_kinds"),
    *([] if missing_libraries("description") else ["cmake_description", "python_description"]),
]


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Workspace:
    """Build packages that cover build types, comments, licenses and qualities of service."""
    made = Workspace(tmp_path_factory.mktemp("ws"), environment.select(os.environ))
    with pytest.MonkeyPatch.context() as sourced:
        sourced.setenv("AMENT_PREFIX_PATH", made.ros.variables["AMENT_PREFIX_PATH"])
        for name, answers in BUILT.items():
            build_type = "ament_" + name.partition("_")[0]
            write(made.root / "src", package=name, build_type=build_type, **answers)
    done = made.colcon("build")
    assert done.returncode == 0, done.stdout + done.stderr
    return made


@pytest.mark.build
@needs_ros
def test_colcon_build_has_no_stderr(workspace: Workspace) -> None:
    for name in BUILT:
        assert workspace.log("build", name, "stderr.log") == ""
        assert "warning" not in workspace.log("build", name, "stdout_stderr.log").lower()
        installed = list((workspace.root / "install" / name / "lib" / name).glob("*"))
        nodes = BUILT[name].get("add")
        assert len(installed) == (len(nodes) if isinstance(nodes, list) else 1)


@pytest.mark.build
@needs_ros
@needs_system_linter("ament_lint_auto")
@needs_system_linter("ament_copyright")
@pytest.mark.timeout(2400)
def test_colcon_test_runs_tests_and_linters(workspace: Workspace, tmp_path: Path) -> None:
    make_importable(system_module("ament_copyright"), tmp_path)
    path = os.pathsep.join(filter(None, [str(tmp_path), workspace.ros.variables.get("PYTHONPATH")]))
    done = workspace.colcon(
        "test",
        "--return-code-on-test-failure",
        "--executor",
        "sequential",
        "--packages-select",
        *TESTED,
        "--ctest-args",
        "--parallel=2",  # each test waits for its node most of the time
        PYTHONPATH=path,
    )
    assert done.returncode == 0, workspace.colcon("test-result", "--verbose").stdout
    build = workspace.root / "build"
    sine = results_of(build / "cmake_float")
    assert sine.pop("test_sine") == (4, 0)
    linters = {"copyright", "flake8", "lint_cmake", "pep257", "xmllint"}
    assert {name for name, (ran, _) in sine.items() if ran} == linters
    kinds = results_of(build / "cmake_kinds")
    of_nodes = {name for name, (ran, _) in kinds.items() if ran >= 2}
    assert len(of_nodes - linters) == len(ALL_KINDS)
    assert [skipped for _, skipped in (*sine.values(), *kinds.values()) if skipped] == []
    assert counts(build / "python_bool" / "pytest.xml") == (7, 0)
    tests = {path.stem for path in (workspace.root / "src/python_kinds/test").glob("test_*.py")}
    ran = sum(kinds[name][0] for name in tests & (of_nodes - linters))
    assert ran >= 2 * len(SOME_KINDS)
    assert counts(build / "python_kinds" / "pytest.xml") == (ran + 3, 0)


@pytest.mark.skipif(bool(NOT_INSTALLED), reason=f"not installed: {', '.join(NOT_INSTALLED)}")
def test_the_tests_of_every_kind_are_run() -> None:
    assert not MORE_KINDS
    assert "cmake_description" in TESTED


@pytest.mark.build
@needs_ros
def test_missing_linters_are_skipped(workspace: Workspace) -> None:
    select = ["--packages-select", "cmake_string"]
    without = "-DCMAKE_DISABLE_FIND_PACKAGE_ament_lint_auto=TRUE"
    done = workspace.colcon("build", *select, "--cmake-args", without)
    assert done.returncode == 0, done.stdout + done.stderr
    assert workspace.log("build", "cmake_string", "stderr.log") == ""
    assert workspace.colcon("test", "--return-code-on-test-failure", *select).returncode == 0
    results = workspace.root / "build" / "cmake_string" / "test_results" / "cmake_string"
    assert {file.name.partition(".")[0]: counts(file) for file in results.iterdir()} == {
        "linters": (1, 1),
        "test_minimal_publisher": (4, 0),
    }


def system_module(name: str) -> Path:
    """Return the directory of the Python package behind a program of the same name."""
    variables = oracles.system_environment()
    program = shutil.which(name, path=variables.get("PATH"))
    assert program is not None
    interpreter = Path(program).read_text().partition("\n")[0].removeprefix("#!").split()
    done = subprocess.run(
        [*interpreter, "-c", f"import {name}; print({name}.__path__[0])"],
        env=variables,
        capture_output=True,
        text=True,
        check=True,
    )
    return Path(done.stdout.strip())


def make_importable(module: Path, directory: Path) -> None:
    """Make one system module importable without the others in its directory."""
    for path in module.parent.glob(f"{module.name}*"):
        (directory / path.name).symlink_to(path)


def results_of(build: Path) -> dict[str, tuple[int, int]]:
    """Return the counts of the reports of an ament_cmake package by test name."""
    return {file.name.partition(".")[0]: counts(file) for file in build.rglob("*.xunit.xml")}


def counts(report: Path) -> tuple[int, int]:
    """Return how many tests a report has and how many were skipped; fail if any failed."""
    suites = list(etree.parse(report).getroot().iter("testsuite"))
    total = {
        key: sum(int(suite.get(key, "0")) for suite in suites)
        for key in ("tests", "failures", "errors", "skipped")
    }
    assert total["failures"] == total["errors"] == 0, report.read_text()
    return total["tests"], total["skipped"]


# -- running


@pytest.fixture
def variables(tmp_path: Path) -> Iterator[dict[str, str]]:
    """Return the variables of an isolated environment to run nodes in."""
    with domain.reserved() as number:
        yield {
            **environment.select(os.environ).variables,
            "ROS_DOMAIN_ID": str(number),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_LOG_DIR": str(tmp_path),
            "PYTHONUNBUFFERED": "1",
        }


OBSERVE = dedent("""\
    import json
    import sys
    import time
    from importlib import import_module
    from pathlib import Path

    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    root, *packages = sys.argv[1:]
    rclpy.init(args=['--ros-args', '-p', 'rate:=20.0', '--log-level', 'warn'])
    executor = SingleThreadedExecutor()
    observer = rclpy.create_node('observer')
    executor.add_node(observer)
    messages = {}
    for package in packages:
        sys.path.insert(0, str(Path(root, package)))
        module = import_module(f'{package}.minimal_publisher')
        node = module.MinimalPublisher()
        executor.add_node(node)
        message = node.publisher.msg_type
        received = messages[package] = []
        topic = f'/{package}'
        node.destroy_publisher(node.publisher)
        node.publisher = node.create_publisher(message, topic, 10)
        observer.create_subscription(message, topic, received.append, 10)
    deadline = time.monotonic() + 240
    while min(map(len, messages.values())) < 4 and time.monotonic() < deadline:
        executor.spin_once(timeout_sec=0.1)
    print(json.dumps({
        package: [repr(getattr(message, 'data', message)) for message in received[:4]]
        for package, received in messages.items()
    }))
""")


@pytest.mark.build
@needs_ros
def test_every_type_is_published(
    combinations: Path, variables: dict[str, str], tmp_path: Path
) -> None:
    script = tmp_path / "observe.py"
    script.write_text(OBSERVE)
    packages = [f"cmake_brief_{name.lower()}" for name in TYPES]
    command = [sys.executable, str(script), str(combinations), *packages]
    diagnostics = subprocess.run(command, env=variables, capture_output=True, text=True, check=True)
    received = {
        name.removeprefix("cmake_brief_"): messages
        for name, messages in json.loads(diagnostics.stdout.splitlines()[-1]).items()
    }
    for name in ("int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64", "char"):
        assert_counts([int(value) for value in received[name]])
    assert_counts([ast.literal_eval(value)[0] for value in received["byte"]])
    assert_counts(
        [int(value.strip("'").removeprefix("Hello World: ")) for value in received["string"]]
    )
    assert received["bool"] in (["True", "False"] * 2, ["False", "True"] * 2)
    for name in ("float32", "float64"):
        sine = [float(value) for value in received[name]]
        assert sine == sorted(set(sine)), name  # the wave starts upwards
        assert 0.0 <= sine[0] < sine[-1] <= 1.0, name
    assert len(set(received["header"])) == 4
    assert all("frame_id='base_link'" in header for header in received["header"])


def assert_counts(numbers: list[int]) -> None:
    assert numbers == list(range(numbers[0], numbers[0] + 4))


@pytest.mark.build
@needs_ros
@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM])
def test_executables_exit_with_0_without_output(
    workspace: Workspace, variables: dict[str, str], stop: signal.Signals
) -> None:
    sourced = environment.source(workspace.root / "install" / "setup.bash", variables)
    for name in (item for item in BUILT if "add" not in BUILT[item]):
        (executable,) = (workspace.root / "install" / name / "lib" / name).iterdir()
        command = [str(executable), "--ros-args", "-p", "rate:=2.0"]
        with running(command, sourced) as node:
            assert stopped(node, stop) == []


@pytest.mark.build
@needs_ros
@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM])
def test_fast_node_exits_with_0_at_any_time(
    combinations: Path, variables: dict[str, str], stop: signal.Signals
) -> None:
    script = combinations / "cmake_brief_string" / "cmake_brief_string" / "minimal_publisher.py"
    command = [sys.executable, str(script), "--ros-args", "-p", "rate:=1000.0"]
    for _ in range(8):
        with running(command, variables) as node:
            assert stopped(node, stop) == []


CREATED = dedent("""\
    import os
    import signal
    import sys

    from minimal_publisher import main, MinimalPublisher

    create_timer = MinimalPublisher.create_timer


    def create_after_signal(self, *arguments):
        os.kill(os.getpid(), int(sys.argv[1]))
        return create_timer(self, *arguments)


    MinimalPublisher.create_timer = create_after_signal
    main()
""")


@pytest.mark.build
@needs_ros
@pytest.mark.parametrize("stop", [signal.SIGINT, signal.SIGTERM])
def test_node_exits_with_0_during_construction(
    combinations: Path, variables: dict[str, str], tmp_path: Path, stop: signal.Signals
) -> None:
    package = combinations / "cmake_brief_string" / "cmake_brief_string"
    script = tmp_path / "created.py"
    script.write_text(CREATED)
    done = subprocess.run(
        [sys.executable, str(script), str(int(stop))],
        env={**variables, "PYTHONPATH": str(package)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")


LOST = dedent("""\
    import sys
    from threading import Timer

    from minimal_publisher import main, MinimalPublisher
    import rclpy


    def fail(self):
        if sys.argv[1] == 'signal':  # what a signal does, whose KeyboardInterrupt rclpy has lost
            Timer(0.1, rclpy.try_shutdown).start()
        raise RuntimeError('Unable to convert call argument')


    MinimalPublisher.publish_message = fail
    main()
""")


@pytest.mark.build
@needs_ros
@pytest.mark.parametrize(("cause", "code"), [("signal", 0), ("defect", 1)])
def test_error_caused_by_a_signal_exits_with_0(
    combinations: Path, variables: dict[str, str], tmp_path: Path, cause: str, code: int
) -> None:
    package = combinations / "cmake_brief_string" / "cmake_brief_string"
    script = tmp_path / "lost.py"
    script.write_text(LOST)
    done = subprocess.run(
        [sys.executable, str(script), cause],
        env={**variables, "PYTHONPATH": str(package)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert (done.returncode, "RuntimeError" in done.stderr) == (code, bool(code))


class running:  # noqa: N801  reads as a statement
    """A process whose output is read; it is killed at the end of the block."""

    def __init__(self, command: list[str], variables: Mapping[str, str]) -> None:
        self._command = command
        self._variables = variables

    def __enter__(self) -> subprocess.Popen[str]:
        self._process = subprocess.Popen(
            self._command,
            env=dict(self._variables),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        return self._process

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.communicate()


def stopped(node: subprocess.Popen[str], stop: signal.Signals) -> list[str]:
    """Stop a node after its first log message; return the rest of its output."""
    assert node.stderr is not None
    assert "]: Publishing: " in node.stderr.readline()
    node.send_signal(stop)
    errors = node.communicate(timeout=PATIENCE)[1]
    assert node.returncode == 0, errors
    errors = re.sub(_IGNORED, "", errors)
    return [
        line for line in errors.splitlines() if not line.startswith(_LOG) and "]: Pub" not in line
    ]


_IGNORED = r"(?m)^Exception ignored in.*\n(?:Traceback .*\n(?: .*\n)*.*\n?)?"
"""What Python says of a destructor of rclpy that a signal came upon; it changes nothing."""
_LOG = "Failed to publish log message to rosout"
"""What rcl says, in C, when the signal comes between the two halves of logging a message."""
