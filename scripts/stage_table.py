#!/usr/bin/env python3
"""Writes the table of stages in docs/architecture.md from the heads of kernels/stages/*.cl and src/wavefront/chain.h.

    scripts/stage_table.py            writes it
    scripts/stage_table.py --check    only whether it is what it would write

Both fail where a head says other than the kernel's parameters: every const buffer stands under "reads:", every other
one under "writes:", and under "reads:" too if its values are used. The parameters of all stages (settings, slots) are left out,
and pages of texels belong to textures.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STAGES = ROOT / "kernels" / "stages"
CHAIN = ROOT / "src" / "wavefront" / "chain.h"
PAGE = ROOT / "docs" / "architecture.md"
FIRST, LAST = "<!-- stages: scripts/stage_table.py -->\n", "<!-- end of stages -->\n"
RUN = re.compile(r'(?:if \((?P<when>[^"]*)\)\s*)?run\("(?P<name>\w+)"')


def stop(message):
    sys.exit(f"stage_table: error: {message}")


def stages_in_order():
    """(name, when) of every stage, in the order of visit_stages."""
    text = CHAIN.read_text()
    body = {name: text[text.index(f"void {name}("):].split("\n}\n")[0] for name in ("iterate", "visit_stages")}

    def runs(part):
        return [(m["name"], m["when"] or "") for m in RUN.finditer(part)]

    begin, rest = body["visit_stages"].split("iterate(")
    compaction, end = rest.split("});")
    before, after = body["iterate"].split("compact();")
    moved = [(name, "the pool is half empty") for name, _ in runs(compaction)]
    return runs(begin) + runs(before) + moved + runs(after) + runs(end)


def head_of(name):
    """What a kernel's head says: its lists of buffers, with remarks, and its work-items."""
    text = (STAGES / f"{name}.cl").read_text()
    head = text.split("\n\n")[0].replace("\n//\n", "\n\n").replace("\n// ", " ").removeprefix("// ")
    said = {}
    for paragraph in head.split("\n"):
        found = re.match(r"\s*(reads|writes): (.*)", paragraph)
        if found:
            said[found[1]] = found[2].strip()
        found = re.search(r"One work-item ([^.;]*)[.;]", paragraph)
        if found:
            said["items"] = found[1]
    for part in ("reads", "writes", "items"):
        if part not in said:
            stop(f"kernels/stages/{name}.cl: its head does not say {part!r}")
    signature = re.search(rf"kernel void {name}\((.*?)\) {{", text, re.S)[1]
    buffers = {"reads": set(), "writes": set()}
    for parameter in signature.split(","):
        if "TEXTURE_PARAMETERS" in parameter:
            buffers["reads"].add("textures")
        elif "*" in parameter and "constant" not in parameter:
            buffers["reads" if "const " in parameter else "writes"].add(parameter.split()[-1])
    named = {part: set(re.findall(r"\w+", re.sub(r"\([^)]*\)", "", said[part]))) for part in buffers}
    unsaid = (buffers["reads"] - named["reads"]) | (buffers["writes"] - named["writes"])
    untrue = (named["writes"] - buffers["writes"]) | (named["reads"] - buffers["reads"] - buffers["writes"])
    if unsaid or untrue:
        stop(f"kernels/stages/{name}.cl: its head leaves out {sorted(unsaid)} and names {sorted(untrue)} wrongly")
    return said


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        stop("usage: stage_table.py [--check]")
    lines = ["| stage | where | reads | writes | one work-item |", "|---|---|---|---|---|"]
    stages = stages_in_order()
    for name, when in stages:
        said = head_of(name)
        when = re.sub(r"f\.(\w+)(\(\))?", r"`\1`", when)
        lines.append(f"| `{name}` | {when} | {said['reads']} | {said['writes']} | {said['items']} |")
    unused = {path.stem for path in STAGES.glob("*.cl")} - {name for name, _ in stages}
    if unused:
        stop(f"kernels/stages: {sorted(unused)} are not in src/wavefront/chain.h")
    page = PAGE.read_text()
    if FIRST not in page or LAST not in page:
        stop(f"{PAGE.relative_to(ROOT)}: the marks around the table are missing")
    before, rest = page.split(FIRST)
    after = rest.split(LAST)[1]
    wanted = before + FIRST + "\n" + "\n".join(lines) + "\n\n" + LAST + after
    if sys.argv[1:]:
        if wanted != page:
            stop(f"{PAGE.relative_to(ROOT)}: the table of stages is out of date: run scripts/stage_table.py")
    else:
        PAGE.write_text(wanted)


if __name__ == "__main__":
    main()
