"""Random runs of all kinds: is `reliable` what their logs say?

``python3 -m experiments.campaigns.reliable_campaign --runs 500 --keep DIR`` prints one line for each run where it is
not, and keeps its files there. The criteria stand in `reliable_claims`; the runs are those of `reliable_runs`.
"""

from __future__ import annotations

import json
import shutil
import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from experiments.campaigns import reliable_claims, reliable_runs
from experiments.campaigns.results import Record
from experiments.campaigns.runs import close, fill, folder_of, parser_of
from guidewire.prepare import ROOT
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner

RUN_LIMIT = 60.0  # s of wall time of one run


@dataclass(frozen=True)
class Judged:
    """What came of a run.

    Attributes
    ----------
    seed, kind : which it was.
    outcome : "reliable", "not reliable", or how it ended.
    claims : where `reliable` is wrong, one line each.
    """

    seed: int
    kind: str
    outcome: str
    claims: list[str]
    reason: str = ""


def campaign(command: Sequence[str], seeds: Iterable[int], folder: Path) -> Iterator[Judged]:
    """The runs of these seeds; the files of those that are judged rightly are removed. A file that is refused counts as
    a run that says nothing of itself."""
    warnings = reliable_claims.listed((ROOT / "docs" / "runs.md").read_text(encoding="utf-8"))
    with closing(Runner(command)) as runner:
        for seed in seeds:
            kind, scene = reliable_runs.draw(seed)
            file, out = folder / f"run-{seed}.json", folder / f"run-{seed}"
            file.write_text(json.dumps(scene, indent=1))
            answer = runner.run(Request(str(seed), file, out), RUN_LIMIT)
            if answer.outcome is None:
                claims = [] if answer.exit_code == 2 else [f"exit code {answer.exit_code}: {answer.message}"]
                judged = Judged(seed, kind, "refused" if answer.exit_code == 2 else "lost", claims)
            else:
                judged = _judge(seed, kind, out, warnings)
            if not judged.claims:
                file.unlink()
                shutil.rmtree(out, ignore_errors=True)
            yield judged


def _judge(seed: int, kind: str, out: Path, warnings: list) -> Judged:
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    scene = json.loads((out / "parameters.json").read_text(encoding="utf-8"))
    with np.load(out / "positions.npz") as log:
        claims = reliable_claims.violations(scene, summary, dict(log), warnings)
    word = summary["outcome"] if summary["outcome"] not in ("finished", "converged") \
        else "reliable" if summary["reliable"] else "not reliable"
    return Judged(seed, kind, word, claims)


def main(arguments: Sequence[str]) -> int:
    parser = parser_of("reliable_campaign", __doc__, runs=500)
    parser.add_argument("--keep", type=Path, help="folder for the files of runs that are judged wrongly")
    given = parser.parse_args(arguments)
    command = building.build(building.RUNNER, print)
    with folder_of(given) as folder:
        lines = fill(Record(given.record), given, lambda seeds: campaign(command, seeds, folder))
    kinds = Counter(f"{one['kind']} {one['outcome']}" for one in lines)
    return close("reliable", "reliable_campaign", lines, given, kinds=dict(sorted(kinds.items())))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
