"""Shapes for make_scenes.py: (vertices, triangles), counter-clockwise from the front."""
import math


def rectangle(*corners):
    """Four corners, counter-clockwise from the front."""
    return list(corners), [(0, 1, 2), (0, 2, 3)]


def cuboid(center, half, degrees=0.0, inward=False):
    """A closed box, turned by `degrees` about +Y; its front is the outside, or with `inward` the inside."""
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    vertices = []
    for corner in range(8):
        x, y, z = (h if corner >> axis & 1 else -h for axis, h in enumerate(half))
        vertices.append((center[0] + cos * x + sin * z, center[1] + y, center[2] - sin * x + cos * z))
    triangles = []
    for axis in range(3):
        u, v, w = 1 << (axis + 1) % 3, 1 << (axis + 2) % 3, 1 << axis
        triangles += [(0, v, u + v), (0, u + v, u)]              # the face towards -axis
        triangles += [(w, w + u, w + u + v), (w, w + u + v, w + v)]  # and the one opposite
    if inward:
        triangles = [(a, c, b) for a, b, c in triangles]
    return vertices, triangles


def ball(center, radius, subdivisions):
    """An icosphere, its corners on the sphere."""
    t = (1.0 + math.sqrt(5.0)) / 2.0
    vertices = [(s, u * t, 0.0) for u in (1, -1) for s in (-1, 1)]
    vertices = [v[k:] + v[:k] for k in (0, 2, 1) for v in vertices]
    length = math.sqrt(1.0 + t * t)
    vertices = [tuple(c / length for c in v) for v in vertices]
    edge2 = 4.0 / (length * length)

    def near(i, j):
        return abs(sum((a - b) ** 2 for a, b in zip(vertices[i], vertices[j])) - edge2) < 1e-9

    def outward(i, j, k):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = vertices[i], vertices[j], vertices[k]
        return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx) > 0

    triangles = [
        (i, j, k) if outward(i, j, k) else (i, k, j)
        for i in range(12) for j in range(i) for k in range(j) if near(i, j) and near(j, k) and near(i, k)
    ]
    for _ in range(subdivisions):
        middles, finer = {}, []

        def middle(i, j):
            key = (min(i, j), max(i, j))
            if key not in middles:
                total = [a + b for a, b in zip(vertices[i], vertices[j])]
                norm = math.sqrt(sum(c * c for c in total))
                vertices.append(tuple(c / norm for c in total))
                middles[key] = len(vertices) - 1
            return middles[key]

        for i, j, k in triangles:
            ij, jk, ki = middle(i, j), middle(j, k), middle(k, i)
            finer += [(i, ij, ki), (j, jk, ij), (k, ki, jk), (ij, jk, ki)]
        triangles = finer
    return [tuple(c + radius * x for c, x in zip(center, v)) for v in vertices], triangles
