"""Coaxial tubes in one plane under dead loads: an own solution, with which the solver's rest shapes are compared.

Across the axis the tubes are one beam: EI, GA and moments at rest add. Along it each is a bar from its own hub. Unknown
is the angle of many short cells, by Newton's method; a hub's force is a difference of the least energy.
"""

import dataclasses

import numpy as np
from scipy.linalg import solve_banded

CELLS = 6000
ELEMENT = 1e-3                     # m, of the solver
LARGEST_ANGLE = 2.5                # rad
STRAIN = 3e-4                      # of a tube along its axis by each of its loads, at most
BARE = 1e-3                        # of the stiffest tube's EI: a softer one ends where a stiffer one carries it


@dataclasses.dataclass(frozen=True)
class Tube:
    """A tube; lengths from its own hub, m, forces (y, z), N."""

    length: float
    lead: float                      # of the outermost hub before its own
    radius: float
    lumen: float
    elements: int
    pieces: tuple                    # (from, E, G, curvature about x)
    density: float
    tip: tuple = (0.0, 0.0)
    line: tuple = (0.0, 0.0)         # N/m
    points: tuple = ()               # (at, force)

    @property
    def end(self):
        """Of it, m from the outermost hub."""
        return self.length - self.lead

    @property
    def area(self):
        """m^2."""
        return np.pi * (self.radius ** 2 - self.lumen ** 2)

    @property
    def second(self):
        """Second moment of area, m^4."""
        return np.pi * (self.radius ** 4 - self.lumen ** 4) / 4.0

    def at(self, station, column):
        """E, G or curvature (columns 1 to 3) at stations (n,) from the outermost hub; 0 where it is not."""
        table = np.array(self.pieces)
        piece = np.searchsorted(table[:, 0], station + self.lead, side="right") - 1
        return np.where(station < self.end, table[piece, column], 0.0)

    def beyond(self, station, weight):
        """Sum of its loads beyond stations (n,), (n, 2) N; weight: of it per length, (y, z) N/m."""
        line = np.array(self.line) + weight
        found = np.outer(np.maximum(self.end - station, 0.0), line)
        for at, force in (*self.points, (self.length, self.tip)):
            if at >= self.lead:
                found += np.outer(station < at - self.lead, force)
        return found


@dataclasses.dataclass(frozen=True)
class Shape:
    """A rest shape: tips (tubes, 2), m, and least energy, J."""

    tips: np.ndarray
    energy: float
    sideways: float                  # largest angle to the axis, rad
    pull: float                      # sum of all loads along it, N


def solve(tubes, gravity, near=None):
    """The rest shape of tubes, the outermost first, each of whose ends is beyond the outermost hub.

    near : (stations, angles) of a shape, whose next rest shape is sought; else the loads grow from none.
    """
    last = max(tube.end for tube in tubes)
    marks = {0.0, last}
    for tube in tubes:
        inner = [piece[0] for piece in tube.pieces] + [at for at, _ in tube.points] + [tube.length]
        marks |= {at - tube.lead for at in inner if 0.0 < at - tube.lead < last}
    marks = np.array(sorted(marks))
    parts = [np.linspace(a, b, max(int(np.ceil(CELLS * (b - a) / last)), 2), endpoint=False)
             for a, b in zip(marks[:-1], marks[1:])]
    nodes = np.concatenate([*parts, [last]])
    h = np.diff(nodes)
    middle = 0.5 * (nodes[:-1] + nodes[1:])
    present = np.array([middle < tube.end for tube in tubes])
    young, shear, curvature = (np.array([tube.at(middle, k) for tube in tubes]) for k in (1, 2, 3))
    bend = young * np.array([[tube.second] for tube in tubes]) * present
    stretch = young * np.array([[tube.area] for tube in tubes]) * present
    across = (shear * np.array([[tube.area] for tube in tubes]) * present).sum(axis=0)
    loads = np.array([tube.beyond(middle, tube.density * tube.area * np.array(gravity)) for tube in tubes])
    force = loads.sum(axis=0)
    total = bend.sum(axis=0)
    rest = (bend * curvature).sum(axis=0) / total
    compliance = np.concatenate([[0.5 * h[0] / total[0]], 0.5 * (h[:-1] / total[:-1] + h[1:] / total[1:])])
    turned = np.concatenate([[0.5 * h[0] * rest[0]], 0.5 * (h[:-1] * rest[:-1] + h[1:] * rest[1:])])

    def axes(angle):
        tangent = np.stack([-np.sin(angle), np.cos(angle)], axis=1)
        return tangent, np.stack([-np.cos(angle), -np.sin(angle)], axis=1)

    angle = np.zeros(len(h)) if near is None else np.interp(middle, *near)
    for share in np.linspace(0.1, 1.0, 10) if near is None else [1.0]:
        for _ in range(60):
            tangent, normal = axes(angle)
            along = share * (force * tangent).sum(axis=1)
            sideways = share * (force * normal).sum(axis=1)
            moment = (np.diff(angle, prepend=0.0) - share * turned) / compliance
            right = np.append(moment[1:], 0.0)
            gradient = moment - right - h * sideways * (1.0 - along / across)
            stiffness = 1.0 / compliance
            diagonal = stiffness + np.append(stiffness[1:], 0.0) + h * (along + (sideways ** 2 - along ** 2) / across)
            bands = np.zeros((3, len(h)))
            bands[0, 1:] = bands[2, :-1] = -stiffness[1:]
            bands[1] = diagonal
            step = solve_banded((1, 1), bands, -gradient)
            angle = angle + step * min(1.0, 0.5 / np.abs(step).max())
            if np.abs(step).max() < 1e-13:
                break
        else:
            raise ArithmeticError("no rest shape")
    tangent, normal = axes(angle)
    sideways = (force * normal).sum(axis=1)
    axial = axial_forces(h, angle, bend, loads, tangent, sideways * bend / total)
    strain = np.divide(axial, stretch, out=np.zeros_like(axial), where=present)
    ahead = np.array([tube_lead(tube, force_0) for tube, force_0 in zip(tubes, axial[:, 0])])
    tips = trace(tubes, nodes, tangent, normal, sideways / across, strain, ahead, present)
    held = (0.5 * bend * curvature ** 2).sum(axis=0) - 0.5 * total * rest ** 2
    energy = (0.5 * compliance * moment ** 2).sum() + (h * held).sum() + sum(straightened(tube) for tube in tubes)
    energy -= (h * ((force * tangent).sum(axis=1) + 0.5 * sideways ** 2 / across)).sum()
    energy -= 0.5 * (h * axial * strain).sum() + 0.5 * (axial[:, 0] * ahead).sum()
    return Shape(tips, energy, float(np.abs(angle).max()), float(force[0, 1]))


def axial_forces(h, angle, bend, loads, tangent, across):
    """Axial force of each tube in the cells: dN/ds = V theta' - f.t; at its tip that of the load there."""
    turn = np.gradient(angle, np.cumsum(h))
    found = np.zeros(bend.shape)
    for i, load in enumerate(loads):
        own = np.flatnonzero(bend[i])
        force = 0.0
        before = np.zeros(2)
        for j in own[::-1]:
            force += (load[j] - before) @ tangent[j] - across[i, j] * turn[j] * h[j]
            before = load[j]
            found[i, j] = force
    return found


def tube_lead(tube, force):
    """How much longer a tube is before the outermost hub under a force, m."""
    borders = [piece[0] for piece in tube.pieces] + [tube.length]
    return sum(max(min(tube.lead, to) - start, 0.0) * force / (young * tube.area)
               for (start, young, *_), to in zip(tube.pieces, borders[1:]))


def straightened(tube):
    """Energy that keeps a tube straight before the outermost hub, J."""
    borders = [piece[0] for piece in tube.pieces] + [tube.length]
    return sum(max(min(tube.lead, to) - start, 0.0) * 0.5 * young * tube.second * curvature ** 2
               for (start, young, _, curvature), to in zip(tube.pieces, borders[1:]))


def trace(tubes, nodes, tangent, normal, shear, strain, ahead, present):
    """Tips (tubes, 2). The curve is that of the outermost tube, stretched as that one is; what is inside lies on it
    farther on by what it is longer from its own hub."""
    h = np.diff(nodes)
    longer = ahead[:, None] + np.concatenate([np.zeros((len(tubes), 1)), np.cumsum(h * strain, axis=1)], axis=1)
    carrier = present.argmax(axis=0)
    cells = np.arange(len(h))
    before = np.concatenate([[0.0], longer[carrier[:-1], cells[1:]]])
    along = h + longer[carrier, cells + 1] - before
    curve = np.concatenate([np.zeros((1, 2)), np.cumsum(along[:, None] * tangent + (h * shear)[:, None] * normal,
                                                        axis=0)])
    tips = []
    for i, tube in enumerate(tubes):
        k = int(np.argmin(np.abs(nodes - tube.end)))
        tips.append(curve[k] + (longer[i, k] - longer[carrier[k - 1], k]) * tangent[k - 1])
    return np.array(tips)


def hub_forces(tubes, gravity, near=None, step=2e-5):
    """Force of each hub on its tube along the axis, N, the outermost first: of inner ones dE/dp. `near` as of solve."""
    forces = []
    for i in range(1, len(tubes)):
        less, more = (solve([dataclasses.replace(tube, lead=tube.lead + sign * step) if k == i else tube
                             for k, tube in enumerate(tubes)], gravity, near).energy for sign in (-1.0, 1.0))
        forces.append((less - more) / (2.0 * step))
    return np.array([-solve(tubes, gravity, near).pull - sum(forces), *forces])


def angles(tube, nodes):
    """Stations, m from the outermost hub, and angles of the elements of a tube of n + 1 nodes (y, z)."""
    along, aside = np.diff(nodes[:, 1]), np.diff(nodes[:, 0])
    n = len(along)
    return tube.length * (np.arange(n) + 0.5) / n - tube.lead, np.unwrap(np.arctan2(-aside, along))


def random_case(seed):
    """Tubes and gravity: the first of random ones whose rest shape under growing loads is not bent too far."""
    random = np.random.default_rng(seed)
    while True:
        tubes, gravity = random_tubes(random)
        try:
            shape = solve(tubes, gravity)
        except ArithmeticError:
            continue
        if shape.sideways < LARGEST_ANGLE:
            return tubes, gravity


def random_tubes(random):
    """Two or three tubes and a gravity, the outermost first: soft and stiff, thin and thick, each with its loads."""
    count = int(random.integers(2, 4))
    length = random.uniform(0.15, 0.4)
    tubes, drawn = [], []
    lumen = 0.0
    lead = random.uniform(0.0, 0.05) * np.arange(count - 1, -1, -1)
    for k in range(count):                     # the wire first
        radius = lumen + random.uniform(0.05e-3, 0.35e-3) + (0.15e-3 if k == 0 else 0.0)
        drawn.append((radius, lumen, 10.0 ** random.uniform(3.0, 12.0), length * random.uniform(0.7, 1.3)))
        lumen = radius + random.uniform(0.02e-3, 0.2e-3)
    stiff = [young * (radius ** 4 - hole ** 4) for radius, hole, young, _ in drawn]
    carried = min(end for (*_, end), one in zip(drawn, stiff) if one >= BARE * max(stiff))
    for k, (radius, lumen, young, end) in enumerate(drawn):
        end = end if stiff[k] >= BARE * max(stiff) else carried * random.uniform(0.3, 0.95)
        own = end + lead[k]
        soft = own - random.uniform(0.05, 0.3) * end
        factor = 10.0 ** random.uniform(-1.0, 0.0)
        bent = random.uniform(-3.0, 3.0, 2)
        tubes.append(Tube(own, float(lead[k]), radius, lumen, 0, ((0.0, young, young / 2.6, bent[0]),
                     (soft, factor * young, factor * young / 2.6, bent[1])),
                          min(random.uniform(1e3, 8e3), STRAIN * factor * young / length)))
    tubes.reverse()
    bend = max(tube.pieces[0][1] * tube.second for tube in tubes)
    scale = random.uniform(0.05, 0.5) * bend / length ** 2
    loaded = []
    for tube in tubes:
        most = STRAIN * tube.pieces[1][1] * tube.area

        def load(size, most=most):
            return tuple(np.clip(size * random.uniform(-1.0, 1.0, 2), -most, most))

        at = tube.lead + tube.end * random.uniform(0.1, 0.95)
        loaded.append(dataclasses.replace(tube, elements=int(np.ceil(tube.length / ELEMENT)), tip=load(0.3 * scale),
                                          line=tuple(np.array(load(0.5 * scale, 0.5 * most)) / tube.end),
                                          points=((at, load(0.3 * scale)),)))
    return loaded, (random.uniform(-3.0, 3.0), random.uniform(-1.0, 1.0))


def parameters(tubes, gravity):
    """The same as a parameter file; lengths in mm."""
    def own(tube):
        sections = [{"from": 1e3 * start, "to": 1e3 * end, "youngsModulus": young, "shearModulus": shear,
                     "restCurvature": [curvature, 0.0, 0.0]}
                    for (start, young, shear, curvature), end
                    in zip(tube.pieces, [*(piece[0] for piece in tube.pieces[1:]), tube.length])]
        return {"wireRadius": tube.radius, "wireSections": sections, "density": tube.density,
                "tipForce": [0.0, *tube.tip], "distributedForce": [0.0, *tube.line],
                "pointLoads": [{"at": 1e3 * at, "force": [0.0, *force]} for at, force in tube.points]}

    *catheters, wire = tubes
    return {"solver": "direct", "guidewireLength": 1e3 * wire.length, "numberRodElements": wire.elements,
            "guidewireOffset": -1e3 * wire.lead, "proximalEnd": "clamped", "drive": "hold", "displacement": 0.0,
            "initialState": "equilibrium", "maxSimulationSteps": 0, "deltaThreshold": 0.0, "logHub": True,
            "logFormat": "npz", "clampRule": "halfElement", "gravity": [0.0, *gravity], "shearFactor": 1.0, **own(wire),
            "catheters": [{"start": 1e3 * (wire.lead - tube.lead), "length": 1e3 * tube.length,
                           "elements": tube.elements, "lumenRadius": tube.lumen, "shearFactor": 1.0, **own(tube)}
                          for tube in catheters]}
