"""What scenes are called where somebody practises on them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from guidewire.prepare import ROOT


@dataclass(frozen=True)
class Mission:
    """A scene with something to achieve. Its own drive reaches the target, as a test says.

    Attributes
    ----------
    title, goal : in words.
    par : a good time, s of the run.
    """

    title: str
    goal: str
    par: int


MISSIONS = {    # by their files in the repository, in the order of their difficulty
    "params/missions/first-branch.json": Mission(
        "Into the artery", "Push the wire past the fork and into the ring.", 12),
    "params/missions/other-branch.json": Mission(
        "The other branch", "Turn the bent tip before the fork, then push.", 15),
    "guidewire/env/data/missions/left-arm.json": Mission(
        "To the left arm", "Bring an angled catheter up the aorta into the left subclavian artery.", 12),
    "guidewire/env/data/missions/siphon-wire.json": Mission(
        "Through the siphon", "Lead a thin wire through the bends of a carotid siphon.", 20),
    "guidewire/env/data/missions/siphon-catheter.json": Mission(
        "With a microcatheter", "Wire first, microcatheter after it: the key I changes hands.", 20),
    "guidewire/env/data/missions/carotid.json": Mission(
        "Catheter, then wire", "Point the catheter at the left carotid, and send the wire into it.", 45),
}

SCENES = {    # of params: title and sentence
    "insertion": ("Arch", "A simple wire, pushed into a branch of an aortic arch."),
    "insertion-accurate": ("Arch, nitinol wire", "A nitinol wire of 0.8 mm with a soft bent tip in the same arch."),
    "sheath": ("Forked artery", "A wire of 0.36 mm out of its sheath: turn the bent tip to choose a branch."),
    "catheter": ("Catheter in a bend", "A 5 F catheter over a 0.035 inch wire: the key I selects one of them."),
    "catheter-branch": ("Catheter into a branch", "Catheter to the ostium, wire into the branch, catheter after it."),
    "catheter-sheath": ("Catheter in a forked artery", "A 5 F catheter over a 0.035 inch wire, both out of a sheath."),
    "microcatheter": ("Siphon", "A microcatheter over a 0.014 inch wire, out of a guide catheter through a siphon."),
    "coronary": ("Beating heart", "A wire of 0.014 inch into a coronary tree that beats 70 times a minute."),
    "aneurysm": ("Aneurysm", "A wire fed into a sac touches itself and coils up into a ball of loops."),
    "plectoneme": ("Plectoneme", "A wire under tension, turned at its end, makes a loop and winds up."),
    "guide-catheter": ("Three instruments", "A microcatheter over a wire in a guide catheter."),
}


def mission_of(file: Path) -> Mission | None:
    """Return what there is to achieve in a shipped scene, or None."""
    return next((mission for path, mission in MISSIONS.items() if (ROOT / path).resolve() == file.resolve()), None)


def title_of(file: Path) -> str:
    """Return a parameter file as a case is called: by its place where its own name says nothing."""
    if mission := mission_of(file):
        return mission.title
    if file.stem in SCENES:
        return SCENES[file.stem][0]
    name = file.resolve().parent.name if file.stem == "scene" else file.stem
    return name.replace("-", " ").capitalize()
