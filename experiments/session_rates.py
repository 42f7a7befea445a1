"""Calls a second of sessions that step the accurate vessel scene by 140 ms a call, as those do who train navigation,
and by 10 ms, as in a control loop: random pushes, pulls and rotations.

    python3 guidewire.py python experiments/session_rates.py [TASK ...]

and then the same of environments, with their observations, rewards and resets, by processor time. With tasks named it
measures them alone.
"""

from __future__ import annotations

import itertools
import multiprocessing
import sys
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from experiments.scene_meshes import main_lumen
from guidewire import Session
from guidewire.env import Environment, Observation, Picture, all_tasks
from guidewire.env.baselines import baseline_of, parts_of
from guidewire.env.spaces import Error
from guidewire.env.task import find_task
from guidewire.runs import building

SCENE = Path(__file__).resolve().parent.parent / "params" / "insertion-accurate.json"
STEPS = (0.14, 0.01)  # s of simulated time a call
SPEED = 5.0 / 0.14  # of the hand, units a second
MOTION = 5.6  # s in, and as many out
TURN = 0.5 / 0.14  # rad a second at most
WARM_UP = 2
ROUNDS = 5
EPISODES, READ = 24, 8  # of an environment; the first ones, in which vessels are read


def tube() -> dict[str, Any]:
    """The scene's aorta and arch in closed form, without the branch."""
    lumen = main_lumen()
    return {"shape": "tube", "knots": lumen.centres.tolist(), "radius": lumen.radii.tolist(), "openStart": True}


def rate(overrides: Mapping[str, Any], native: bool, step: float, seed: int = 0) -> tuple[float, float]:
    """Calls a second of one session: the median of its rounds, and the best, which a busy machine disturbs least."""
    rates = []
    with Session(SCENE, hand=True, native=native, maxSimulationSteps=1_000_000_000, deltaThreshold=0,
                 **overrides) as session:
        steps = round(step / session.parameters["timeStep"])
        calls = round(MOTION / step)
        random = np.random.default_rng(seed)
        for _ in range(WARM_UP + ROUNDS):
            session.reset()
            began = time.perf_counter()
            for call in range(2 * calls):
                push = SPEED * step if call < calls else -SPEED * step
                session.step(push=push, turn=step * random.uniform(-TURN, TURN), steps=steps)
            rates.append(2 * calls / (time.perf_counter() - began))
            if session.state.outcome is not None:
                raise RuntimeError(session.state.reason)
    return float(np.median(rates[WARM_UP:])), max(rates)


def environment_rate(task: str, native: bool, image: Picture | None = None) -> tuple[float, float]:
    """Steps a second of processor time of the environment of a task under its baseline, resets included, and the
    median time of a reset, ms, in episodes of the first seeds. With an `image` each step makes that too. (What a runner
    simulates does not count as time of this process.)"""
    observation = Observation(parts=parts_of(find_task(task)), image=image)
    with Environment(task, native=native, observation=observation) as environment:
        policy = baseline_of(environment)
        clock, resets, spent, made = time.process_time if native else time.perf_counter, [], 0.0, 0
        for seed in range(1, 1 + EPISODES):
            before = clock()
            seen, _ = environment.reset(seed=seed)
            began = clock()
            policy.reset(seen)
            steps, ended = 0, False
            while not ended:
                seen, _, terminated, truncated, _ = environment.step(policy.act(seen))
                steps, ended = steps + 1, terminated or truncated
            if seed > READ:
                made, spent = made + steps, spent + clock() - before
                resets.append(1e3 * (began - before))
    return made / spent, float(np.median(resets))


def sessions(natives: Sequence[bool]) -> None:
    """Print the rates of sessions."""
    for name, overrides in (("a tube", {"vessel": tube()}), ("a mesh", {})):
        for native, step in itertools.product(natives, STEPS):
            one, best = rate(overrides, native, step)
            with multiprocessing.get_context("spawn").Pool(2) as pool:
                both = [(overrides, native, step, seed) for seed in (1, 2)]
                two = sum(calls for calls, _ in pool.starmap(rate, both))
            with ThreadPoolExecutor(2) as pool:
                threads = sum(calls for calls, _ in pool.map(lambda seed: rate(overrides, native, step, seed), (1, 2)))
            print(f"{name}, {'native library' if native else 'runner'}: {one:.0f} calls of {1e3 * step:.0f} ms a second"
                  f" in one session (at best {best:.0f}), {two:.0f} in two processes ({two / one:.2f} times),"
                  f" {threads:.0f} in two threads ({threads / one:.2f} times)", flush=True)


def environments(tasks: Sequence[str], natives: Sequence[bool]) -> None:
    """Print the rates of environments."""
    for task, native in itertools.product(tasks, natives):
        one, reset = environment_rate(task, native)
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            two = sum(steps for steps, _ in pool.starmap(environment_rate, [(task, native)] * 2))
        seen, _ = environment_rate(task, native, Picture(pixels=128))
        print(f"environment {task}, {'native library' if native else 'runner'}: {one:.0f} steps of 140 ms a second, "
              f"{two:.0f} in two processes ({two / one:.2f} times), {seen:.0f} with a picture of 128 x 128 each "
              f"({seen / one:.2f} times), a reset in {reset:.1f} ms", flush=True)


def main() -> None:
    natives, named = (False, True) if building.native_library() else (False,), sys.argv[1:]
    try:
        for task in named:
            find_task(task)
    except Error as error:
        sys.exit(f"session_rates: {error}")
    if not named:
        sessions(natives)
    environments(named or list(all_tasks()), natives)


if __name__ == "__main__":
    main()
