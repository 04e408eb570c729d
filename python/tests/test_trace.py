# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the numbers of a page come from, and who answers for them."""
import argparse
import contextlib
import hashlib
import io
import unittest

from synthetic import DESIGN
from test_report import SUMMARY, WithPage, leave_run

import caisson.report as report
from caisson.run_error_bar import NAME as ERROR
from caisson.report import page, trace
from caisson.results import Results


class Trace(WithPage):
    """Checksums, mesh error, and signatures at the foot of the page."""

    def test_checksums(self) -> None:
        """That of the results is what sha256sum says of history.csv; that of the scene
        does not know where the results are."""
        leave_run(self.path, SUMMARY)
        found = trace.trace_of(Results(self.path))
        assert found is not None
        history = (self.path / "history.csv").read_bytes()
        self.assertEqual(found.results, hashlib.sha256(history).hexdigest())
        entries = DESIGN | {"Rigid body/Outer diameter": "10"}
        lines = "".join(f"{k} = {entries[k]}\n" for k in sorted(entries))
        self.assertEqual(found.scene, hashlib.sha256(lines.encode()).hexdigest())
        self.assertEqual(found.mesh, "not known")
        for name, changes in (("Output/Directory", False), ("Soil/Submerged", True)):
            leave_run(self.path, {**SUMMARY, "defaults": {name: "x"}})
            other = trace.sum_of_scene(Results(self.path))
            self.assertEqual(other != found.scene, changes)

    def test_mesh_error(self) -> None:
        """20 % where the title asks for them, and the error bar where there is one."""
        leave_run(self.path, {**SUMMARY, "title": "mine, for an error of about 20 %"})
        found = trace.trace_of(Results(self.path))
        assert found is not None
        self.assertEqual(found.mesh, "-20 to +20 % (asked for, not computed)")
        lines = ["# fingerprint: f00d", "penetration_m,total_below,total_above"]
        lines += ["1,0.05,0.1", "5,0.05,0.1"]
        (self.path / ERROR).write_text("\n".join(lines), encoding="utf-8")
        report.write(self.path)
        found = trace.trace_of(Results(self.path))
        assert found is not None
        self.assertEqual(found.mesh, "-5 to +10 % (error bar)")

    def command(self, *words: str) -> str:
        """Call `caisson report` for the run; return the page."""
        parser = argparse.ArgumentParser()
        report.add_arguments(parser)
        with contextlib.redirect_stdout(io.StringIO()):
            report.main(parser.parse_args([*words, str(self.path)]))
        return (self.path / report.NAME).read_text(encoding="utf-8")

    def test_signatures(self) -> None:
        """They stand on the page and at its foot until the results change."""
        leave_run(self.path, SUMMARY)
        text = self.command("--author", "A. Ng")
        self.assertTrue("Author: <i>A. Ng</i> Checked: <i></i>" in text)
        foot = page.css_text("author A. Ng; not checked")
        self.assertTrue(foot in text)
        text = self.command("--checked", "B </style>")
        self.assertTrue(page.css_text("author A. Ng; checked by B </style>") in text)
        self.assertFalse("B </style>" in text)
        history = self.path / "history.csv"
        history.write_text(history.read_text(encoding="utf-8") + "\n")
        self.assertTrue("Author: <i></i>" in self.command())
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.command("--author", "A. Ng", "--rate", "-1")
        self.assertIn("--rate -1: give m/h above 0", said.getvalue())
        self.assertEqual(trace.signed_of(self.path), trace.Signed())
        (self.path / trace.NAME).write_text("{")
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.command()
        self.assertIn("signed.json cannot be read", said.getvalue())

    def test_run_that_goes_on(self) -> None:
        """It has no checksum yet."""
        leave_run(self.path, None)
        self.assertIsNone(trace.trace_of(Results(self.path)))


if __name__ == "__main__":
    unittest.main()
