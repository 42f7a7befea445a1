"""Spaces and a base class with the attributes of gymnasium's, for where gymnasium is not installed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from enum import Enum
from typing import Any

import numpy as np


class Space:
    """A set of values. shape, dtype : of a value; None where it has none."""

    def __init__(self, shape: tuple[int, ...] | None, dtype: Any, seed: int | None = None) -> None:
        self.shape = shape
        self.dtype = None if dtype is None else np.dtype(dtype)
        self._np_random = np.random.default_rng(seed)

    @property
    def np_random(self) -> np.random.Generator:
        """What samples are drawn with."""
        return self._np_random

    def seed(self, seed: int | None = None) -> int | None:
        """Start the samples anew."""
        self._np_random = np.random.default_rng(seed)
        return seed

    def __contains__(self, value: Any) -> bool:
        return self.contains(value)

    def _known(self) -> dict[str, Any]:
        return {name: one for name, one in vars(self).items() if name != "_np_random"}

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and all(map(np.array_equal, self._known().values(), other._known().values()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._known()})"


class Box(Space):
    """Arrays between two bounds, both included."""

    def __init__(self, low: Any, high: Any, shape: tuple[int, ...] | None = None, dtype: Any = np.float32,
                 seed: int | None = None) -> None:
        shape = tuple(shape) if shape is not None else np.broadcast(low, high).shape
        super().__init__(shape, dtype, seed)
        self.low = np.broadcast_to(np.asarray(low, self.dtype), shape).copy()
        self.high = np.broadcast_to(np.asarray(high, self.dtype), shape).copy()

    def sample(self) -> np.ndarray:
        """Even between finite bounds, normal around 0 where both are infinite."""
        finite = np.isfinite(self.low) & np.isfinite(self.high)
        even = self._np_random.uniform(np.where(finite, self.low, 0.0), np.where(finite, self.high, 1.0))
        normal = np.clip(self._np_random.normal(size=self.shape), self.low, self.high)
        return np.where(finite, even, normal).astype(self.dtype)

    def contains(self, value: Any) -> bool:
        """Return whether it is an array of this shape between the bounds."""
        return (isinstance(value, np.ndarray) and np.can_cast(value.dtype, self.dtype) and value.shape == self.shape
                and bool(np.all(value >= self.low) and np.all(value <= self.high)))


class Discrete(Space):
    """Whole numbers from start, n of them."""

    def __init__(self, n: int, seed: int | None = None, start: int = 0) -> None:
        super().__init__((), np.int64, seed)
        self.n, self.start = np.int64(n), np.int64(start)

    def sample(self) -> np.int64:
        """Draw one, each as likely."""
        return self.start + self._np_random.integers(self.n)

    def contains(self, value: Any) -> bool:
        """Return whether it is one of them."""
        whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool) or (
            isinstance(value, np.ndarray) and value.shape == () and np.issubdtype(value.dtype, np.integer))
        return whole and bool(self.start <= value < self.start + self.n)


class MultiDiscrete(Space):
    """Arrays of whole numbers from 0, each below its own of nvec."""

    def __init__(self, nvec: Any, seed: int | None = None) -> None:
        self.nvec = np.asarray(nvec, np.int64)
        super().__init__(self.nvec.shape, np.int64, seed)

    def sample(self) -> np.ndarray:
        """Draw one, each as likely."""
        return self._np_random.integers(self.nvec)

    def contains(self, value: Any) -> bool:
        """Say whether all are."""
        return (isinstance(value, np.ndarray) and np.issubdtype(value.dtype, np.integer) and value.shape == self.shape
                and bool(np.all((value >= 0) & (value < self.nvec))))


class Dict(Space, Mapping):
    """A value of a space for each name."""

    def __init__(self, spaces: Mapping[str, Space]) -> None:
        super().__init__(None, None)
        self.spaces = dict(spaces)

    def seed(self, seed: int | None = None) -> dict[str, int | None]:
        """Start the samples anew, each with a seed of its own."""
        seeds = np.random.default_rng(seed).integers(2**31, size=len(self.spaces))
        return {name: space.seed(None if seed is None else int(own))
                for (name, space), own in zip(self.spaces.items(), seeds)}

    def sample(self) -> dict[str, Any]:
        """Draw one of each."""
        return {name: space.sample() for name, space in self.spaces.items()}

    def contains(self, value: Any) -> bool:
        """Say whether all are."""
        return (isinstance(value, dict) and value.keys() == self.spaces.keys()
                and all(self.spaces[name].contains(part) for name, part in value.items()))

    def __getitem__(self, name: str) -> Space:
        return self.spaces[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.spaces)

    def __len__(self) -> int:
        return len(self.spaces)


class Env:
    """What gymnasium's base class has: random numbers, names, `with`."""

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode: str | None = None
    spec = None
    _np_random: np.random.Generator | None = None
    _np_random_seed: int | None = None

    @property
    def np_random(self) -> np.random.Generator:
        """What an episode is drawn with; from the operating system where no seed was given."""
        if self._np_random is None:
            self._np_random = np.random.default_rng()
        return self._np_random

    @np_random.setter
    def np_random(self, value: np.random.Generator) -> None:
        self._np_random, self._np_random_seed = value, -1

    @property
    def unwrapped(self) -> Env:
        """Itself: it wraps nothing."""
        return self

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> Any:
        """Seed, where a seed is given."""
        if seed is not None:
            if isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or seed < 0:
                raise Error(f"seed = {seed!r} is not allowed: needs a whole number from 0")
            self._np_random, self._np_random_seed = np.random.default_rng(seed), int(seed)

    def close(self) -> None:
        """Nothing to be closed here."""

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: Any) -> bool:
        self.close()
        return False


class VectorEnv(Env):
    """What gymnasium's base class of several environments has."""


class AutoresetMode(Enum):
    """As gymnasium.vector.AutoresetMode: when an episode follows the one that has ended."""

    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


class Error(Exception):
    """As gymnasium.error.Error."""


class InvalidAction(Error):
    """As gymnasium.error.InvalidAction: an action that is not in the space."""


class ResetNeeded(Error):
    """As gymnasium.error.ResetNeeded: a step before the first reset or after the end of an episode."""


class ClosedEnvironmentError(Exception):
    """As gymnasium.error.ClosedEnvironmentError."""


class NameNotFound(Error):
    """As gymnasium.error.NameNotFound: there is no task of that name."""


def batch_space(space: Space, n: int) -> Space:
    """Return the space of n values at once, as gymnasium.vector.utils.batch_space."""
    if isinstance(space, Dict):
        return Dict({name: batch_space(part, n) for name, part in space.items()})
    if isinstance(space, Discrete):
        return MultiDiscrete(np.full(n, space.n))
    repeats = (n,) + (1,) * len(space.shape)
    return Box(np.tile(space.low, repeats), np.tile(space.high, repeats), dtype=space.dtype)
