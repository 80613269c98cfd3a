"""Starts the command `wear`. Ctrl-C is silent from its first import on."""

import sys

CLASH = """\
wear: the package `derive` found here is another distribution's of the same name.
Uninstall that, or make an environment for derive-wear alone, and then
pip install --force-reinstall derive-wear"""


def main() -> int:
    """Run `wear` with the arguments of the process; return the exit status."""
    try:
        from wear import cli

        return cli.main()
    except ImportError as fault:
        if fault.name is None or fault.name.partition(".")[0] != "derive":
            raise
        print(CLASH, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130  # as `derive.terminal` has it, which may not be imported yet


if __name__ == "__main__":
    sys.exit(main())
