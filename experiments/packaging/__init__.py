"""What others take along: the Python wheel and the NuGet packages, built from what stands in the repository."""
