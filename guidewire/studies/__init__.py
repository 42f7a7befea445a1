"""Studies: tables of parameters over any number of axes, and the names of its runs and their folders.

``table`` says what one run and a table of runs are, ``sampling`` and ``bisection`` which other tables there are,
``keys`` how runs are named, ``study_file`` reads a study that a user wrote, ``builtin`` holds those that the command
line knows. Whoever makes runs (``guidewire.sweeps.sweep``) and whoever reads them (``analysis``) start from here;
nothing here starts a run or reads one, and nothing but the standard library is needed, except to draw a sample.
"""
