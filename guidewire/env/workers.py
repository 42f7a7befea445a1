"""What steps the environments of a vector: threads here, or processes of their own."""

from __future__ import annotations

import multiprocessing
import os
import pickle
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from guidewire.env.environment import Environment
from guidewire.env.spaces import ClosedEnvironmentError, Error
from guidewire.runs.process import how_it_ended

try:
    import cloudpickle
except ImportError:
    cloudpickle = None

_WITHOUT_GUARD = 68  # exit code of a process that would start others while it imports the script
_GUARD = ('VectorEnvironment(backend="processes") starts processes that import this script: what it does belongs below '
          'if __name__ == "__main__":')
Request = tuple[str, tuple[Any, ...]]


class Threads:
    """A thread for each list of environments.

    Parameters
    ----------
    chosen : numbers of the environments of each.
    task, options : of each Environment.
    """

    def __init__(self, chosen: Sequence[Sequence[int]], task: Any, options: Mapping[str, Any]) -> None:
        self._chosen = chosen
        self._environments = {k: Environment(task, **options) for own in chosen for k in own}
        self._pool = ThreadPoolExecutor(len(chosen), "environment")

    def ask(self, requests: Sequence[Request]) -> list[Any]:
        """Answers in the order of the environments."""
        waiting = [self._pool.submit(_answers, self._environments, [(k, requests[k]) for k in own])
                   for own in self._chosen]
        done = [one.exception() or one.result() for one in waiting]    # all, before the first error is raised
        return _in_order(done)

    def revive(self) -> None:
        """Nothing to be started anew: an environment opens its session again."""

    def close(self) -> None:
        """End the sessions."""
        self._pool.shutdown()
        for environment in self._environments.values():
            environment.close()


class Processes:
    """A process for each list of environments; parameters as of Threads.

    Raises
    ------
    Error : the options cannot be sent to another process.
    """

    def __init__(self, chosen: Sequence[Sequence[int]], task: Any, options: Mapping[str, Any]) -> None:
        if getattr(multiprocessing.current_process(), "_inheriting", False):    # the script, imported by such a process
            os._exit(_WITHOUT_GUARD)
        self._chosen, self._made_of = chosen, _packed((task, dict(options)))
        self._workers: list[tuple[Any, Any] | None] = [None] * len(chosen)    # pipe and process
        self.revive()

    def ask(self, requests: Sequence[Request]) -> list[Any]:
        """Answers in the order of the environments."""
        for worker, own in zip(self._workers, self._chosen):
            try:
                if worker is not None:
                    worker[0].send([(k, requests[k]) for k in own])
            except OSError:
                pass    # it has ended, as its answer will say
        return _in_order([self._answer(number) for number in range(len(self._workers))])

    def revive(self) -> None:
        """Start those processes that are not there."""
        context = multiprocessing.get_context("spawn")    # a forked one could not load the native library
        for number, own in enumerate(self._chosen):
            if self._workers[number] is None:
                here, there = context.Pipe()
                process = context.Process(target=_serve, args=(there, own, self._made_of), daemon=True)
                process.start()
                there.close()
                self._workers[number] = (here, process)

    def close(self) -> None:
        """End the processes."""
        workers = [worker for worker in self._workers if worker is not None]
        for pipe, _ in workers:
            try:
                pipe.send(None)
            except OSError:
                pass
        for _, process in workers:
            process.join(timeout=10.0)
            if process.is_alive():
                process.kill()

    def _answer(self, number: int) -> Any:
        worker = self._workers[number]
        if worker is None:
            return ClosedEnvironmentError(f"process {number} of this environment has ended: reset() starts it anew")
        pipe, process = worker
        try:
            return pipe.recv()
        except (EOFError, OSError):
            process.join(timeout=10.0)
            code = process.exitcode
            process.kill()
            self._workers[number] = None
            pipe.close()
        if code == _WITHOUT_GUARD:
            return Error(_GUARD)
        how = "it closed its pipe and does not end" if code is None else how_it_ended(code)
        return ClosedEnvironmentError(f"process {number} of this environment has ended ({how}): reset() starts it anew")


def _packed(made_of: Any) -> bytes:
    try:
        return (cloudpickle or pickle).dumps(made_of)
    except Exception as error:    # whatever what is to be sent says of itself
        hint = "" if cloudpickle else "; functions without a name need cloudpickle: pip install cloudpickle"
        raise Error(f"backend \"processes\": the options cannot be sent to another process ({error}){hint}") from error


def _serve(pipe: Any, own: Sequence[int], made_of: bytes) -> None:
    environments: dict[int, Environment] = {}
    try:
        while (requests := pipe.recv()) is not None:
            try:
                if not environments:
                    task, options = pickle.loads(made_of)
                    environments = {k: Environment(task, **options) for k in own}
                answer: Any = _answers(environments, requests)
            except Exception as error:    # for whoever asked
                answer = error
            pipe.send(answer)
    except (EOFError, KeyboardInterrupt):
        pass
    finally:
        for environment in environments.values():
            environment.close()


def _answers(environments: Mapping[int, Environment], requests: Sequence[tuple[int, Request]]) -> list[tuple[int, Any]]:
    return [(k, _answer(environments[k], what, words)) for k, (what, words) in requests]


def _answer(environment: Environment, what: str, words: tuple[Any, ...]) -> Any:
    if what == "reset":
        return environment.reset(seed=words[0], options=words[1])
    if what == "set":
        return setattr(environment, *words)
    if what == "call":
        name, arguments, named = words
        found = getattr(environment, name)
        return found(*arguments, **named) if callable(found) else found
    action, begins_anew = words
    seen, reward, terminated, truncated, info = environment.step(action)
    if begins_anew and (terminated or truncated):
        last = {"final_obs": seen, "final_info": info}
        seen, info = environment.reset()
        info = {**last, **info}
    return seen, reward, terminated, truncated, info


def _in_order(done: Sequence[Any]) -> list[Any]:
    for answer in done:
        if isinstance(answer, BaseException):
            raise answer
    return [answer for _, answer in sorted((pair for answers in done for pair in answers), key=lambda pair: pair[0])]
