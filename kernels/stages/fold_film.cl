// Folds the cells of a window into the film, pixel by pixel, in the order of the passes, so
// that the bytes of the film depend neither on the pool nor on how the passes were divided into
// windows. Compensated sums [Kahan 1965]: 10^7 samples of a constant stay right to 1e-7. The
// variance between batches is updated by Welford's recurrence, weighted [West 1979].
//
// reads: plan, cells, cell_flags, film, film_flags
//
// writes: film, film_flags (of the band that holds the window's pixels)
//
// One work-item a pixel of the window.

#include "sampling/vector.cl"
#include "shared/film.h"
#include "shared/inline.h"
#include "shared/params.h"
#include "shared/path.h"

typedef struct {
    float sum, lost;  // the true sum is sum - lost
} Compensated;

INLINE Compensated add_compensated(Compensated c, const float value) {
    const float y = value - c.lost;
    const float t = c.sum + y;
    c.lost = (t - c.sum) - y;
    c.sum = t;
    return c;
}

kernel void fold_film(
    constant const RenderParams* restrict settings,
    global const PlanRow* restrict plan,
    global const float* restrict cells,
    global const uint* restrict cell_flags,
    global float* restrict film,
    global uint* restrict film_flags) {
    const RenderParams params = *settings;
    const uint i = (uint)get_global_id(0);
    if (i >= params.window_pixels) return;
    const size_t pixels = params.window_pixels;  // of the film's band, which is the window's
    const uint pixel = i;
    const uint passes = params.cells / params.window_pixels;

    for (uint k = 0; k < SUM_PLANES; ++k) {
        Compensated total;
        total.sum = film[(FILM_SUM + k) * pixels + pixel];
        total.lost = film[(FILM_LOST + k) * pixels + pixel];
        for (uint pass = 0; pass < passes; ++pass)
            total =
                add_compensated(total, cells[(pass * params.window_pixels + i) * CELL_FLOATS + k]);
        film[(FILM_SUM + k) * pixels + pixel] = total.sum;
        film[(FILM_LOST + k) * pixels + pixel] = total.lost;
    }

    for (uint k = 0; k < 3; ++k) {
        Compensated batch;
        batch.sum = film[(FILM_BATCH_SUM + k) * pixels + pixel];
        batch.lost = film[(FILM_BATCH_LOST + k) * pixels + pixel];
        float mean = film[(FILM_MEAN + k) * pixels + pixel];
        float deviation = film[(FILM_DEVIATION + k) * pixels + pixel];
        for (uint pass = 0; pass < passes; ++pass) {
            batch =
                add_compensated(batch, cells[(pass * params.window_pixels + i) * CELL_FLOATS + k]);
            if (plan[pass].closes_batch == 0) continue;
            const float n = (float)plan[pass].closes_batch;
            const float batch_mean = (batch.sum - batch.lost) / n;
            const float difference = batch_mean - mean;
            mean += difference * (n / ((float)plan[pass].batch_start + n));
            deviation += n * difference * (batch_mean - mean);
            batch.sum = 0.0f;
            batch.lost = 0.0f;
        }
        film[(FILM_BATCH_SUM + k) * pixels + pixel] = batch.sum;
        film[(FILM_BATCH_LOST + k) * pixels + pixel] = batch.lost;
        film[(FILM_MEAN + k) * pixels + pixel] = mean;
        film[(FILM_DEVIATION + k) * pixels + pixel] = deviation;
    }

    for (uint pass = 0; pass < passes; ++pass) {
        const uint flags = cell_flags[pass * params.window_pixels + i];
        if (flags == 0) continue;
        if (film_flags[FILM_NONFINITE * pixels + pixel] == 0) {
            const uint sample = plan[pass].first_sample + (flags & 0xffffu) - 1;
            film_flags[FILM_FIRST_NONFINITE * pixels + pixel] = sample;
        }
        film_flags[FILM_NONFINITE * pixels + pixel] += flags >> 16;
    }
}
