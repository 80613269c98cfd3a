"""`wear scenes`: the built-in scenes."""

from __future__ import annotations

import argparse

from derive import terminal
from derive.command_line import Command
from wear.commands import arguments

EXAMPLE = """\
  wear scenes                                 names and titles
  wear scenes --describe section4             what it is, and its data
  wear scenes --describe section4 > own.toml  to start a scene of your own
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    arguments.add_choice(
        parser,
        "names",
        arguments.built_in_names,
        metavar="SCENE",
        nargs="*",
        help="a built-in scene (default: all)",
    )
    parser.add_argument("--describe", action="store_true", help="show each as a scene file")


def execute(options: argparse.Namespace) -> int:
    from wear.scene import load_scene

    arguments.read(options).stop_if_any()
    scenes = [load_scene(name) for name in options.names or arguments.built_in_names()]
    if options.json:
        terminal.print_json(
            [
                {"name": scene.name, "title": scene.title, "description": scene.description}
                | ({"tables": scene.to_tables()} if options.describe else {})
                for scene in scenes
            ]
        )
    elif options.describe:
        print("\n".join(f"# wear run {scene.name}\n{scene.to_toml()}" for scene in scenes))
    else:
        width = max(len(scene.name) for scene in scenes)
        for scene in scenes:
            print(f"{scene.name:{width}}  {scene.title}")
    return terminal.DONE


COMMAND = Command("scenes", "the built-in scenes", EXAMPLE, add_arguments, execute)
