"""Real wires beside the computed ones: three hanging wires of an open data set (docs/measured.md)."""
