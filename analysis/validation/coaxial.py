"""Checks of a wire in a catheter on one shared centreline: concentric tubes, and a wire that slides in a catheter.

A turn of the inner hub is written as a turn of the wire's rest curvature, so that a rest shape needs no motion.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes
from analysis.validation.concentric import coupling, hub_slope, snap_angle, threshold
from analysis.validation.states import last_state, solver_report, tip_motion, wall_time
from guidewire.figures.wording import number, percent, span
from guidewire.logs.hub import read_hub, snap_turns
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

SECTION = "A wire in a catheter"

_LENGTH = 0.1  # m, of the catheter: the unit of length here, and
_BENDING = 1e-3  # N m^2, its bending stiffness
_RADIUS, _LUMEN, _OUTER = 1e-4, 1.1e-4, 1.3e-4  # m
_REACHED = 0.02  # of an element beyond the outer tip, where a wire node comes in
_TINY = 5e-6  # of an element, either side of that
_STEP = 1.0  # s: nothing moves but by the hub

_Sections = Sequence[tuple[float, float]]  # (length, rest curvature) from the hub, over _LENGTH


@dataclass(frozen=True)
class Pair:
    """Two instruments, lengths over the catheter's, stiffnesses over its.

    Attributes
    ----------
    elements, wire_elements : of the catheter and of the wire.
    outer, inner : pieces from the hub.
    stiffness : B_2 of the wire; `rigid` that of the catheter.
    nu : EI/GJ - 1 of both.
    lead : of the wire's hub behind the catheter's.
    turn : of the wire's hub, rad.
    more, catheter : other keys of the scene and of the catheter.
    """

    elements: int
    wire_elements: int
    outer: _Sections
    inner: _Sections
    stiffness: float = 1.0
    nu: float = 0.3
    lead: float = 0.0
    turn: float = 0.0
    rigid: float = 1.0
    more: dict[str, Any] = field(default_factory=dict)
    catheter: dict[str, Any] = field(default_factory=dict)

    def case(self, key: str) -> Case:
        """Return its rest shape, or what `more` makes of it."""
        tube = 0.25 * math.pi * (_OUTER**4 - _LUMEN**4)
        solid = 0.25 * math.pi * _RADIUS**4
        return Case(key, {
            **scenes.at_rest({}), "guidewireLength": _units(sum(piece[0] for piece in self.inner)),
            "numberRodElements": self.wire_elements, "guidewireOffset": -_units(self.lead), "wireRadius": _RADIUS,
            **_material(self.stiffness * _BENDING / solid, self.nu), "drive": "displace", "insertionSpeed": 0.0,
            "logHub": True, "solverTolerance": 1e-12, "wireSections": _sections(self.inner, self.turn),
            "catheters": [{"start": _units(self.lead), "length": _units(sum(piece[0] for piece in self.outer)),
                           "elements": self.elements, "wireRadius": _OUTER, "lumenRadius": _LUMEN,
                           **_material(self.rigid * _BENDING / tube, self.nu),
                           "wireSections": _sections(self.outer, 0.0), **self.catheter}],
            **self.more})


def _units(length: float) -> float:
    return length * _LENGTH / scenes.UNIT


def _material(modulus: float, nu: float) -> dict[str, float]:
    return {"youngsModulus": modulus, "shearModulus": 0.5 * modulus / (1.0 + nu), "density": 6450.0}


def _sections(pieces: _Sections, turn: float) -> list[dict[str, Any]]:
    made, start = [], 0.0
    for length, curvature in pieces:
        k = curvature / _LENGTH
        made.append({"from": _units(start), "to": _units(start + length),
                     "restCurvature": [k * math.cos(turn), k * math.sin(turn), 0.0]})
        start += length
    return made


def even(n: int, ratio: float, nu: float, curvature: float, turn: float, lead: float = 0.0, **more: Any) -> Pair:
    """Return two tubes of one length and curvature, the inner one with a straight length before."""
    before = [(lead, 0.0)] if lead else []
    return Pair(n, n, [(1.0, curvature)], [*before, (1.0, curvature)], ratio, nu, lead, turn, more=more)


def _hub(run: Run, name: str) -> float:
    """Force (N) or torque (N m) of the wire's hub, over B/L^2 or B/L."""
    return float(run.summary["hub"][name]) / (_BENDING / _LENGTH**(2 if name == "force" else 1))


def tip_of(run: Run) -> np.ndarray:
    """Return the tip of the wire, over L."""
    return tip_motion(run)[1][-1] / _LENGTH


def _line(what: str, value: float, reference: float, error: float, gate: float | None, unit: str = "",
          error_in: str = "relative", cost: float | None = None) -> Result:
    return Result(what, "direct", value, reference, error, gate, unit, cost, error_in)


_RATIO, _NU = 0.6, 0.3
_TURNS = (0.3, 1.0, 2.0, 3.0)


def _torque() -> Plan:
    """Two turned tubes: the mean curvature where twist is stiff, and the torque at the hub."""
    stiff = {turn: even(10, 0.5, -0.9999, 1.2, turn).case(f"stiff,turn={turn:g}") for turn in (0.0, 0.8, 2.5)}
    soft = {(n, turn): even(n, _RATIO, _NU, 1.0, turn).case(f"n={n},turn={turn:g}")
            for n in (10, 20) for turn in _TURNS}
    runs = yield [*stiff.values(), *soft.values()]
    results = []
    for turn, case in stiff.items():
        mean = 1.2 * np.array([1.0 + 0.5 * math.cos(turn), 0.5 * math.sin(turn)]) / 1.5
        reference = float(np.linalg.norm(mean))
        directors = last_state(runs[case.key]).directors
        bends = [math.acos(min(1.0, float(a @ b))) * 10.0 for a, b in zip(directors[:-1], directors[1:])]
        worst = max(bends, key=lambda bend: abs(bend - reference))
        results.append(_line(f"two tubes, GJ/EI = 1e4, turned by {turn:g}: curvature of any joint; reference: mean by "
                             "stiffness", worst, reference, abs(worst - reference) / 1.2, 5e-4, "1/L",
                             "of one tube's", wall_time(runs[case.key])))
    exact = {turn: -hub_slope(coupling(_RATIO, _NU, 1.0), turn) / ((1.0 + _NU) * (1.0 + 1.0 / _RATIO))
             for turn in _TURNS}
    found = {key: _hub(runs[case.key], "torque") for key, case in soft.items()}
    for (n, turn), value in found.items():
        results.append(_line(f"two tubes turned by {turn:g} rad, n = {n}: torque of the hub; reference: theta'' = c "
                             "sin theta", value, exact[turn], abs(value / exact[turn] - 1.0), 1e-3 if n == 20 else 4e-3,
                             "B/L", cost=wall_time(runs[soft[n, turn].key])))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        angle = np.linspace(0.05, 3.1, 60)
        axes.plot(angle, [-hub_slope(coupling(_RATIO, _NU, 1.0), a) / ((1.0 + _NU) * (1.0 + 1.0 / _RATIO))
                          for a in angle], "k-", linewidth=1.0, label="theta'' = c sin theta")
        for marker, n in zip(pictures.MARKERS, (10, 20)):
            axes.plot(_TURNS, [found[n, turn] for turn in _TURNS], marker, fillstyle="none", label=f"n = {n}")
        axes.set(xlabel="turn of the inner hub (rad)", ylabel="torque of the inner hub (B/L)")
        axes.legend()

    return Finding(tuple(results), draw, (
        f"Two tubes of one curvature (k L = 1) and B_2/B_1 = {_RATIO:g}, the inner one turned at its hub: torque by "
        "the solver and by the differential equation of concentric tubes."))


_BELOW = (0.94, 0.96, 0.98)  # of the threshold


def _stability() -> Plan:
    """Find where the twist of pi ceases to be stable: the smallest eigenvalue goes to zero."""
    part = 1.0 / _RATIO / (1.0 + 1.0 / _RATIO)  # of the relative twist, the inner one's
    points = [*((0.0, n) for n in (5, 10, 20)), (0.5, 10), (2.0, 10)]
    cases = {}
    for lead, n in points:
        for level in _BELOW:
            root = level * threshold(lead * part)
            curvature = root / math.sqrt(coupling(_RATIO, _NU, 1.0))
            cases[lead, n, level] = even(n, _RATIO, _NU, curvature, math.pi, lead).case(
                f"lead={lead:g},n={n},level={level:g}")
    runs = yield list(cases.values())
    results, errors, lines = [], {}, {}
    for lead, n in points:
        squares = np.array(_BELOW) ** 2
        values = np.array([float(solver_report(runs[cases[lead, n, level].key], "smallestEigenvalue"))
                           for level in _BELOW])
        lines[lead, n] = values
        roots = np.roots(np.polyfit(squares, values, 2))
        real = [root.real for root in roots if abs(root.imag) < 1e-9 and root.real > squares[-1]]
        found = math.sqrt(min(real)) if real else math.nan
        errors[lead, n] = found - 1.0
        exact = threshold(lead * part)
        results.append(_line(
            f"two tubes at a twist of pi, straight length before {lead:g} L, n = {n}: sqrt(c) L at which they are no "
            "longer stable; reference: closed form", found * exact, exact, abs(found - 1.0),
            2.5e-3 if n >= 10 else None, cost=sum(wall_time(runs[cases[lead, n, level].key]) for level in _BELOW)))
    for coarse, fine in ((5, 10), (10, 20)):
        order = math.log2(errors[0.0, coarse] / errors[0.0, fine])
        results.append(_line(f"the same: order of that error between n = {coarse} and {fine}; reference 2", order, 2.0,
                             2.0 - order, 0.1, error_in="less than 2"))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for marker, (lead, n) in zip(pictures.MARKERS, points):
            axes.plot(_BELOW, lines[lead, n] / lines[lead, n][0], marker + "-", fillstyle="none",
                      label=f"lead {lead:g} L, n = {n}")
        axes.set(xlabel="sqrt(c) L over that of the closed form", ylabel="smallest eigenvalue, over the first")
        axes.legend(fontsize="x-small")

    return Finding(tuple(results), draw, (
        "Two tubes whose curvatures are opposite: their straight twist is a minimum up to sqrt(c) L = pi/2. The "
        "smallest eigenvalue of the second derivative of the energy is extrapolated to zero by a parabola in c."))


SNAPS = {"B_2/B_1 = 1, k L = 1.5": (1.0, 0.3, 1.5, 0.0), "B_2/B_1 = 1, k L = 2": (1.0, 0.3, 2.0, 0.0),
          "B_2/B_1 = 1/2, k L = 1.2, L_t = L": (0.5, 0.35, 1.2, 1.0)}
BEGIN = 175.0  # degrees, of the hub at the start
_FINE = {10: 0.1, 20: 0.02}  # degrees a step
_TURN_STEP = 2.5  # degrees


def turning(pair: Pair, degrees: float, steps: int, key: str, step: float = _STEP) -> Case:
    """Turn from its rest shape a hub that turns by so many degrees a step, which takes `step` s."""
    return Case(key, {**pair.case(key).overrides, "integrator": "implicitEuler", "timeStep": step,
                      "maxSimulationSteps": steps, "deltaThreshold": 0.0, "massDamping": 100.0, "logSpheres": "last",
                      "rotationSpeed": math.radians(degrees) / step})


def _jumps(run: Run, start: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Hub angles, torques, and the angles at the end of the steps in which it snapped, degrees."""
    log = read_hub(run.folder)
    angle = start + np.degrees(log.turn)
    torque = log.torque / (_BENDING / _LENGTH)
    return angle, torque, np.degrees(snap_turns(np.radians(angle), torque)[1])


def _snap() -> Plan:
    """Two tubes turned until they snap."""
    cases, turned = {}, {}
    for name, (ratio, nu, curvature, straight) in SNAPS.items():
        # The inner one alone is straight before: its part of the twist is (1/C_2)/(1/C_1 + 1/C_2).
        lead = straight * (1.0 + ratio)
        turned[name] = math.degrees(snap_angle(coupling(ratio, nu, curvature), straight))
        for n, fine in _FINE.items():
            pair = even(n, ratio, nu, curvature, math.radians(BEGIN), lead)
            steps = math.ceil((1.01 * turned[name] - BEGIN) / fine)
            cases[name, n] = turning(pair, fine, steps, f"{list(SNAPS).index(name)},n={n}")
    three = turning(even(10, 1.0, 0.3, 2.0, 0.0), _TURN_STEP, round(1080.0 / _TURN_STEP), "three-turns")
    runs = yield [*cases.values(), three]
    results = []
    for (name, n), case in cases.items():
        found = _jumps(runs[case.key], BEGIN)[2]
        angle = float(found[0]) - 0.5 * _FINE[n] if len(found) == 1 else math.nan
        results.append(_line(f"two tubes, {name}, n = {n}: hub angle of the snap; reference: theta'' = c sin theta",
                             angle, turned[name], abs(angle / turned[name] - 1.0), 2e-3 if n == 10 else 5e-4, "degrees",
                             cost=wall_time(runs[case.key])))
    angle, torque, found = _jumps(runs[three.key], 0.0)
    first = turned["B_2/B_1 = 1, k L = 2"]
    for k in range(3):
        at = float(found[k]) if len(found) == 3 else math.nan
        exact = first + 360.0 * k
        results.append(_line(f"the second, n = 10, turned three times by {_TURN_STEP:g} degrees a step: hub angle at "
                             f"the end of the step of snap {k + 1}", at, exact, max(exact - at, at - exact - _TURN_STEP,
                                                                                    0.0 if math.isfinite(at) else
                                                                                    math.nan), 0.5, "degrees",
                             "degrees outside of that step"))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot(angle, torque, linewidth=1.0, label="k L = 2, n = 10")
        for k in range(3):
            axes.axvline(first + 360.0 * k, color="0.6", linestyle="--", linewidth=0.8,
                         label="theta'' = c sin theta" if k == 0 else None)
        axes.set(xlabel="turn of the inner hub (degrees)", ylabel="torque of the inner hub (B/L)")
        axes.legend()

    return Finding(tuple(results), draw, (
        "The inner of two tubes is turned at its hub, slowly against all its motions. The torque grows until the tube "
        f"snaps: at {number(first, 6)} degrees, and again after every turn."))


_RATIOS = (0.2, 1.0, 5.0)
_INSIDE = tuple(0.2 + 0.0271 * k for k in range(0, 23, 3))  # how far the wire's hub is behind


def _expulsion() -> Plan:
    """A straight wire in a bent catheter, its tip inside."""
    cases = {(ratio, lead): Pair(10, 11, [(1.0, 1.3)], [(1.1, 0.0)], ratio, lead=lead).case(
        f"ratio={ratio:g},lead={lead:.4f}") for ratio in _RATIOS for lead in _INSIDE}
    runs = yield list(cases.values())
    results, forces = [], {}
    for ratio in _RATIOS:
        exact = 0.5 * 1.3**2 * ratio / (1.0 + ratio)
        forces[ratio] = np.array([_hub(runs[cases[ratio, lead].key], "force") for lead in _INSIDE]) / exact
        worst = float(forces[ratio][np.argmax(np.abs(forces[ratio] - 1.0))])
        ripple = float(np.ptp(forces[ratio]))
        what = f"a straight wire in a bent catheter, B_w/B_c = {ratio:g}, tip at {len(_INSIDE)} positions"
        results += [_line(f"{what}: force that drives it out; reference: kappa^2 B_c B_w/(2 (B_c + B_w))",
                          worst * exact, exact, abs(worst - 1.0), 1e-4, "B/L^2"),
                    _line(f"{what}: ripple of that force", ripple * exact, 0.0, ripple, 1e-3, "B/L^2", "of the force")]

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for marker, ratio in zip(pictures.MARKERS, _RATIOS):
            axes.plot([1.1 - lead for lead in _INSIDE], 1e6 * (forces[ratio] - 1.0), marker + "-", fillstyle="none",
                      label=f"B_w/B_c = {ratio:g}")
        axes.set(xlabel="position of the wire's tip along the catheter (L)", 
                 ylabel="force over its closed form - 1 (1e-6)")
        axes.legend()

    return Finding(tuple(results), draw, (
        "A straight wire in a catheter of curvature kappa L = 1.3 is driven out by the energy per length that the two "
        f"hold against one another; over {len(_INSIDE)} positions of its tip, most of them within an element, the "
        f"force is off by at most {percent(max(float(np.max(np.abs(f - 1.0))) for f in forces.values()))}."))


_EXTENSIONS = tuple(-0.3 + 0.1 * k for k in range(7))
_TIP_GATE, _FORCE_GATE = {10: 4e-3, 20: 1e-3}, {10: 6e-3, 20: 1.5e-3}
_TURNED = 1.2  # rad


def _hooked(n: int, extension: float, key: str) -> Case:
    """Return a wire with a hook through a catheter with a bent tip, a load on the outermost tip."""
    load = {"tipForce": (np.array([0.1, 0.2, -0.1]) * _BENDING / _LENGTH**2).tolist()}
    is_wire = extension > 1e-9
    return Pair(n, 3 * n // 2, [(0.6, 0.0), (0.4, 1.5)], [(1.27, 0.0), (0.23, 3.0)], 0.5, 0.3, 0.5 - extension,
                _TURNED, more=load if is_wire else {}, catheter={} if is_wire else load).case(key)


def _sliding() -> Plan:
    """Against a finer one, and a wire node that comes in."""
    finest = 80
    cases = {(n, p): _hooked(n, p, f"n={n},p={p:.2f}") for n in (*_TIP_GATE, finest) for p in _EXTENSIONS}
    entries = {(n, k, side): _hooked(n, (k + _REACHED + side * _TINY) / n, f"enters,n={n},k={k},{side:+d}")
               for n in _TIP_GATE for k in range(1, n // 2) for side in (-1, 1)}
    runs = yield [*cases.values(), *entries.values()]
    force = {key: _hub(runs[case.key], "force") for key, case in cases.items()}
    reach = np.ptp([force[finest, p] for p in _EXTENSIONS])
    results = []
    for n in _TIP_GATE:
        tips = [float(np.linalg.norm(tip_of(runs[cases[n, p].key]) - tip_of(runs[cases[finest, p].key])))
                for p in _EXTENSIONS]
        apart = max(abs(force[n, p] - force[finest, p]) for p in _EXTENSIONS)
        what = f"a wire with a hook through a bent catheter, n = {n}; reference: n = {finest}"
        results += [_line(f"{what}: tip", max(tips), 0.0, max(tips), _TIP_GATE[n], "L", "of L"),
                    _line(f"{what}: force of the hub", float(apart), 0.0, float(apart / reach), _FORCE_GATE[n], "B/L^2",
                          "of its range")]
        made = {key: _hub(runs[case.key], "force") for key, case in entries.items() if key[0] == n}
        jump = max(abs(made[n, k, 1] - made[n, k, -1]) for k in range(1, n // 2))
        largest = max(abs(value) for value in made.values())
        results.append(_line(f"the same, n = {n}: jump of the hub's force where a wire node comes in", jump, 0.0,
                             jump / largest, 5e-3, "B/L^2", "of the largest force"))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot(_EXTENSIONS, [force[finest, p] for p in _EXTENSIONS], "k-", linewidth=1.0, label=f"n = {finest}")
        for marker, n in zip(pictures.MARKERS, _TIP_GATE):
            axes.plot(_EXTENSIONS, [force[n, p] for p in _EXTENSIONS], marker, fillstyle="none", label=f"n = {n}")
        axes.set(xlabel="how far the wire's tip is beyond the catheter's (L)", ylabel="force of the wire's hub (B/L^2)")
        axes.legend()

    return Finding(tuple(results), draw, (
        "A wire with a hook is pushed through a catheter with a bent tip, its hub turned by "
        f"{_TURNED:g} rad, a load at the outermost tip: force of its hub over {span(_EXTENSIONS, 2)} L of extension."))


_LOAD = 0.6  # B/L^2, across


def _limits() -> Plan:
    """A catheter of no stiffness, and one that is a guide."""
    across = {"tipForce": [_LOAD * _BENDING / _LENGTH**2, 0.0, 0.0]}
    guides = {n: Pair(n, 2 * n, [(1.0, 0.0)], [(2.0, 0.0)], 1.0, 0.3, 0.5, rigid=1e7, more=across).case(f"guide,n={n}")
              for n in (10, 20, 40)}
    own = {"straight": 0.0, "bent": 0.8}
    # The wire alone by the clamp that coaxial instruments have.
    alike = {"tipForce": [0.0, -0.2 * _BENDING / _LENGTH**2, 0.05 * _BENDING / _LENGTH**2], "clampRule": "halfElement"}
    soft = {name: Pair(6, 10, [(0.6, 0.0 if name == "straight" else 2.0)], [(1.0, k)], 1.0, 0.3, rigid=1e-9,
                       more=alike).case(f"none,{name}") for name, k in own.items()}
    alone = {name: Case(f"alone,{name}", {key: value for key, value in case.overrides.items() if key != "catheters"})
             for name, case in soft.items()}
    runs = yield [*guides.values(), *soft.values(), *alone.values()]
    results, errors = [], {}
    for n, case in guides.items():
        state = last_state(runs[case.key])
        exit_node = np.array([0.0, 0.0, 1.0])
        arm = state.positions[-1] / _LENGTH - exit_node
        moment = float(np.linalg.norm(np.cross(arm, [_LOAD, 0.0, 0.0])))
        exact, found = 0.5 * moment**2, _hub(runs[case.key], "force")
        errors[n] = abs(abs(found) / exact - 1.0)
        results.append(_line(f"a straight catheter 1e7 times stiffer, elements of L/{n}: force that drives the wire "
                             "back; reference: M^2/2B at the exit", abs(found), exact, errors[n],
                             1e-2 if n >= 20 else None, "B/L^2"))
    order = math.log2(errors[10] / errors[20])
    results.append(_line("the same: order of that error between L/10 and L/20; reference 2", order, 2.0, 2.0 - order,
                         0.1, error_in="less than 2"))
    for name in own:
        apart = float(np.max(np.linalg.norm(last_state(runs[soft[name].key]).positions
                                            - last_state(runs[alone[name].key]).positions, axis=1))) / _LENGTH
        results.append(_line(f"a {name} wire in a catheter of 1e-9 of its stiffness; reference: the wire alone on the "
                             "same stations: any node", apart, 0.0, apart, 1e-6, "L", "of L"))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.loglog([1.0 / n for n in errors], list(errors.values()), "o-", fillstyle="none", label="error of M^2/2B")
        axes.loglog([1.0 / n for n in errors], [errors[10] * (10.0 / n) ** 2 for n in errors], "k:", label="order 2")
        axes.set(xlabel="element (L)", ylabel="error of the hub's force, relative")
        axes.legend()

    return Finding(tuple(results), draw, (
        "The two limits of the catheter's stiffness: a straight one that does not bend is a guide, out of which a "
        "loaded wire is driven back by M^2/2B; one that resists nothing leaves the wire as it is alone."))


CHECKS = tuple(Check(name, SECTION, title, plan) for name, title, plan in (
    ("coaxial-torque", "two turned tubes: curvature and torque", _torque),
    ("coaxial-stability", "two turned tubes: end of stability", _stability),
    ("coaxial-snap", "two turned tubes: snaps", _snap),
    ("coaxial-expulsion", "a straight wire is driven out of a bent catheter", _expulsion),
    ("coaxial-sliding", "a wire with a hook slides through a bent catheter", _sliding),
    ("coaxial-limits", "limits of the catheter's stiffness", _limits),
))
