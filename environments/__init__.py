"""Environments to train on: a wire, a vessel and a target, as Gymnasium 1.x has them. docs/environments.md."""

from environments.drive import Drive
from environments.environment import Environment, Reward
from environments.episode import SAFE_FORCE, Report
from environments.observation import Observation
from environments.recorded import RecordedDrive
from environments.task import Task, all_tasks, find_task
from environments.vector import VectorEnvironment

__all__ = ["Drive", "Environment", "Observation", "RecordedDrive", "Report", "Reward", "SAFE_FORCE", "Task",
           "VectorEnvironment", "all_tasks", "find_task"]
