"""Vessels from meshes, segmentations and centrelines: inspection, repair, centrelines, and generated anatomies."""
