#pragma once

/// FENESTRA_WIDE before a function compiles it for AVX-512, AVX2 and the baseline; the widest one
/// that the machine has is chosen when the program starts. All versions round alike, since fused
/// multiply-add is off for the whole project. For loops over arrays only: no Eigen type may cross
/// the boundary of such a function. Sanitizers instrument the chooser, which then runs too early.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FENESTRA_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define FENESTRA_WIDE
#endif
