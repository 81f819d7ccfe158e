/// HeapLocator: a Locator with memory of its own, for images up to 4096 x 4096 px.
///
///     Fix fix = HeapLocator().locate(image.view());
#pragma once

#include <memory>

#include "dotpose/locate.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Memory of a HeapLocator; a base class, because it must exist before the Locator and outlive it.
class LocatorMemory {
  protected:
    std::unique_ptr<LargeMemory> memory_ = std::make_unique<LargeMemory>();
};

/// A Locator for images up to 4096 x 4096 px that owns its memory of 1.7 MB on the heap.
class HeapLocator : private LocatorMemory, public Locator {
  public:
    explicit HeapLocator(const Options& options = {}) : Locator(*memory_, options) {}
};

}  // namespace dotpose

#pragma GCC visibility pop
