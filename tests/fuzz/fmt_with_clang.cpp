// clang gives this function of fmt 9 another name than GCC, with which the library was compiled, so
// that it is not found there.
#include <fmt/format.h>

template void fmt::detail::vformat_to(buffer<char>&, string_view,
                                      basic_format_args<buffer_context<char>>, locale_ref);
