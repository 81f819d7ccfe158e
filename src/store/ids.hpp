// Caches the database IDs of robots and places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "store/database.hpp"

namespace dotpose::store {

/// A cache that maps keys to database IDs. The cache is cleared when it is full. The size is
/// limited because robots choose their own names and may use any number of them.
template <typename Key>
class Ids {
  public:
    /// Returns the ID of a key. If the cache does not contain it, calls `look_up(key)`.
    template <typename LookUp>
    std::int64_t of(const Key& key, const LookUp& look_up) {
        const auto known = ids_.find(key);
        if (known != ids_.end()) return known->second;
        const std::int64_t id = look_up(key);
        if (ids_.size() == kMax) ids_.clear();
        ids_.emplace(key, id);
        return id;
    }
    void clear() { ids_.clear(); }

  private:
    static constexpr std::size_t kMax = 20'000;
    std::map<Key, std::int64_t> ids_;
};

}  // namespace dotpose::store
