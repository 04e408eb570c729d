# SPDX-License-Identifier: LGPL-2.1-or-later
"""Extension of Sphinx: makes the pages complete without a network or a server."""
import re
import shutil
from pathlib import Path
from typing import Any

MATHJAX = Path("/usr/share/javascript/mathjax")
# What the configuration of MathJax in doc/conf.py loads.
PARTS = [
    "MathJax.js",
    "extensions",
    "jax/element",
    "jax/input/TeX",
    "jax/output/CommonHTML",
    "fonts/HTML-CSS/TeX/woff",
]


def copy_mathjax(static: Path) -> None:
    """Copy the part of MathJax that draws the formulas beside the pages."""
    for part in PARTS:
        source, target = MATHJAX / part, static / "mathjax" / part
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, dirs_exist_ok=True)
        else:
            shutil.copy(source, target)


def join_scripts(scripts: Path) -> None:
    """Put the theme's two scripts into one.

    Debian ships them as modules, which a browser does not load from a file."""
    main, spy = scripts / "furo.js", scripts / "gumshoe-patched.js"
    text = main.read_text()
    first, _, rest = text.partition("\n")
    if first.startswith("import Gumshoe") and spy.exists():
        main.write_text(spy.read_text() + rest)


def follow_system(style: Path) -> None:
    """Let the theme be dark where the system is, which Debian 12's package lacks."""
    text = style.read_text()
    dark = re.search(r'body\[data-theme="dark"\] \{(.*?)\}', text, re.DOTALL)
    if dark and "prefers-color-scheme" not in text:
        rule = f'body:not([data-theme="light"]) {{{dark[1]}}}'
        style.write_text(f"{text}\n@media (prefers-color-scheme: dark) {{{rule}}}\n")


def complete(app: Any, failure: Exception | None) -> None:
    """Complete the pages after they have been written."""
    if failure is None and app.builder.format == "html":
        static = Path(app.outdir) / "_static"
        copy_mathjax(static)
        join_scripts(static / "scripts")
        follow_system(static / "styles" / "furo.css")


def setup(app: Any) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("build-finished", complete)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
