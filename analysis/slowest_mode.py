"""The slowest mode of the longitudinal run in closed form, which explains how tau depends on m, n, M and dt.

With gains, a step is linear in the distances u from the new rest as long as the wire stays straight. One link of rest
length l and gain g, between two spheres of inverse mass w, moves each of them by gamma = g w/(2 w + 4 wq l^2) times its
stretch, with wq = 1: the fraction 4 wq l^2 of the correction goes to the orientation, points along the quaternion there
and is lost when that is normalised. Long elements and heavy spheres (small w) therefore lose most of the gain.

In sweep order each link sees its left sphere already moved by the link before it, which raises a slow mode's stretch
to stretch/(1 - gamma). Then a sweep is a step of diffusion, u_i += gamma/(1 - gamma) (u_{i-1} - 2 u_i + u_{i+1}). The
first link moves one sphere only, by g w/(w + 4 wq l^2), and counts as gamma over that of a link's length; the free end
lies half a link beyond the last sphere. So with N links in effect the slowest mode, a quarter of a wave, shrinks in
the m sweeps of a step by

    a = exp(-m gamma/(1 - gamma) (pi/(2 N))^2).

With the prediction 2 u_k - u_{k-1}, a step is u_{k+1} = a (2 u_k - u_{k-1}). From rest it gives
u_k = u_0 r^k cos(k theta) with r = sqrt(a) and cos(theta) = sqrt(a): the decay is what the sweeps leave undone, not a
damping of the model, and dt does not appear. A start with all spheres at distance D from their new rest has 4 D/pi of
this mode at the last sphere, and its prediction error there is (1 - a)/a of the next distance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from guidewire.logs.runs import Run


@dataclass(frozen=True)
class SlowestMode:
    """Closed form for a run along the wire without damping or forces.

    Attributes
    ----------
    relaxation_time, period : tau and T, in s.
    steady_state_time : when the envelope of the prediction error falls below the threshold, in s; 0 where it never was
        above, infinite without a threshold.
    effective_gain : 2 gamma, the fraction of a link's stretch that an iteration takes out, dimensionless.
    """

    relaxation_time: float
    period: float
    steady_state_time: float
    effective_gain: float

    @classmethod
    def of(cls, run: Run) -> SlowestMode:
        """Make it of a run's parameters."""
        count = int(run.number("numberRodElements"))
        length = run.number("guidewireLength") / count
        weight = (count + 1) / run.number("totalMass")
        turning = 4.0 * length * length
        gamma = run.number("stretchStiffness") * weight / (2.0 * weight + turning)
        links = count + 0.5 - weight / (2.0 * weight + turning)
        exponent = run.number("constraintSolverSteps") * gamma / (1.0 - gamma) * (0.5 * math.pi / links) ** 2
        time_step = run.number("timeStep")
        tau = 2.0 * time_step / exponent
        threshold = run.number("deltaThreshold")
        first = 4.0 / math.pi * abs(run.number("displacement")) * math.expm1(exponent)  # (1 - a)/a = exp(exponent) - 1
        return cls(
            relaxation_time=tau,
            period=2.0 * math.pi * time_step / math.acos(math.exp(-0.5 * exponent)),
            steady_state_time=math.inf if threshold <= 0.0 else max(0.0, tau * math.log(first / threshold)),
            effective_gain=2.0 * gamma,
        )
