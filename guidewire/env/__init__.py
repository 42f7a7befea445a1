"""Training environments as defined by Gymnasium 1.x: a wire, a vessel and a target. docs/environments.md."""

import sys

from guidewire.env import registration
from guidewire.env.drive import Drive
from guidewire.env.environment import Environment, Reward
from guidewire.env.episode import SAFE_FORCE, Report
from guidewire.env.observation import Observation
from guidewire.env.picture import Picture
from guidewire.env.recorded import RecordedDrive
from guidewire.env.task import Task, all_tasks, find_task
from guidewire.env.vector import VectorEnvironment

__all__ = ["Drive", "Environment", "Observation", "Picture", "RecordedDrive", "Report", "Reward", "SAFE_FORCE", "Task",
           "VectorEnvironment", "all_tasks", "find_task"]

if "gymnasium" in sys.modules:    # spaces has imported it, where it is installed
    registration.register()
