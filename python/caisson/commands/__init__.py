# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands that put other folders to work together: run, cpt, park and compare."""
