#!/usr/bin/env python3
"""Asks that #includes below src/ go one way: a folder includes those named behind it here, and no other."""
import re
import sys
from pathlib import Path

SRC = Path(__file__).resolve().parents[2] / "src"
ANYWHERE = {"shared", "root"}  # kernels/shared, and what lies in src itself

BELOW = {
    "commands": {"wavefront", "film", "device", "gltf", "scene", "page", "measure", "image"},
    "wavefront": {"film", "device", "prepare", "scene"},
    "film": {"device", "image"},
    "device": set(),
    "prepare": {"scene"},
    "gltf": {"scene"},
    "scene": {"image"},
    "page": {"image"},
    "measure": {"image"},
    "image": set(),
}


def folder_of(name):
    return name.split("/")[0] if "/" in name else "root"


def main():
    wrong = []
    for path in sorted(SRC.rglob("*.h")) + sorted(SRC.rglob("*.cpp")):
        name = path.relative_to(SRC).as_posix()
        if name == "main.cpp":
            continue
        folder = folder_of(name)
        allowed = BELOW.get(folder, set()) | ANYWHERE | {folder}
        for include in re.findall(r'#include "([\w/.]+)"', path.read_text()):
            if folder_of(include) not in allowed:
                wrong.append(f"src/{name} includes {include}")
    if wrong:
        sys.exit("\n".join(wrong) + "\nsee tests/lint/include_order.py")


if __name__ == "__main__":
    main()
