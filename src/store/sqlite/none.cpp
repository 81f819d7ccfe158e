#include "store/database.hpp"

namespace dotpose::store {

std::unique_ptr<Database> make_sqlite(const std::string& path, Access) {
    throw Error(
        "cannot use the database " + path +
        ": this dotpose was built without SQLite (install libsqlite3-dev, and build again)");
}

}  // namespace dotpose::store
