"""The reader takes any layout of a log, any cut of it, and keeps no more than it was asked for."""

from __future__ import annotations

import json
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analysis.tests.chain import Chain
from guidewire.logs.entries import arrays_of
from guidewire.logs.logs import LogError, find_log, read_columns, read_log


@pytest.fixture(scope="module")
def chain() -> Chain:
    return Chain(constraint_solver_steps=20, elements=3, most_steps=12)


def write(folder: Path, text: str, name: str = "positions.json") -> Path:
    path = folder / name
    path.write_text(text)
    return path


def test_last_sphere_is_read_exactly(tmp_path: Path, chain: Chain) -> None:
    log = read_log(write(tmp_path, chain.log()))
    assert log.complete and log.final_step == chain.steps
    np.testing.assert_array_equal(log.steps, np.arange(chain.steps + 1))
    np.testing.assert_array_equal(log.spheres, [chain.elements])
    np.testing.assert_array_equal(log.positions[:, 0, 2], chain.z[:, -1])
    np.testing.assert_array_equal(log.prediction_error, chain.prediction_error)
    np.testing.assert_allclose(log.time, chain.time, rtol=1e-15)
    np.testing.assert_allclose(log.elapsed, 0.002 * np.arange(chain.steps + 1), rtol=1e-15)
    np.testing.assert_array_equal(log.final_positions[:, 2], chain.z[-1])


def test_all_spheres_and_velocities_are_read_on_request(tmp_path: Path, chain: Chain) -> None:
    log = read_log(write(tmp_path, chain.log()), spheres="all", velocities=True)
    np.testing.assert_array_equal(log.positions[:, :, 2], chain.z)
    assert log.velocities is not None
    np.testing.assert_allclose(log.velocities[1:, :, 2], np.diff(chain.z, axis=0) / chain.time_step, rtol=1e-12)


def test_chosen_spheres_come_in_ascending_order(tmp_path: Path, chain: Chain) -> None:
    log = read_log(write(tmp_path, chain.log()), spheres=[2, 1])
    np.testing.assert_array_equal(log.spheres, [1, 2])
    np.testing.assert_array_equal(log.sphere(2)[:, 2], chain.z[:, 2])
    with pytest.raises(LogError, match="sphere 3 was not read"):
        log.sphere(3)


def test_columns_are_read_of_the_entries_that_are_asked_for(tmp_path: Path, chain: Chain) -> None:
    path = write(tmp_path, chain.log())
    steps = read_log(path).steps[[1, 3]]
    columns = read_columns(path, ("step", "positions"), steps)
    assert columns["step"].tolist() == steps.tolist()
    np.testing.assert_array_equal(columns["positions"], read_columns(path, ("positions",))["positions"][[1, 3]])


def test_null_is_no_number(chain: Chain) -> None:
    entry = json.loads(chain.log())["3"]
    assert np.isnan(arrays_of(3, {**entry, "delta": None})["delta"])


def test_thinning_keeps_multiples_and_still_knows_the_end(tmp_path: Path, chain: Chain) -> None:
    log = read_log(write(tmp_path, chain.log()), every=5)
    np.testing.assert_array_equal(log.steps, [0, 5, 10])
    assert log.final_step == 12
    np.testing.assert_array_equal(log.final_positions[:, 2], chain.z[12])


@pytest.mark.parametrize("indent", [None, 1, 4])
def test_layout_does_not_matter(tmp_path: Path, chain: Chain, indent: int | None) -> None:
    text = json.dumps(json.loads(chain.log()), indent=indent)
    assert (indent is None) == (text.count("\n") == 0)
    log = read_log(write(tmp_path, text), spheres="all")
    np.testing.assert_array_equal(log.positions[:, :, 2], chain.z)


def test_byte_order_mark_is_no_part_of_the_log(tmp_path: Path, chain: Chain) -> None:
    assert read_log(write(tmp_path, "\ufeff" + chain.log())).complete


def test_log_of_the_last_sphere_alone(tmp_path: Path, chain: Chain) -> None:
    entries = {str(k): chain.entry(k, spheres=[chain.elements]) for k in range(3)}
    log = read_log(write(tmp_path, json.dumps(entries)), spheres="last")
    np.testing.assert_array_equal(log.positions[:, 0, 2], chain.z[:3, -1])
    np.testing.assert_array_equal(log.final_spheres, [chain.elements])


def test_every_cut_is_read_up_to_its_last_whole_step(tmp_path: Path) -> None:
    """Cut at every single character: what counts as whole is decided by the standard parser, entry by entry."""
    text = "{\n" + ",\n".join(Chain(elements=8, most_steps=5).log()[2:].split(",\n")[:3]) + "\n}\n"
    ends = []
    at = 0
    for k in range(3):
        at = text.index(f'"{k}": {{"totalTime"', at)
        start = text.index("{", at)
        _, at = json.JSONDecoder().raw_decode(text, start)
        ends.append(at)
    path = tmp_path / "positions.json.partial"
    for cut in range(ends[0], len(text.rstrip())):
        path.write_text(text[:cut])
        log = read_log(path)
        whole = sum(end <= cut for end in ends) - 1
        assert log.final_step == whole == log.steps[-1], f"cut at {cut}"
        assert not log.complete and f"up to step {whole}" in (log.warning or "")


def test_cut_before_the_first_whole_step_is_an_error(tmp_path: Path, chain: Chain) -> None:
    for text in ("", "{", "{\n", chain.log()[:100]):
        with pytest.raises(LogError, match="holds no whole step"):
            read_log(write(tmp_path, text))


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 400), st.booleans())
def test_chunks_may_end_anywhere(tmp_path_factory: pytest.TempPathFactory, size: int, cut: bool) -> None:
    """Read in chunks of any size, down to one character, a log says the same."""
    chain = Chain(constraint_solver_steps=2, elements=2, most_steps=4)
    text = chain.log()[: -200 if cut else None]
    path = write(tmp_path_factory.mktemp("log"), text)
    with pytest.MonkeyPatch.context() as patch:
        expected = read_log(path, spheres="all")
        patch.setattr("guidewire.logs.logs._CHUNK", size)
        log = read_log(path, spheres="all")
    np.testing.assert_array_equal(log.positions, expected.positions)
    assert log.warning == expected.warning and log.complete is not cut


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[1, 2]", "not a position log at character 0"),
        ('{"a": {}}', "not a position log"),
        ('{"0": 3}', "not a position log"),
        ('{"0": {"totalTime": 0}}', "step 0 lacks"),
        ("{}", "holds no whole step"),
        ('{"0": {"x": trx' + "e" * 100 + "}}", "not a position log at character 12"),
    ],
)
def test_what_is_no_log_is_refused_in_one_line(tmp_path: Path, text: str, said: str) -> None:
    path = write(tmp_path, text)
    with pytest.raises(LogError, match=said) as error:
        read_log(path)
    assert str(path) in str(error.value) and "\n" not in str(error.value)


def test_damage_in_the_middle_is_no_cut(tmp_path: Path, chain: Chain) -> None:
    text = chain.log()
    middle = text.index('"6": ')
    with pytest.raises(LogError, match="not a position log"):
        read_log(write(tmp_path, text[:middle] + "\0" * 10 + text[middle + 10:]))


def test_steps_out_of_order_are_refused(tmp_path: Path, chain: Chain) -> None:
    text = '{"1": %s, "0": %s}' % (json.dumps(chain.entry(1)), json.dumps(chain.entry(0)))
    with pytest.raises(LogError, match="step 0 stands after step 1"):
        read_log(write(tmp_path, text))


def test_missing_and_binary_files(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="no such log"):
        read_log(tmp_path / "positions.json")
    with pytest.raises(LogError, match="holds neither"):
        read_log(tmp_path)
    (tmp_path / "positions.json").write_bytes(b"\xff\xfe\x80")
    with pytest.raises(LogError, match="not a text file"):
        read_log(tmp_path)


def test_folder_means_the_complete_log_before_the_partial_one(tmp_path: Path, chain: Chain) -> None:
    write(tmp_path, chain.log()[:-100], "positions.json.partial")
    assert find_log(tmp_path).name == "positions.json.partial" and not read_log(tmp_path).complete
    write(tmp_path, chain.log())
    assert find_log(tmp_path).name == "positions.json" and read_log(tmp_path).complete


@pytest.mark.parametrize("one_line", [False, True])
@pytest.mark.few(1)
def test_memory_is_set_by_what_is_asked(tmp_path: Path, one_line: bool) -> None:
    """10 MB of log, of which 100 steps of one sphere are 6 kB: the reader stays below 8 chunks of 1 MB."""
    sphere = json.dumps({"x": 0.1234567890123456, "y": -0.1234567890123456, "z": 123.45678901234567,
                         "vx": 0.0, "vy": 0.0, "vz": 0.0})
    spheres = ", ".join(f'"{i}": {sphere}' for i in range(91))
    path = tmp_path / "positions.json"
    with path.open("w") as stream:
        for k in range(1000):
            stream.write("{" if k == 0 else ("," if one_line else ",\n"))
            stream.write(f'"{k}": {{"totalTime": {k}, "elapsedMilliseconds": 1, "delta": 0, "sphere": {{{spheres}}}}}')
        stream.write("}")
    assert path.stat().st_size > 9.5e6
    tracemalloc.start()
    try:
        log = read_log(path, every=10)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert log.steps.size == 100 and peak < 8 * 2**20
