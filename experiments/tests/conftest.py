"""What several test files need: the real runner, built once, and a fake one with the journal of what it was asked."""

import json
import signal
import sys
from pathlib import Path

import pytest

from experiments import building


# A shell that starts us in the background leaves Ctrl-C ignored, for us and for every program that we start; the tests
# of Ctrl-C then wait for ever.
signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_configure(config):
    config.addinivalue_line("markers", "timed: measures or sleeps; run with nothing beside it")


class FakeRunner:
    """The command of the fake runner, and what it noted."""

    def __init__(self, journal):
        self.journal = journal
        self.command = [sys.executable, str(Path(__file__).with_name("fake_runner.py")), str(journal)]

    def calls(self):
        """(process id, start, end, request) of every run that it answered, in the order of their ends."""
        return [json.loads(line) for line in self.journal.read_text().splitlines()]


@pytest.fixture
def fake(tmp_path):
    return FakeRunner(tmp_path / "journal")


@pytest.fixture(scope="session")
def runner_command():
    """The real runner's command."""
    return building.build(building.RUNNER, print)
