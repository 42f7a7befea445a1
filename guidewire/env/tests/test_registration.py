"""The tasks' names for gymnasium.make, and a benchmark's table."""

import importlib
import os
import subprocess
import sys
import types

import pytest

from guidewire.env import Reward, all_tasks, command, registration
from guidewire.env.environment import Environment
from guidewire.env.spaces import Error
from guidewire.env.task import find_task
from guidewire.env.tests.environment_cases import tube  # noqa: F401
from guidewire.prepare import ROOT

# A package with the names that are used of gymnasium's.
GYMNASIUM = {
    "__init__.py": "class Env: pass",
    "error.py": "class Error(Exception): pass\n"
                "ClosedEnvironmentError = InvalidAction = NameNotFound = ResetNeeded = Error",
    "spaces.py": "class Box: pass\nDict = Discrete = Space = Box",
    "vector/__init__.py": "import enum\nclass VectorEnv: pass\n"
                          "AutoresetMode = enum.Enum('AutoresetMode', {'NEXT_STEP': 'NextStep', 'SAME_STEP': "
                          "'SameStep'})",
    "vector/utils.py": "batch_space = None",
    "envs/__init__.py": "",
    "envs/registration.py": "registry = {}\ndef register(id, **known): registry[id] = known",
}


class Forwards:
    """A policy whose environment has options of its own."""

    options = {"reward": Reward(time=-0.5)}

    def __init__(self, environment):
        assert environment.reward.time == -0.5

    def reset(self, observation):
        pass

    def act(self, observation):
        return [1.0, 0.0]


def test_each_task_has_a_name_by_which_what_it_names_is_made(monkeypatch, tube):
    registered = {}
    module = types.ModuleType("gymnasium.envs.registration")
    module.registry = registered
    module.register = lambda id, **known: registered.update({id: known})
    envs = types.ModuleType("gymnasium.envs")
    envs.registration = module
    for name, one in (("gymnasium", types.ModuleType("gymnasium")), ("gymnasium.envs", envs),
                      ("gymnasium.envs.registration", module)):
        monkeypatch.setitem(sys.modules, name, one)
    registration.register()
    registration.register()
    assert set(registered) == {f"guidewire/{name}-v0" for name in all_tasks(None)}
    for known in registered.values():
        task = find_task(known["kwargs"]["task"])
        assert known["max_episode_steps"] == pytest.approx(task.time / 0.14, abs=0.01)    # as the environment truncates
        assert known["reward_threshold"] == pytest.approx(2.0 - 0.02 * task.time)
        home, _, name = known["entry_point"].partition(":")
        assert getattr(importlib.import_module(home), name) is Environment
        home, _, name = known["vector_entry_point"].partition(":")
        make, steps = getattr(importlib.import_module(home), name), {"max_episode_steps": 20}    # as make_vec gives
        with make(2, **{**known["kwargs"], "task": tube}, **steps) as vector:
            assert vector.num_envs == 2
        with pytest.raises(Error, match="max_episode_steps = 21 is not allowed"):
            make(2, **{**known["kwargs"], "task": tube, "max_episode_steps": 21})


@pytest.mark.parametrize("script", (
    "import guidewire, sys; assert not {'gymnasium', 'numpy'} & set(sys.modules); import gymnasium",
    "import gymnasium, guidewire",
    "from guidewire import Environment",
    "import guidewire, importlib.util; importlib.util.find_spec('gymnasium'); import gymnasium.spaces",
))
def test_names_are_there_once_both_are_imported_and_neither_imports_the_other(script, tmp_path):
    for name, text in GYMNASIUM.items():
        path = tmp_path / "gymnasium" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
    shown = ("; from gymnasium.envs import registration; import gymnasium, guidewire.env.spaces as spaces; "
             "print(spaces.Env is gymnasium.Env, spaces.Box is gymnasium.spaces.Box, *registration.registry)")
    done = subprocess.run([sys.executable, "-c", script + shown], capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": os.pathsep.join((str(ROOT), str(tmp_path)))})
    names = [f"guidewire/{name}-v0" for name in all_tasks(None)]
    assert (done.stdout.split(), done.stderr) == (["True", "True", *names], "")


def test_gymnasium_makes_what_is_registered():
    gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed; the names are tested above")
    registration.register()
    with gymnasium.make("guidewire/artery-v0", safe_force=1.0) as made:
        assert made.unwrapped.safe_force == 1.0 and made.reset(seed=1)[1]["draw"]
    gymnasium.make_vec("guidewire/artery-v0", num_envs=2, vectorization_mode="vector_entry_point").close()


def test_a_policy_is_given_by_its_module_and_name():
    with pytest.raises(Error, match="retry, random, or MODULE:NAME"):
        command._policy_of("nowhere:Forwards")
    make = command._policy_of("guidewire.env.tests.test_registration:Forwards")
    with Environment("artery", **make.options) as own:
        assert make(own, 0).act(None) == [1.0, 0.0]
