#!/usr/bin/env python3
"""Counts the floating-point operations and bytes of global memory of every kernel, into kernels/counts.json.

    scripts/kernel_counts.py [--build DIR]    small renders on oclgrind with a plugin of ours (tools/oclgrind_counts.cpp);
                                              needs oclgrind, liboclgrind-dev and LLVM's headers
    scripts/kernel_counts.py --check          whether each kernel's text is the one that was counted
    scripts/kernel_counts.py --hand-counted   whether kernels/peaks count as a pencil counts them

A kernel's row is of the first of SCENES in which it works, an average over the items that the profile reports: slots
without work are among them, and what an item costs depends on the scene. `intersect` and `occlusion` have a row for
each way of tracing.
"""
import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
KERNELS = ROOT / "kernels"
TABLE = KERNELS / "counts.json"
TRACED = ("intersect", "occlusion")
SCENES = {
    "cornell_box": "scenes/cornell_box/scene.gltf --size 16x16 --spp 4 --pool 256",
    "hills": "{hills} --size 16x16 --spp 1 --pool 256 --env tests/oclgrind/sky.hdr",
    "veach_plates": "scenes/veach_plates/scene.gltf --size 16x16 --spp 1 --pool 256",
    "glass_of_liquid": "scenes/glass_of_liquid/scene.gltf --size 16x16 --spp 1 --pool 256",
    "fog_shaft": "scenes/fog_shaft/scene.gltf --size 8x8 --spp 1 --pool 256 --termination depth:8",
    "fog_shaft, branching": "scenes/fog_shaft/scene.gltf --size 4x4 --spp 1 --pool 256 --termination depth:4 "
                            "--distance mis --splits 2,2,2",
    "textures": "tests/oclgrind/textures.gltf --size 16x16 --spp 1 --pool 256 --look-at 0.1,0.1,3,0,0,0 --fov 30",
    # From afar most rays miss, and the few paths left are moved together.
    "cornell_box, from afar": "scenes/cornell_box/scene.gltf --size 24x24 --look-at 0,0,12,0,0,0 --fov 39 --spp 1 "
                              "--method bsdf --termination depth:1",
    "touching": "tests/oclgrind/touching.gltf --size 16x16 --spp 1 --pool 256",
}


def text_of(name, seen):
    """A kernel file with what it includes of ours, once each, without comments and blanks."""
    if name in seen:
        return ""
    seen.add(name)
    text = ""
    for line in (KERNELS / name).read_text().splitlines():
        line = re.sub(r"//.*", "", line).strip()
        include = re.match(r'#\s*include\s+"(.*)"', line)
        text += text_of(include[1], seen) if include else line + "\n" if line else ""
    return text


def hash_of(kernel):
    return hashlib.sha256(text_of(f"stages/{kernel}.cl", set()).encode()).hexdigest()[:16]


def kernel_names():
    return sorted(path.stem for path in (KERNELS / "stages").glob("*.cl"))


def check():
    rows = json.loads(TABLE.read_text())["kernels"]
    stale = [name for name in kernel_names() if rows.get(name, {}).get("text") != hash_of(name)]
    stale += sorted(set(rows) - set(kernel_names()))
    if stale:
        sys.exit(f"kernels/counts.json is not of these kernels as they stand: {', '.join(stale)}; "
                 "run scripts/kernel_counts.py")


def skip(packages):
    print(f"SKIPPED: to count, install {packages}")
    sys.exit()


def output_of(command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def build_plugin(folder):
    """Against the oclgrind and the LLVM that oclgrind itself is linked to."""
    if not shutil.which("oclgrind") or not Path("/usr/include/oclgrind/Plugin.h").exists():
        skip("oclgrind and liboclgrind-dev")
    libraries = re.findall(r"=> (\S*/lib(?:oclgrind-|LLVM)\S*)",
                           output_of(["ldd", "/usr/lib/oclgrind/liboclgrind-rt.so"]))
    version = re.search(r"libLLVM\D*(\d+)", " ".join(libraries))[1]
    headers = Path(f"/usr/lib/llvm-{version}/include")
    if not (headers / "llvm-c/Core.h").exists():
        skip(f"llvm-{version}-dev")
    plugin = folder / "counts.so"
    subprocess.run(["c++", "-std=c++17", "-O2", "-shared", "-fPIC", "-fno-rtti", "-isystem", headers,
                    ROOT / "tools/oclgrind_counts.cpp", "-o", plugin, *libraries], check=True)
    return plugin


def run_counted(plugin, folder, command):
    """Runs a command on oclgrind; returns the counts of its launches, in order."""
    counts = folder / "counts"
    counts.unlink(missing_ok=True)
    environment = os.environ | {"WAVEPATH_COUNTS": str(counts), "XDG_CACHE_HOME": str(folder / "cache"),
                                "OCLGRIND_BUILD_OPTIONS": f"-cl-opt-disable -disable-llvm-passes -I{KERNELS}",
                                "OCLGRIND_PLUGINS": str(plugin)}
    environment.pop("OCL_ICD_VENDORS", None)
    subprocess.run(command, check=True, env=environment, cwd=ROOT, stdout=subprocess.DEVNULL)
    return [json.loads(line) for line in counts.read_text().splitlines()]


def count_scene(plugin, folder, build, arguments):
    """(its way of tracing, {kernel: (flops, bytes) an item}) of a render."""
    report_file = folder / "report.json"
    launches = run_counted(plugin, folder, [
        "oclgrind", "--global-mem-size", "1073741824", build / "wavepath", "render", *arguments.split(),
        "-o", folder / "picture.exr", "--json", report_file, "--quiet"])
    profile = json.loads(report_file.read_text())["profile"]
    rows = {}
    for row in profile["kernels"]:
        # The launches before those of the report only load the kernels.
        counted = [launch for launch in launches if launch["kernel"] == row["kernel"]][-row["launches"]:]
        if row["items"] > 0:
            rows[row["kernel"]] = tuple(round(sum(launch[key] for launch in counted) / row["items"], 2)
                                        for key in ("flops", "bytes"))
    return profile["tracing"], rows


def count_all(build):
    kernels = {name: {"text": hash_of(name), "counts": []} for name in kernel_names()}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        plugin = build_plugin(folder)
        hills = folder / "hills.glb"
        subprocess.run([build / "make_terrain", hills, "150"], check=True, stdout=subprocess.DEVNULL)
        for scene, arguments in SCENES.items():
            tracing, rows = count_scene(plugin, folder, build, arguments.format(hills=hills))
            print(f"{scene}: {len(rows)} kernels, {tracing}", flush=True)
            for kernel, (flops, size) in rows.items():
                known = kernels[kernel]["counts"]
                if kernel in TRACED:
                    if all(row["tracing"] != tracing for row in known):
                        known.append({"scene": scene, "tracing": tracing, "flops": flops, "bytes": size})
                elif not known:
                    known.append({"scene": scene, "flops": flops, "bytes": size})
    missing = [name for name, row in kernels.items() if not row["counts"]]
    if missing:
        sys.exit(f"no scene launches {', '.join(missing)}")
    version = re.search(r"Oclgrind ([\d.]+)", output_of(["oclgrind", "--version"]))[1]
    TABLE.write_text(json.dumps({"counted_with": f"oclgrind {version}", "kernels": kernels}, indent=1) + "\n")


# oclgrind-kernel's input: file, kernel, items, work-group, then an argument a line. Expected: (flops, bytes) in all.
HAND_COUNTED = {
    "triad": ("triad.cl", "triad\n64 1 1\n16 1 1\n<size=4 float>\n0.5\n" + 3 * "<size=256 float fill=1>\n",
              (2 * 64, 12 * 64)),
    "fma_chains": ("fma_chains.cl", "fma_chains\n4 1 1\n4 1 1\n<size=4 float>\n0.5\n<size=4 float>\n1\n"
                                    "<size=128 float fill=0>\n", (4 * 8 * (2 * 8 * 512 + 7), 4 * 8 * 4)),
}


def check_hand_counted():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        plugin = build_plugin(folder)
        for kernel, (file, rest, expected) in HAND_COUNTED.items():
            simulation = folder / f"{kernel}.sim"
            simulation.write_text(f"{KERNELS / 'peaks' / file}\n{rest}")
            launch, = run_counted(plugin, folder, ["oclgrind-kernel", "--plugins", plugin, simulation])
            if (launch["flops"], launch["bytes"]) != expected:
                sys.exit(f"{kernel}: counted {launch}, by hand (flops, bytes) = {expected}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="where wavepath was built")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--hand-counted", action="store_true")
    arguments = parser.parse_args()
    if arguments.check:
        check()
    elif arguments.hand_counted:
        check_hand_counted()
    else:
        count_all(arguments.build.resolve())


if __name__ == "__main__":
    main()
