"""guidewire.py render, with the real runner: every shape of a vessel, obstacles, and what cannot be drawn."""

import json

import numpy as np
import pytest
from PIL import Image, ImageSequence

from guidewire.commands import commands, drawn
from guidewire.logs.logs import read_log
from guidewire.logs.runs import read_run
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs.runner import Request
from guidewire.sessions.session import Session, SessionError

SCENE = {"guidewireLength": 60, "numberRodElements": 6, "guidewireOffset": -60, "displacement": 0, "sphereRadius": 2,
         "maxSimulationSteps": 2}
OBSTACLES = [
    {"shape": "sphere", "centre": [0, 20, -20], "radius": 4}, {"shape": "box", "centre": [0, -20, -20],
                                                               "halfSize": [3, 2, 10]},
    {"shape": "capsule", "from": [-9, 20, 0], "to": [9, 20, 0], "radius": 2},
    {"shape": "hull", "points": [[0, 20, -60], [5, 20, -60], [0, 25, -60], [0, 20, -50]]},
]
SHAPES = {
    "none": {},
    "plane": {"vessel": {"shape": "plane", "point": [0, -6, 0], "normal": [0, 1, 0]}},
    "tube": {"vessel": {"shape": "tube", "knots": [[0, 0, -70], [0, 0, 0], [0, 30, 30]], "radius": [8, 8, 6]}},
    "a tube that is placed": {"vessel": {"shape": "tube", "knots": [[0, 0, 0], [35, 0, 0]], "radius": 4},
                              "position": [0, 0, -70], "rotation": [0, -90, 0], "scale": [2, 2, 2]},
    "mesh": {"vessel": {"shape": "mesh", "file": str(ROOT / "params" / "meshes" / "arch.obj"),
                        "openRims": {"entrance": [0, 0, -320]}}, "guidewireOffset": -310},
    "obstacles": {"obstacles": OBSTACLES},
}


@pytest.fixture
def make_run(live, tmp_path):
    """A function that makes a run of `SCENE` with changes; its folder."""
    def make(**changes):
        (tmp_path / "scene.json").write_text(json.dumps({**SCENE, **changes}))
        answer = live.run(Request("run", tmp_path / "scene.json", tmp_path / "run"))
        assert answer.exit_code == 0, answer.message
        return tmp_path / "run"

    return make


def draw(*words):
    arguments = commands.parse(["render", *map(str, words)])
    return arguments.action(arguments)


# The other shapes' walls are those of the simulation by the test below.
@pytest.mark.parametrize("changes", [
    pytest.param(changes, id=name, marks=() if name in ("none", "a tube that is placed", "mesh") else pytest.mark.long(
        "drawn as are a tube and a mesh")) for name, changes in SHAPES.items()])
@pytest.mark.few(2)
def test_every_shape_is_drawn(make_run, capsys, changes):
    folder = make_run(**changes)
    assert draw(folder) == 0
    assert capsys.readouterr().out.strip().endswith("render.png")
    with Image.open(folder / "render.png") as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    background = pixels[2, 2] if not changes.get("vessel") else np.array([20, 23, 31])
    shown = np.abs(pixels - background).max(axis=2) > 12
    alone = 30_000  # pixels of the wire and the caption, at most
    assert 5_000 < shown.sum() < alone if not changes else shown.sum() > 5_000


def test_walls_are_those_of_the_simulation(make_run, runner_command):
    run = read_run(make_run(**SHAPES["a tube that is placed"], obstacles=OBSTACLES))
    with drawn.walls_of(run, read_log(run.folder, "all"), np.zeros(3), 60.0) as (walls, moved):
        tube, *bodies = walls
    assert moved is None, "they are rigid"
    rings = tube.vertices
    # Scaled by 2 and turned from x to z: a tube of radius 8 along z, whose open ends are drawn 60 units far.
    assert np.hypot(rings[:, 0], rings[:, 1]) == pytest.approx(8.0)
    assert (rings[:, 2].min(), rings[:, 2].max()) == pytest.approx((-130.0, 60.0))
    assert [body.vertices.min(axis=0).tolist() for body in bodies[:2]] == [
        pytest.approx([-4, 16, -24]), pytest.approx([-3, -22, -30])]
    assert [body.vertices.max(axis=0).tolist() for body in bodies[:2]] == [
        pytest.approx([4, 24, -16]), pytest.approx([3, -18, -10])]


@pytest.mark.long("a film has as many pictures as are asked for")
def test_times_and_films(make_run, tmp_path):
    folder = make_run()
    assert draw(folder, "--out", tmp_path / "new" / "some.png", "--times", 0, 0.01, "--yaw", 0, "--pitch", 90) == 0
    assert draw(folder, "--out", tmp_path / "film.gif", "--frames", 2) == 0
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 2


def test_x_ray_pictures_and_films_come_from_the_core(make_run, tmp_path):
    folder = make_run(**SHAPES["tube"])
    words = ("--fluoroscopy", "--lao", 30, "--field", 90, "--pixels", 128)
    assert draw(folder, "--out", tmp_path / "x.png", *words, "--noise", 0, "--blur", 0) == 0
    with Image.open(tmp_path / "x.png") as picture:
        grey = np.asarray(picture)
        assert picture.mode == "L" and picture.size == (128, 128)
    assert (grey == 191).mean() > 0.3 and (grey > 195).any() and (grey < 150).any()  # tissue, road map, wire
    assert draw(folder, "--out", tmp_path / "x.gif", *words, "--frames", 2, "--follow", "tip") == 0
    with Image.open(tmp_path / "x.gif") as film:
        assert film.n_frames == 2


@pytest.mark.parametrize("words, said", [
    (["--fluoroscopy", "--yaw", "3"], "--yaw is for drawn pictures"), (["--lao", "3"], "add --fluoroscopy"),
    (["--fluoroscopy", "--times", "0", "0.02"], "one moment"), (["--fluoroscopy", "--cranial", "91"], "cranial = 91"),
    (["--out", "a.jpg"], "a.jpg: a picture's name ends with .png"), (["--out", "picture"], ".png"),
    (["--out", "a.gif", "--times", "1"], "--times is for a picture"),
    (["--times", "99"], "--times 99 is beyond the run, whose log goes from 0 s to 0.02 s"),
    (["--times", "-1"], "beyond"),
    (["--follow", "tip", "--times", "0", "0.02"], "the tip is followed in a film or at one moment"),
    (["--out", "/proc/no/a.png"], "/proc/no"),
])
def test_what_cannot_be_drawn_is_one_line(make_run, words, said):
    folder = make_run()
    with pytest.raises(PreparationError) as refused:
        draw(folder, *words)
    assert said in str(refused.value) and "\n" not in str(refused.value)


def test_a_folder_without_a_run_and_a_mesh_that_is_gone_are_named(make_run, tmp_path):
    with pytest.raises(PreparationError, match="nowhere"):
        draw(tmp_path / "nowhere")
    folder = make_run()
    parameters = json.loads((folder / "parameters.json").read_text())
    (folder / "parameters.json").write_text(json.dumps({**parameters, "vessel": {"shape": "mesh", "file": "gone.obj"}}))
    with pytest.raises(PreparationError, match="gone.obj"):
        draw(folder)


@pytest.mark.parametrize("middle, reach", [([0, 0], 1.0), ([0, "far", 0], 1.0), ([0, 0, 0], 0.0)])
def test_walls_are_asked_for_with_three_numbers_and_a_number(runner_command, middle, reach):
    with Session(ROOT / "params" / "collision-wall.json", hand=False, native=False) as session:
        with pytest.raises(SessionError, match="three numbers|a number above 0"):
            session.walls(middle, reach)
        wall = session.walls()[0]
    assert len(wall.vertices) == 4 and np.ptp(wall.vertices, axis=0).max() > 0.0


def test_a_film_shows_an_injection_what_has_changed_and_its_road_map(make_run, tmp_path):
    scene = json.loads((ROOT / "params" / "sheath.json").read_text())
    meshes = ROOT / "params" / "meshes"
    scene["vessel"].update(file=str(meshes / "artery.obj"), anatomy=str(meshes / "artery.anatomy.json"))
    folder = make_run(**{**scene, "maxSimulationSteps": 60, "logEvery": 4})
    films = {}
    for name, words in (("agent", ()), ("subtracted", ("--subtract",)), ("map", ("--road-map",))):
        assert draw(folder, "--fluoroscopy", "--inject", 0.3, 3, 4, *words, "--frames", 8, "--pixels", 96, "--noise", 0,
                    "--blur", 0, "--vessel", "none", "--out", tmp_path / f"{name}.gif") == 0
        with Image.open(tmp_path / f"{name}.gif") as film:
            films[name] = [np.asarray(one.convert("L")).astype(int)[:74] for one in ImageSequence.Iterator(film)]
    agent = [int((grey < 150).sum()) for grey in films["agent"]]
    assert agent[0] == 0 and max(agent) > 30 and agent[-1] < max(agent)    # it comes, and goes
    assert np.abs(films["subtracted"][0] - 191).max() <= 3    # nothing has changed yet: the wire is not seen
    assert (films["map"][-1] > 195).sum() > 30 and (films["map"][-1] < 150).sum() < max(agent) / 2
    with pytest.raises(PreparationError, match="add --fluoroscopy"):
        draw(folder, "--inject", 0, 1, 1)
