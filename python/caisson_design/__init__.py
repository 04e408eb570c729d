# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solutions that a run is compared with; none of them needs the program."""
