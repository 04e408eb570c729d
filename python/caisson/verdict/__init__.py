# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is decided about a run: what the methods say of it, the limits of its suction,
where suction ends, and what came out. The floors above show it."""
