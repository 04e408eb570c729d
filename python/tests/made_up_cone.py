# SPDX-License-Identifier: LGPL-2.1-or-later
"""Made-up files of cone tests, for the tests that read them."""
import argparse
import tempfile
import unittest
from pathlib import Path
from typing import Any

import numpy as np

from caisson.design import cone_file, interpretation
from caisson.disk import InputError
from caisson.design.cone_options import How

HEAD = "depth_m,qc_MPa,fs_kPa,u2_kPa\n"
HEADINGS = (
    '"HEADING","LOCA_ID","SCPG_TESN","SCPT_DPTH","SCPT_RES","SCPT_FRES","SCPT_PWP2"'
)
UNITS = '"UNIT","","","m","MN/m2","kN/m2","kPa"'
AGS = f""""GROUP","PROJ"
"HEADING","PROJ_ID"
"UNIT",""
"TYPE","ID"
"DATA","7"

"GROUP","SCPT"
{HEADINGS}
{UNITS}
"TYPE","ID","X","2DP","2DP","1DP","1DP"
"DATA","CPT01","1","0.50","1.00","5.0","10"
"DATA","CPT01","1","1.00","2.50","",""
"DATA","CPT01","1","1.50","4.00","20.0","15"
"""
OTHER = (
    '"DATA","CPT02","1","0.50","9.00","50.0","1"\n"DATA","CPT02","1","1","9","50","1"\n'
)

GEF = """#GEFID= 1, 1, 0
#REPORTCODE= GEF-CPT-Report, 1, 1, 0
#COLUMN= 5
#COLUMNINFO= 1, m, Sondeerlengte, 1
#COLUMNINFO= 2, MPa, Conusweerstand, 2
#COLUMNINFO= 3, MPa, Plaatselijke wrijving, 3
#COLUMNINFO= 4, kPa, Waterspanning, 6
#COLUMNINFO= 5, m, Gecorrigeerde diepte, 11
#COLUMNVOID= 2, -9999.000
#COLUMNVOID= 4, -1
#COLUMNSEPARATOR= ;
#RECORDSEPARATOR= !
#EOH=
0.50;1.00;0.005;-1;0.49;!
1.00;-9999;0.006;-1;0.98;!
1.50;4.00;2.0E-002;-1;1.47;!
"""


def options(*words: str) -> argparse.Namespace:
    """Return the options that say how a test is read."""
    parser = argparse.ArgumentParser()
    interpretation.add_arguments(parser)
    return parser.parse_args(words)


class WithFiles(unittest.TestCase):
    """Has a directory for a file."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "mine.csv"

    def written(self, text: str) -> Path:
        """Return a file with this text."""
        self.path.write_text(text, encoding="utf-8")
        return self.path

    def read(self, text: str, location: str = "", **how: Any) -> cone_file.Test:
        """Return the test of a file with this text."""
        return cone_file.read(self.written(text), how=How(location, **how))

    def refused(self, text: str, words: str, **how: str) -> None:
        """Expect words in the refusal of a text, which is one line."""
        with self.assertRaisesRegex(InputError, words) as caught:
            self.read(text, **how)
        self.assertNotIn("\n", str(caught.exception))

    def layered(self, *soils: tuple[float, ...]) -> Path:
        """Return the file of a test in soils (bottom, q_c in MPa at 10 m, f_s/q_c in
        %, and u_2 above water at rest in kPa, 0 if not given); q_c grows with the root
        of the depth."""
        rows, top = [], 0.0
        for bottom, resistance, ratio, *excess in soils:
            for z in np.arange(top + 0.05, bottom + 0.01, 0.05):
                q, u = resistance * (z / 10) ** 0.5, 9.81 * z + sum(excess)
                rows.append(f"{z:.2f},{q:.4f},{10 * q * ratio:.3f},{u:.2f}")
            top = bottom
        return self.written(HEAD + "\n".join(rows))
