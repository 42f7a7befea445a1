"""What all tests share: the real runner, built once, a fake one with the journal of what it was asked, and tests that
run where campaigns run in full."""

import json
import os
import signal
import sys
import tempfile
import time
from pathlib import Path

import pytest

from experiments.tests.run_claims import Campaign
from guidewire.runs import building
from guidewire.runs.key_table import read_key_table
from guidewire.runs.runner import Runner
from guidewire.viewer.tests.browsing import browse, desk, firefox  # noqa: F401  fixtures
from tools.testing import FULL_CAMPAIGNS, READY


# A shell that starts us in the background leaves Ctrl-C ignored, for us and for every program that we start; the tests
# of Ctrl-C then wait for ever.
signal.signal(signal.SIGINT, signal.default_int_handler)


FAKE_RUNNER = Path(__file__).parent / "guidewire" / "runs" / "tests" / "fake_runner.py"


def pytest_configure(config):
    config.addinivalue_line("markers", "long(reason): runs where campaigns run in full; elsewhere skipped, and the "
                                       "reason names what holds the claim there")
    config.addinivalue_line("markers", "few(count): so many cases of a parametrised test, spread over its list; all "
                                       "of them where campaigns run in full")


def pytest_collection_modifyitems(items):
    if FULL_CAMPAIGNS in os.environ:
        return
    cases = {}
    for item in items:
        mark = item.get_closest_marker("long")
        if mark is not None:
            item.add_marker(pytest.mark.skip(reason=mark.args[0]))
        elif item.get_closest_marker("few") is not None:
            cases.setdefault(item.nodeid.partition("[")[0], []).append(item)
    for family in cases.values():
        count = family[0].get_closest_marker("few").args[0]
        taken = {place * len(family) // count for place in range(count)}
        for place, item in enumerate(family):
            if place not in taken:
                item.add_marker(pytest.mark.skip(reason=f"{count} of {len(family)} cases run here"))


class FakeRunner:
    """The command of the fake runner, and what it noted."""

    def __init__(self, journal):
        self.journal = journal
        self.command = [sys.executable, str(FAKE_RUNNER), str(journal)]

    def calls(self):
        """(process id, start, end, request) of every run that it answered, in the order of their ends."""
        return [json.loads(line) for line in self.journal.read_text().splitlines()]


@pytest.fixture
def fake(tmp_path):
    return FakeRunner(tmp_path / "journal")


@pytest.fixture(scope="session")
def runner_command():
    """The real runner's command, once it is built."""
    while READY in os.environ and not Path(os.environ[READY]).exists():
        time.sleep(0.1)
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
