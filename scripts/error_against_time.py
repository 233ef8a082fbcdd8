#!/usr/bin/env python3
"""Draws the error of every method against its time: error_SCENE.svg and, with the numbers, error_SCENE.csv.

    scripts/error_against_time.py                            three scenes, into build/accuracy/: 40 minutes on two cores
    scripts/error_against_time.py scenes/white_furnace       one scene: a folder with scene.gltf, a .gltf or a .glb
    scripts/error_against_time.py --redraw -o docs/images    the charts again from the CSV files there, no rendering

Needs build/wavepath and the packages gnuplot-nox, python3-numpy and python3-openimageio (--redraw: gnuplot-nox alone).
Run it on an idle machine: what else runs there is in the times.

Time is `times_s.render` of the report, without start-up, loading and compiling. The error of a picture A is

    relMSE = mean((A - R)^2 / (R^2 + 0.01)) - e                  mean over pixels and channels

The reference R = (R1 + R2) / 2 comes from two `mis` renders of half its samples each, with seeds of their own. They are
independent, so e = mean(((R1 - R2) / 2)^2 / (R^2 + 0.01)) is, on average, what R's own error adds to the first term. A
point whose relMSE is below e is left out of chart and fit, with a warning: it takes more --reference-spp. R1 and R2 are
kept in build/accuracy/ under a hash of the scene's file; delete them if another file that the scene reads has changed.

A point is the median over the seeds, of time and of error. The slope of a method is that of the least-squares line
through log error over log time: -1 for independent samples of finite variance, steeper where Sobol points help or small
pictures leave the device idle; the slope against samples, printed too, does not depend on time. Where the variance is
infinite (`direct`, `direct-bsdf` in white_furnace) or rests on a few bright paths (box_light; `path` on veach_plates) a
slope is fitted all the same, but is flatter than -1 and differs from run to run: take more seeds.
"""
import argparse
import csv
import hashlib
import json
import math
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import linear_regression, median

ROOT = Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build" / "wavepath"
WORK = ROOT / "build" / "accuracy"
SCENES = [ROOT / "scenes" / name for name in ("cornell_box", "box_light", "veach_plates")]
REFERENCE_SEEDS = (1000001, 1000002)  # measured renders count from 1

# Colour (Okabe and Ito's), gnuplot's point type and dash. Methods that coincide on diffuse scenes differ in all three.
METHODS = {
    "path": ("#000000", 4, "solid"),
    "bsdf": ("#E69F00", 2, "'-'"),
    "direct": ("#D55E00", 8, "solid"),
    "direct-bsdf": ("#009E73", 1, "'-'"),
    "mis": ("#0072B2", 7, "solid"),
}


def stop(message):
    sys.exit(f"error_against_time: error: {message}")


def render(scene, size, method, spp, seed, picture):
    """Writes `picture`, an EXR, and returns the report."""
    report = picture.with_suffix(".json")
    command = [PROGRAM, "render", scene, "--size", size, "--method", method, "--spp", str(spp), "--seed", str(seed),
               "-o", picture, "--json", report, "--quiet"]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        said = run.stderr.strip().splitlines() or [f"exit code {run.returncode}"]
        stop(f"wavepath render {scene} --method {method} --spp {spp}: {said[-1].removeprefix('error: ')}")
    return json.loads(report.read_text())


def read_rgb(picture):
    import OpenImageIO  # here, since --redraw does without

    file = OpenImageIO.ImageInput.open(str(picture))  # not ImageBuf: it caches by name, and names repeat
    pixels = file.read_image(OpenImageIO.FLOAT) if file else None
    if pixels is None:
        stop(f"{picture} cannot be read: delete it and run again")
    return pixels[..., [file.spec().channelindex(channel) for channel in "RGB"]].astype(float)


def reference_half(name, scene, options, seed, folder):
    spp = options.reference_spp // 2
    digest = hashlib.sha256(scene.read_bytes()).hexdigest()[:8]
    kept = WORK / f"reference_{name}_{digest}_{options.size}_{spp}_{seed}.exr"
    if not kept.exists():
        print(f"{name}: reference, {spp} samples a pixel, seed {seed}", flush=True)
        render(scene, options.size, "mis", spp, seed, folder / "reference.exr")
        shutil.move(folder / "reference.exr", kept)
    return read_rgb(kept)


def measure(name, scene, options, folder):
    """What goes into the CSV file: facts about the run, and a row for every render."""
    first, second = (reference_half(name, scene, options, seed, folder) for seed in REFERENCE_SEEDS)
    reference = (first + second) / 2
    weight = 1 / (reference**2 + 0.01)
    own_error = float(((first - second) ** 2 / 4 * weight).mean())

    rows = []
    for repeat in range(options.seeds):
        for index, spp in enumerate(options.spp):
            seed = 1 + repeat * len(options.spp) + index  # no two pictures of a method share samples
            print(f"{name}: {spp} samples a pixel, seed {seed}", flush=True)
            for method in METHODS:
                report = render(scene, options.size, method, spp, seed, folder / "picture.exr")
                error = float(((read_rgb(folder / "picture.exr") - reference) ** 2 * weight).mean()) - own_error
                if not math.isfinite(error):
                    stop(f"{scene}: --method {method} --spp {spp} --seed {seed}: pixels that are not finite, a bug")
                rows.append({"method": method, "spp": spp, "seed": seed, "seconds": report["times_s"]["render"],
                             "relmse": error})
    device = report["device"]
    return {"scene": name, "size": options.size, "seeds": options.seeds, "reference_spp": options.reference_spp,
            "reference_relmse": own_error, "version": report["version"],
            "device": f"{device['name']}, {device['platform']} {device['driver']}"}, rows


def write_csv(table, facts, rows):
    with open(table, "w", newline="") as file:
        file.writelines(f"# {key}: {value}\n" for key, value in facts.items())
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def read_curves(table):
    """The facts, and for each method its points (samples, seconds, relMSE)."""
    lines = table.read_text().splitlines()
    facts = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    runs = {}
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        runs.setdefault((row["method"], int(row["spp"])), []).append((float(row["seconds"]), float(row["relmse"])))
    curves = {method: [] for method in METHODS}
    for (method, spp), measured in sorted(runs.items()):
        seconds, error = (median(values) for values in zip(*measured))
        if error >= float(facts["reference_relmse"]):
            curves[method].append((spp, seconds, error))
        else:
            print(f"error_against_time: warning: {facts['scene']}: {method} at {spp} samples is as near to the truth "
                  "as the reference is, and left out; use more --reference-spp", file=sys.stderr)
    return facts, {method: points for method, points in curves.items() if points}


def slope(points, x):
    logs = [(math.log(point[x]), math.log(point[2])) for point in points]
    return linear_regression(*zip(*logs)).slope if len(logs) > 1 else math.nan


def draw(table, chart):
    try:
        facts, curves = read_curves(table)
        scene, size, seeds, own_error = (facts[key] for key in ("scene", "size", "seeds", "reference_relmse"))
    except (FileNotFoundError, KeyError, TypeError, ValueError):
        stop(f"{table} is missing, or not a table that this script wrote: run it without --redraw")
    if not curves:
        stop(f"{table}: no error is above that of the reference: run again with more --reference-spp")

    print(f"\n{scene}, {size} pixels, median of {seeds}; relMSE of the reference: {float(own_error):.2g}\n\n"
          "| method | slope, time | slope, samples | samples | seconds | relMSE |\n|---|---|---|---|---|---|")
    data, plots = "", []
    for method, points in curves.items():
        spp, seconds, error = points[-1]
        print(f"| `{method}` | {slope(points, 1):.2f} | {slope(points, 0):.2f} | {spp} | {seconds:.3g} | {error:.2g} |")
        colour, symbol, dash = METHODS[method]
        label = f"{method}  {slope(points, 1):.2f}".replace("  -", "  \u2212")
        block = f"$curve{len(plots)}"
        data += f"{block} << EOD\n" + "".join(f"{x} {y}\n" for _, x, y in points) + "EOD\n"
        plots.append(f"{block} with linespoints lw 2.2 pt {symbol} dt {dash} lc rgb '{colour}' title '{label}'")

    # Independent samples have relMSE = c / time; this c takes the line through the middle of all points.
    _, xs, ys = zip(*(point for points in curves.values() for point in points))
    c = math.exp(sum(math.log(x * y) for x, y in zip(xs, ys)) / len(xs))
    title = f"{scene}, {size.replace('x', ' × ')} pixels, median of {seeds}".replace("'", "''")
    script = f"""set encoding utf8
set terminal svg size 880,520 font 'sans-serif,15' background 'white'
set title '{title}' noenhanced
set xlabel 'time of rendering [s]'
set ylabel 'relative mean squared error'
set logscale xy
set format x '%g'
set format y '10^{{%L}}'
set xrange [{min(xs) / 1.5}:{max(xs) * 1.5}]
set yrange [{min(ys) / 2}:{max(ys) * 2}]
set grid lc rgb '#EEEEEE' lw 1 lt 1
set border 3
set tics nomirror
set key outside right center Left reverse noenhanced samplen 3 spacing 1.3 title 'method, slope' left
{data}plot {c} / x with lines lw 5 lc rgb '#DDDDDD' title 'slope \u22121', {', '.join(plots)}
"""
    run = subprocess.run(["gnuplot"], input=script, capture_output=True, encoding="utf-8")
    if run.returncode != 0 or not run.stdout:
        stop(f"{table}: gnuplot cannot draw this: {' '.join(run.stderr.split())}")
    chart.write_text(run.stdout, encoding="utf-8")
    print(f"\n{chart}")


def sample_counts(text):
    if not re.fullmatch(r"[1-9]\d*(,[1-9]\d*)+", text):
        raise argparse.ArgumentTypeError(f"{text}: use two numbers of samples or more, for example 4,16,64")
    return sorted({int(count) for count in text.split(",")})


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=Path, default=SCENES, metavar="SCENE")
    parser.add_argument("-o", dest="out", type=Path, default=WORK, metavar="FOLDER", help="of SVG and CSV files")
    parser.add_argument("--size", default="128x128", metavar="WxH", help="default %(default)s")
    parser.add_argument("--spp", type=sample_counts, default="4,16,64,256,1024", metavar="N,N,...",
                        help="default %(default)s")
    parser.add_argument("--seeds", type=int, default=3, metavar="N", help="renders a point; default %(default)s")
    parser.add_argument("--reference-spp", type=int, default=16384, metavar="N", help="default %(default)s")
    parser.add_argument("--redraw", action="store_true", help="draw what the CSV files say")
    options = parser.parse_args()
    if options.seeds < 1 or options.reference_spp < 2:
        parser.error("--seeds starts at 1, --reference-spp at 2")
    return options


def check_tools(redraw):
    if not shutil.which("gnuplot"):
        stop("gnuplot is missing: apt-get install gnuplot-nox")
    if redraw:
        return
    if not PROGRAM.exists():
        stop(f"{PROGRAM} is missing: cmake --preset release && cmake --build --preset release")
    try:
        import numpy, OpenImageIO  # noqa: E401, F401
    except ImportError as error:
        stop(f"{sys.executable} has no {error.name}: apt-get install python3-numpy python3-openimageio, "
             "then run it with /usr/bin/python3")


def main():
    options = parse_arguments()
    check_tools(options.redraw)
    try:
        for folder in (WORK, options.out):
            folder.mkdir(parents=True, exist_ok=True)
        for given in options.scenes:
            scene = given / "scene.gltf" if given.is_dir() else given
            name = scene.resolve().parent.name if scene.stem == "scene" else scene.stem
            table, chart = (options.out / f"error_{name}.{suffix}" for suffix in ("csv", "svg"))
            if not options.redraw:
                with tempfile.TemporaryDirectory() as folder:
                    write_csv(table, *measure(name, scene, options, Path(folder)))
            draw(table, chart)
    except OSError as error:
        stop(f"{error.filename}: {error.strerror}: check the path")
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
