"""The last results of campaigns, and the table that quotes them."""

import json

from experiments.campaigns import results


def test_the_page_quotes_the_last_results():
    page = results.PAGE.read_text(encoding="utf-8")
    found = page.split("<!-- campaigns -->\n")[1].split("<!-- /campaigns -->")[0]
    assert found == results.table(), "python3 -m experiments.campaigns.results writes the table anew"


def test_a_row_takes_the_place_of_its_last_one_and_counts_reasons_by_kind(tmp_path, monkeypatch):
    monkeypatch.setattr(results, "FILE", tmp_path / "results.json")
    kinds = results.kinds_of(["no solution at t = 0.2 s; 3 N", "no solution at t = 1.5e-05 s", "buckles"])
    assert kinds == {"no solution at t = # s": 2, "buckles": 1}
    results.keep("b", "push", [3, 4, 9], {"finished": 2, "failed": 1}, [9])
    results.keep("a", "pull", [1], {"finished": 1}, [])
    results.keep("b", "push", range(10, 1210), {"failed": 1, "finished": 1199}, [], failures=kinds)
    rows = json.loads(results.FILE.read_text())
    assert list(rows) == ["a", "b"] and rows["b"]["seeds"] == [10, 1209] and rows["b"]["broken"] == []
    line = results.table().splitlines()[-1]
    assert "| 10 to 1209 | 1,200 | 1 *failed*, 1199 finished | 0 |" in line and len(rows["a"]["commit"]) == 8


def test_a_record_goes_on_where_it_was_ended(tmp_path):
    results.Record(tmp_path / "record").add({"seed": 7, "outcome": "finished"})
    results.Record(tmp_path / "record").add({"seed": 8, "outcome": "failed"})
    assert sorted(results.Record(tmp_path / "record").found) == [7, 8]
    results.Record(None).add({"seed": 1})
