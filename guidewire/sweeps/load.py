"""Load of the machine by other programs during a timed run."""

from __future__ import annotations

import time

import psutil

DISTURBED = 0.25  # processors that others keep busy, from which a timed run is measured again
_TICK = 0.02  # s; clocks of processors count in steps of 0.01 s, so two readings differ by up to this for nothing


class LoadBeside:
    """Measures from its making to `others_busy` what processes but this one's kept busy.

    Parameters
    ----------
    process : id of the process that makes the run.
    """

    def __init__(self, process: int) -> None:
        self._process = psutil.Process(process)
        self._start = self._read()

    def others_busy(self) -> float:
        """Processors that other processes kept busy on average, from 0 to their number."""
        wall, busy, own = (now - before for now, before in zip(self._read(), self._start))
        return max(0.0, busy - own - _TICK) / max(wall, _TICK)

    def _read(self) -> tuple[float, float, float]:
        """Clock, busy time of all processors and time of the process, in s."""
        times = psutil.cpu_times()
        idle = times.idle + getattr(times, "iowait", 0.0)
        guest = getattr(times, "guest", 0.0) + getattr(times, "guest_nice", 0.0)  # counted as user time already
        used = self._process.cpu_times()
        return time.monotonic(), sum(times) - idle - guest, used.user + used.system
