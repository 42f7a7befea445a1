"""Vessels from meshes, segmentations and centrelines: inspection, repair, centrelines, and anatomies made by code."""
