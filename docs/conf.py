"""Configuration of Sphinx: MyST pages, furo theme, formulas as MathML, nothing from a network."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_extensions"))
_PROJECT = tomllib.loads((HERE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]

project = _PROJECT["name"]
author = "The derive-wear contributors"
release = version = _PROJECT["version"]

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "docstrings",
    "insertions",
    "mathml_renderer",
    "notebook_pages",
]
source_suffix = {".md": "markdown", ".ipynb": "notebook"}
exclude_patterns = ["_build", "_extensions", "_static", "bench", "examples", "papers"]
default_role = "code"  # what docstrings have in single backticks
nitpicky = True
nitpick_ignore_regex = [("py:.*", r".*")]  # types in signatures name what these pages do not list

myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
myst_links_external_new_tab = False

autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
napoleon_numpy_docstring = True
napoleon_google_docstring = False
napoleon_attr_annotations = False  # types are in the source; here they hide the meaning
napoleon_use_rtype = False

html_math_renderer = "mathml"
html_theme = "furo"
html_title = f"derive-wear {release}"
html_static_path = [
    "_static",
    "../wear/report/assets/stix-two-math.woff2",
    "../wear/report/assets/OFL.txt",
]
html_css_files = ["docs.css"]
html_show_copyright = False
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b57a4", "color-brand-content": "#0b57a4"},
    "dark_css_variables": {"color-brand-primary": "#86b8f2", "color-brand-content": "#86b8f2"},
    "footer_icons": [],
}
pygments_style = "friendly"
pygments_dark_style = "github-dark"
