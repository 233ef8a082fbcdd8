#!/usr/bin/env python3
"""Renders every sample model, and puts those of them that may be shown into one picture with their credits.

    scripts/contact_sheet.py ASSETS             docs/images/contact_sheet.jpg and docs/contact_sheet.md
    scripts/contact_sheet.py ASSETS Fox Duck    renders models whose path contains one of the words, no sheet

ASSETS is the folder of sample models: models/, env/, INDEX.md with file, triangles, licence and credit, and
goldens/goldens.json with cameras. Every picture goes to build/contact_sheet/, for looking at; the sheet shows the models
under CC0 or CC-BY alone. Cameras are those of the published reference pictures, else the file's own, else an overview of
the scene. Needs build/wavepath and the package openimageio-tools.
"""
import argparse
import json
import re
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "wavepath"
WORK = ROOT / "build" / "contact_sheet"
SHEET = ROOT / "docs" / "images" / "contact_sheet.jpg"
CREDITS = ROOT / "docs" / "contact_sheet.md"
LIGHT = "env/lightroom_14b_reconstructed.hdr"
FREE = {"CC0-1.0", "CC-BY-4.0"}
COLUMNS = 7
SHOWN = 160  # pixels a picture is wide in the sheet


def stop(message):
    sys.exit(f"contact_sheet: error: {message}")


def read_index(assets):
    """The rows of INDEX.md that name a model: file, credit."""
    rows = []
    for line in (assets / "INDEX.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) > 6 and cells[1].startswith("models/"):
            rows.append({"file": cells[1], "name": cells[1].split("/")[1], "credit": cells[6]})
    if not rows:
        stop(f"{assets / 'INDEX.md'}: lists no models; name the folder of the sample models")
    return rows


def is_free(row):
    licences = set(re.findall(r"CC0-1\.0|CC-BY-4\.0|LicenseRef-\w+|SCEA|Apache-2\.0|\bMIT\b", row["credit"]))
    return bool(licences) and licences <= FREE | {"MIT"} and licences & FREE != set()


def camera_options(row, goldens):
    for scenario in goldens["scenarios"]:
        if scenario["model"] == row["file"]:
            view = ",".join(str(x) for x in scenario["eye"] + scenario["target"])
            return ["--look-at", view, "--fov", str(scenario["vfov_deg"])]
    return []


def render(row, assets, goldens, arguments):
    """Writes the model's picture; returns what the program said and whether it failed."""
    picture = WORK / f"{row['file'].split('/')[1]}.png"
    picture.unlink(missing_ok=True)
    command = [PROGRAM, "render", assets / row["file"], "--size", f"{arguments.size}x{arguments.size}",
               "--spp", str(arguments.spp), "--env", assets / LIGHT, "--quiet", "-o", picture]
    start = time.monotonic()
    run = subprocess.run(command + camera_options(row, goldens), capture_output=True, text=True)
    print(f"{row['name']}: {time.monotonic() - start:.1f} s{'' if run.returncode == 0 else ', FAILED'}")
    print("".join(f"    {line}\n" for line in run.stderr.splitlines()), end="", flush=True)
    row["picture"] = picture if run.returncode == 0 else None


def write_sheet(rows):
    lines = -(-len(rows) // COLUMNS)
    command = ["oiiotool"]
    for row in rows:
        command += [row["picture"], "--ch", "R,G,B", "--resize", f"{SHOWN}x{SHOWN}"]
    command += [f"--mosaic:pad=4", f"{COLUMNS}x{lines}", "-d", "uint8", "--compression", "jpeg:85", "-o", SHEET]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        stop(f"oiiotool: {(run.stdout + run.stderr).strip()}")
    text = ["# Sample models", "", "![sample models](images/contact_sheet.jpg)", "",
            "Models of the glTF Sample Assets as `scripts/contact_sheet.py` renders them, row by row:", "",
            "| model | by |", "|---|---|"]
    for row in rows:
        text.append(f"| {row['name']} | {row['credit'].replace('Everthing', 'Everything')} |")
    CREDITS.write_text("\n".join(text) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("assets", type=Path)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--spp", type=int, default=32)
    arguments = parser.parse_args()
    if not PROGRAM.exists():
        stop(f"{PROGRAM}: is not built; see README.md")
    WORK.mkdir(parents=True, exist_ok=True)
    rows = [row for row in read_index(arguments.assets)
            if not arguments.words or any(word in row["file"] for word in arguments.words)]
    goldens = json.loads((arguments.assets / "goldens" / "goldens.json").read_text())
    for row in rows:
        render(row, arguments.assets, goldens, arguments)
    if not arguments.words:
        write_sheet([row for row in rows if row["picture"] and is_free(row)])


if __name__ == "__main__":
    main()
