#!/usr/bin/env python3
"""Command line of the project: `python3 guidewire.py --help` lists the commands.

Needs nothing but Python's standard library (3.6 can read this file). It looks for a Python that can do what is asked,
makes one if there is none, and hands over to the package `guidewire` beside it there.
"""

import sys

from guidewire.__main__ import main

if __name__ == "__main__":
    sys.exit(main())
