"""A day has seeds of its own, and a seed that broke a claim is taken first until it does no more."""

import pytest

from tools import seeds
from tools.testing import FULL_CAMPAIGNS


@pytest.fixture(autouse=True)
def of_a_day(tmp_path, monkeypatch):
    monkeypatch.setattr(seeds, "RED", tmp_path / "red")
    monkeypatch.setenv(seeds.DAY, "7")
    monkeypatch.setenv(FULL_CAMPAIGNS, "1")


def test_days_follow_one_another_without_a_gap(monkeypatch):
    assert seeds.seeds("pushes", [1], 12) == list(range(84, 96))
    monkeypatch.setenv(seeds.DAY, "8")
    assert seeds.seeds("pushes", [1], 12)[0] == 96
    days = []
    for day in range(7):
        monkeypatch.setenv(seeds.DAY, str(day))
        days += seeds.of_the_day(3, 20)
    assert days == list(range(20))


def test_what_broke_a_claim_is_taken_first_until_it_does_no_more(monkeypatch):
    seeds.keep("pushes", [90, 5])
    assert seeds.seeds("pushes", [1], 12)[:3] == [90, 5, 84] and len(seeds.seeds("pushes", [1], 12)) == 13
    monkeypatch.delenv(FULL_CAMPAIGNS)
    assert seeds.seeds("pushes", [1], 12) == [90, 5, 1] and seeds.seeds("others", [1], 12) == [1]
    seeds.keep("pushes", [])
    assert seeds.seeds("pushes", [1], 12) == [1]
