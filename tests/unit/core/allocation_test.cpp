// Tests that a Locator allocates no memory after its construction. scripts/check-core-symbols
// checks the object code for allocations, including malloc.
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"

// The operators are not replaced under AddressSanitizer. It replaces them itself, and must see the
// allocations made by the tests.
#ifndef __SANITIZE_ADDRESS__

namespace {
thread_local int allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
    ++allocations;
    // aligned_alloc requires a size that is a multiple of the alignment.
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    void* memory = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
}  // namespace

// The other forms of `new` call one of these two operators. No operator is inlined, because GCC
// warns about `new` and `free` if it inlines only `new` or only `delete`.
[[gnu::noinline]] void* operator new(std::size_t size) {
    return counted(size, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace dotpose::core_test::allocation_test {
namespace {

/// Returns frames that cover all outcomes: located by the first attempt, located by the second
/// attempt, and refused.
std::vector<GreyImage> frames_of(int width_px, int height_px) {
    std::vector<GreyImage> frames;
    for (const Preset preset : kPresets) {
        Setup setup;
        setup.preset = preset;
        setup.seed = 77;
        setup.camera.width_px = width_px;
        setup.camera.height_px = height_px;
        for (std::uint64_t i = 0; i < 6; ++i)
            frames.push_back(render(draw_shot(setup, i)));
        for (const Scene scene : kScenes)
            frames.push_back(render_scene(scene, draw_shot(setup, 0)));
    }
    return frames;
}

/// Locates all frames with all combinations of options. Returns the number of allocations, and adds
/// the number of fixes to `fixes`.
int allocations_of(const std::vector<GreyImage>& frames, Locator& locator, int& fixes) {
    int counted = 0;
    for (const GreyImage& frame : frames) {
        for (const Effort effort : {Effort::device, Effort::once, Effort::twice}) {
            for (const Decoder decoder : {Decoder::window, Decoder::all}) {
                DeviceOptions options;
                options.effort = effort;
                options.decoder = decoder;
                const int before = allocations;
                locator.set_options(options);
                const Fix fix = locator.locate(frame.view());
                counted += allocations - before;
                fixes += fix.status == Status::ok ? 1 : 0;
            }
        }
    }
    return counted;
}

TEST(Allocation, IsSeenWhereItHappens) {
    const int before = allocations;
    // Calls the operators directly, because compilers may remove new-expressions.
    ::operator delete(::operator new(1));
    EXPECT_EQ(allocations - before, 1);
}

TEST(Allocation, NoneInSmallFrames) {
    const auto memory = std::make_unique<SmallMemory>();
    Locator locator(*memory, DeviceOptions{});
    int fixes = 0;
    EXPECT_EQ(allocations_of(frames_of(188, 120), locator, fixes), 0);
    EXPECT_GT(fixes, 50);
}

TEST(Allocation, NoneInLargeFrames) {
    const auto memory = std::make_unique<LargeMemory>();
    Locator locator(*memory, DeviceOptions{});
    int fixes = 0;
    EXPECT_EQ(allocations_of(frames_of(320, 240), locator, fixes), 0);
    EXPECT_GT(fixes, 50);
}

}  // namespace
}  // namespace dotpose::core_test::allocation_test

#endif
