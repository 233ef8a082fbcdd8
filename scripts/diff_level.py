#!/usr/bin/env python3
"""Asks whether the p-value of `wavepath diff` holds its level on renders of many pairs of seeds.

    scripts/diff_level.py scenes/cornell_box/scene.gltf                          1000 pairs at 32x32, 8 samples: 20 minutes
    scripts/diff_level.py SCENE --pairs 300 --both "--spp 64" --b "--method path"      A by `mis`, B by `path`, both with 64

Prints how many p-values are below some levels, and the largest distance of
their distribution from the uniform one with what Kolmogorov allows at 1 %. Needs build/wavepath.
"""
import argparse
import json
import math
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[1] / "build" / "wavepath"


def run(*words):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    if done.returncode not in (0, 3):
        sys.exit(f"diff_level: error: {done.stderr.strip()}")


def p_of_pair(options, first_seed, folder):
    for name, own, seed in (("a", options.a, first_seed), ("b", options.b, first_seed + 1)):
        run("render", options.scene, "--size", options.size, "--quiet", "--seed", seed,
            *shlex.split(f"{options.both} {own}"), "-o", folder / f"{name}.exr")
    run("diff", folder / "a.exr", folder / "b.exr", "--json", folder / "diff.json")
    return json.loads((folder / "diff.json").read_text())["p_same_expectation"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path)
    parser.add_argument("--pairs", type=int, default=1000)
    parser.add_argument("--size", default="32x32")
    parser.add_argument("--a", default="", help="options of A alone")
    parser.add_argument("--b", default="", help="options of B alone")
    parser.add_argument("--both", default="--spp 8", help="options of both")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        told = [p_of_pair(options, 1 + 2 * k, Path(folder)) for k in range(options.pairs)]
    values = sorted(p for p in told if p is not None)
    print(f"{options.pairs} pairs, {options.pairs - len(values)} of which cannot be told")
    for level in (0.5, 0.1, 0.05, 0.01, 0.001):
        print(f"p < {level}: {sum(p < level for p in values)}")
    n = len(values)
    if n > 0:
        distance = max(max((i + 1) / n - p, p - i / n) for i, p in enumerate(values))
        print(f"largest distance from the uniform law {distance:.4f}; allowed at 1 %: {1.628 / math.sqrt(n):.4f}")


if __name__ == "__main__":
    main()
