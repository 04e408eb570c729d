# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workshop: checks of the sources and documents, the search for faults, clean
installations, figures of the manual. tools/workshop is the command line.

The workshop imports the user's package, caisson, and the laboratory, lab; neither
imports anything of it.
"""
