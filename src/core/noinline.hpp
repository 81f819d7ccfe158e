#pragma once

/// Marks functions that are not inlined on processors with few registers, because the callers would
/// run out of registers. On other processors, inlining is faster.
#if defined(__thumb__) && !defined(__thumb2__)
#define DOTPOSE_NOINLINE [[gnu::noinline]]
#else
#define DOTPOSE_NOINLINE
#endif
