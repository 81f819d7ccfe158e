#include "store/database.hpp"

namespace dotpose::store {

bool is_on_server(const std::string& where) {
    return where.starts_with("postgresql://") || where.starts_with("postgres://");
}

std::unique_ptr<Database> make_database(const std::string& where, Access access) {
    return is_on_server(where) ? make_postgres(where, access) : make_sqlite(where, access);
}

}  // namespace dotpose::store
