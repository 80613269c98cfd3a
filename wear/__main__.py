"""Starts the command `wear`. Ctrl-C is silent from its first import on."""

import sys


def main() -> int:
    """Run `wear` with the arguments of the process; return the exit status."""
    try:
        from wear import cli

        return cli.main()
    except KeyboardInterrupt:
        return 130  # as `derive.terminal` has it, which may not be imported yet


if __name__ == "__main__":
    sys.exit(main())
