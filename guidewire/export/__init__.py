"""Runs for other programs: ParaView, 3D Slicer, tables, Omniverse and Blender."""
