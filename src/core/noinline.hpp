#pragma once

/// Before a function that processors of few registers had better not inline: its caller would not
/// have enough of them. Others gain from it.
#if defined(__thumb__) && !defined(__thumb2__)
#define DOTPOSE_NOINLINE [[gnu::noinline]]
#else
#define DOTPOSE_NOINLINE
#endif
