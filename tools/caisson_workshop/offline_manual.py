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


def join_scripts(pages: Path) -> None:
    """Put the theme's two scripts into one, and load it as a plain script.

    Debian ships them as modules, which a browser does not load from a file."""
    main = pages / "_static/scripts/furo.js"
    first, _, rest = main.read_text().partition("\n")
    if first.startswith("import") and "Gumshoe" in first:
        main.write_text((main.parent / "gumshoe-patched.js").read_text() + rest)
    for page in pages.rglob("*.html"):
        text = page.read_text()
        page.write_text(text.replace('<script type="module" src=', "<script src="))


def follow_system(style: Path) -> None:
    """Let the theme be dark where the system is, which Debian's package lacks."""
    text = style.read_text()
    dark = re.search(r'body\[data-theme="dark"\] \{(.*?)\}', text, re.DOTALL)
    if dark and "(prefers-color-scheme: dark) {body" not in text:
        rule = f'body:not([data-theme="light"]) {{{dark[1]}}}'
        style.write_text(f"{text}\n@media (prefers-color-scheme: dark) {{{rule}}}\n")


def name_files(_: Any, page: str, source: list[str]) -> None:
    """Name files beside the manual, to which its sources link, in the pages."""
    if page:
        source[0] = re.sub(
            r"\[([^]]*)\]\((?:\.\./)+(lab/[^)]+)\)", r"\1 (`\2`)", source[0]
        )


def complete(app: Any, failure: Exception | None) -> None:
    """Complete the pages after they have been written."""
    if failure is None and app.builder.format == "html":
        pages = Path(app.outdir)
        copy_mathjax(pages / "_static")
        join_scripts(pages)
        follow_system(pages / "_static/styles/furo.css")


def setup(app: Any) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("source-read", name_files)
    app.connect("build-finished", complete)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
