"""Values that a key of the table does not allow, by its type, and those at its borders."""

import math

from hypothesis import strategies as st
from hypothesis.strategies import integers as whole

from guidewire.runs.key_table import Key


def wrong(key: Key) -> st.SearchStrategy:
    """Values that a key does not allow."""
    no_number = st.one_of(st.text(max_size=5), st.booleans(), st.none(), st.lists(st.floats(-1, 1), max_size=4),
                          st.dictionaries(st.text(max_size=2), st.integers(), max_size=3))
    if key.may_be_null:
        no_number = no_number.filter(lambda value: value is not None)
    number = st.floats(-1.0, 1.0)
    if key.kind == "switch":
        null = [] if key.may_be_null else [st.none()]
        return st.one_of(whole(0, 1), st.text(max_size=5), st.just("true"), *null)
    if key.kind == "word":
        return st.one_of(st.text(max_size=8), whole(-2, 5), st.none(), st.booleans()).filter(
            lambda value: value not in key.words)
    if key.kind == "text":
        return st.one_of(number, st.none(), st.booleans(), st.lists(st.text(max_size=2), max_size=2))
    if key.kind == "vector":
        counts = st.lists(number, max_size=5).filter(lambda v: len(v) != 3)
        zero = [st.just([0, 0.0, -0.0])] if key.needs_length else []
        return st.one_of(counts, number, st.text(max_size=5), st.none(), st.just([1, 2, "3"]),
                         st.just({"x": 1, "y": 2}), st.just({"x": 1, "y": 2, "z": 3, "w": 4}), *zero)
    if key.kind in ("list", "object"):
        broken = st.sampled_from([{"shape": "cube"}, {"shape": 1}, {}, {"from": 2, "to": 1}, {"from": 0},
                                  {"from": -1, "to": 1}, {"from": 0, "to": 1, "wireRadius": 0}])
        if key.name == "loadTables":
            broken = broken.filter(bool)    # none of its loads has a table: nothing is wrong
        null = [] if key.may_be_null else [st.none()]
        item = broken if key.kind == "object" else st.one_of(broken, number, st.none()).map(lambda x: [x])
        return st.one_of(number, st.text(max_size=5), st.booleans(), item, *null)
    outside = [no_number]
    if key.kind == "whole":
        outside += [whole(-(10**25), int(key.low) - 1), whole(int(key.high) + 1, 10**25),
                    whole(-3, 1000).map(lambda k: k + 0.5)]
    elif not math.isinf(key.low):
        outside.append(st.floats(-1e300, key.low, exclude_max=key.low_is_allowed))
    if key.kind == "number" and not math.isinf(key.high):
        outside.append(st.floats(key.high, 1e300, exclude_min=True))
    return st.one_of(outside)


def borders(key: Key) -> tuple[list[float], list[float]]:
    """The numbers at a key's borders: those allowed that cost nothing, and those just outside."""
    if key.kind == "whole":
        return [int(key.low)], [int(key.low) - 1, int(key.high) + 1]
    inside, outside = [], []
    if not math.isinf(key.low):
        inside.append(key.low if key.low_is_allowed else key.low + 1e-12)  # the smallest doubles are not of interest
        outside.append(math.nextafter(key.low, -math.inf) if key.low_is_allowed else key.low)
    if not math.isinf(key.high):
        inside.append(key.high)
        outside.append(math.nextafter(key.high, math.inf))
    return inside, outside
