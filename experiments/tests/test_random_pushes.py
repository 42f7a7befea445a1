"""Wires pushed at random into vessels of twelve kinds: what each log says, found by an independent search."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from analysis.wall_search import MeshSearch, Walls, closed_form, crosses_itself
from experiments.campaigns import material_claims, material_pushes, pushes
from experiments.campaigns.push_campaign import campaign
from experiments.campaigns.push_claims import passage_bounds, violations
from guidewire.logs.hub import read_hub
from guidewire.logs.logs import read_log
from guidewire.logs.surfaces import read_obj
from tools.seeds import keep, seeds

# In the fraction six kinds with one rule each, and each rule with two of them.
FRACTION = [1008 + 12 * rule + kind for rule in range(3) for kind in range(rule, 12, 6)]
DAILY = 120
# Of a wire with a material, by method: how many seeds a day in full, and those of the fraction.
MATERIAL = {"direct": (60, (3, 5)), "sheath": (33, (3, 8)), "xpbd": (24, (3, 8)), "catheter": (12, (234,)),
            "catheters": (12, (226,)), "sheathed": (11, (229,))}
CASES = Path(__file__).with_name("wall_cases")

BOX = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)    # its corners
FACES = np.array([face for a, b, c, d in
                  [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
                  for face in ((a, b, c), (a, c, d))])


def assert_true(name, broken):
    keep(name, [push.seed for push in broken])
    assert not broken, "\n".join(f"{push.seed} {push.kind} {push.outcome}: {push.claims}" for push in broken)


def test_pushes_pass_no_wall_freeze_nowhere_and_say_what_is_true(runner_command, tmp_path):
    runs = campaign(runner_command, seeds("pbd", FRACTION, DAILY), tmp_path)
    assert_true("pbd", [push for push in runs if push.claims])


@pytest.mark.parametrize("method", MATERIAL)
def test_wires_with_a_material_pass_no_wall_and_say_what_is_true(runner_command, tmp_path, method):
    daily, fraction = MATERIAL[method]
    chosen = seeds(method, fraction, daily)
    runs = list(campaign(runner_command, chosen, tmp_path, method))
    assert_true(method, [push for push in runs if push.claims])
    assert len(runs) > 0.5 * len(chosen)
    if method in material_pushes.CATHETERS:
        assert sum(run.is_touching for run in runs) > 0.25 * len(runs)
        assert sum(run.overtakings for run in runs) > 0.25 * len(runs)


@pytest.mark.long("pushes between rigid walls, and SoftCatheterTests")
def test_catheters_pass_no_wall_that_gives_way(runner_command, tmp_path):
    assert_true("catheters soft", [push for push in campaign(
        runner_command, seeds("catheters soft", [], 8), tmp_path, "catheters", True) if push.claims])


def test_catheters_that_are_pushed_hard_at_the_exit_of_their_sheath_never_come_out(runner_command, tmp_path):
    push, = campaign(runner_command, [224], tmp_path, "sheathed")
    assert push.claims == []
    assert push.outcome == "finished" or "the wire buckles at the exit of its sheath and would come out" in push.reason


@pytest.mark.long("random pushes go through the same judge; BentTipFrictionTests has a hub that slips")
def test_a_thin_tip_that_snaps_round_under_a_weak_hub_passes_no_wall_and_goes_to_its_end(runner_command, tmp_path):
    every = 3  # of 471 steps
    done = subprocess.run([*runner_command, "-parameters", str(CASES / "tip_that_snaps.json"), "-logEvery", str(every),
                           "-out", str(tmp_path / "run")], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    scene = json.loads((CASES / "tip_that_snaps.json").read_text())
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["outcome"] == "finished" and summary["steps"] == scene["maxSimulationSteps"]
    mesh = read_obj(CASES / scene["vessel"]["file"])
    assert not crosses_itself(mesh.vertices, mesh.triangles)
    walls = Walls.of(scene, mesh.vertices[mesh.triangles])
    scene["displacementPerStep"] = every * 1e3 * scene["insertionSpeed"] * scene["timeStep"]
    positions = read_log(tmp_path / "run", spheres="all").positions
    radii = material_pushes.radii_of(scene)
    assert material_claims.violations(scene, summary, positions, radii, walls) == []
    hub = read_hub(tmp_path / "run")
    assert 0.9 * scene["hubForceLimit"] < np.abs(hub.force).max() <= scene["hubForceLimit"]
    assert summary["extremes"]["axialForce"] <= scene["hubForceLimit"]
    assert np.ptp(hub.turn + hub.twist) > 2.0 * np.pi  # of the tip: it snapped round


@pytest.mark.long("catheters that buckle there end so in the test above")
def test_a_wire_that_buckles_at_the_exit_of_its_sheath_fails_before_it_is_outside(runner_command, tmp_path):
    done = subprocess.run([*runner_command, "-parameters", str(CASES / "jammed_at_the_exit.json"), "-out",
                           str(tmp_path / "run")], capture_output=True, text=True)
    assert done.returncode == 5 and "the wire buckles at the exit of its sheath and would come out" in done.stderr
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert "the hub pushes with 22." in summary["reason"]
    assert summary["passages"] == 0 and "a hubForceLimit lets the hub slip" in summary["reason"]
    data = np.frombuffer((CASES / "jammed_at_the_exit.stl").read_bytes()[84:],
                         np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("count", "<u2")]))
    mesh = MeshSearch(data["corners"].astype(float))
    positions = read_log(tmp_path / "run", spheres="all").positions
    scene = json.loads((CASES / "jammed_at_the_exit.json").read_text())
    out = positions[positions[..., 2] > scene["sheath"]["exit"][2]]
    assert len(out) > 1000 and mesh.inside(out).all()


def test_a_mesh_that_crosses_itself_is_known():
    both = np.concatenate([FACES, FACES + 8])
    assert not crosses_itself(BOX, FACES)
    assert crosses_itself(np.concatenate([BOX, BOX + [0.7, 0.6, 0.5]]), both)
    assert not crosses_itself(np.concatenate([BOX, BOX + [2.7, 0.6, 0.5]]), both)


def test_a_seed_is_one_scene_and_seeds_have_all_kinds_and_rules(tmp_path):
    drawn = [pushes.draw(seed, tmp_path) for seed in range(36)]
    assert {(kind, scene["elementContact"]) for kind, scene in drawn} == {
        (kind, rule) for kind in pushes.KINDS for rule in pushes.CONTACT_RULES}
    assert drawn[:12] == [pushes.draw(seed, tmp_path) for seed in range(12)]
    steps = [scene["displacementPerStep"] / scene["sphereRadius"] for _, scene in drawn]
    assert 0.1 <= min(steps) < 0.5 and 10.0 < max(steps) <= 20.0
    lengths = [scene["guidewireLength"] / scene["numberRodElements"] for _, scene in drawn]
    assert 4.0 <= min(lengths) < 6.0 and 50.0 < max(lengths) <= 100.0


# The search itself, against what is known without it.


def _box_mesh(half):
    return (half * BOX)[FACES]


def test_the_search_knows_a_box_from_its_formula():
    random = np.random.default_rng(3)
    half = np.array([3.0, 2.0, 5.0])
    mesh = MeshSearch(_box_mesh(half))
    points = random.uniform(-6.0, 6.0, (2000, 3))
    beyond = np.abs(points) - half
    signed = np.linalg.norm(np.maximum(beyond, 0.0), axis=1) + np.minimum(beyond.max(axis=1), 0.0)
    assert np.array_equal(mesh.inside(points), signed < 0.0)
    assert mesh.distance(points) == pytest.approx(np.abs(signed), abs=1e-12)
    box = {"shape": "box", "centre": [0, 0, 0], "halfSize": half.tolist(), "rotation": [0, 0, 0]}
    wall = closed_form(box)
    distance = wall.distance
    assert distance(points) == pytest.approx(signed, abs=1e-12)
    a, b = points[:1000], points[1000:]
    fraction = np.linspace(0.0, 1.0, 2001)[:, None]
    for p, q in zip(a[:6], b[:6]):
        along = distance((1.0 - fraction) * p + fraction * q)
        step = np.linalg.norm(q - p) / 2000
        least = wall.least_along(p[None], q[None], np.inf)
        assert along.min() - step <= least <= along.min() + 1e-12
        crosses = mesh.crosses(p[None], q[None])[0]
        assert crosses == (along.min() < 0.0 < along.max())
        if not crosses:
            unsigned = mesh.least_distance(p[None], q[None], 100.0)
            assert np.abs(along).min() - step <= unsigned <= np.abs(along).min() + 1e-12


def test_the_search_knows_a_tube_on_its_axis_and_beyond_its_open_end():
    tube = {"shape": "tube", "knots": [[0, 0, 0], [0, 0, 50], [0, 20, 90]], "radius": [10, 8, 6]}
    wall = closed_form(tube)
    assert wall.distance(np.array([[0.0, 3.0, -70.0], [0.0, 0.0, 25.0]])) == pytest.approx(
        [7.0, 9.0], abs=1e-12)


def _broken(scene, summary, positions):
    """The first words of what a claim is made of."""
    walls = Walls.of(scene, _box_mesh(np.array([10.0, 10.0, 100.0])))
    return [claim.split(" = ")[0] for claim in violations(scene, summary, positions, walls)]


def test_the_check_finds_what_was_made_wrong():
    scene = {"vessel": {"shape": "mesh"}, "elementContact": "barycentric", "displacementPerStep": 0.5,
             "sphereRadius": 2.0}
    steps = 30
    z = 10.0 * np.arange(4)[None] + 0.5 * np.arange(steps + 1)[:, None]
    positions = np.stack([np.full_like(z, 9.0), np.zeros_like(z), z], axis=2)
    warning = "the drive fell short: of 15 units that it asked of the first sphere 1 are missing"
    summary = {"passages": 0, "maxPenetration": 1.0, "driveAsked": 0.5 * steps, "driveShortfall": 0.0,
               "outcome": "finished", "reason": "all steps are done", "warnings": [warning], "reliable": False}
    trusted = {**summary, "warnings": [], "reliable": True}
    assert _broken(scene, summary, positions) == [] == _broken(scene, trusted, positions)
    assert _broken(scene, {**summary, "reliable": True}, positions) == ["reliable"]
    assert _broken(scene, {**trusted, "reliable": False}, positions) == ["reliable"]
    assert _broken(scene, {**trusted, "reason": "all steps are done, but not well"}, positions) == ["reliable"]
    assert _broken(scene, {**trusted, "outcome": "diverged"}, positions) == ["reliable"]
    assert _broken(scene, {**summary, "maxPenetration": 1.0 + 1e-8}, positions) == ["maxPenetration"]
    assert _broken(scene, {**summary, "driveAsked": 0.5 * steps + 1e-7}, positions) == ["driveAsked"]
    assert _broken(scene, {**summary, "driveShortfall": None}, positions)[0] == "driveShortfall is null"
    lost = {**summary, "outcome": "diverged", "reason": "sphere 0 has no finite position at step 31", "warnings": [],
            "driveAsked": 0.5 * (steps + 1), "driveShortfall": None}
    assert _broken(scene, lost, positions) == []
    assert _broken(scene, {**lost, "driveAsked": 0.5 * steps}, positions) == ["driveAsked"]
    assert _broken(scene, {**summary, "passages": 1}, positions) == ["passages"]
    frozen = positions.copy()
    frozen[5:, 2:4] = frozen[5, 2:4]
    assert _broken(scene, summary, frozen) == ["element 2 is frozen from step 5 to 25"]
    across = positions.copy()
    across[7, 1, 0] = 10.0 + 1e-7
    claims = _broken(scene, {**summary, "maxPenetration": 2.0, "passages": 1}, across)
    assert claims == ["sphere 1 is beyond a wall after step 7", "element 0 crosses a wall after step 7; 2 times in all"]
    assert "calls itself reliable" in _broken(scene, {**trusted, "maxPenetration": 2.0, "passages": 1}, across)[0]


def test_a_point_on_a_wall_to_rounding_may_be_on_either_side():
    entries = {  # of one point: + inside, - beyond, 0 inside and on the wall, x beyond and on it
        "+-+-": (2, 2), "+0-": (1, 1), "+x-": (1, 1), "-x-": (0, 1), "-0-": (0, 1), "+0+": (0, 1), "+x+": (0, 1),
        "0x0x": (0, 2), "-": (0, 0), "++--": (1, 1), "-x0-+": (0, 1), "+-x+-": (2, 2),
    }
    for text, bounds in entries.items():
        beyond = np.array([c in "-x" for c in text])[None, :, None]
        on_wall = np.array([c in "0x" for c in text])[None, :, None]
        assert passage_bounds(beyond, on_wall) == bounds, text
    both = [np.concatenate([x, x], axis=2) for x in (beyond, on_wall)]
    assert passage_bounds(*both) == (4, 4)


@pytest.mark.parametrize("solver", ["direct", "xpbd"])
def test_the_check_of_a_wire_with_a_material_excuses_but_a_depth_that_is_named(solver):
    scene = {"solver": solver, "vessel": {"shape": "mesh"}, "displacementPerStep": 0.5, "guidewireLength": 30.0}
    walls = Walls.of(scene, _box_mesh(np.array([10.0, 10.0, 100.0])))
    radii = np.full(3, 2.0)
    entries = 11

    def broken(depth, summary, kept=entries):
        z = 10.0 * np.arange(4)[None] + 0.5 * np.arange(kept)[:, None]
        positions = np.stack([np.full_like(z, 8.0 + depth), np.zeros_like(z), z], axis=2)
        return [claim.split(" = ")[0].split(" by ")[0]
                for claim in material_claims.violations(scene, summary, positions, radii, walls)]

    def summary(depth, *warnings, **changed):
        return {"outcome": "finished", "reason": "all steps are done", "warnings": list(warnings), "passages": 0,
                "reliable": not warnings, "driveAsked": 0.5 * (entries - 1), "driveShortfall": 0.0,
                "maxPenetration": depth, "extremes": None, **changed}

    deep = "the surface is in a wall"
    wall = "the wire penetrated a wall by 0.12 units, 0.1 units are allowed"
    short = "the drive fell short: of 5 units that it asked of the first sphere 1 are missing"
    too_deep = [] if solver == "xpbd" else [deep, "maxPenetration"]
    assert broken(0.0, summary(0.0)) == []
    assert broken(0.09, summary(0.09)) == too_deep  # a twentieth of 2 is allowed with xpbd
    assert broken(0.12, summary(0.12, wall)) == too_deep
    assert deep in broken(0.12, summary(0.12)) and deep in broken(0.12, summary(0.12, short))
    assert broken(0.12, summary(0.12, wall, reliable=True))[:2] == ["reliable", deep]
    assert broken(0.0, summary(0.0, passages=1)) == ["passages"]
    kinked = "the outermost fibre was strained by up to 30 % at t = 0.1 s: a real instrument would have kinked"
    bent = {"strain": 0.3}
    assert broken(0.0, summary(0.0, kinked, extremes=bent)) == []
    assert broken(0.0, summary(0.0, extremes=bent)) == broken(0.0, summary(0.0, kinked)) == ["strain"]
    # A last step without a state did not go, and is not asked for.
    failed = summary(0.0, outcome="failed", reliable=False)
    assert broken(0.0, failed) == [] and "driveAsked" in broken(0.0, failed, entries - 1)


def test_the_outermost_instrument_of_several_is_looked_at_with_its_own_radius():
    z = np.linspace(0.0, 40.0, 9)[:, None] * [0.0, 0.0, 1.0]
    wire = np.stack([z, z + [0.0, 0.0, 3.0]])                 # nodes 5 apart, tip at 40 and 43
    outer = np.stack([z[:5] * 1.5, z[:5] * 1.5])              # 7.5 apart, tip at 30
    inner = np.stack([z[:5], z[:5] + [0.0, 0.0, 12.0]])       # tip at 20, inside, and at 32
    radii = [np.full(8, 1.0), np.full(4, 2.0), np.full(4, 3.0)]
    nodes, wide = material_claims.chain(wire, (outer, inner), radii)
    assert nodes[0, :7, 2].tolist() == [0.0, 7.5, 15.0, 22.5, 30.0, 35.0, 40.0]
    assert wide[0, :6].tolist() == [3.0, 3.0, 3.0, 3.0, 1.0, 1.0]
    assert nodes[1, :8, 2].tolist() == [0.0, 7.5, 15.0, 22.5, 30.0, 32.0, 33.0, 38.0] and nodes[1, -1, 2] == 43.0
    assert wide[1].tolist() == [3.0, 3.0, 3.0, 3.0, 2.0, 1.0, 1.0, 1.0]
    scene = {"hubForceLimit": 2.0, "catheters": [{}, {"hubForceLimit": 0.5}]}
    forces = [np.array([9.0, 1.0, -1.9]), np.array([9.0, 9.0]), np.array([0.1, 0.1, -0.6])]
    assert material_claims.beyond(scene, forces) == pytest.approx(0.2)
    assert [material_claims._first_outside({"sheath": {"exit": [0.0, 0.0, at]}}, wire).tolist()
            for at in (12.0, 41.0)] == [[3, 2], [9, 8]]
    hubs = {"catheters": [{"start": 30.0}, {"start": 10.0}]}
    rest = np.zeros(2)
    assert material_claims.order(hubs, [rest, rest, rest]) == []
    assert material_claims.order(hubs, [rest, rest, np.array([0.0, 0.021])]) != []
    assert material_claims.order(hubs, [np.array([0.011, 0.0]), rest, rest]) != []
    on_nodes = [np.ones((2, 3, 3)), np.zeros((2, 5, 3))]
    assert material_claims.force_sums(on_nodes, np.full((2, 3), 3.0)) == []
    assert material_claims.force_sums(on_nodes, np.full((2, 3), 3.0 + 1e-8)) != []


def test_a_hub_that_is_faster_than_asked_and_than_it_may_slip_breaks_a_claim():
    scene = {"timeStep": 0.01, "displacementPerStep": 2.0, "catheters": [{"slipSpeed": 0.1}]}
    slow, fast = np.array([0.0, 0.005, 0.003]), np.array([0.0, 0.0051, 0.0])
    scene["catheters"][0]["displacementPerStep"] = 0.0
    assert material_claims.speeds(scene, [slow, np.array([0.0, 0.002, 0.0])]) == []    # 0.5 m/s, and what is asked
    assert len(material_claims.speeds(scene, [fast, np.zeros(3)])) == 1
    assert len(material_claims.speeds(scene, [slow, np.array([0.0, 0.0021, 0.0])])) == 1
