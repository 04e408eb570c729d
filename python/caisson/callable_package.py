# SPDX-License-Identifier: LGPL-2.1-or-later
"""Packages that are functions, too: `caisson.report` is a package, and
`caisson.report("results/own")` calls the function of caisson.api with its name."""
import importlib
import sys
from types import ModuleType
from typing import Any


class CallablePackage(ModuleType):
    """A package whose call is that of the function of caisson.api with its name."""

    def __call__(self, *args: Any, **options: Any) -> Any:
        """Call the function; help(caisson.api) has all of them."""
        name = self.__name__.rpartition(".")[2]
        return getattr(importlib.import_module("caisson.api"), name)(*args, **options)


def make_callable(package: str) -> None:
    """Let a package, by its full name, be called."""
    sys.modules[package].__class__ = CallablePackage
