#include "program.hpp"

#include "host.hpp"
#include "locate_frames.hpp"
#include "number.hpp"
#include "stack.hpp"

int run_program(const char* path) {
    const int status = locate_frames(path);
    if (stack::has_overflown()) {
        host::print("the stack has overflown\n");
        return 1;
    }
    host::print("stack");
    print_number(static_cast<std::int64_t>(stack::high_water_bytes()));
    host::print("\n");
    return status;
}
