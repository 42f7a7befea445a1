"""`run --check`: a run is made again with finer settings, and what is other stands beside its result."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from guidewire.advice import repeats
from guidewire.logs.logs import LogError
from guidewire.logs.runs import PARAMETERS_NAME, Run, read_run
from guidewire.prepare import PreparationError
from guidewire.runs.process import hand_to
from guidewire.runs.whole_files import write_whole

REPORT = "check.md"  # beside the run
DOES_NOT_HOLD = 6  # exit code
_COMPLETE = (0, 4, 5)  # exit codes of a run with a summary


def check(runner: Sequence[str], out: Path, elements: bool) -> int:
    """Repeat a complete run with half its time step, and with twice its elements if asked; returns the exit code.

    Raises
    ------
    PreparationError : the run cannot be read, or has too few steps; one line.
    """
    try:
        run = read_run(out)
        made: dict[str, Run] = {}
        for trial in repeats.trials_of(run, elements):
            folder = out / "check" / trial.name.replace(" ", "-")
            command = [*runner, "-parameters", str(out / PARAMETERS_NAME), "-out", str(folder), "-force"]
            changed = dict(trial.changed)
            if "numberRodElements" in changed:    # it has no effect, and would be warned of
                changed["rodElementLength"] = run.number("guidewireLength") / changed["numberRodElements"]
            for key, value in changed.items():
                command += [f"-{key}", json.dumps(value)]
            code = hand_to(command)
            if code not in _COMPLETE:
                return code
            made[trial.name] = read_run(folder)
        if not made:
            raise PreparationError(f"{out}: nothing to repeat: --check needs a run of three steps or more")
        table = repeats.as_markdown(run, made)
        write_whole(out / REPORT, table)
        print(table + repeats.verdict(run, made))
        return DOES_NOT_HOLD if repeats.differences(run, made) else 0
    except LogError as error:
        raise PreparationError(str(error)) from error
