"""What all tests of the checker share."""

import pytest


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "built: asks what the build of the solution has made")
