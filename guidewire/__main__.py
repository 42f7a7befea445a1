"""The command line: `python -m guidewire`, or `guidewire` once it is installed. Any Python from 3.6 on can read this
file."""

import sys

from guidewire import prepare


def main():
    """Run the command line; returns the exit code."""
    try:
        prepare.require_version()
        from guidewire.commands import commands  # only a new enough Python can read it
        arguments = commands.parse(sys.argv[1:])
        prepare.require_packages(arguments.packages)
        return commands.run(arguments)
    except KeyboardInterrupt:
        print("guidewire: interrupted", file=sys.stderr)
        return 130
    except prepare.PreparationError as error:
        print("guidewire: {}".format(error), file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
