// Verify: all dots in view against the position that a part of them gave, and how probable it is
// that chance would agree as well. differs: the paper accepts whatever decodes; see
// docs/differs-from-paper.md.
#pragma once

#include "dotpose/options.hpp"
#include "dotpose/status.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Sets bit_errors and p_wrong_log2 of the fix: from chance, and from rivals (quick_rivals.hpp, and
/// rivals.hpp where they leave doubts).
/// Errors: not_certain.
Status verify(const Grid& grid, Profile profile, const Decoding& decoding,
              const IntegrityOptions& options, std::span<LineScores> storage, Fix& fix);

/// The same in integers only, and in bounded time: what quick_rivals leaves in doubt is refused.
Status verify_quickly(const Grid& grid, Profile profile, const Decoding& decoding,
                      const IntegrityOptions& options, std::span<LineScores> storage, Fix& fix);

}  // namespace dotpose::core
