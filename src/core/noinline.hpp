#pragma once

/// Prevents inlining on processors with few registers. On other processors, inlining is faster.
#if defined(__thumb__) && !defined(__thumb2__)
#define DOTPOSE_NOINLINE [[gnu::noinline]]
#else
#define DOTPOSE_NOINLINE
#endif
