// Encodes rows in the binary format of COPY. Values in this format need no quoting.
#pragma once

#include <cstdint>
#include <string>

#include "store/database.hpp"

namespace dotpose::store {

class CopyRows {
  public:
    CopyRows();
    void add(const State& state, std::int64_t robot_id, std::int64_t place_id);
    /// Returns the finished data. No rows can be added afterwards.
    const std::string& finish();

  private:
    void add_integer(std::int64_t value, std::size_t bytes);
    void add_text(std::string_view text);

    std::string data_;
};

}  // namespace dotpose::store
