"""Start the command `derive`. Ctrl-C is silent from the first import on."""

import sys


def main() -> int:
    """Run `derive` with the arguments of the process; return the exit status."""
    try:
        from derive import cli

        return cli.main()
    except KeyboardInterrupt:
        return 130  # `derive.terminal.INTERRUPTED`, which may not be imported yet


if __name__ == "__main__":
    sys.exit(main())
