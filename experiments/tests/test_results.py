"""The last results of campaigns, and the table that quotes them."""

import json
from dataclasses import dataclass

from experiments.campaigns import results
from experiments.campaigns.runs import close, fill, parser_of
from tools import seeds


def test_the_pages_quote_the_last_results():
    for page, table in results.tables().items():
        assert results.quoted(page) == table, "python3 -m experiments.campaigns.results writes the tables anew"


def test_a_row_takes_the_place_of_its_last_one_and_counts_reasons_by_kind(tmp_path, monkeypatch):
    monkeypatch.setattr(results, "FILE", tmp_path / "results.json")
    kinds = results.kinds_of(["no solution at t = 0.2 s; 3 N", "no solution at t = 1.5e-05 s", "buckles"])
    assert kinds == {"no solution at t = # s": 2, "buckles": 1}
    results.keep("b", "push", [{"seed": seed} for seed in (3, 4, 9)], {"finished": 2, "failed": 1}, [9])
    results.keep("a", "pull", [results.Record(None).add({"seed": 1})], {"finished": 1}, [])
    lines = [{"seed": seed, "commit": "a" if seed < 50 else "b"} for seed in range(10, 1210)]
    results.keep("b", "push", lines, {"failed": 1, "finished": 1199}, [], failures=kinds)
    rows = json.loads(results.FILE.read_text())
    assert list(rows) == ["a", "b"] and rows["b"]["seeds"] == [10, 1209] and rows["b"]["broken"] == []
    line = results.tables()[results.VERIFICATION].splitlines()[-1]
    assert ", a, b | 10 to 1209 | 1,200 | 1 *failed*, 1199 finished | 0 |" in line and len(rows["a"]["commit"]) == 8


def test_a_record_goes_on_where_it_was_ended(tmp_path):
    results.Record(tmp_path / "record").add({"seed": 7, "outcome": "finished"})
    results.Record(tmp_path / "record").add({"seed": 8, "outcome": "failed"})
    assert sorted(results.Record(tmp_path / "record").found) == [7, 8]


@dataclass
class Run:
    seed: int
    vessel: str
    outcome: str
    claims: list[str]
    reason: str = "stuck at 3 mm"


def test_what_a_record_lacks_is_run_and_a_start_that_is_refused_does_not_count(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(results, "FILE", tmp_path / "results.json")
    monkeypatch.setattr(seeds, "RED", tmp_path)
    asked = []

    def play(vessel):
        def run(wanted):
            for seed in wanted:
                asked.append((vessel, seed))
                outcome = "refused" if seed % 3 == 0 else "failed" if seed == 14 else "finished"
                yield Run(seed, vessel, outcome, ["wrong"] if seed == 13 else [])
        return run

    def campaign(runs):
        given = parser_of("walk", "", runs).parse_args(["--first", "10", "--record", str(tmp_path / "r"), "--result"])
        record, lines = results.Record(given.record, "vessel", "seed"), []
        for vessel in ("a", "b"):
            lines += fill(record, given, play(vessel), [2, 11], "refused", vessel=vessel)
        return lines, given

    lines, given = campaign(2)
    assert asked == [(vessel, seed) for vessel in "ab" for seed in (2, 11, 10)]
    assert [one["seed"] for one in lines] == [10, 11, 10, 11] and capsys.readouterr().out == ""
    del asked[:]
    lines, given = campaign(4)
    assert asked == [(vessel, seed) for vessel in "ab" for seed in (12, 13, 14)]
    assert [line.strip() for line in capsys.readouterr().out.splitlines()] == [
        f"{vessel} {line}" for vessel in "ab" for line in ("13  finished: wrong", "14  failed: stuck at 3 mm")]
    assert close("walk", "walk FOLDER", lines, given, length=3) == 1 and seeds.red("walk") == [13, 13]
    row = json.loads(results.FILE.read_text())["walk"]
    assert (row["runs"], row["ends"], row["broken"]) == (8, {"failed": 2, "finished": 6}, [13, 13])
    assert row["failures"] == {"stuck at # mm": 2} and row["length"] == 3
    assert "walk; " not in (told := capsys.readouterr().out) and "8 runs (2 failed, 6 finished), 2 break" in told
    del asked[:]
    nothing = fill(results.Record(None, "vessel", "seed"), given, lambda seeds: (
        Run(seed, "c", "refused", []) for seed in seeds), skipped="refused", vessel="c")
    assert nothing == []
