#!/usr/bin/env python3
"""That results are counted case by case, and that nothing that went wrong is lost."""
import tempfile
import unittest
from pathlib import Path

from count_results import results_of

CTEST = """<testsuite>
<testcase name="cases.0" status="fail"><failure/></testcase>
<testcase name="leaks.0" status="fail"><failure/></testcase>
<testcase name="crashes.0" status="fail"><failure/></testcase>
<testcase name="alone" status="run"/>
<testcase name="off" status="disabled"><skipped message=""/></testcase>
<testcase name="skips" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>
<testcase name="absent" status="notrun"><skipped message="Unable to find executable"/></testcase>
</testsuite>"""
CASES = """<testsuites><testsuite>
<testcase name="A" classname="S" result="completed"><failure message="bad"/></testcase>
<testcase name="B" classname="S" result="completed"/>
<testcase name="C" classname="S" result="skipped"><skipped/></testcase>
</testsuite></testsuites>"""
LEAKS = '<testsuites><testsuite><testcase name="A" classname="L" result="completed"/></testsuite></testsuites>'


class Results(unittest.TestCase):
    def test_are_those_of_the_cases_and_of_programs_that_ended_badly_beside_them(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "tests").mkdir()
            (folder / "tests.xml").write_text(CTEST)
            (folder / "tests/cases.0.xml").write_text(CASES)
            (folder / "tests/leaks.0.xml").write_text(LEAKS)
            self.assertEqual(list(results_of(folder)), [
                ("S.A", "failed"), ("S.B", "passed"), ("S.C", "skipped"), ("L.A", "passed"), ("leaks.0", "failed"),
                ("crashes.0", "failed"), ("alone", "passed"), ("off", "skipped"), ("skips", "skipped"), ("absent", "failed")])


unittest.main()
