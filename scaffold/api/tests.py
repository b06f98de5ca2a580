"""Test files, test functions and fixtures."""

from __future__ import annotations

from scaffold.model.tests import (
    LAUNCH,
    Fixture,
    TestFunction,
    arguments,
    fixture_decorator,
    fixtures,
    has_other_ways,
    is_named_elsewhere,
    is_test_case,
    keywords,
    made_name,
    marks,
    may_start,
    methods,
    node_tests,
    own_fixtures,
    test_functions,
    test_modules,
)

__all__ = [
    "LAUNCH",
    "Fixture",
    "TestFunction",
    "arguments",
    "fixture_decorator",
    "fixtures",
    "has_other_ways",
    "is_named_elsewhere",
    "is_test_case",
    "keywords",
    "made_name",
    "marks",
    "may_start",
    "methods",
    "node_tests",
    "own_fixtures",
    "test_functions",
    "test_modules",
]
