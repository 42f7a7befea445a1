"""Reads the files of runs, evaluates them and draws figures.

Nothing here starts a run: the package knows run folders (``runs``) and their logs (``logs``), measures relaxation
(``relaxation``), errors and steady state (``errors``) and distances between runs (``distances``), puts a study's runs
into one table (``tables``) and draws tables and runs (``figures``). Positions are in units, times in seconds unless a
name says otherwise.
"""
