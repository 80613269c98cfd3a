"""`wear explore`: an interactive page, in which the wear follows the parameters.

examples:
  wear explore                          section4 of the note, into explorer.html
  wear explore scene.toml -o mine.html  a scene of your own, beside the built-in ones
  wear explore section4 --set contact.ends_at_3_sigma=true
"""

from __future__ import annotations

from derive import files, terminal
from derive.command_line import Answer, Options, Parser, declare
from wear.commands import arguments


def add_arguments(parser: Parser) -> None:
    arguments.add_scene(parser, default="section4")
    arguments.add_readings(parser, "show readings: columns cycles, wear_mm or wear_um")
    about = "the page to write (default: %(default)s)"
    declare(
        parser, "-o, --output FILE", about, default="explorer.html", type=arguments.file(".html")
    )


def execute(options: Options) -> Answer:
    from wear.report.explorer import page

    faults = arguments.read(options)
    specimens = options.readings
    if any(each.changes for each in specimens):
        faults.append(f"--data: {options.data}: the page has one scene; leave its entries out")
    faults.stop_if_any()
    with terminal.busy("solving the scenes that the page checks itself against"):
        text = page(options.scene, specimens)
    files.write_atomically(options.output, text)
    place = options.output.resolve().as_uri()
    return Answer(
        {"page": str(options.output), "bytes": len(text.encode())},
        lambda: f"{options.output}: open it in a browser ({place})",
    )
