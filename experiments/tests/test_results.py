"""The last results of campaigns, and the table that quotes them."""

import json

from experiments.campaigns import results


def test_the_pages_quote_the_last_results():
    for page, table in results.tables().items():
        assert results.quoted(page) == table, "python3 -m experiments.campaigns.results writes the tables anew"


def test_a_row_takes_the_place_of_its_last_one_and_counts_reasons_by_kind(tmp_path, monkeypatch):
    monkeypatch.setattr(results, "FILE", tmp_path / "results.json")
    kinds = results.kinds_of(["no solution at t = 0.2 s; 3 N", "no solution at t = 1.5e-05 s", "buckles"])
    assert kinds == {"no solution at t = # s": 2, "buckles": 1}
    results.keep("b", "push", [{"seed": seed} for seed in (3, 4, 9)], {"finished": 2, "failed": 1}, [9])
    record = results.Record(None)
    record.add({"seed": 1})
    results.keep("a", "pull", list(record.found.values()), {"finished": 1}, [])
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
    results.Record(None).add({"seed": 1})
