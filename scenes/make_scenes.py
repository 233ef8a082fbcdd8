#!/usr/bin/env python3
"""Writes scenes/NAME/scene.gltf for the scenes that are small enough to keep in the repository.

    make_scenes.py            write them beside this file
    make_scenes.py --check    compare with what is there; exit 1 and name the files that differ

Units: metres and linear RGB radiance; +Y is up. Everything is diffuse (KHR_materials_specular with specularFactor 0)
unless `metallic` or `boundary` is said. Lights emit from the front of their triangles only; all else is seen from both sides.
The same input gives the same bytes on every machine: vertices are rounded to float32, camera angles to 12 digits.
"""
import base64
import json
import math
import re
import struct
import sys
from pathlib import Path

from shapes import ball, cuboid, rectangle

FLOAT, UNSIGNED_SHORT, ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 5126, 5123, 34962, 34963  # glTF 2.0's codes


# --- materials and cameras ---------------------------------------------------------------------------------------------


def diffuse(name, color, emission=None):
    material = {
        "name": name,
        "doubleSided": emission is None,
        "pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0},
        "extensions": {"KHR_materials_specular": {"specularFactor": 0.0}},
    }
    if emission is not None:
        strength = max(1.0, *emission)
        material["emissiveFactor"] = [e / strength for e in emission]
        if strength > 1.0:
            material["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
    return material


def lamp(name, radiance):
    return diffuse(name, (0.0,) * 3, (radiance,) * 3)


def metal(name, color, roughness):
    return {
        "name": name,
        "doubleSided": True,
        "pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 1.0, "roughnessFactor": roughness},
    }


def boundary(name, sigma_a, sigma_s=(0.0,) * 3, g=0.0, ior=1.0):
    """A smooth boundary, index-matched unless `ior` is said, around a medium; coefficients in 1/m (docs/media.md)."""
    surface = {"metallicFactor": 0.0} if ior == 1.0 else {"metallicFactor": 0.0, "roughnessFactor": 0.0}
    return {
        "name": name,
        "pbrMetallicRoughness": surface,
        "extensions": {
            "KHR_materials_ior": {"ior": ior},
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_volume": {"thicknessFactor": 1.0},
        },
        "extras": {"wavepath_medium": {"sigma_a": list(sigma_a), "sigma_s": list(sigma_s), "g": g}},
    }


def camera(eye, y_fov, pitch=0.0):
    """Looks along -Z, tilted by `pitch` degrees about +X; y_fov in degrees, square pictures."""
    half = math.radians(pitch) / 2
    node = {"name": "camera", "camera": 0, "translation": list(eye)}
    if pitch:
        node["rotation"] = [round(math.sin(half), 12), 0.0, 0.0, round(math.cos(half), 12)]
    lens = {"yfov": round(math.radians(y_fov), 12), "aspectRatio": 1.0, "znear": 0.001}
    return node, {"name": "camera", "type": "perspective", "perspective": lens}


# --- the scenes: (meshes as (name, shape, material), camera) -----------------------------------------------------------

WHITE = diffuse("white", (0.73,) * 3)
RED = diffuse("red", (0.63, 0.065, 0.05))
GREEN = diffuse("green", (0.14, 0.45, 0.091))
ROOM_CAMERA = camera((0.0, 0.0, 3.9), 39.3)


def room():
    """A box of edge 2 m, open towards the camera."""
    return [
        ("floor", rectangle((-1, -1, 1), (1, -1, 1), (1, -1, -1), (-1, -1, -1)), WHITE),
        ("ceiling", rectangle((-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, 1, 1)), WHITE),
        ("back", rectangle((-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)), WHITE),
        ("left", rectangle((-1, -1, 1), (-1, -1, -1), (-1, 1, -1), (-1, 1, 1)), RED),
        ("right", rectangle((1, -1, -1), (1, -1, 1), (1, 1, 1), (1, 1, -1)), GREEN),
    ]


def tall_box():
    return "tall box", cuboid((-0.35, -0.4, -0.3), (0.3, 0.6, 0.3), -18.0), WHITE


def cornell_box():
    light = rectangle((-0.25, 0.999, -0.25), (0.25, 0.999, -0.25), (0.25, 0.999, 0.25), (-0.25, 0.999, 0.25))
    short_box = cuboid((0.35, -0.7, 0.35), (0.3, 0.3, 0.3), 18.0)
    return room() + [("light", light, lamp("light", 15.0)), ("short box", short_box, WHITE), tall_box()], ROOM_CAMERA


def box_light():
    light = cuboid((0.0, 0.979, 0.0), (0.04, 0.001, 0.04))
    return room() + [("light", light, lamp("light", 400.0)), tall_box()], ROOM_CAMERA


def mirroring_plate(center, eye, target, half_width, half_height):
    """A rectangle across X whose mirror direction takes `eye` to `target`; all three lie in the plane x = 0."""
    to_eye, to_target = (math.atan2(p[1] - center[1], p[2] - center[2]) for p in (eye, target))
    angle = (to_eye + to_target) / 2  # of the normal, from +Z towards +Y
    dy, dz = half_height * math.cos(angle), -half_height * math.sin(angle)
    y, z, w = center[1], center[2], half_width
    return rectangle((-w, y - dy, z - dz), (w, y - dy, z - dz), (w, y + dy, z + dz), (-w, y + dy, z + dz))


def veach_plates():
    eye, lamps, gray = (0.0, 1.0, 6.0), (0.0, 1.9, -1.6), diffuse("gray", (0.4,) * 3)
    meshes = [
        ("floor", rectangle((-6, -1, 6), (6, -1, 6), (6, -1, -6), (-6, -1, -6)), gray),
        ("wall", rectangle((-6, -1, -3), (6, -1, -3), (6, 6, -3), (-6, 6, -3)), gray),
    ]
    for i, roughness in enumerate((0.07, 0.16, 0.3, 0.5)):
        plate = mirroring_plate((0.0, -0.75 + 0.3 * i, 1.8 - 0.75 * i), eye, lamps, 1.6, 0.32)
        name = f"plate of roughness {roughness}"
        meshes.append((name, plate, metal(name, (0.8,) * 3, roughness)))
    for i, size in enumerate((0.02, 0.06, 0.18, 0.5)):
        radiance = 0.375 / size**2  # the four have equal power
        cube = cuboid((i - 1.5, lamps[1], lamps[2]), (0.8 * size,) * 3, 45.0)
        meshes.append((f"light {i}", cube, lamp(f"light {i}", round(radiance, 9))))
    return meshes, camera(eye, 40.0, -math.degrees(math.atan2(0.55, 6.0)))


def white_furnace():
    walls = diffuse("walls", (0.5,) * 3, (0.5,) * 3)
    return [("walls", cuboid((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), inward=True), walls)], camera((0.2, 0.1, 0.6), 60.0)


def fog_shaft():
    """Light falls through a hole in the ceiling of a room of fog."""
    hole, lamp_height = 0.15, 2.4
    walls = [mesh for mesh in room() if mesh[0] != "ceiling"]
    strips = (
        ("ceiling left", rectangle((-1, 1, -1), (-hole, 1, -1), (-hole, 1, 1), (-1, 1, 1)), WHITE),
        ("ceiling right", rectangle((hole, 1, -1), (1, 1, -1), (1, 1, 1), (hole, 1, 1)), WHITE),
        ("ceiling back", rectangle((-hole, 1, -1), (hole, 1, -1), (hole, 1, -hole), (-hole, 1, -hole)), WHITE),
        ("ceiling front", rectangle((-hole, 1, hole), (hole, 1, hole), (hole, 1, 1), (-hole, 1, 1)), WHITE),
    )
    light = rectangle(*((x, lamp_height, z) for x, z in ((-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1))))
    fog = boundary("fog", (0.02,) * 3, (0.4,) * 3, 0.3)
    return [
        *walls, *strips, tall_box(), ("light", light, lamp("light", 1500.0)),
        ("fog", cuboid((0.0, 0.0, 0.0), (1.1, 1.1, 1.1)), fog),
    ], ROOM_CAMERA


def slab():
    """A plate of thickness 1 m, optical thickness 0.1, 1, 10 in R, G, B, albedo 0.9; its sides are out of sight."""
    taus = (0.1, 1.0, 10.0)
    medium = boundary("slab", [round(0.1 * t, 6) for t in taus], [round(0.9 * t, 6) for t in taus], 0.0)
    return [("slab", cuboid((0.0, 0.0, 0.0), (400.0, 0.5, 400.0)), medium)], camera((0.0, 2.5, 0.0), 0.5, -90.0)


def studio(light_radiance):
    """A floor and a lamp above it, 2 m wide."""
    lamp_corners = ((-0.5, 2.5, -0.5), (0.5, 2.5, -0.5), (0.5, 2.5, 0.5), (-0.5, 2.5, 0.5))
    return [
        ("floor", rectangle((-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)), WHITE),
        ("light", rectangle(*lamp_corners), lamp("light", light_radiance)),
    ]


STUDIO_CAMERA = camera((0.0, 1.4, 4.0), 25.0, -14.0)


def milk():
    """A ball of a medium that scatters as milk does under a lamp."""
    medium = boundary("milk", (0.01, 0.02, 0.1), (10.0,) * 3)
    return [*studio(10.0), ("milk", ball((0.0, 0.51, 0.0), 0.5, 4), medium)], STUDIO_CAMERA


def absorbing_glass():
    """Three balls of glass that absorb more and more."""
    balls = [
        (f"glass {i}", ball((0.95 * (i - 1), 0.41, 0.0), 0.4, 4), boundary(f"glass {i}", [round(s * a, 6) for a in (5.0, 1.25, 0.25)], ior=1.5))
        for i, s in enumerate((0.0, 0.5, 1.0))
    ]
    return [*studio(20.0), *balls], camera((0.0, 1.4, 4.0), 38.0, -14.0)


def glass_of_liquid():
    """A hollow block of glass, two thirds full; the liquid reaches 1 cm into the glass."""
    glass, liquid = boundary("glass", (0.0,) * 3, ior=1.5), boundary("liquid", (2.0, 0.4, 0.1), ior=1.33)
    outer, hollow = cuboid((0.0, 0.51, 0.0), (0.4, 0.5, 0.4), 30.0), cuboid((0.0, 0.51, 0.0), (0.34, 0.44, 0.34), 30.0, inward=True)
    shell = outer[0] + hollow[0], outer[1] + [tuple(i + 8 for i in t) for t in hollow[1]]
    filling = cuboid((0.0, 0.36, 0.0), (0.35, 0.3, 0.35), 30.0)
    return [*studio(20.0), ("glass", shell, glass), ("liquid", filling, liquid)], STUDIO_CAMERA


SCENES = {
    f.__name__: f for f in (
        cornell_box, box_light, veach_plates, white_furnace, fog_shaft, slab, milk, absorbing_glass, glass_of_liquid)
}


# --- glTF --------------------------------------------------------------------------------------------------------------


def shortest(value):
    """The float32 nearest to `value`, as the shortest decimal that rounds back to it."""
    (single,) = struct.unpack("<f", struct.pack("<f", value))
    texts = (f"{single:.{digits}g}" for digits in range(1, 10))  # 9 digits always suffice
    return next(float(t) for t in texts if struct.pack("<f", float(t)) == struct.pack("<f", single)) + 0.0  # no -0.0


def unique(things):
    kept = []
    for thing in things:
        if thing not in kept:
            kept.append(thing)
    return kept


def document(meshes, camera_parts):
    """One buffer: all positions, then all indices; one accessor into each a mesh."""
    camera_node, lens = camera_parts
    materials = unique(material for _, _, material in meshes)
    positions, indices, accessors, gltf_meshes = bytearray(), bytearray(), [], []
    for name, (vertices, triangles), material in meshes:
        vertices = [tuple(shortest(c) for c in vertex) for vertex in vertices]
        accessors.append({
            "bufferView": 0, "byteOffset": len(positions), "componentType": FLOAT, "count": len(vertices), "type": "VEC3",
            "min": [min(axis) for axis in zip(*vertices)], "max": [max(axis) for axis in zip(*vertices)],
        })
        accessors.append({
            "bufferView": 1, "byteOffset": len(indices), "componentType": UNSIGNED_SHORT, "count": 3 * len(triangles),
            "type": "SCALAR",
        })
        positions += b"".join(struct.pack("<3f", *vertex) for vertex in vertices)
        indices += b"".join(struct.pack("<3H", *triangle) for triangle in triangles)
        primitive = {
            "attributes": {"POSITION": len(accessors) - 2}, "indices": len(accessors) - 1,
            "material": materials.index(material),
        }
        gltf_meshes.append({"name": name, "primitives": [primitive]})
    nodes = [{"name": name, "mesh": i} for i, (name, _, _) in enumerate(meshes)] + [camera_node]
    data = base64.b64encode(positions + indices).decode("ascii")
    return {
        "asset": {
            "version": "2.0", "generator": "wavepath scenes/make_scenes.py",
            "copyright": "The wavepath authors, Apache-2.0",
        },
        "extensionsUsed": sorted({name for material in materials for name in material.get("extensions", {})}),
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "cameras": [lens],
        "meshes": gltf_meshes,
        "materials": materials,
        "accessors": accessors,
        "bufferViews": [
            {"buffer": 0, "byteLength": len(positions), "byteStride": 12, "target": ARRAY_BUFFER},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices), "target": ELEMENT_ARRAY_BUFFER},
        ],
        "buffers": [{"byteLength": len(positions) + len(indices), "uri": f"data:application/octet-stream;base64,{data}"}],
    }


def readable(gltf):
    """Indented JSON with each list of numbers on one line."""
    text = json.dumps(gltf, indent=2)
    return re.sub(r"\[[-+.\d,\seE]*\]", lambda m: "[" + ", ".join(m.group()[1:-1].replace(",", " ").split()) + "]", text) + "\n"


def main(arguments):
    if arguments not in ([], ["--check"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    differing = []
    for name, make in SCENES.items():
        path, text = Path(__file__).resolve().parent / name / "scene.gltf", readable(document(*make()))
        if not arguments:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            differing.append(f"scenes/{name}/scene.gltf")
    if differing:
        print(f"error: {', '.join(differing)}: not what make_scenes.py writes; run scenes/make_scenes.py", file=sys.stderr)
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
