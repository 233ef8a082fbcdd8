#!/usr/bin/env python3
"""Renders sample models as published path-traced pictures of them were made, and says how far they differ.

    scripts/compare_goldens.py ASSETS                     the scenarios that core glTF 2.0 covers, 256 pixels wide
    scripts/compare_goldens.py ASSETS Duck Suzanne        some of them, by the end of their names
    scripts/compare_goldens.py ASSETS -o FOLDER           keeps pictures there, ours and theirs side by side

ASSETS is a folder with goldens/goldens.json, the models and maps that it names and the goldens as PNG. Needs
build/wavepath and the packages python3-numpy and python3-openimageio.

Ours is shown as Cycles' and V-Ray's goldens are: radiance / 0.6, the ACES fit of Hill, clipped to 0.9999, power 1/2.2.
Goldens were rendered larger and scaled down as they are displayed, which keeps thin dark lines dark, and are scaled down
further here, by whole factors. Ours is rendered twice as large as the goldens and treated alike. Only pixels count that are opaque
in every golden of the scenario, and in their neighbours: elsewhere the background shows. For each golden the table has
RMSE of the displayed colours and the mean of FLIP [Andersson et al. 2020, LDR, 67 pixels a degree] with the error map's
pixels outside the mask left out; then the least of either between two goldens: how well independent path tracers agree.
"within": ours is no farther from that golden. Noise of ours is in all numbers. Goldens that are known to be wrong are
shown and not judged by.
"""
import argparse
import itertools
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import OpenImageIO as oiio

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "wavepath"
SCENARIOS = ("Duck", "Suzanne", "NormalTangentTest", "TwoSidedPlane", "EmissiveStrengthTest", "MorphPrimitivesTest",
             "Fox", "UnlitTest", "TextureTransformTest", "OrientationTest", "AlphaBlendModeTest", "TransmissionTest")

# What renders these differs from what the model asks for: Cycles' opaque and mask columns, one transform a material.
KNOWN_BAD = {("AlphaBlendModeTest", "blender-cycles"), ("TextureTransformTest", "three-gpu-pathtracer"),
             ("TextureTransformTest", "vray")}

# Hill's fit of the ACES reference and output transforms, as three.js has it.
ACES_IN = np.array([[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]])
ACES_OUT = np.array([[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]])

SRGB_TO_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750],
                        [0.0193339, 0.1191920, 0.9503041]])
WHITE = SRGB_TO_XYZ @ np.ones(3)
PIXELS_PER_DEGREE = 67.0
OVERSAMPLING = 2  # of ours against the goldens as they are stored
OPAQUE = 0.99  # of alpha


def stop(message):
    sys.exit(f"compare_goldens: error: {message}")


def read(path):
    picture = oiio.ImageInput.open(str(path))
    if not picture:
        stop(f"{path}: cannot be read: {oiio.geterror()}")
    pixels = picture.read_image(oiio.FLOAT)
    picture.close()
    return pixels


def display(radiance):
    x = np.maximum(radiance, 0) / 0.6 @ ACES_IN.T
    x = (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081)
    return np.clip(x @ ACES_OUT.T, 0, 0.9999) ** (1 / 2.2)


def shrink(pixels, factor):
    h, w, c = pixels.shape
    return pixels[:h // factor * factor, :w // factor * factor].reshape(
        h // factor, factor, w // factor, factor, c).mean(axis=(1, 3))


def rmse(a, b, mask):
    return float(np.sqrt(np.mean((a - b)[mask] ** 2)))


def eroded(mask):
    padded = np.pad(mask, 1, mode="edge")
    h, w = mask.shape
    return np.logical_and.reduce([padded[y:y + h, x:x + w] for y in range(3) for x in range(3)])


# FLIP: section and equation numbers are Andersson et al.'s.

def filtered(plane, kernel, axis):
    radius = len(kernel) // 2
    width = [(radius, radius) if k == axis else (0, 0) for k in range(2)]
    padded = np.pad(plane, width, mode="edge")
    return np.apply_along_axis(lambda line: np.convolve(line, kernel[::-1], mode="valid"), axis, padded)


def linear(srgb):
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def ycxcz(rgb):
    xyz = rgb @ SRGB_TO_XYZ.T / WHITE
    return np.stack([116 * xyz[..., 1] - 16, 500 * (xyz[..., 0] - xyz[..., 1]), 200 * (xyz[..., 1] - xyz[..., 2])], -1)


def rgb_of_ycxcz(colour):
    y = (colour[..., 0] + 16) / 116
    xyz = np.stack([y + colour[..., 1] / 500, y, y - colour[..., 2] / 200], -1)
    return xyz * WHITE @ np.linalg.inv(SRGB_TO_XYZ).T


def hunt_lab(rgb):
    xyz = rgb @ SRGB_TO_XYZ.T / WHITE
    delta = 6 / 29
    f = np.where(xyz > delta ** 3, np.cbrt(xyz), xyz / (3 * delta ** 2) + 4 / 29)
    lightness = 116 * f[..., 1] - 16
    return np.stack([lightness, 0.01 * lightness * 500 * (f[..., 0] - f[..., 1]),
                     0.01 * lightness * 200 * (f[..., 1] - f[..., 2])], -1)


def seen(srgb):
    """What the eye resolves (section 4.1.1): contrast sensitivity by channel, sums of Gaussians in degrees."""
    opponent = ycxcz(linear(srgb))
    radius = int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi ** 2)) * PIXELS_PER_DEGREE))
    degrees = np.arange(-radius, radius + 1) / PIXELS_PER_DEGREE
    planes = []
    for channel, lobes in enumerate((((1, 0.0047),), ((1, 0.0053),), ((34.1, 0.04), (13.5, 0.025)))):
        result, total = 0, 0
        for a, b in lobes:
            kernel = np.exp(-np.pi ** 2 * degrees ** 2 / b)
            weight = a * np.sqrt(np.pi / b)
            result = result + weight * filtered(filtered(opponent[..., channel], kernel, 0), kernel, 1)
            total += weight * kernel.sum() ** 2
        planes.append(result / total)
    return hunt_lab(np.clip(rgb_of_ycxcz(np.stack(planes, -1)), 0, 1))


def hyab(a, b):
    d = a - b
    return np.abs(d[..., 0]) + np.hypot(d[..., 1], d[..., 2])


def features(srgb):
    """Edges and points of the luminance (section 4.2)."""
    luminance = (ycxcz(linear(srgb))[..., 0] + 16) / 116
    deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE
    radius = int(np.ceil(3 * deviation))
    x = np.arange(-radius, radius + 1)
    gaussian = np.exp(-x ** 2 / (2 * deviation ** 2))
    found = []
    for kernel in (-x * gaussian, (x ** 2 / deviation ** 2 - 1) * gaussian):
        kernel = np.where(kernel < 0, kernel / -kernel[kernel < 0].sum(), kernel / kernel[kernel > 0].sum())
        across = gaussian / gaussian.sum()
        gx = filtered(filtered(luminance, kernel, 1), across, 0)
        gy = filtered(filtered(luminance, kernel, 0), across, 1)
        found.append(np.hypot(gx, gy))
    return found


def flip(reference, test):
    power, cut, share = 0.7, 0.4, 0.95
    largest = hyab(hunt_lab(np.array([0.0, 1, 0])), hunt_lab(np.array([0.0, 0, 1]))) ** power
    colour = hyab(seen(reference), seen(test)) ** power
    colour = np.where(colour < cut * largest, share / (cut * largest) * colour,
                      share + (colour - cut * largest) / (largest - cut * largest) * (1 - share))
    differences = [np.abs(a - b) for a, b in zip(features(reference), features(test))]
    feature = (np.maximum(*differences) / np.sqrt(2)) ** 0.5
    return np.clip(colour, 0, 1) ** (1 - np.clip(feature, 0, 1))


def render(assets, scenario, width, height, options, picture):
    numbers = ",".join(str(x) for x in scenario["eye"] + scenario["target"])
    command = [PROGRAM, "render", assets / scenario["model"], "--size", f"{width}x{height}", f"--look-at={numbers}",
               "--fov", str(scenario["vfov_deg"]), "--env", assets / "env/lightroom_14b_reconstructed.hdr", "--spp",
               str(options.spp), "--layering", options.layering, "--quiet", "-o", picture]
    done = subprocess.run([str(x) for x in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return done.stderr.strip()
    return ""


def compare(assets, scenario, options, folder):
    goldens = {name: read(assets / entry["png"]) for name, entry in scenario["goldens"].items()}
    height, width = next(iter(goldens.values())).shape[:2]
    factor = max(1, width // options.width)
    name = scenario["name"].removeprefix("khronos-")
    picture = Path(folder) / f"{name}.exr"
    problem = render(assets, scenario, width * OVERSAMPLING, height * OVERSAMPLING, options, picture)
    if problem:
        print(f"| {name} | {problem} | | | | | |")
        return
    ours = shrink(shrink(display(read(picture)[..., :3]), OVERSAMPLING), factor)
    theirs = {k: shrink(v, factor) for k, v in goldens.items()}
    covered = {k: v[..., 3] >= OPAQUE if v.shape[2] > 3 else np.ones(v.shape[:2], bool) for k, v in theirs.items()}
    for blank in [k for k, v in covered.items() if v.mean() < 0.01]:
        print(f"| {name} | {blank} | nothing is opaque in this golden | | | | |")
        del theirs[blank], covered[blank]
    mask = eroded(np.logical_and.reduce(list(covered.values())))
    theirs = {k: np.where(mask[..., None], v[..., :3], 0) for k, v in theirs.items()}
    ours = np.where(mask[..., None], ours, 0)

    def distances(a, b):
        return rmse(a, b, mask), float(flip(a, b)[mask].mean())

    usable = [k for k in theirs if (name, k) not in KNOWN_BAD]
    pairs = [distances(theirs[a], theirs[b]) for a, b in itertools.combinations(usable, 2)]
    closest = [min(column) for column in zip(*pairs)]
    for golden, pixels in theirs.items():
        found = distances(pixels, ours)
        verdict = "known to be wrong" if golden not in usable else "" if not closest else ", ".join(
            f"{measure} {'within' if ours_off <= pair else 'outside'}"
            for measure, ours_off, pair in zip(("RMSE", "FLIP"), found, closest))
        columns = [f"{x:.4f}" for x in found] + ([f"{x:.4f}" for x in closest] or ["one golden", ""])
        print(f"| {name} | {golden} | {' | '.join(columns)} | {verdict} |", flush=True)
    if options.output:
        sheet = np.concatenate([np.where(mask[..., None], p, 0.5) for p in (ours, *theirs.values())], axis=1)
        out = oiio.ImageOutput.create(f"{name}.png")
        out.open(str(Path(folder) / f"{name}.png"), oiio.ImageSpec(sheet.shape[1], sheet.shape[0], 3, oiio.UINT8))
        out.write_image(np.ascontiguousarray(sheet, np.float32))
        out.close()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("assets", type=Path)
    parser.add_argument("scenarios", nargs="*")
    parser.add_argument("--spp", type=int, default=64, help="16 such pixels make one that is compared, at the usual width")
    parser.add_argument("--width", type=int, default=256, help="of the pictures compared, about")
    parser.add_argument("--layering", choices=("conserving", "specification"), default="conserving", help="wavepath's")
    parser.add_argument("-o", "--output", type=Path, help="folder for pictures")
    options = parser.parse_intermixed_args()
    listing = options.assets / "goldens/goldens.json"
    if not listing.is_file():
        stop(f"{listing}: no such file; name the folder of assets")
    if not PROGRAM.is_file():
        stop(f"{PROGRAM}: no such file; build wavepath first")
    known = {s["name"].removeprefix("khronos-"): s for s in json.loads(listing.read_text())["scenarios"]}
    wanted = options.scenarios or SCENARIOS
    unknown = [name for name in wanted if name not in known]
    if unknown:
        stop(f"{', '.join(unknown)}: no such scenario; there are {', '.join(known)}")
    print("| scenario | golden | RMSE | FLIP | closest two: RMSE | FLIP | |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.output or scratch
        Path(folder).mkdir(parents=True, exist_ok=True)
        for name in wanted:
            compare(options.assets, known[name], options, folder)


if __name__ == "__main__":
    main()
