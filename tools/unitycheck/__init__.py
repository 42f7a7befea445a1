"""Finds, without Unity, what Unity would refuse or silently ignore.

Each module holds the rules of one noun (metas, scenes, asmdefs, ...) and yields a Violation for each breach. Standard
library only, so that it runs on a machine that has nothing but Python.
"""
