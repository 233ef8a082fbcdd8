#!/usr/bin/env python3
"""Tabulates the directional albedo of the specular layer: writes kernels/materials/layer_albedo_table.h.

    scripts/layer_albedo.py

Takes a minute and needs the package python3-numpy. kernels/materials/layer_albedo.cl reads the table, and
tests/kernels/layer_albedo_test.cpp compares what it reads with a quadrature of its own.

With Schlick's weight w = (1 - wo.m)^5 and D V of glTF 2.0 (appendix B.3.2) over the hemisphere of wi

    A = integral of D V (1 - w) cos,   B = integral of D V w cos,   M = 1 - A - B,

so that the layer of reflectances f0 and f90 has the albedo f0 A + f90 B, and M is what microfacets lose. The table holds
sqrt(M) and B - (1 - mu)^5 on a grid of x = .8 sqrt(mu (1 + alpha) / (mu + alpha)) + .2 mu and roughness = sqrt(alpha), which
opens the corner where mu and alpha are both small. Nodes are moved by half of the error that bilinear interpolation makes
between them. Behind the last x of a row stand the means over the projected hemisphere of what the row interpolates.
"""
import pathlib

import numpy as np

TABLE = pathlib.Path(__file__).resolve().parents[1] / "kernels" / "materials" / "layer_albedo_table.h"
COSINES = 63  # nodes in x; the means make 64 words a row
ROUGHNESSES = 64
LEAST_ALPHA = 1e-3  # MIRROR_ALPHA of kernels/materials/ggx.cl
WORD = 65535


def double_exponential(count):
    """Nodes and weights on [0, 1] [Takahasi & Mori 1974]."""
    t = np.linspace(-3.2, 3.2, count)
    s = 0.5 * np.pi * np.sinh(t)
    return 0.5 * (1 + np.tanh(s)), (t[1] - t[0]) * 0.25 * np.pi * np.cosh(t) / np.cosh(s) ** 2


NODES, WEIGHTS = double_exponential(56)


def missing_and_grazing(mu, alpha):
    """M and B by quadrature over the normals visible from wo [Heitz 2018], in polar angles theta and phi of m.

    theta is cut where wi or m leave the hemisphere they must lie in at phi = 0 or pi, phi where they do at theta.
    """
    sine = np.sqrt(1 - mu * mu)
    angle = np.arccos(mu)
    root = np.sqrt(alpha**2 + (1 - alpha**2) * mu * mu)
    cuts = [1e-12, (np.pi / 2 - angle) / 2, (np.pi / 2 + angle) / 2, np.pi / 2 - angle, alpha / 20, alpha,
            np.pi / 2 - 1e-13]
    cuts = sorted(np.clip(cuts, 1e-12, np.pi / 2 - 1e-13))
    missing = grazing = 0.0
    for low, high in zip(cuts[:-1], cuts[1:]):
        if high - low < 1e-13:
            continue
        log_low, log_high = np.log(np.tan([low, high]))
        tangent = np.exp(log_low + (log_high - log_low) * NODES)
        c = 1 / np.sqrt(1 + tangent**2)
        s = tangent * c
        distribution = alpha**2 / (np.pi * (alpha**2 * c * c + s * s) ** 2)
        # D_v = G1(wo) wo.m D / mu, G1 / mu = 2 / (mu + root); phi and -phi count alike
        density = distribution * s * s * c * (log_high - log_low) * WEIGHTS * 4 / (mu + root)
        above = np.arccos(np.clip((mu / (2 * c) - mu * c) / (sine * s), -1, 1))
        seen = np.maximum(np.arccos(np.clip(-mu * c / (sine * s), -1, 1)), above)
        missing += np.sum(density * (sine * s * (np.sin(seen) - np.sin(above)) + mu * c * (seen - above)))
        cos_m = np.clip(sine * s[:, None] * np.cos(np.outer(above, NODES)) + (mu * c)[:, None], 0, 1)
        cos_i = np.clip(2 * cos_m * c[:, None] - mu, 1e-30, 1)
        root_i = np.sqrt(alpha**2 + (1 - alpha**2) * cos_i**2)
        together = cos_i * root + mu * root_i
        weight = np.outer(density * above, WEIGHTS) * cos_m
        # 1 - G2 / G1 without its cancellation, and G2 / G1 [Heitz 2014, eq. 99]
        missing += np.sum(weight * mu * alpha**2 * (1 - cos_i**2) / ((root_i + cos_i) * together))
        grazing += np.sum(weight * cos_i * (mu + root) / together * (1 - cos_m) ** 5)
    return missing, grazing


def coordinate(mu, alpha):
    return 0.8 * np.sqrt(mu * (1 + alpha) / (mu + alpha)) + 0.2 * mu


def cosine_at(x, alpha):
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if coordinate(middle, alpha) < x else (low, middle)
    return min(max(low, 1e-12), 1 - 1e-12)


def alpha_at(v):
    return (np.sqrt(LEAST_ALPHA) + (1 - np.sqrt(LEAST_ALPHA)) * v) ** 2


def halfway(nodes):
    """Bilinear interpolation to twice the resolution."""
    for axis in (0, 1):
        nodes = np.moveaxis(nodes, axis, 0)
        fine = np.repeat(nodes, 2, axis=0)[:-1]
        fine[1::2] = (nodes[:-1] + nodes[1:]) / 2
        nodes = np.moveaxis(fine, 0, axis)
    return nodes


def settled(fine):
    """Nodes from values at twice their resolution: moved until errors at nodes and half-way cancel."""
    nodes = fine[::2, ::2].copy()
    for _ in range(20):
        error = np.pad(halfway(nodes) - fine, 1, mode="edge")
        height, width = fine.shape
        around = [error[i:i + height:2, j:j + width:2] for i in range(3) for j in range(3)]
        nodes -= (np.minimum.reduce(around) + np.maximum.reduce(around)) / 4
    return nodes


def means_of(row, alpha, power, added):
    """2 integral of interpolated row ** power + added(mu) over mu dmu."""
    mu = (np.arange(1 << 14) + 0.5) / (1 << 14)
    values = np.interp(coordinate(mu, alpha) * (row.size - 1), np.arange(row.size), row)
    return 2 * np.mean((values**power + added(mu)) * mu)


def main():
    fine = np.zeros((2 * ROUGHNESSES - 1, 2 * COSINES - 1, 2))
    for j in range(fine.shape[0]):
        alpha = alpha_at(j / (fine.shape[0] - 1))
        for i in range(fine.shape[1]):
            mu = cosine_at(i / (fine.shape[1] - 1), alpha)
            missing, grazing = missing_and_grazing(mu, alpha)
            fine[j, i] = np.sqrt(missing), grazing - (1 - mu) ** 5
    roots = np.clip(settled(fine[..., 0]), 0, 1)
    grazing = settled(fine[..., 1])
    lines = []
    for j in range(ROUGHNESSES):
        alpha = alpha_at(j / (ROUGHNESSES - 1))
        mean_missing = means_of(roots[j], alpha, 2, lambda mu: 0)
        mean_grazing = means_of(grazing[j], alpha, 1, lambda mu: (1 - mu) ** 5)
        left = np.round(WORD * np.append(roots[j], np.sqrt(mean_missing))).astype(int)
        right = np.round(WORD * np.append(-grazing[j], 1 / 21 - mean_grazing) * 63 / 64 + WORD / 64).astype(int)
        words = [f"0x{(a << 16 | b):08x}" for a, b in zip(left, right)]
        lines += [", ".join(words[k : k + 16]) + "," for k in range(0, len(words), 16)]
    text = "\n".join(lines)
    TABLE.write_text(f"""// Written by scripts/layer_albedo.py, which says what stands here; read by layer_albedo.cl.
#pragma once

#define LAYER_COSINES {COSINES}
#define LAYER_ROUGHNESSES {ROUGHNESSES}

// clang-format off
constant uint layer_albedos[LAYER_ROUGHNESSES * (LAYER_COSINES + 1)] = {{
{text}
}};
// clang-format on
""")


if __name__ == "__main__":
    main()
