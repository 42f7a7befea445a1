"""Axes of the patient. All vessels are kept in left, posterior, superior (LPS) where their file, or the user, says how
its own axes lie in the patient; with a file that does not say it, its axes are kept, and are unknown."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from guidewire.anatomy.mesh import AnatomyError, Mesh

_TOWARDS = {"L": (1.0, 0.0, 0.0), "R": (-1.0, 0.0, 0.0), "P": (0.0, 1.0, 0.0), "A": (0.0, -1.0, 0.0),
            "S": (0.0, 0.0, 1.0), "I": (0.0, 0.0, -1.0)}
LETTERS = "three letters that say where x, y and z point: one of L and R, one of A and P, one of S and I, such as RAS"


@dataclass(frozen=True)
class Axes:
    """letters : where +x, +y and +z of a file point in the patient, such as "RAS"; empty where nothing says it."""

    letters: str = ""

    @property
    def is_known(self) -> bool:
        """Whether the file's axes are known."""
        return bool(self.letters)

    @property
    def to_lps(self) -> np.ndarray:
        """(3, 3): from the file's axes to LPS, of signs and exchanges; the identity where they are unknown. Its
        transpose is the way back."""
        return np.array([_TOWARDS[letter] for letter in self.letters]).T if self.letters else np.eye(3)

    @property
    def is_mirrored(self) -> bool:
        """Whether the file's axes are left-handed."""
        return np.linalg.det(self.to_lps) < 0.0

    def of_vessel(self) -> str:
        """Axes of the vessel that is made of the file, for anatomy.json and scenes; empty where they are unknown."""
        return "LPS" if self.letters else ""

    def take(self, mesh: Mesh) -> Mesh:
        """Return a mesh of the file in LPS, its triangles oriented as they were."""
        return Mesh(mesh.vertices @ self.to_lps.T, mesh.triangles[:, ::-1] if self.is_mirrored else mesh.triangles)

    def describe(self) -> str:
        """Return one line of a report."""
        if not self.letters:
            return ("axes of the patient: unknown, those of the file are kept; --axes says how they lie, and a "
                    "C-arm has LAO and RAO then")
        return "axes of the patient: LPS" + (", as in the file" if self.letters == "LPS" else
                                             f"; those of the file are {self.letters}")


def axes_named(text: str) -> Axes:
    """Axes from letters, "LPS", or words, "left-posterior-superior".

    Raises
    ------
    AnatomyError : the text names none.
    """
    words = text.strip().split("-")
    letters = "".join(word[:1] for word in words).upper() if len(words) == 3 else text.strip().upper()
    if len(letters) != 3 or any(len(set(pair) & set(letters)) != 1 for pair in ("LR", "AP", "SI")):
        raise AnatomyError(f"axes '{text}': {LETTERS}")
    return Axes(letters)
