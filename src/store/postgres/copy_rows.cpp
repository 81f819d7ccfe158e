#include "store/postgres/copy_rows.hpp"

#include "store/schema.hpp"

namespace dotpose::store {

// The format is specified in the PostgreSQL documentation of COPY, section "Binary Format".
CopyRows::CopyRows() {
    using namespace std::string_literals;
    data_ = "PGCOPY\n\377\r\n\0"s;
    add_integer(0, 4);  // flags
    add_integer(0, 4);  // length of the header extension
}

void CopyRows::add(const State& state, std::int64_t robot_id, std::int64_t place_id) {
    add_integer(kColumnCount, 2);
    const Integers integers = integers_of(state, robot_id, place_id);
    for (std::size_t i = 0; i < integers.size(); ++i) {
        const std::size_t bytes = i < kWideCount ? 8 : 4;
        if (integers[i]) {
            add_integer(static_cast<std::int64_t>(bytes), 4);
            add_integer(*integers[i], bytes);
        } else {
            add_integer(-1, 4);
        }
    }
    add_text(name(state.motion));
    add_text(reason_text(state.reason));
}

const std::string& CopyRows::finish() {
    add_integer(-1, 2);
    return data_;
}

void CopyRows::add_integer(std::int64_t value, std::size_t bytes) {
    for (std::size_t i = bytes; i-- > 0;)
        data_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i));
}

void CopyRows::add_text(std::string_view text) {
    add_integer(static_cast<std::int64_t>(text.size()), 4);
    data_ += text;
}

}  // namespace dotpose::store
