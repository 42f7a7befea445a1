#!/usr/bin/env python3
"""Command line of the project: `python3 guidewire.py --help` lists the commands.

Needs nothing but Python's standard library (3.6 can read this file). It looks for a Python that can do what is asked,
makes one if there is none, and hands over to experiments/commands.py there.

To a script that `python3 guidewire.py python SCRIPT` starts it is a module: `from guidewire import Session, read_run,
read_log` (docs/python.md).
"""

import importlib
import sys
from typing import TYPE_CHECKING

from experiments import prepare

if TYPE_CHECKING:  # the same names for type checkers
    import types

    from analysis.advice.plan import Advice as Advice
    from analysis.logs import LogError as LogError, PositionLog as PositionLog
    from analysis.logs import read_entries as read_entries, read_log as read_log
    from analysis.runs import Run as Run, read_run as read_run, read_runs as read_runs
    from environments import Drive as Drive, Environment as Environment, Observation as Observation
    from environments import RecordedDrive as RecordedDrive, Reward as Reward, Task as Task
    from environments import VectorEnvironment as VectorEnvironment, all_tasks as all_tasks, find_task as find_task
    from experiments.library import advise as advise, sweep as sweep
    from experiments.prepare import PreparationError as PreparationError
    from experiments.session import Session as Session
    from experiments.session_state import SessionError as SessionError, State as State

    anatomy: types.ModuleType
    env: types.ModuleType

_LENT = {  # name to where it stands; looked up when it is asked for, because it needs numpy
    "Session": "experiments.session", "SessionError": "experiments.session_state",
    "State": "experiments.session_state",
    "read_run": "analysis.runs", "read_runs": "analysis.runs", "Run": "analysis.runs",
    "read_log": "analysis.logs", "read_entries": "analysis.logs", "PositionLog": "analysis.logs",
    "LogError": "analysis.logs", "sweep": "experiments.library", "advise": "experiments.library",
    "Advice": "analysis.advice.plan", "PreparationError": "experiments.prepare", "Environment": "environments",
    "VectorEnvironment": "environments", "Drive": "environments", "Observation": "environments",
    "Reward": "environments", "Task": "environments", "RecordedDrive": "environments", "find_task": "environments",
    "all_tasks": "environments",
}
_MODULES = {"anatomy": "anatomy", "env": "environments"}  # name to the module that it is
__all__ = sorted([*_LENT, *_MODULES])


def __getattr__(name):
    """What scripts import from here."""
    home = "guidewire." if prepare.INSTALLED else ""
    if name in _MODULES:
        return importlib.import_module(home + _MODULES[name])
    if name not in _LENT:
        raise AttributeError("module 'guidewire' has no attribute '{}'".format(name))
    return getattr(importlib.import_module(home + _LENT[name]), name)


def command():
    """The command `guidewire` of the installed package."""
    sys.exit(main())


def main():
    """Run the command line; returns the exit code."""
    try:
        prepare.require_version()
        from experiments import commands  # only a new enough Python can read it
        arguments = commands.parse(sys.argv[1:])
        prepare.require_packages(arguments.packages)
        return commands.run(arguments)
    except KeyboardInterrupt:
        print("guidewire: interrupted", file=sys.stderr)
        return 130
    except prepare.PreparationError as error:
        print("guidewire: {}".format(error), file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
