# SPDX-License-Identifier: LGPL-2.1-or-later
"""Layers of soil and their parameters from a cone penetration test."""
