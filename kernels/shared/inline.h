// Every device function is inlined: a call that survives keeps PoCL from vectorising the kernel
// around it.
#ifndef WAVEPATH_INLINE_H
#define WAVEPATH_INLINE_H

#define INLINE inline __attribute__((always_inline))

#endif
