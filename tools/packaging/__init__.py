"""Builds the Python wheel and the NuGet packages from the repository."""
