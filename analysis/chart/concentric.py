"""Closed forms of two concentric tubes.

Two pieces of bending stiffness B_1, B_2 and torsional stiffness C_1, C_2 with rest curvatures k_1 and R(theta) k_2
have the energy per length 1/2 B_r |k_1 - R k_2|^2 + 1/2 C_r theta'^2, B_r = B_1 B_2/(B_1 + B_2) and
C_r = C_1 C_2/(C_1 + C_2): a pendulum theta'' = c sin(theta) with c = k_1 k_2 B_r/C_r, theta given at the hub and
theta' = 0 at the tip (Rucker, Jones and Webster 2010; Dupont et al. 2010). A length before it in which nothing is bent
is a spring in series.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


def coupling(ratio: float, nu: float, curvature: float) -> float:
    """c over 1/L^2 for B_2/B_1 = `ratio`, both with this curvature (over 1/L)."""
    return curvature**2 * ratio / (1.0 + ratio) * (1.0 + nu) * (1.0 + 1.0 / ratio)


def hub_slope(c: float, turn: float) -> float:
    """theta'(0) of theta'' = c sin(theta), theta(0) = `turn`, theta'(1) = 0, on the branch from 0."""

    def hub(tip: float) -> tuple[float, float]:
        solution = solve_ivp(lambda _, y: [y[1], c * math.sin(y[0])], (1.0, 0.0), [tip, 0.0], rtol=1e-11, atol=1e-12)
        return float(solution.y[0, -1]), float(solution.y[1, -1])

    tip = brentq(lambda angle: hub(angle)[0] - turn, 0.0, min(turn, math.pi - 1e-12), xtol=1e-13)
    return hub(tip)[1]


def snap_angle(c: float, lead: float = 0.0) -> float:
    """Largest hub angle of that branch, rad: over all tips, that of the pendulum and what `lead` (over L) twists."""

    def hub(tip: float) -> float:
        solution = solve_ivp(lambda _, y: [y[1], c * math.sin(y[0])], (1.0, 0.0), [tip, 0.0], rtol=1e-10, atol=1e-12)
        return float(solution.y[0, -1] - lead * solution.y[1, -1])

    tips = np.linspace(1e-3, math.pi - 1e-3, 200)
    return max(hub(tip) for tip in tips)


def turned_tip(ratio: float, nu: float, curvature: float, turn: float) -> np.ndarray:
    """Tip (over L) of two tubes of one curvature, the inner one turned at its hub, on the branch from 0.

    In the outer tube's frame, R' = R [u]x and x' = R e3, the bending is the mean by stiffness of k_1 and R(theta) k_2,
    and without a couple about the axis C_1 u_z + C_2 (u_z + theta') = 0."""
    c = coupling(ratio, nu, curvature)
    inner = ratio / (1.0 + ratio)

    def rate(_: float, y: np.ndarray) -> np.ndarray:
        theta, slope = y[:2]
        directors = y[2:11].reshape(3, 3)
        u1, u2 = curvature * (1.0 - inner + inner * math.cos(theta)), curvature * inner * math.sin(theta)
        u3 = -inner * slope
        turned = directors @ np.array([[0.0, -u3, u2], [u3, 0.0, -u1], [-u2, u1, 0.0]])
        return np.concatenate(([slope, c * math.sin(theta)], turned.ravel(), directors[:, 2]))

    start = np.concatenate(([turn, hub_slope(c, turn)], np.eye(3).ravel(), np.zeros(3)))
    return solve_ivp(rate, (0.0, 1.0), start, rtol=1e-10, atol=1e-12).y[-3:, -1]
