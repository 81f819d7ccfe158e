// Defines a function of fmt 9 for which clang and GCC generate different mangled names. The library
// was compiled with GCC, so it does not contain the name that clang expects.
#include <fmt/format.h>

template void fmt::detail::vformat_to(buffer<char>&, string_view,
                                      basic_format_args<buffer_context<char>>, locale_ref);
