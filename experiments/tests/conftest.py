"""What several test files need: the real runner, built once, and a fake one with the journal of what it was asked."""

import json
import signal
import sys
import tempfile
from pathlib import Path

import pytest

from experiments import building
from experiments.key_table import read_key_table
from experiments.runner import Runner
from browsing import browse  # noqa: F401  a fixture
from run_claims import Campaign


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


@pytest.fixture(scope="session")
def live(runner_command):
    """One runner for every test that only asks how a scene is answered; each start of a process costs 0.1 s."""
    runner = Runner(runner_command)
    yield runner
    runner.close()


@pytest.fixture(scope="session")
def table(runner_command):
    """The runner's table of parameters."""
    return read_key_table(runner_command)


@pytest.fixture(scope="session")
def campaign(runner_command):
    """A runner that stays up from one random scene to the next."""
    with tempfile.TemporaryDirectory() as folder:
        campaign = Campaign(runner_command, Path(folder))
        yield campaign
        campaign.close()


@pytest.fixture(scope="session")
def integrators(campaign, table):
    """Method to the integrators that it takes, as the runner says itself."""
    key = table["integrator"]

    def takes(solver, word):
        return campaign.run({"solver": solver, "integrator": word, "maxSimulationSteps": 1})[0].exit_code != 2

    return {solver: [word for word in key.words if solver in key.solvers and takes(solver, word)]
            for solver in table["solver"].words}
