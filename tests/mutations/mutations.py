#!/usr/bin/env python3
"""Breaks the kernels on purpose, one way at a time, and asks whether a test notices.

    tests/mutations/mutations.py BUILD/tests/wavepath_tests [NAME ...]
    tests/mutations/mutations.py --check    only whether every text still stands in its file, once

The test program reads its kernels from the folder that WAVEPATH_KERNELS names, so nothing is rebuilt. Prints a table;
fails if a mutation survives, or if a test fails on kernels that nobody broke.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

LONGEST_RUN = 600  # [s]
KERNELS = pathlib.Path(__file__).resolve().parents[2] / "kernels"

# name, file, text, its replacement, tests that must notice
MUTATIONS = [
    ("missing cosine at the receiver", "materials/lambert.cl",
     "return max(wi.z, 0.0f) * INV_PI_F;  // f_r cos for albedo 1", "return wi.z > 0.0f ? INV_PI_F : 0.0f;",
     "Irradiance.OfATriangleLight"),
    ("missing cosine at the light", "sampling/mis.cl",
     "return pdf_a * distance2 / cos_light;", "return pdf_a * distance2;",
     "Irradiance.OfATriangleLight"),
    ("light counted twice", "stages/shade_emission.cl",
     "weight = pdf_w == PDF_CERTAIN ? 1.0f : share;", "weight = 1.0f;",
     "AreaLight.EmitsBothWaysWhenDoubleSided"),
    ("light not seen by the camera", "stages/shade_emission.cl",
     "weight = pdf_w == PDF_CERTAIN ? 1.0f : share;", "weight = share;",
     "Furnace.StopsAtTheDepthAsked"),
    ("roulette without 1/q", "stages/roulette_compact.cl",
     "ends ? 1.0f : 1.0f / survival", "1.0f",
     "Furnace.RouletteHasThePredictedVariance"),
    ("depth off by one", "stages/sample_indirect.cl",
     "scattering < params.max_scatterings", "scattering <= params.max_scatterings",
     "Furnace.StopsAtTheDepthAsked"),
    ("light samples one scattering too deep", "stages/direct_light.cl",
     "scattering < params.max_scatterings", "scattering <= params.max_scatterings",
     "Furnace.StopsAtTheDepthAsked"),
    ("every light as probable as the others", "lights/area_light.cl",
     "light->pmf / light->area, distance2", "1.0f / (4.0f * light->area), distance2",
     "Agreement.OfLightChoices"),
    ("no light choice in the mis weight", "stages/shade_emission.cl",
     "power_heuristic(pdf_w, light_pdf_w)", "power_heuristic(pdf_w, light_pdf_w / lights[(int)row].pmf)",
     "Agreement.OfLightChoices"),
    ("result x 1.005", "stages/accumulate.cl",
     "load3(PLANE(radiances, RADIANCE_R), stride, slot),\n        load3(PLANE(throughputs",
     "scale3(load3(PLANE(radiances, RADIANCE_R), stride, slot), 1.005f),\n        load3(PLANE(throughputs",
     "Irradiance.OfATriangleLight"),
    ("light emits from its back", "geometry/interaction.cl",
     "front || material->double_sided ? as_uint", "1 ? as_uint",
     "AreaLight.EmitsFromItsFrontOnly"),
    ("lamps in fog show another point", "lights/area_light.cl",
     "s.at.u = by_solid_angle ? at.u : s.at.u;", "s.at.u = by_solid_angle ? 1.0f - at.u - at.v : s.at.u;",
     "EmissionTextures.LightByWhatTheyShow"),
    ("half of a seen triangle", "lights/solid_angle.cl",
     "0.25f * INV_PI_F * u.u", "0.125f * INV_PI_F * u.u",
     "AreaLight.BySolidAngleMeansAreThoseOfLambertAndOneTriangleHasNoVariance"),
    ("densities by area beside light points by solid angle", "lights/area_light.cl",
     "return is_seen_well(seen) ? light->pmf / seen.solid_angle : by_area;", "return by_area;",
     "AreaLight.BySolidAngleMeansAreThoseOfLambertAndOneTriangleHasNoVariance"),
    ("the outermost index of nested glass", "media/medium_stack.cl",
     "for (uint shift = 32; shift > 0; shift -= 8)", "for (uint shift = 8; shift <= 32; shift += 8)",
     "Dielectric.BodiesInOneAnotherHaveTheirOwnIndices"),
    ("streams forget where rays start", "geometry/ray_stream.cl",
     "if (STARTS_BEHIND) ray->start", "if (HAS_MEDIA) ray->start",
     "Determinism.OfStreamsThatMeetAWindowOnAWall"),
    ("packets: the highest of equal ids", "geometry/ray_packet.cl",
     "hit & (t < first.t)", "hit & (t <= first.t)", "RayPacket.TracesAsRaysAlone"),
    ("packets: the triangle they start behind again", "geometry/ray_packet.cl",
     "id > start_primitive", "id >= start_primitive", "RayPacket.TracesAsRaysAlone"),
    ("packets: what lies behind forgets what was nearer", "geometry/ray_packet.cl",
     "select(t, first.t, nearer), near)", "t, near)", "RayPacket.TracesAsRaysAlone"),
    ("packets: slots without a ray are traced", "stages/intersect.cl",
     "return !(HAS_SPLITS && PLANE(hits, HIT_T)[slot] < 0.0f);", "return 1;",
     "Determinism.OfPacketsAndSingleRays"),
    ("packets: nothing known lies behind", "stages/intersect.cl",
     "            behind = *next;", "            behind = hit;",
     "Determinism.OfPacketsAndSingleRays"),
    ("packets: connections of every lane arrive", "stages/occlusion.cl",
     "if ((blocked >> k & 1u) == 0)", "if (k >= 0)",
     "Determinism.OfPacketsAndSingleRays"),
    ("rays start on their surface", "geometry/interaction.cl",
     "#define RAY_OFFSET 0x1p-20f", "#define RAY_OFFSET 0.0f",
     "SelfIntersection.*"),
    ("rays start far off their surface", "geometry/interaction.cl",
     "#define RAY_OFFSET 0x1p-20f", "#define RAY_OFFSET 1e-4f",
     "ThinGap.*"),
    ("edge functions of rounded products", "geometry/triangle.cl",
     "fma(a, b, -rounded) - fma(c, d, -rounded)", "a * b - rounded",
     "Bvh.NoRayThatLeavesASliverMeetsIt"),
    ("barycentrics off by a thousandth", "geometry/triangle.cl",
     "*u = edge_b * inverse", "*u = 0.999f * edge_b * inverse",
     "Bvh.HitsAreEmbrees"),
    ("aimed directions weighed without their cone", "lights/guide.cl",
     "fma(g.share, cone, (1.0f - g.share) * pdf_w)", "fma(0.0f, cone, (1.0f - g.share) * pdf_w)",
     "Guide.ChangesNoMeanOfDiffuseWalls"),
    ("directions at the cone's rim weighed as if outside", "lights/guide.cl",
     "guided | (", "(",
     "Guide.RimsOfNarrowConesWeighByTheCone"),
    ("density of a sky even within its cells", "lights/environment.cl",
     "4.0f * here / sum", "1.0f",
     "Environment.DirectionsFollowTheirDensity"),
    ("light points weighed as if no direction were aimed", "stages/direct_light.cl",
     "pdf_w = guided_pdf_w(guide, 0, s.wi, pdf_w);", "pdf_w *= 1.0f - guide.share;",
     "Guide.IrradianceOfASquareLight"),
    ("plain film sum", "stages/fold_film.cl",
     "c.lost = (t - c.sum) - y;", "c.lost = 0.0f;",
     "Film.StaysRightAtAMillionSamples"),
    ("windows folded into the first band of the film", "stages/fold_film.cl",
     "params.first_pixel - first_pixel + i;", "i;",
     "FilmBands.SameBytesWhateverOneBufferHolds"),
    ("spot falloff not squared", "lights/punctual.cl",
     "cone * cone * window", "cone * window",
     "PunctualLight.SpotFallsOffBetweenItsCones"),
    ("spots by rounded cosines", "lights/punctual.cl",
     "fma(-0.5f, dot3(chord, chord), light->spot_outer)", "(light->spot_outer - (1.0f + dot3(s.wi, shines)))",
     "Spot.*"),
    ("GGX masking left out of the density", "materials/ggx.cl",
     "/ (2.0f * (wo.z + ggx_smith_root(wo.z, alpha)))", "/ (4.0f * wo.z)",
     "MaterialInFurnace.SampledByItsLobes"),
    ("map sampled without its sine", "lights/environment.cl",
     "(0.5f * INV_PI_F * INV_PI_F) / sine", "(0.5f * INV_PI_F * INV_PI_F)",
     "Environment.OneBrightTexelLightsFromItsPlace"),
    ("extinction without absorption", "media/homogeneous.cl",
     "medium->sigma_t_r, medium->sigma_t_g, medium->sigma_t_b", "medium->sigma_s_r, medium->sigma_s_g, medium->sigma_s_b",
     "MediaSlab.AbsorbsByBeerAndLambert"),
    ("phase function turned round", "media/phase.cl",
     "g < 0.0f ? d - 1.0f : 1.0f - d", "g < 0.0f ? 1.0f - d : d - 1.0f",
     "Phase.HasTheMeanCosineAndItsSquare"),
    ("phase function turned round for light points", "media/phase.cl",
     "g < 0.0f ? 1.0f : -1.0f", "g < 0.0f ? -1.0f : 1.0f",
     "Phase.DensityKeepsItsDigits"),
    ("phase function without 1/(4 pi)", "media/phase.cl",
     "#define INV_4PI_F 0.0795774715459477f", "#define INV_4PI_F 1.0f",
     "MediaPointSource.IsScatteredOnce"),
    ("stops weigh by extinction", "media/homogeneous.cl",
     "select3(event.stops, scattering_of(medium), one)", "select3(event.stops, sigma_t, one)",
     "Homogeneous.DistancesAreUnbiasedInEveryChannel"),
    ("boundaries stop connections", "stages/connect_through_media.cl",
     "boundary < BOUNDARY_INDEX_MATCHED", "boundary < 7u",
     "MediaBoundary.AroundNothingIsNotThere"),
    ("roulette once a boundary", "stages/roulette_compact.cl",
     "primitive == HIT_BOUNDARY ? 1.0f : survival", "survival",
     "MediaBoundary.IsNoScattering"),
    ("boundaries count as scatterings", "stages/sample_indirect.cl",
     "scattering < params.max_scatterings",
     "scattering + as_uint(PLANE(path_media, MEDIUM_PASSES)[slot]) < params.max_scatterings",
     "MediaBoundary.IsNoScattering"),
    ("refraction the wrong way", "materials/dielectric.cl",
     "    const float eta = ior_i / ior_t;\n    const float sine2", "    const float eta = ior_t / ior_i;\n    const float sine2",
     "Dielectric.PaneReflectsAndTransmits"),
    ("no n^2 on refraction", "materials/dielectric.cl",
     "s.weight = s.reflects ? 1.0f : eta * eta;", "s.weight = 1.0f;",
     "Dielectric.RadianceInsideIsNSquared"),
    ("connections know no media", "stages/connect_through_media.cl",
     "mul3(value, transmittance(tau))", "value",
     "MediaPointSource.IsScatteredOnce"),
    ("holes filled", "geometry/surface_texture.cl",
     "return unit_float(hash_pair(cover->key, (uint)primitive)) < share;", "return 1;",
     "Masks.LetThroughTheShareOfTheirHoles"),
    ("one decision for all layers", "geometry/surface_texture.cl",
     "hash_pair(cover->key, (uint)primitive)", "hash_pair(cover->key, 1u)",
     "Blends.TransmitOneMinusAlphaALayer"),
    ("lights shine through their holes", "stages/direct_light.cl",
     "scale3(area.radiance, cover_of", "scale3(area.radiance, 1.0f + 0.0f * cover_of",
     "Blends.DimLightsAndWhatTheyCover"),
    ("light points see the factor of emission alone", "stages/direct_light.cl",
     "if (HAS_EMISSION_TEXTURES)\n", "if (0)\n",
     "EmissionTextures.LightByWhatTheyShow"),
    ("light lost below the face", "geometry/shading_normal.cl",
     "r.value = add3(r.value, gltf_eval(surface, wo, mirrored, through));", ";",
     "NormalMaps.KeepTheFurnaceWhite"),
    ("normal maps upside down", "geometry/textured_surface.cl",
     "row->scale * fma(2.0f, t.g, -1.0f)", "-row->scale * fma(2.0f, t.g, -1.0f)",
     "NormalMaps.TiltAlongUAndUp"),
    ("textures repeat where they should mirror", "materials/texture.cl",
     "const float mirrored = turn > 1.0f ? 2.0f - turn : turn;", "const float mirrored = turn > 1.0f ? turn - 1.0f : turn;",
     "Texture.WrapsAndFiltersAtItsBorders"),
    ("what goes through forgets the base colour", "materials/gltf_material.cl",
     "r.through = scale3(entered,", "r.through = scale3(vec3(1.0f, 1.0f, 1.0f),",
     "Transmission.OfASmoothWallIsWhatFresnelLeaves"),
    ("children not divided by their number", "stages/sample_distance.cl",
     "1.0f / (float)params.stops", "1.0f",
     "MediaDistance.ChangesNoMeanInACavity"),
    ("segments of a ray share their random numbers", "stages/sample_distance.cl",
     "passes > 0 ? hash_pair(seed, passes) : seed", "seed",
     "MediaPointSource.HasCasesFluence:MediaSphere.LightsItsCavityFromTheCentre"),
    ("stops kept far from boundaries", "stages/sample_distance.cl",
     "#define STOP_MARGIN 0x1p-24f", "#define STOP_MARGIN 0x1p-18f",
     "MediaStability.OpaquePlateReflectsAsAHalfSpace"),
    ("what refracted rays skip is empty", "stages/refract_boundary.cl",
     "[slot] = -RAY_OFFSET / max(", "[slot] = -0.0f / max(",
     "MediaStability.OpaquePlateOfGlassReflectsLikeAThinnerOne"),
    ("connections stay in an open mesh beyond the scene", "stages/connect_through_media.cl",
     "ends && leaves ? 0u : innermost_medium(stack)", "innermost_medium(stack)",
     "MediaBoundary.WithAHoleHoldsNothingThatLeavesTheScene"),
    ("stops between faces that touch", "stages/sample_distance.cl",
     "& (length > least)", "& (length > 0.0f)",
     "MediaBody.MayShareItsFacesWithOthers"),
    ("connections end before what touches their lamp", "stages/direct_light.cl",
     "1.0f + RAY_OFFSET / LEAST_COSINE", "1.0f + 0.0f * RAY_OFFSET / LEAST_COSINE",
     "MediaBoundary.TintsConnectionsJustBelowALamp"),
    ("walls float on what they touch", "stages/find_contacts.cl",
     "(material->boundary == BOUNDARY_OPAQUE) & !is_wall;", "material->boundary == BOUNDARY_OPAQUE;",
     "ContactOfWalls.*"),
    ("light through a wall stays outside what touches it", "stages/sample_indirect.cl",
     "PLANE(path_media, MEDIUM_STACK)[slot] = PLANE(path_media, CONTACT_MEDIA)[slot];", ";",
     "ContactOfWalls.*"),
    ("smooth glass absorbs what its normals send astray", "stages/refract_boundary.cl",
     "wi = select3(dot3(side, wi) < 0.0f, mirror3(wi, ng), wi);", ";",
     "Dielectric.OfSmoothNormalsLosesNothing"),
    ("rough glass by half of its lobes", "materials/dielectric.cl",
     "by_mirrored * m.value", "0.0f * m.value",
     "RoughDielectric.OfSmoothNormalsIsLitAlike"),
    ("connections are not tinted", "stages/connect_through_media.cl",
     "value = mul3(value, tint_of_boundary(&cover, materials, &hit));", "",
     "MediaBoundary.TintsConnections"),
    ("textures do not tint connections", "media/boundary.cl",
     "tint = mul3(tint, vec3(t.r, t.g, t.b));", "",
     "MediaBoundary.TintsConnections"),
    ("connections push the outermost medium out", "stages/connect_through_media.cl",
     "value = scale3(value, weight_of_crossing(stack, crossed, material->medium));", "",
     "MediaBoundary.OfAFifthMediumIsRefusedOrFound"),
    ("paths push the outermost medium out", "stages/pass_boundary.cl",
     "const float weight = weight_of_crossing(stack, crossed, material->medium);", "const float weight = 1.0f;",
     "MediaBoundary.OfAFifthMediumIsRefusedOrFound"),
    ("bumps of backs are those of fronts", "geometry/textured_surface.cl",
     "< 0.0f ? -1.0f : 1.0f;", "< 0.0f ? 1.0f : 1.0f;",
     "NormalMaps.OfTheBackAreTheFrontsTurnedRound"),
    ("what is index-matched has index 1 in glass", "media/medium_stack.cl",
     "((row > 0) & (ior > 0.0f)) ? ior : index", "row > 0 ? max(ior, 1.0f - ior) : index",
     "Dielectric.BodiesInOneAnotherKeepTheFurnace"),
    ("surfaces resumed lie before the boundaries passed", "stages/pass_boundary.cl",
     "(apart >= 0.0f) & ", "",
     "MediaBoundary.IsPassedOnceByWhatBranchesBehindIt"),
    ("floors where fog ends lie outside it", "stages/pass_boundary.cl",
     "if (touch & passed & sends_back)", "if (0)",
     "MediaBoundary.OfFogMayEndAtAFloor"),
    ("floors lie outside the last fog alone that ends there", "media/medium_stack.cl",
     "if (alone) PLANE", "PLANE",
     "MediaBoundary.OfFogMayEndAtAFloor"),
    ("panes lie outside the fog that ends on them", "stages/pass_boundary.cl",
     "HAS_CONTACTS |", "0 |",
     "Contact.FogOnAPane"),
    ("glass floats on what it touches", "stages/find_contacts.cl",
     "if (replaces) shown = hit;", ";",
     "Contact.PaneOnAFloor"),
    ("there is air between glass and liquid", "stages/find_contacts.cl",
     "if (hit.primitive < 0) break;", "break;",
     "Contact.LiquidBetweenPanes"),
    ("filters on glass do not tint", "stages/find_contacts.cl",
     "tint = mul3(tint, tint_of_boundary(&cover, materials, &hit));", ";",
     "Contact.TintsWhatPasses"),
    ("equiangular density of another height", "media/homogeneous.cl",
     "return view.height / (2.0f", "return 1.01f * view.height / (2.0f",
     "Homogeneous.StopsAreUnbiasedInEveryChannel"),
    ("refracting facets without their Jacobian", "materials/dielectric.cl",
     "mirrored * ior_t * ior_t * fabs(cos_i)", "mirrored * ior_t * fabs(cos_i)",
     "RoughDielectric.SamplesFollowItsValues"),
    ("refracted paths scatter once too often", "stages/refract_boundary.cl",
     "float goes_on = scattering < params.max_scatterings ? 1.0f : 0.0f;", "float goes_on = 1.0f;",
     "Dielectric.PaneHasTheOrdersOfTheDepthAsked"),
    ("glass tints what it reflects", "stages/refract_boundary.cl",
     "scale3(select3(s.reflects, one, passed), s.weight)", "scale3(passed, s.weight)",
     "Dielectric.PaneTintsWhatPasses"),
    ("segments emit once a stop", "stages/sample_distance.cl",
     "resumed ? 0.0f : length));", "length));",
     "MediaEmission.*"),
    ("every medium scatters as the first", "stages/scatter_medium.cl",
     "media[(int)innermost - 1].anisotropy", "media[0].anisotropy",
     "MediaPhase.OfAPlateIsItsOwn"),
    ("light points see the phase function of the first medium", "stages/direct_light.cl",
     "media[(int)max(innermost_medium(stack), 1u) - 1].anisotropy", "media[0].anisotropy",
     "MediaPhase.OfTwoPlatesUnderASun"),
    ("uniform directions weighed as if by the phase function", "media/phase.cl",
     "return PHASE_DIRECTIONS ? value : INV_4PI_F;", "return value;",
     "MediaPhase.OfUniformDirectionsIsInvisibleAtOneTemperature"),
    ("uniform directions aimed as if by the phase function", "stages/scatter_medium.cl",
     "guided_pdf_w(guide, guided, s.wi, phase_pdf_w(phase))", "guided_pdf_w(guide, guided, s.wi, phase)",
     "MediaPhase.OfAirlightOfALampHasOneMeanByAllDirections"),
    ("light points in media weighed as if no direction were aimed", "stages/direct_light.cl",
     "if (HAS_GUIDE) phase_pdf = guided_pdf_w(aimed, 0, s.wi, phase_pdf);", "",
     "MediaPhase.OfAirlightOfALampHasOneMeanByAllDirections"),
    ("aimed directions in media keep the density of the phase function", "stages/scatter_medium.cl",
     "s.pdf_w = mixture;", "",
     "MediaPhase.OfAirlightOfALampHasOneMeanByAllDirections"),
    ("light points behind rough glass see air in what touches it", "stages/direct_light.cl",
     "crossed = HAS_CONTACTS ?", "crossed = 0 ?",
     "Contact.LampBelowARoughPaneIsLitAlike"),
    ("filters on rough glass do not tint light points", "stages/direct_light.cl",
     "f = mul3(f, load3(PLANE(path_media, CONTACT_R), stride, slot));", ";",
     "Contact.LampBelowARoughPaneIsLitAlike"),
    ("refracted paths push the outermost medium out", "stages/refract_boundary.cl",
     "passed = scale3(passed, weight_of_crossing(stack, crossed, material->medium));", "",
     "MediaBoundary.OfAFifthMediumIsFoundBehindGlass"),
    ("glass among contacts pushes the outermost medium out", "stages/find_contacts.cl",
     "tint = scale3(tint, weight_of_crossing(stack, crossed, material->medium));\n        stack", "stack",
     "MediaBoundary.OfAFifthMediumIsFoundBehindGlass"),
    ("what touches glass pushes the outermost medium out", "stages/find_contacts.cl",
     "tint = scale3(tint, weight_of_crossing(stack, crossed, material->medium));\n        if", "if",
     "MediaBoundary.OfAFifthMediumIsFoundBehindGlass"),
    ("roulette takes glass for half a loss", "stages/roulette_compact.cl",
     "carried *= ior * ior;", "carried *= ior;",
     "Dielectric.IsNoReasonForRoulette"),
    ("rays start at a far camera", "stages/generate_rays.cl",
     "origin = madd3(origin, direction, params.ray_start);", ";",
     "ContactOfWalls.OfFogAreSeenFromFarOff"),
    ("depth from where rays start", "stages/first_hit.cl",
     "t += params.ray_start;", ";",
     "ContactOfWalls.OfFogAreSeenFromFarOff"),
    ("boundaries are seen", "stages/first_hit.cl",
     "const int hit = primitive >= 0;", "const int hit = (primitive >= 0) | (primitive == HIT_BOUNDARY);",
     "FirstHit.IsSeenThroughMatchedMedia"),
    ("what touches a lamp hides it", "stages/find_contacts.cl",
     "if (HAS_LAMP_CONTACTS && is_opaque)", "if (0)",
     "LampPlane.OfACeiling"),
    ("backs of lamps are seen", "geometry/interaction.cl",
     "return emits & (front |", "return emits & (1 |",
     "LampPlane.OfLampsBackToBack"),
    ("lamps on lamps light together", "stages/connect_through_media.cl",
     "if (shown.primitive < lamp &&", "if (0 &&",
     "LampPlane.OfTwoLampsTheFirstShows"),
    ("the last of two lamps shows", "geometry/shown_face.cl",
     "hit.primitive < shown.primitive", "hit.primitive > shown.primitive",
     "LampPlane.OfTwoLampsTheFirstShows"),
    ("walls do not dim connections", "stages/connect_through_media.cl",
     "value = mul3(value, straight);", ";",
     "SmoothWall.ConnectionsToPunctualLightsPassAnyNumber"),
    ("connections pass rough walls", "materials/gltf_material.cl",
     "return HAS_SMOOTH_WALLS && gltf_is_mirror(s)", "return HAS_SMOOTH_WALLS",
     "SmoothWall.ConnectionsAskTheTextures"),
    ("connections see walls without their shading normal", "stages/connect_through_media.cl",
     "-dot3(n, direction)", "-dot3(x.ng, direction)",
     "SmoothWall.FresnelGoesByTheShadingNormal"),
    ("walls on a ray share their random number", "stages/pass_walls.cl",
     "passes + 1)", "1u)",
     "SmoothWall.SkiesAreCountedOnce"),
    ("what a wall scatters is not weighed by its chance", "stages/pass_walls.cl",
     "const float rest = 1.0f / (1.0f - pmf);", "const float rest = 1.0f;",
     "SmoothWall.KeepTheFurnaceWhite"),
    ("a pass makes light behind a find of chance alone", "stages/pass_walls.cl",
     "if (!is_passed) return;", "if (!is_passed) return;\n    PLANE(throughputs, THROUGHPUT_PDF)[slot] = PDF_CERTAIN;",
     "SmoothWall.AreaLightsAreCountedOnce"),
    ("passed walls keep the media that they send back into", "stages/pass_boundary.cl",
     "PLANE(path_media, MEDIUM_BEFORE)[slot] = behind;", ";",
     "SmoothWall.StandsInFog"),
    ("light points on rough glass 2 % too bright", "stages/direct_light.cl",
     "f = select3(refracts, scale3(tint, v.value), f);", "f = select3(refracts, scale3(tint, 1.02f * v.value), f);",
     "RoughDielectric.IsLitAlikeFromWithin"),
]


def check(file, text):
    count = (KERNELS / file).read_text().count(text)
    if count != 1:
        sys.exit(f"{file}: holds '{text}' {count} times, not once; bring tests/mutations/mutations.py up to date")


def mutate(folder, file, text, replacement):
    path = folder / file
    path.write_text(path.read_text().replace(text, replacement))


def tests_pass(program, tests, kernels):
    environment = dict(os.environ, WAVEPATH_KERNELS=str(kernels))
    command = [program, f"--gtest_filter={tests}", "--gtest_brief=1"]
    try:
        run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=LONGEST_RUN)
    except subprocess.TimeoutExpired:
        return False  # it would not end: noticed
    if run.returncode == 0 and "[  PASSED  ] 0 tests" in run.stdout:
        sys.exit(f"{tests}: no such test")
    if "kernels do not build" in run.stdout or re.search(r"\.cl:\d+:\d+: ", run.stdout):
        sys.exit(f"{tests}: the broken kernels do not compile, which proves nothing:\n{run.stdout}")
    return run.returncode == 0


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for _, file, text, _, _ in MUTATIONS:
        check(file, text)
    if sys.argv[1] == "--check":
        return False
    program, wanted = sys.argv[1], sys.argv[2:]
    if not os.access(program, os.X_OK):
        sys.exit(f"{program}: no such program; name the tests' (BUILD/tests/wavepath_tests)")
    unknown = set(wanted) - {m[0] for m in MUTATIONS}
    if unknown:
        sys.exit(f"no such mutation: {', '.join(sorted(unknown))}")
    mutations = [m for m in MUTATIONS if not wanted or m[0] in wanted]
    survivors = 0
    width = max(len(m[0]) for m in mutations)
    for tests in sorted({m[4] for m in mutations}):
        if not tests_pass(program, tests, KERNELS):
            sys.exit(f"{tests}: fails on unbroken kernels")
    for name, file, text, replacement, tests in mutations:
        with tempfile.TemporaryDirectory() as folder:
            kernels = pathlib.Path(folder) / "kernels"
            shutil.copytree(KERNELS, kernels)
            mutate(kernels, file, text, replacement)
            caught = not tests_pass(program, tests, kernels)
        survivors += not caught
        print(f"{name:{width}}  {'caught' if caught else 'SURVIVED':8}  {tests}", flush=True)
    print(f"{len(mutations) - survivors} of {len(mutations)} caught")
    return survivors > 0


if __name__ == "__main__":
    sys.exit(main())
