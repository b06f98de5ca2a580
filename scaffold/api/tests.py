"""Test files, test functions and fixtures."""

from __future__ import annotations

from scaffold.model.install.pytest_settings import (
    Setting,
    files_collected,
    module_name,
    pytest_settings,
)
from scaffold.model.tests import (
    LAUNCH,
    Fixture,
    TestFunction,
    arguments,
    constructed_class,
    files_of_tests,
    fixture_decorator,
    fixtures,
    is_named_elsewhere,
    is_test_case,
    keywords,
    marks,
    may_be_imported,
    may_start,
    methods,
    node_tests,
    own_fixtures,
    settings_or_tests_mention,
    test_functions,
    test_modules,
)

__all__ = [
    "LAUNCH",
    "Fixture",
    "Setting",
    "TestFunction",
    "arguments",
    "constructed_class",
    "files_collected",
    "files_of_tests",
    "fixture_decorator",
    "fixtures",
    "is_named_elsewhere",
    "is_test_case",
    "keywords",
    "marks",
    "may_be_imported",
    "may_start",
    "methods",
    "module_name",
    "node_tests",
    "own_fixtures",
    "pytest_settings",
    "settings_or_tests_mention",
    "test_functions",
    "test_modules",
]
