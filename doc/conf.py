# SPDX-License-Identifier: LGPL-2.1-or-later
#
# Configuration of the manual, which tools/docs builds. It works with Sphinx
# 5.3 to 8.1 and MyST 0.18 to 4.0, the versions of Debian 12 and 13.
import sys
from pathlib import Path

for folder in ("python", "tools"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))

project = "caisson_mpm"
author = "the caisson_mpm authors"
copyright = "the caisson_mpm authors, LGPL-2.1-or-later"
extensions = ["myst_parser", "sphinx.ext.mathjax", "caisson_workshop.offline_manual"]

# Headings get the anchors that GitHub gives them, so that a link to a section
# works in both places and Sphinx can check it.
myst_enable_extensions = ["deflist", "dollarmath", "smartquotes"]
myst_heading_anchors = 4
myst_update_mathjax = False

# Formulas are drawn by the MathJax of Debian, copied beside the pages, so that
# the manual can be read without a network.
mathjax_path = "mathjax/MathJax.js"
mathjax2_config = {
    "jax": ["input/TeX", "output/CommonHTML"],
    "extensions": ["tex2jax.js"],
    "TeX": {"extensions": ["AMSmath.js", "AMSsymbols.js", "noErrors.js"]},
    # Not the width of the place: an empty cell of a table has none.
    "CommonHTML": {"linebreaks": {"automatic": True, "width": "40em"}},
    "showMathMenu": False,
    "messageStyle": "none",
}

html_theme = "furo"
html_title = "caisson_mpm"
html_static_path = ["style.css"]
html_css_files = ["style.css"]
html_copy_source = False
html_show_sphinx = False
pygments_style = "tango"
highlight_language = "none"
