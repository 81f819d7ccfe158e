#pragma once

/// Marks functions that processors with few registers do not inline, because the caller would run
/// out of registers. Other processors gain from inlining.
#if defined(__thumb__) && !defined(__thumb2__)
#define DOTPOSE_NOINLINE [[gnu::noinline]]
#else
#define DOTPOSE_NOINLINE
#endif
