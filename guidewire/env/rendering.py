"""What an environment shows: an X-ray picture and, beside it, vessel and instruments in three dimensions."""

from __future__ import annotations

from typing import Any

import numpy as np

from guidewire.env.route import Route
from guidewire.sessions.session import Session, State

SIDE = 360  # pixels of each of the two pictures
_COLOURS = ((255, 214, 64), (96, 200, 255), (150, 255, 140))  # the wire, and each catheter
_VESSEL, _TARGET, _BACKGROUND = (120, 70, 74), (255, 80, 80), 18
_TILT = np.radians(25.0)  # of the view from above
_POINTS, _MOVING = 60_000, 4_000  # of a wall, at most; of one that moves and is painted anew


class Scenery:
    """A scene's picture, whose still parts are painted once.

    Parameters
    ----------
    session : whose walls.
    route : to the target, in a vessel that is where it says.
    """

    def __init__(self, session: Session, route: Route) -> None:
        corners = [wall.vertices for wall in session.walls()]
        points = np.concatenate(corners) if corners else session.state.positions
        low, high = points.min(axis=0), points.max(axis=0)
        self._middle, self._scale = 0.5 * (low + high), 0.92 * SIDE / max(float(np.linalg.norm(high - low)), 1e-9)
        cosine, sine = np.cos(_TILT), np.sin(_TILT)
        # To the right, upwards and towards the eye; wires enter along +z.
        self._axes = np.array([[0.0, 1.0, 0.0], [-sine, 0.0, cosine], [cosine, 0.0, sine]])
        self._route, most = route, _MOVING if route.is_moving else _POINTS
        self._wall = points[::max(1, len(points) // most)]
        self._still = None if route.is_moving else self._painted()

    def picture(self, state: State) -> np.ndarray:
        """(SIDE, 2 SIDE, 3) of uint8: the X-ray picture with the vessel as a road map, and the view beside it."""
        beside = self._painted() if self._still is None else self._still.copy()
        catheters = [one.positions for one in state.catheters]
        for k, positions in [*enumerate(catheters, 1), (0, state.positions)]:
            along = np.linspace(0.0, len(positions) - 1.0, 8 * len(positions))
            fine = np.column_stack([np.interp(along, np.arange(len(positions)), one) for one in positions.T])
            self._paint(beside, (fine - self._middle) @ self._axes.T,
                        np.broadcast_to(_COLOURS[k % len(_COLOURS)], fine.shape), 1 if k == 0 else 2)
        grey = state.picture(pixels=SIDE, vessel="roadmap")
        return np.concatenate([np.repeat(grey[:, :, None], 3, axis=2), beside], axis=1)

    def _painted(self) -> np.ndarray:
        """The wall and the target where they are now."""
        picture = np.full((SIDE, SIDE, 3), _BACKGROUND, dtype=np.uint8)
        seen = (self._route.moved(self._wall) - self._middle) @ self._axes.T
        far = np.argsort(seen[:, 2])    # what is nearer is painted over it
        depth = seen[far, 2]
        light = 0.35 + 0.65 * (depth - depth.min()) / max(float(np.ptp(depth)), 1e-9)
        self._paint(picture, seen[far], np.asarray(_VESSEL) * light[:, None], int(self._route.is_moving))
        target = self._route.target_position[None]
        self._paint(picture, (target - self._middle) @ self._axes.T, np.asarray(_TARGET)[None], 3)
        return picture

    def _paint(self, picture: np.ndarray, seen: np.ndarray, colours: np.ndarray, around: int) -> None:
        columns = np.rint(0.5 * SIDE + self._scale * seen[:, 0]).astype(int)
        rows = np.rint(0.5 * SIDE - self._scale * seen[:, 1]).astype(int)
        for dx in range(-around, around + 1):
            for dy in range(-around, around + 1):
                x, y = columns + dx, rows + dy
                inside = (x >= 0) & (x < SIDE) & (y >= 0) & (y < SIDE)
                picture[y[inside], x[inside]] = colours[inside].astype(np.uint8)


class Window:
    """A window on the screen that shows pictures one after another, with Matplotlib."""

    def __init__(self, title: str) -> None:
        from matplotlib import pyplot

        self._pyplot = pyplot
        self._figure, axes = pyplot.subplots(num=title, figsize=(8.0, 4.0), layout="constrained")
        axes.set_axis_off()
        self._shown: Any = axes.imshow(np.zeros((SIDE, 2 * SIDE, 3), dtype=np.uint8))
        pyplot.show(block=False)

    def show(self, picture: np.ndarray) -> None:
        """Show one."""
        self._shown.set_data(picture)
        self._figure.canvas.draw_idle()
        self._figure.canvas.flush_events()

    def close(self) -> None:
        """Take it off the screen."""
        self._pyplot.close(self._figure)
