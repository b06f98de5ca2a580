"""Shared setup: tests neither read nor change the user's home directory."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile(
    "repository",
    deadline=None,  # the time of an example tells about the machine
    derandomize=True,  # the gate gives the same verdict every time
    suppress_health_check=[HealthCheck.too_slow],
)
# `make nightly` looks for new examples.
settings.register_profile("random", settings.get_profile("repository"), derandomize=False)
settings.load_profile("repository")


@pytest.hookimpl(optionalhook=True)  # of pytest-xdist, which not all environments have
def pytest_xdist_auto_num_workers() -> int:
    """Return one process more than there are processors: tests of nodes wait most of the time."""
    return len(os.sched_getaffinity(0)) + 1


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Deselect tests that take hours unless their marker is given; run slow files first.

    pytest-xdist hands out whole files in this order: a file that takes minutes must not be the
    last, with only one process left to do it.
    """
    if "nightly" not in config.option.markexpr:
        left_out = [item for item in items if "nightly" in item.keywords]
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if "nightly" not in item.keywords]
    with_builds = {item.path for item in items if "build" in item.keywords}
    items.sort(key=lambda item: (item.path not in with_builds, "generate" not in item.path.parts))


@pytest.fixture(scope="session", autouse=True)
def home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Give the session an empty home directory."""
    empty = str(tmp_path_factory.mktemp("home"))
    with pytest.MonkeyPatch.context() as patch:
        for name in [name for name in os.environ if name.startswith(("XDG_", "ROS_HOME"))]:
            patch.delenv(name)
        # Container images set it; each command of the tests would compile all modules again.
        patch.delenv("PYTHONDONTWRITEBYTECODE", raising=False)
        patch.setenv("HOME", empty)
        yield empty


@pytest.fixture(scope="session")
def new_cache(tmp_path_factory: pytest.TempPathFactory, home: str) -> Callable[[], Path]:
    """Return a function that makes a directory for ``XDG_CACHE_HOME`` without results.

    The tests of a session share the stubs and the bytecode of the rules, which take half a second
    to write.
    """

    def make() -> Path:
        directory = tmp_path_factory.mktemp("cache")
        kept = directory / "ros2-scaffold"
        kept.mkdir()
        for kind in ("rules", "stubs"):
            shared = Path(home) / "shared" / kind
            shared.mkdir(parents=True, exist_ok=True)
            (kept / kind).symlink_to(shared)
        return directory

    return make


@pytest.fixture
def own_cache(new_cache: Callable[[], Path]) -> Path:
    """Return a directory for ``XDG_CACHE_HOME`` without results."""
    return new_cache()
