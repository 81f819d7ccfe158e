#include "store/database.hpp"

namespace dotpose::store {

std::unique_ptr<Database> make_postgres(const std::string&, Access) {
    throw Error(
        "cannot use PostgreSQL: this dotpose was built without libpq (install libpq-dev, and build "
        "again)");
}

}  // namespace dotpose::store
