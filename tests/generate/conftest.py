"""Setup of the tests of the generator."""

from __future__ import annotations

from collections.abc import Iterator

import pytest


@pytest.fixture(scope="module", autouse=True)
def _outside_of_the_repository(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Start tests in an empty directory: interfaces are searched in the repository around it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("current"))
        yield
