"""Finds a wire's properties from measurements: bending stiffness from a shape, friction from a force at the hub.

`measured` says how far a run is from a measurement, `unknowns` what is sought, `trials` makes the runs, `fit` finds the
values with their standard errors, `identified` keeps them, `critical` the load at which a wire snaps.
"""

from guidewire.identification.fit import identify
from guidewire.identification.identified import Identified

__all__ = ["Identified", "identify"]
