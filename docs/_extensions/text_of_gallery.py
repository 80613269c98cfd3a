"""The pictures of the gallery: each page's first figure, linked to the page."""

from __future__ import annotations

import base64
import json
from html import escape
from pathlib import Path

PAGES = Path(__file__).parents[1] / "gallery"
ORDER = (
    "own_scene",
    "measured_load",
    "fit",
    "loss_of_contact",
    "compliant_support",
    "own_law",
    "map_of_wear",
    "life_distribution",
    "fe_coupling",
    "latex_appendix",
)


def pictures() -> str:
    """Return the pictures with their titles, as a block of HTML."""
    cards = "\n".join(map(_card, ORDER))
    return f'```{{raw}} html\n<div class="gallery">\n{cards}\n</div>\n```'


def _card(name: str) -> str:
    cells = json.loads((PAGES / f"{name}.ipynb").read_text(encoding="utf-8"))["cells"]
    title = cells[0]["source"][0].strip("# \n").replace("$", "")
    (figure,) = (cell for cell in cells if "title" in cell["metadata"])
    svg = "".join(figure["outputs"][-1]["data"]["image/svg+xml"])
    source = f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}"
    return (
        f'<a href="gallery/{name}.html"><img alt="{escape(figure["metadata"]["title"])}" '
        f'src="{source}"><span>{escape(title)}</span></a>'
    )
