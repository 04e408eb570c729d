# SPDX-License-Identifier: LGPL-2.1-or-later
"""What only those need who change the program."""
