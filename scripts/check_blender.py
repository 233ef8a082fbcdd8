#!/usr/bin/env python3
"""Exports a scene from Blender, renders it with Cycles and with wavepath, and compares the pictures.

    python3.11 -m venv VENV && VENV/bin/pip install bpy OpenEXR
    VENV/bin/python scripts/check_blender.py [--wavepath build/wavepath]

Takes some minutes. The Python must be the one that PyPI's bpy is for (3.11 for Blender 4.2 to 5.0). The scene has a
floor, a cube and a polyhedron of diffuse materials, a sun and a point light: what both renderers define alike. It is
exported in both lighting modes: Standard, rendered with `--lumens-per-watt 683`, and Unitless, rendered as it is.

Both programs render SEEDS pictures. Means over 16 x 16 pixels, 48 of them with the channels, and over the whole picture are
compared by their own standard errors, with 30 degrees of freedom: two right renderers differ by 5 of them once in a thousand
runs. The errors are held below 0.2 % of a block's mean and 0.05 % of the picture's, so that a bias of 1 % in a block and of
0.25 % in the picture is seen.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import bpy
import numpy
import OpenEXR

SIZE = 64  # pixels a side
BLOCK = 16
SEEDS = 16
SAMPLES = 256  # a pixel, of each picture
LUMENS_PER_WATT = 683
ROOT = pathlib.Path(__file__).resolve().parents[1]


def diffuse(name, color):
    """A Principled BSDF without its specular layer: Lambert's."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    inputs = material.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (*color, 1)
    inputs["Roughness"].default_value = 1
    inputs["Specular IOR Level"].default_value = 0
    return material


def add_light(kind, energy, location, rotation=(0, 0, 0)):
    bpy.ops.object.light_add(type=kind, location=location, rotation=rotation)
    light = bpy.context.object.data
    light.energy = energy
    if kind == "SUN":
        light.angle = 0
    else:
        light.shadow_soft_size = 0  # glTF's are points


def make_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_plane_add(size=60)
    bpy.context.object.data.materials.append(diffuse("floor", (0.6, 0.6, 0.6)))
    bpy.ops.mesh.primitive_cube_add(size=1, location=(-0.9, 0.2, 0.5))
    bpy.context.object.data.materials.append(diffuse("red", (0.7, 0.2, 0.1)))
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2, radius=0.7, location=(0.8, 0, 0.7))
    bpy.context.object.data.materials.append(diffuse("blue", (0.1, 0.3, 0.7)))
    add_light("SUN", 2, (0, 0, 5), (0.7, 0.3, 0))
    add_light("POINT", 300, (1.5, -2, 3))
    bpy.ops.object.camera_add(location=(0, -5, 4.5), rotation=(0.9, 0, 0))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    return scene


def render_with_cycles(scene, folder):
    scene.render.engine = "CYCLES"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.samples = SAMPLES
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    cycles.max_bounces = cycles.diffuse_bounces = 64
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    pictures = []
    for seed in range(SEEDS):
        cycles.seed = seed
        scene.render.filepath = str(folder / f"cycles{seed}.exr")
        bpy.ops.render.render(write_still=True)
        pictures.append(read(scene.render.filepath))
    return pictures


def render_with_wavepath(program, scene, folder, options):
    pictures = []
    for seed in range(SEEDS):
        name = folder / f"wavepath{seed}.exr"
        subprocess.run([program, "render", scene, "-o", name, "--size", f"{SIZE}x{SIZE}", "--spp", str(SAMPLES),
                        "--seed", str(seed), "--quiet", *options], check=True)
        pictures.append(read(name))
    return pictures


def read(name):
    channels = OpenEXR.File(str(name), separate_channels=True).channels()
    return numpy.stack([channels[c].pixels for c in "RGB"], axis=-1).astype(float)


def means(pictures, block):
    """Means over blocks of pixels, one a channel, and their standard errors by the scatter between pictures."""
    n = SIZE // block
    blocks = numpy.stack([p.reshape(n, block, n, block, 3).mean(axis=(1, 3)) for p in pictures])
    return blocks.mean(axis=0), blocks.std(axis=0, ddof=1) / SEEDS ** 0.5


def compare(mode, cycles, wavepath):
    good = True
    for block, precision in ((BLOCK, 0.002), (SIZE, 0.0005)):
        a, error_a = means(cycles, block)
        b, error_b = means(wavepath, block)
        error = numpy.hypot(error_a, error_b)
        worst = numpy.abs((a - b) / error).max()
        good &= bool(worst < 5 and (error < precision * a).all())
        print(f"{mode}, blocks of {block}: wavepath / Cycles {b.mean() / a.mean():.5f}; worst {worst:.1f} standard errors; "
              f"largest error {100 * (error / a).max():.3f} % of a mean")
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--wavepath", type=pathlib.Path, default=ROOT / "build" / "wavepath")
    program = parser.parse_args().wavepath.resolve()
    scene = make_scene()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        cycles = render_with_cycles(scene, folder)
        good = True
        for mode, options in (("SPEC", ["--lumens-per-watt", str(LUMENS_PER_WATT)]), ("COMPAT", [])):
            exported = folder / f"{mode}.glb"
            bpy.ops.export_scene.gltf(filepath=str(exported), export_lights=True, export_cameras=True,
                                      export_import_convert_lighting_mode=mode)
            good &= compare(mode, cycles, render_with_wavepath(program, exported, folder, options))
    sys.exit(0 if good else "the pictures differ")


if __name__ == "__main__":
    main()
