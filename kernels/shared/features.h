// What the scene and the method need. The program that is built for a render defines each of these
// as 0 or 1 (DISTANCES as what it names) ahead of this file; kernels test them with a plain `if`,
// so both branches are always parsed and the dead one is removed. Here every feature is on: the
// full set, as the linter builds it.
#ifndef WAVEPATH_FEATURES_H
#define WAVEPATH_FEATURES_H

#ifndef HAS_VERTEX_NORMALS
#define HAS_VERTEX_NORMALS 1  // some triangle is smooth
#endif
#ifndef HAS_VERTEX_COLORS
#define HAS_VERTEX_COLORS 1  // some mesh has COLOR_0
#endif
#ifndef HAS_TEXTURES
#define HAS_TEXTURES 1  // some surface has a texture besides its emission
#endif
#ifndef UV_SETS
#define UV_SETS 2  // sets of texture coordinates a triangle has
#endif
#ifndef HAS_NORMAL_MAPS
#define HAS_NORMAL_MAPS 1
#endif
#ifndef HAS_LOBE_TEXTURES
#define HAS_LOBE_TEXTURES 1  // of what gltf_material.cl calls Surface, but for its base colour
#endif
#ifndef HAS_EMISSION_TEXTURES
#define HAS_EMISSION_TEXTURES 1  // or vertex colours that tint emission
#endif
#ifndef HAS_ALPHA
#define HAS_ALPHA 1  // some material has holes or is blended
#endif
#ifndef HAS_VERTEX_ALPHAS
#define HAS_VERTEX_ALPHAS 1  // some such mesh has them in COLOR_0
#endif
#ifndef HAS_SPECULAR
#define HAS_SPECULAR 1  // some material has a microfacet or mirror lobe, or transmits in part
#endif
#ifndef LAYERS_CONSERVE
#define LAYERS_CONSERVE 1  // what is below a dielectric's specular layer gets what that leaves
#endif
#ifndef HAS_TRANSMISSION
#define HAS_TRANSMISSION 1  // some thin wall lets light through
#endif
#ifndef HAS_SMOOTH_WALLS
#define HAS_SMOOTH_WALLS 1  // some such wall lets it straight through
#endif
#ifndef HAS_AREA_LIGHTS
#define HAS_AREA_LIGHTS 1
#endif
#ifndef HAS_PUNCTUAL_LIGHTS
#define HAS_PUNCTUAL_LIGHTS 1
#endif
#ifndef HAS_ENVIRONMENT
#define HAS_ENVIRONMENT 1
#endif
#ifndef HAS_ENVIRONMENT_MAP
#define HAS_ENVIRONMENT_MAP 1
#endif
#ifndef HAS_MEDIA
#define HAS_MEDIA 1  // some material encloses a medium
#endif
#ifndef HAS_DIELECTRICS
#define HAS_DIELECTRICS 1  // some boundary refracts
#endif
#ifndef HAS_MATCHED_MEDIA
#define HAS_MATCHED_MEDIA 1  // some medium has the index of what is around it
#endif
#ifndef TINTED_BOUNDARIES
#define TINTED_BOUNDARIES 1  // some index-matched boundary has a base colour
#endif
#ifndef HAS_CONTACTS
#define HAS_CONTACTS 1  // something touches a refracting boundary, a thin wall or a lamp
#endif
#ifndef HAS_LAMP_CONTACTS
#define HAS_LAMP_CONTACTS 1  // something touches a lamp
#endif
#ifndef LAMPS_ON_LAMPS
#define LAMPS_ON_LAMPS 1  // and shines to the same side
#endif
#ifndef HAS_FAR_GEOMETRY
#define HAS_FAR_GEOMETRY 1  // triangles lie outside the unit cube
#endif
#ifndef HAS_FAR_CAMERA
#define HAS_FAR_CAMERA 1  // the eye is so far off that rays start at the scene
#endif
#ifndef ROUGH_DIELECTRICS
#define ROUGH_DIELECTRICS 1  // some boundary refracts by microfacets
#endif
#ifndef PARTIAL_BOUNDARIES
#define PARTIAL_BOUNDARIES 1  // some boundary transmits in part, the rest reflects
#endif
#ifndef MEDIA_SCATTER
#define MEDIA_SCATTER 1  // some medium scatters; 0: they absorb and emit alone
#endif
#define DISTANCE_EXPONENTIAL 0
#define DISTANCE_UNIFORM 1
#define DISTANCE_TRUNCATED 2
#define DISTANCE_EQUIANGULAR 3
#define DISTANCE_MIS 4
#ifndef DISTANCES
#define DISTANCES DISTANCE_MIS  // how distances in media are drawn: one of the above
#endif
#ifndef PHASE_DIRECTIONS
#define PHASE_DIRECTIONS 1  // directions in media follow the phase function; 0: uniform
#endif
#ifndef HAS_SPLITS
#define HAS_SPLITS 1  // --splits: branch vertices are kept and resumed
#endif
#ifndef SAMPLE_LIGHTS
#define SAMPLE_LIGHTS 1  // the method chooses points on lights
#endif
#ifndef SAMPLE_LOBES
#define SAMPLE_LOBES 1  // directions follow the bsdf's lobes; 0: uniform in projected solid angle
#endif
#ifndef WEIGH_BOTH
#define WEIGH_BOTH 1  // light and bsdf samples are joined by multiple importance sampling
#endif
#ifndef HAS_GUIDE
#define HAS_GUIDE 1  // some directions are aimed at the surroundings of the lamps
#endif
#ifndef SAMPLER_SOBOL
#define SAMPLER_SOBOL 1  // 0: independent points
#endif

// Normals to shade by that are not the face's own.
#define HAS_SHADING_NORMALS (HAS_VERTEX_NORMALS || HAS_NORMAL_MAPS)

// Surfaces that a ray may pass as the same ray.
#define HAS_PASSAGES (HAS_MEDIA || HAS_SMOOTH_WALLS)

#endif
