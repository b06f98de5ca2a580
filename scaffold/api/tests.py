"""Test files, test functions and fixtures."""

from __future__ import annotations

from scaffold.model.tests import (
    LAUNCH,
    Fixture,
    TestFunction,
    arguments,
    constructed_class,
    fixture_decorator,
    fixtures,
    is_named_elsewhere,
    is_test_case,
    keywords,
    marks,
    may_start,
    methods,
    node_tests,
    own_fixtures,
    runs_around_tests,
    test_functions,
    test_modules,
    uses_pytest_plugins,
)

__all__ = [
    "LAUNCH",
    "Fixture",
    "TestFunction",
    "arguments",
    "constructed_class",
    "fixture_decorator",
    "fixtures",
    "is_named_elsewhere",
    "is_test_case",
    "keywords",
    "marks",
    "may_start",
    "methods",
    "node_tests",
    "own_fixtures",
    "runs_around_tests",
    "test_functions",
    "test_modules",
    "uses_pytest_plugins",
]
