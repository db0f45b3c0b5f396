#!/usr/bin/env python3
"""count_results.py FOLDER ...: what the tests of build folders did, as `ctest --output-junit FOLDER/tests.xml` tells, and case by case
as GoogleTest does in FOLDER/tests/NAME.xml for each test NAME that is a program of its. Names on standard error the cases that failed.
Prints "P passed, F failed", after a line "S skipped" where some were. Exit status 1 where one failed or there are none.

A program counts as one more that failed where it ended badly and no case of it did: it crashed, it leaked, it took too long.
"""
import sys
from pathlib import Path
from xml.etree import ElementTree


def cases_of(program):
    """(name, passed or failed or skipped) of each case of a file of GoogleTest's."""
    for case in ElementTree.parse(program).getroot().iter("testcase"):
        name = f'{case.get("classname")}.{case.get("name")}'
        if case.find("failure") is not None:
            yield name, "failed"
        elif case.get("result") == "completed":
            yield name, "passed"
        else:
            yield name, "skipped"


def results_of(folder):
    """The same of everything that ctest ran in a build folder."""
    for test in ElementTree.parse(folder / "tests.xml").getroot().iter("testcase"):
        name, status = test.get("name"), test.get("status")
        ended_well = status == "run"
        program = folder / "tests" / f"{name}.xml"
        cases = list(cases_of(program)) if program.exists() else []
        yield from cases
        skipped = test.find("skipped")
        if status == "disabled" or skipped is not None and skipped.get("message", "").startswith("SKIP_"):
            yield name, "skipped"
        elif not ended_well and not any(result == "failed" for _, result in cases):
            yield name, "failed"
        elif ended_well and not cases:
            yield name, "passed"


def main():
    counts = {"passed": 0, "failed": 0, "skipped": 0}
    for folder in sys.argv[1:]:
        for name, result in results_of(Path(folder)):
            counts[result] += 1
            if result == "failed":
                print(f"{folder}: {name} failed", file=sys.stderr)
    if counts["skipped"] > 0:
        print(f'{counts["skipped"]} skipped')
    print(f'{counts["passed"]} passed, {counts["failed"]} failed')
    return 0 if counts["failed"] == 0 and counts["passed"] > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
