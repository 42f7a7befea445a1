#!/usr/bin/env python3
"""The one door to the project: `python3 guidewire.py --help` lists what it can do.

Needs nothing but Python's standard library (3.6 can read this file). It looks for a Python that can do what is asked,
makes one if there is none, and hands over to experiments/commands.py there.
"""

import sys

from experiments import prepare


def main():
    """Run the command line; returns the exit code."""
    try:
        prepare.require_version()
        from experiments import commands  # only a new enough Python can read it
        arguments = commands.parse(sys.argv[1:])
        prepare.require_packages(arguments.packages)
        return commands.run(arguments)
    except prepare.PreparationError as error:
        print("guidewire: {}".format(error), file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
