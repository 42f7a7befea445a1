"""The pages read as tools/prose.py allows, and it counts as its texts say."""

import pytest

from guidewire.prepare import ROOT
from tools import prose

_SPLIT = """# A heading of many words that counts for nothing; really: nothing

A run is made by `python3 guidewire.py run FILE; more: code`. It writes [three files](runs.md), e.g. a log.
See https://example.org/a;b and then: 0.36 mm.

- An item without an end
- Another one; with a break

```
code: of; any length
```

| key | meaning |
|---|---|
| `a`, `b` | one two `three four` five |
<!-- warnings -->
| a line of the program itself | meaning |
<!-- /warnings -->
"""


def test_sentences_cells_and_the_opening_are_counted_as_a_reader_would():
    page = prose.read(_SPLIT)
    assert [prose.words(one) for one in page.sentences] == [6, 7, 6, 5, 5]
    assert page.mean == 29 / 5 and page.chaining == 2 / 5
    assert [prose.words(cell) for cell in page.cells] == [1, 1, 0, 4, 0, 1]
    assert page.opening == 29 + 11    # a heading is read, too


@pytest.mark.parametrize("text, fault", [
    ("word " * 19 + ".\n```\nx\n```\n", "19.0 words a sentence"), ("One: two.\n```\nx\n```\n", "1.00 colons"),
    ("One.\n```\nx\n```\n| " + "word " * 26 + "|\n", "a cell of 26 words"), ("One.\n", "no example"),
])
def test_each_limit_is_told(text, fault):
    (found,) = prose.read(text).faults(opens=True)
    assert found.startswith(fault)
    assert not prose.read("One.\n```\nx\n```\n").faults(opens=True)


def test_the_command_tells_the_pages_beyond_a_limit(tmp_path, capsys):
    (tmp_path / "long.md").write_text("word " * 40 + ". One two.\n", encoding="utf-8")
    (tmp_path / "short.md").write_text("One two.\n", encoding="utf-8")
    assert prose.main([str(tmp_path / "short.md")]) == 0
    assert prose.main(["--longest", "1", *map(str, sorted(tmp_path.glob("*.md")))]) == 1
    said = capsys.readouterr().out
    assert "    40: word word" in said and "long.md: 21.0 words" in said and "short.md: " not in said


@pytest.mark.parametrize("page", prose.PAGES, ids=lambda page: page.name)
def test_every_page_reads_within_the_limits(page):
    assert not prose.read(page.read_text(encoding="utf-8")).faults(opens=page in prose.COUNTED)


def test_all_pages_together_are_not_long():
    assert sum(prose.read(page.read_text(encoding="utf-8")).words for page in prose.COUNTED) <= prose.TOTAL_WORDS
