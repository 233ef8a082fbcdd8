#!/usr/bin/env python3
"""Asks that files have at most 300 lines and functions 60, but for those that are named below with a reason; of tests,
files alone.

A function is what begins at the margin and ends with a brace at the margin, as clang-format leaves it.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MOST_LINES = 300
MOST_FUNCTION_LINES = 60

# One kernel each: what a stage keeps in registers a second one would store and load again.
LONG_KERNELS = {"connect_through_media", "direct_light", "find_contacts", "generate_rays", "refract_boundary",
                "roulette_compact", "sample_distance", "sample_indirect"}


def functions(lines):
    """(name, lines) of every function at the margin."""
    start = None
    for n, line in enumerate(lines):
        begins = re.match(r"[A-Za-z].*\(", line) and not line.endswith(";")
        if start is None and begins and not re.match(r"(namespace|static_assert|(inline )?constexpr|typedef)\b", line):
            start = n
        elif start is not None and line.endswith(";") and not line.startswith((" ", "}")):
            start = None
        if start is not None and line == "}":
            yield re.search(r"(\w+)\(", lines[start])[1], n - start + 1
            start = None
        elif start is not None and line.endswith(");") and not any(text.endswith("{") for text in lines[start:n]):
            start = None


def main():
    wrong = []
    patterns = ["src/**/*.cpp", "src/**/*.h", "kernels/**/*.cl", "tests/**/*.cpp", "tests/**/*.h"]
    for path in sorted(found for pattern in patterns for found in ROOT.glob(pattern)):
        name = path.relative_to(ROOT).as_posix()
        lines = path.read_text().splitlines()
        if len(lines) > MOST_LINES:
            wrong.append(f"{name} has {len(lines)} lines")
        if name.startswith("tests/"):
            continue
        for function, count in functions(lines):
            if path.suffix == ".cl" and function in LONG_KERNELS:
                continue
            if count > MOST_FUNCTION_LINES:
                wrong.append(f"{name}: {function} has {count} lines")
    if wrong:
        sys.exit("\n".join(wrong) + "\nsee tests/lint/sizes.py")


if __name__ == "__main__":
    main()
