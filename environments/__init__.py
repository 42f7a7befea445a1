"""Training environments as defined by Gymnasium 1.x: a wire, a vessel and a target. docs/environments.md."""

from environments.drive import Drive
from environments.environment import Environment, Reward
from environments.episode import SAFE_FORCE, Report
from environments.observation import Observation
from environments.recorded import RecordedDrive
from environments.task import Task, all_tasks, find_task
from environments.vector import VectorEnvironment

__all__ = ["Drive", "Environment", "Observation", "RecordedDrive", "Report", "Reward", "SAFE_FORCE", "Task",
           "VectorEnvironment", "all_tasks", "find_task"]
