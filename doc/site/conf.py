"""Sphinx settings of the site; see make_site.sh."""

import re

project = "polydda"
author = "The polydda maintainers"
extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 3
myst_update_mathjax = False
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML"
root_doc = "index"
exclude_patterns = ["site"]
html_theme = "furo"
html_title = "polydda"
html_copy_source = False
html_show_copyright = False


def without_folders(app, page, source):
    """Links to folders of the repository and to its README, which a site has not, become their text."""
    source[0] = re.sub(r"\[([^\]]*)\]\((\.\./)+([\w/]+|README\.md)\)", r"\1", source[0])


def setup(app):
    app.connect("source-read", without_folders)
