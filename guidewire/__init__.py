"""Simulation of medical guidewires: runs, logs, sessions, sweeps, vessels and environments for scripts
(docs/python.md).

`from guidewire import Session, read_run, read_log`. Each name is imported when it is asked for, because most of them
need numpy. Any Python from 3.6 on can read this file.
"""

import importlib
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # the same names for type checkers
    __version__: str
    from guidewire import anatomy as anatomy, env as env
    from guidewire.advice.plan import Advice as Advice
    from guidewire.env import Drive as Drive, Environment as Environment, Observation as Observation
    from guidewire.env import Picture as Picture, RecordedDrive as RecordedDrive, Reward as Reward, Task as Task
    from guidewire.env import VectorEnvironment as VectorEnvironment, all_tasks as all_tasks, find_task as find_task
    from guidewire.identification import Identified as Identified, identify as identify
    from guidewire.library import advise as advise, sweep as sweep
    from guidewire.logs.logs import LogError as LogError, PositionLog as PositionLog
    from guidewire.logs.logs import read_entries as read_entries, read_log as read_log
    from guidewire.logs.relaxation import Relaxation as Relaxation, RelaxationError as RelaxationError
    from guidewire.logs.relaxation import read_relaxation as read_relaxation
    from guidewire.logs.runs import Run as Run, read_run as read_run, read_runs as read_runs
    from guidewire.prepare import PreparationError as PreparationError
    from guidewire.sessions.session import Session as Session
    from guidewire.sessions.session_state import SessionError as SessionError, State as State

_HOMES = {
    "guidewire.advice.plan": ("Advice",),
    "guidewire.env": ("Drive", "Environment", "Observation", "Picture", "RecordedDrive", "Reward", "Task",
                      "VectorEnvironment", "all_tasks", "find_task"),
    "guidewire.identification": ("Identified", "identify"),
    "guidewire.library": ("advise", "sweep"),
    "guidewire.logs.logs": ("LogError", "PositionLog", "read_entries", "read_log"),
    "guidewire.logs.relaxation": ("Relaxation", "RelaxationError", "read_relaxation"),
    "guidewire.logs.runs": ("Run", "read_run", "read_runs"),
    "guidewire.prepare": ("PreparationError",),
    "guidewire.sessions.session": ("Session",),
    "guidewire.sessions.session_state": ("SessionError", "State"),
}
_LENT = {name: home for home, names in _HOMES.items() for name in names}
_MODULES = ("anatomy", "env")
__all__ = sorted([*_LENT, *_MODULES])


def __dir__():
    return sorted({*globals(), *__all__})


def __getattr__(name):
    """Return what scripts import from here."""
    if name == "__version__":
        return importlib.import_module("guidewire.installed").version()
    if name in _MODULES:
        return importlib.import_module("guidewire." + name)
    if name not in _LENT:
        raise AttributeError("module 'guidewire' has no attribute '{}'".format(name))
    return getattr(importlib.import_module(_LENT[name]), name)


class _Gymnasium:
    """Finds gymnasium for whoever imports it, and then imports guidewire.env, which names the tasks there. So nothing
    waits for gymnasium that does not use it."""

    @classmethod
    def find_spec(cls, name, path=None, target=None):
        if name != "gymnasium":
            return None
        others = (finder.find_spec(name, path, target) for finder in sys.meta_path if finder is not cls)
        spec = next((found for found in others if found is not None), None)
        if spec is not None and spec.loader is not None:
            execute = spec.loader.exec_module

            def executed(module):
                execute(module)
                importlib.import_module("guidewire.env")

            spec.loader.exec_module = executed
        return spec


if "gymnasium" in sys.modules:
    importlib.import_module("guidewire.env")
else:
    sys.meta_path.insert(0, _Gymnasium)
