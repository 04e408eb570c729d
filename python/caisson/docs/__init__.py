# SPDX-License-Identifier: LGPL-2.1-or-later
"""What builds the manual: pages and pictures that are made, names that are checked."""
