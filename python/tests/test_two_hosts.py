# SPDX-License-Identifier: LGPL-2.1-or-later
"""What two hosts have sent each other is counted."""
import unittest

from caisson_workshop.two_hosts import Traffic, describe, read_profile

PROFILE = """# POINT TO POINT
E\t1\t0\t800 bytes\t10 msgs sent\t0,0,0,6,10
E\t1\t2\t80 bytes\t5 msgs sent\t0,0,0,6,10
I\t1\t0\t84 bytes\t11 msgs sent
# COLLECTIVES
C\t1\t3\t84 bytes\t11 msgs sent
D\tMPI_COMM_WORLD\tprocs: 0,1,2,3
O2A\t1\t12 bytes\t1 msgs sent
A2O\t1\t0 bytes\t0 msgs sent
A2A\t1\t240 bytes\t10 msgs sent
"""


class Counts(unittest.TestCase):
    """What Open MPI has counted."""

    def test_profile(self) -> None:
        """Messages of the program, not those that its collectives are made of."""
        traffic = [Traffic(steps, 0, 0) for steps in (10, 20)]
        read_profile(PROFILE, 1, traffic[1])
        self.assertEqual(traffic[1].messages[1], 15)
        self.assertEqual(traffic[1].message_bytes[1], 880)
        self.assertEqual(traffic[1].collectives[1], 11)
        words = describe(*traffic).split("rank 1:")[1]
        self.assertEqual(
            words.split(),
            "1.5 messages to others, 88 bytes, 1.1 collectives".split(),
        )


if __name__ == "__main__":
    unittest.main()
