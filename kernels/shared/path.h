// The state of a path, declared once: groups of planes, one float or uint a path slot. A group is
// one buffer; plane k of slot s is group[k * stride + s]. A group that the scene or the method does
// not need is not allocated. The slots in use are 0 .. n - 1, all of them: the queue of every stage
// is that range, so that planes are read in order.
#ifndef WAVEPATH_PATH_H
#define WAVEPATH_PATH_H

// rays: the ray to trace, in normalised scene space
enum RayPlane {
    RAY_ORIGIN_X,
    RAY_ORIGIN_Y,
    RAY_ORIGIN_Z,
    RAY_DIRECTION_X,  // unit
    RAY_DIRECTION_Y,
    RAY_DIRECTION_Z,
    RAY_PLANES
};

// hits: where it met the scene
enum HitPlane {
    HIT_PRIMITIVE,  // (int bits) the triangle, or one of the codes below
    HIT_T,          // distance [normalised]
    HIT_U,          // barycentric weight of corner 1
    HIT_V,          // of corner 2
    HIT_PLANES
};
#define HIT_WORTH HIT_U  // with HAS_GUIDE, once the hit is shaded: guide_worth of the new direction
#define HIT_MISS (-1)
#define HIT_ENDED (-2)
#define HIT_IDLE (-3)
#define HIT_MEDIUM (-4)  // this and what follows only with HAS_PASSAGES
#define HIT_BOUNDARY (-5)
#define HIT_DIELECTRIC (-6)
#define HIT_LEAVING (-7)

// What HIT_PRIMITIVE says, for which geometry/path_state.cl has words. first_hit and
// roulette_compact look at every code; what a ray has just hit, a Hit, is asked by its id.
//
// 0 and more      The path is at this triangle.
//   set by        intersect, find_contacts; resume_branch; sample_indirect leaves it so
//   seen by       all stages that shade, until one of them sets another code
//   valid         HIT_U, HIT_V, and HIT_T where it is no sign (below); surfaces from interact on
// HIT_MISS        It left the scene.
//   set by        intersect; sample_distance, in place of HIT_LEAVING
//   seen by       shade_miss, first_hit; roulette_compact ends it
//   valid         its ray
// HIT_ENDED       It is over: absorbed, or cut.
//   set by        pass_boundary, refract_boundary, sample_indirect, scatter_medium,
//                 roulette_compact; assign_units
//   seen by       resume_branch, accumulate; generate_rays starts the next
//   valid         its radiance
// HIT_IDLE        There is no path: the slot has no work left.
//   set by        generate_rays, move_paths
//   seen by       scatter_queue, which fills the slot; intersect, which has no ray to trace
// HIT_MEDIUM      It stopped in a medium before the surface.
//   set by        sample_distance; resume_branch; scatter_medium leaves it so
//   seen by       direct_light, scatter_medium; sample_distance, where it is resumed
//   valid         HIT_T, SURFACE_X
// HIT_BOUNDARY    It passes a boundary or a wall and goes on as the same ray.
//   set by        pass_boundary, pass_walls
//   seen by       no stage that shades; intersect goes on behind it
//   valid         MEDIUM_T, MEDIUM_PRIMITIVE
// HIT_DIELECTRIC  It leaves a dielectric boundary as a new ray.
//   set by        refract_boundary
//   seen by       no stage that shades; intersect traces it
//   valid         its new ray
// HIT_LEAVING     It leaves its last medium at HIT_T and meets nothing behind.
//   set by        intersect
//   seen by       sample_distance, which sets HIT_MISS or HIT_MEDIUM
//   valid         HIT_T
//
// And what HIT_T says, with HAS_SPLITS:
//
// 0 and more      The triangle was met at this distance.
// T_RESUMED       The path is back at a branch vertex, which was shaded before. Set by
//                 resume_branch; what shades skips it.
// others below 0  It is back on a segment of this length that it went through before, to stop on
//                 it, or has stopped there. Set by resume_branch and sample_distance, seen by
//                 sample_distance.
// Both            are no rays to trace (intersect, find_contacts) and no first hits. generate_rays
//                 sets 0, and next_child (sampling/branch.cl) when the path leaves a vertex.

// surfaces: what was hit, where HIT_PRIMITIVE >= 0
enum SurfacePlane {
    SURFACE_X,  // position [normalised]
    SURFACE_Y,
    SURFACE_Z,
    SURFACE_NG_X,  // geometric normal, unit, on the viewer's side
    SURFACE_NG_Y,
    SURFACE_NG_Z,
    SURFACE_BASE_R,  // base colour [1]
    SURFACE_BASE_G,
    SURFACE_BASE_B,
    SURFACE_MATERIAL,  // (int bits)
    SURFACE_LIGHT,     // (uint bits) row of the light table if it emits towards the viewer, else
                       // NO_LIGHT
    SURFACE_N_X,       // shading normal, unit, on the viewer's side (only with HAS_SHADING_NORMALS)
    SURFACE_N_Y,
    SURFACE_N_Z,
    SURFACE_METALLIC,  // [1] (only with HAS_LOBE_TEXTURES, as are the next)
    SURFACE_ALPHA,     // [1] roughness^2
    SURFACE_SPECULAR,  // [1]
    SURFACE_F0_R,      // [1] of the dielectric
    SURFACE_F0_G,
    SURFACE_F0_B,
    SURFACE_TRANSMISSION,  // [1]
    SURFACE_PLANES
};
#define SURFACE_PLANES_FLAT SURFACE_N_X
#define SURFACE_PLANES_SHADED SURFACE_METALLIC

// path_media: where a path stands among the media and the surfaces that it passes (only with
// HAS_PASSAGES). A ray that passes an index-matched boundary or a smooth thin wall keeps its
// origin: its next segment begins at MEDIUM_T, behind the triangle MEDIUM_PRIMITIVE, and no offset
// has to be right.
enum MediumPlane {
    MEDIUM_STACK,      // (uint bits) media around the segment, 8 bits each: rows of the table of
                       // media + 1, the innermost lowest; 0: vacuum (media/medium_stack.cl)
    MEDIUM_T,          // where the segment begins [distance along the ray, normalised]; below 0
                       // behind a dielectric, from which the ray's origin keeps ray_offset
    MEDIUM_PRIMITIVE,  // (int bits) the boundary it begins at; NO_BOUNDARY at the ray's origin
    MEDIUM_PASSES,     // (uint bits) boundaries and walls passed since the ray's origin
    MEDIUM_BEFORE,    // (uint bits) MEDIUM_STACK before MEDIUM_PRIMITIVE and boundaries touching it
    MEDIUM_TOUCHING,  // how far behind MEDIUM_PRIMITIVE surfaces touch it [along the ray]
    // Of the glass or thin wall that was hit (only with HAS_CONTACTS; from find_contacts on):
    CONTACT_MEDIA,  // (uint bits) MEDIUM_STACK behind it and all that touches it
    CONTACT_R,      // [1] product of the base colours of what touches it
    CONTACT_G,
    CONTACT_B,
    MEDIUM_PLANES
};
#define MEDIUM_PLANES_APART CONTACT_MEDIA
#define NO_BOUNDARY (-1)

// throughputs: what the path carries
enum ThroughputPlane {
    THROUGHPUT_R,  // product of f cos / pdf so far [1]
    THROUGHPUT_G,
    THROUGHPUT_B,
    THROUGHPUT_PDF,  // pdf_w of the last direction [1/sr]; PDF_CERTAIN after the camera or a delta
                     // lobe
    THROUGHPUT_PLANES
};
#define PDF_CERTAIN (-1.0f)

// radiances: what the path has gathered, and the sums of its unit of work
enum RadiancePlane {
    RADIANCE_R,  // of the running sample
    RADIANCE_G,
    RADIANCE_B,
    SUM_R,  // over the finished samples of the unit
    SUM_G,
    SUM_B,
    SUM_ALBEDO_R,
    SUM_ALBEDO_G,
    SUM_ALBEDO_B,
    SUM_NORMAL_X,
    SUM_NORMAL_Y,
    SUM_NORMAL_Z,
    SUM_DEPTH,     // [m], over the samples that hit something
    SUM_COVERAGE,  // samples that hit something
    RADIANCE_PLANES
};
#define SUM_PLANES (RADIANCE_PLANES - SUM_R)
#define CELL_FLOATS \
    12  // SUM_PLANES and padding: the sums of one unit, side by side, since units end one by one

// shadows: the pending connection to a light, at most one a slot
enum ShadowPlane {
    SHADOW_ORIGIN_X,
    SHADOW_ORIGIN_Y,
    SHADOW_ORIGIN_Z,
    SHADOW_DIRECTION_X,  // not unit: the light lies at t = 1
    SHADOW_DIRECTION_Y,
    SHADOW_DIRECTION_Z,
    SHADOW_T_MAX,  // where the search for what is in the way ends: 1, or with TINTED_BOUNDARIES or
                   // LAMPS_ON_LAMPS behind the triangle that is the light, for what touches it; 0:
                   // nothing pending
    SHADOW_R,      // radiance it brings if nothing is in the way
    SHADOW_G,
    SHADOW_B,
    SHADOW_MEDIA,  // (uint bits) MEDIUM_STACK at its origin (only with HAS_MEDIA)
    SHADOW_LAMP,   // (int bits) the triangle that is the light, or -1 (only with LAMPS_ON_LAMPS)
    SHADOW_PLANES
};
#define SHADOW_PLANES_CLEAR SHADOW_MEDIA
#define SHADOW_PLANES_ALONE SHADOW_LAMP

// ids (uint): which sample this is
enum IdPlane {
    ID_CELL,        // unit of work, counted from the first of the window; where its sum goes
    ID_PIXEL,       // y * width + x
    ID_PASS,        // row of the sample plan, counted from the first of the window
    ID_SAMPLE,      // of the unit
    ID_LEFT,        // samples of the unit after this one
    ID_SEED,        // hash of (seed, pixel)
    ID_INDEX,       // of the sample in the pixel's sequence, bits reversed
    ID_SCATTERING,  // scatterings so far
    ID_NONFINITE,   // of the unit: count << 16 | first such sample + 1
    ID_BRANCH,  // which child of its branch vertices this is (only with --splits, as are the next)
    ID_STACK,   // branch vertices on the path's stack
    ID_SHARES,  // (float bits) among how many its branch vertices divided what it carries
    ID_PLANES
};
#define ID_PLANES_UNSPLIT ID_BRANCH

// branches: a stack of branch vertices a slot, BRANCH_PLANES planes a level; without media level =
// scatterings before the vertex (only with --splits). With media two levels belong together: a
// segment that branches into its stops and the surface behind, and the vertex at its end, of which
// either may be missing. The planes from BRANCH_SCATTERING on exist only with media.
enum BranchPlane {
    BRANCH_LEFT,       // (uint bits) children still to run
    BRANCH_ID,         // (uint bits) ID_BRANCH at the vertex
    BRANCH_SHARES,     // (float bits) ID_SHARES of a child
    BRANCH_PRIMITIVE,  // what was hit; HIT_MEDIUM: a stop
    BRANCH_U,
    BRANCH_V,
    BRANCH_DIRECTION_X,  // of the ray that hit it
    BRANCH_DIRECTION_Y,
    BRANCH_DIRECTION_Z,
    BRANCH_R,  // throughput of a child, before its direction or distance
    BRANCH_G,
    BRANCH_B,
    BRANCH_SCATTERING,  // (uint bits) scatterings before the vertex
    BRANCH_T,           // HIT_T to resume with: T_RESUMED, or of a segment its end, negative
    BRANCH_ORIGIN_X,    // of the ray along a segment; the place of a stop
    BRANCH_ORIGIN_Y,
    BRANCH_ORIGIN_Z,
    BRANCH_PDF,    // plane THROUGHPUT_PDF
    BRANCH_MEDIA,  // and the planes of media
    BRANCH_PLANES = BRANCH_MEDIA + MEDIUM_PLANES
};
#define BRANCH_PLANES_SURFACE BRANCH_SCATTERING
#define T_RESUMED (-INFINITY)

#endif
