// How much work an item of peaks/fma_chains does; read by C++ and OpenCL C alike.
#ifndef WAVEPATH_PEAKS_H
#define WAVEPATH_PEAKS_H

#define FMA_CHAINS 8  // that do not wait for one another
#define FMA_STEPS 512

#endif
