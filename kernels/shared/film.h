// Planes of the film, one float or uint a pixel.
#ifndef WAVEPATH_FILM_H
#define WAVEPATH_FILM_H

#include "shared/path.h"

enum FilmPlane {
    FILM_SUM,                                 // compensated sums of the SUM_PLANES of path.h
    FILM_LOST = FILM_SUM + SUM_PLANES,        // and what rounding took from them
    FILM_BATCH_SUM = FILM_LOST + SUM_PLANES,  // radiance of the batch under way
    FILM_BATCH_LOST = FILM_BATCH_SUM + 3,
    FILM_MEAN = FILM_BATCH_LOST + 3,  // of the batches closed so far
    FILM_DEVIATION = FILM_MEAN + 3,   // sum over batches of samples * (batch mean - mean)^2
    FILM_PLANES = FILM_DEVIATION + 3
};

// film_flags (uint)
enum FilmFlag {
    FILM_NONFINITE,        // samples that were not finite
    FILM_FIRST_NONFINITE,  // the first of them
    FILM_FLAGS
};

// Bits of the NaN, but for its sign, of paths that meet more media around one another than
// MEDIUM_STACK holds.
#define NAN_OF_MEDIA 0x7fc04d00u

#endif
