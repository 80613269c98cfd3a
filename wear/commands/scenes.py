"""`wear scenes`: the built-in scenes.

examples:
  wear scenes                                 names and titles
  wear scenes --describe section4             its description and data
  wear scenes --describe section4 > own.toml  to start a scene of your own
"""

from __future__ import annotations

from derive.command_line import Answer, Options, Parser, declare
from wear.commands import arguments


def add_arguments(parser: Parser) -> None:
    names, about = arguments.built_in_names, "a built-in scene (default: all)"
    arguments.add_choice(parser, "[SCENE ...]", names, about, dest="names")
    declare(parser, "--describe", "show each as a scene file")


def execute(options: Options) -> Answer:
    from wear.scene import load_scene

    arguments.read(options).stop_if_any()
    scenes = [load_scene(name) for name in options.names or arguments.built_in_names()]
    document = [
        {"name": scene.name, "title": scene.title, "description": scene.description}
        | ({"tables": scene.to_tables()} if options.describe else {})
        for scene in scenes
    ]
    width = max(len(scene.name) for scene in scenes)
    lines = [
        f"# wear run {scene.name}\n{scene.to_toml()}\n"
        if options.describe
        else f"{scene.name:{width}}  {scene.title}\n"
        for scene in scenes
    ]
    return Answer(document, lambda: "".join(lines))
