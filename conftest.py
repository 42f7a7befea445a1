"""What all suites share: tests that run where campaigns run in full."""

import os

import pytest

from experiments.testing import FULL_CAMPAIGNS


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "long(reason): runs where campaigns run in full; elsewhere skipped, and the reason "
                                       "names what holds the claim there")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    if FULL_CAMPAIGNS in os.environ:
        return
    for item in items:
        mark = item.get_closest_marker("long")
        if mark is not None:
            item.add_marker(pytest.mark.skip(reason=mark.args[0]))
