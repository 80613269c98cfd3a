"""Starts the command `wear`. Ctrl-C is silent from its first import on."""

import sys

from wear import CLASH, is_clash


def main() -> int:
    """Run `wear` with the arguments of the process; return the exit status."""
    try:
        from wear import cli

        return cli.main()
    except ImportError as fault:
        if not is_clash(fault):
            raise
        print(f"wear: {CLASH}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130  # as `derive.terminal` has it, which may not be imported yet


if __name__ == "__main__":
    sys.exit(main())
