// What the memory gives: a = b + factor * c, 2 operations and 12 bytes an item, over more than the
// caches hold [McCalpin 1995]. As there, what a cache reads of a line before it writes it is not
// counted.
//
// One work-item a float.

kernel void triad(
    const float factor,
    global const float* restrict b,
    global const float* restrict c,
    global float* restrict a) {
    const size_t i = get_global_id(0);
    a[i] = fma(factor, c[i], b[i]);
}
