// C functions for print maps (dotpose_print_map.h).
#include "dotpose/files/print_map.hpp"

#include <string_view>

#include "dotpose/tools/print_mapping.hpp"
#include "dotpose_print_map.h"
#include "structs.hpp"

struct dotpose_print_map {
    dotpose::PrintMap map;
};

namespace {

using namespace dotpose;

static_assert(DOTPOSE_MAP_USED == static_cast<int>(MapUse::used) &&
              DOTPOSE_MAP_NOT_COVERED == static_cast<int>(MapUse::not_covered) &&
              DOTPOSE_MAP_CONTRADICTED == static_cast<int>(MapUse::contradicted));

/// Returns the fix of the newest image, corrected by the map. The locator must store the dots
/// (`show_stages`).
MappedFix mapped_fix(const dotpose_print_map& map, const dotpose_locator& locator) {
    const Trace trace = locator.locator->trace();
    return with_print_map(trace.fix, map.map, trace);
}

}  // namespace

extern "C" {

dotpose_status dotpose_print_map_create(const void* bytes, size_t byte_count,
                                        dotpose_print_map** map) {
    if (map == nullptr) return DOTPOSE_NULL_POINTER;
    *map = nullptr;
    if (bytes == nullptr) return DOTPOSE_NULL_POINTER;
    return c::without_exceptions([&] {
        *map = new dotpose_print_map{
            parse_print_map(std::string_view(static_cast<const char*>(bytes), byte_count))};
        return DOTPOSE_OK;
    });
}

void dotpose_print_map_destroy(dotpose_print_map* map) {
    delete map;
}

dotpose_status dotpose_print_map_correct(const dotpose_print_map* map,
                                         const dotpose_locator* locator, dotpose_fix* fix,
                                         dotpose_map_use* use) {
    if (map == nullptr || fix == nullptr || use == nullptr) return DOTPOSE_NULL_POINTER;
    const dotpose_status status = c::check_locator(locator);
    if (status != DOTPOSE_OK) return status;
    if (fix->size != sizeof *fix) return DOTPOSE_BAD_SIZE;
    return c::without_exceptions([&] {
        if (!locator->locator->trace().fix) return DOTPOSE_NO_FIX;
        const MappedFix mapped = mapped_fix(*map, *locator);
        c::to_c(mapped.fix, *fix);
        *use = static_cast<dotpose_map_use>(mapped.use);
        return DOTPOSE_OK;
    });
}

dotpose_status dotpose_print_map_fit_space(const dotpose_print_map* map,
                                           const dotpose_locator* locator,
                                           const dotpose_space_camera* camera,
                                           const uint8_t* pixels, int32_t width_px,
                                           int32_t height_px, ptrdiff_t stride_bytes,
                                           dotpose_space_pose* pose, dotpose_map_use* use) {
    if (map == nullptr || use == nullptr) return DOTPOSE_NULL_POINTER;
    const dotpose_status is_locator = c::check_locator(locator);
    if (is_locator != DOTPOSE_OK) return is_locator;
    return c::without_exceptions([&] {
        const Trace trace = locator->locator->trace();
        const MapUse found = trace.fix ? mapped_fix(*map, *locator).use : MapUse::no_map;
        const MapPage* page = nullptr;
        if (found == MapUse::used)
            page = find_page(map->map, trace.options.code, {trace.fix.cell, trace.fix.section});
        const dotpose_status status =
            c::fit_space(locator, camera, {pixels, width_px, height_px, stride_bytes}, page, pose);
        if (status == DOTPOSE_OK) *use = static_cast<dotpose_map_use>(found);
        return status;
    });
}
}
