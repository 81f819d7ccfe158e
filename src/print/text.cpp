#include <string>

#include "symbol_rows.hpp"
#include "writers.hpp"

namespace dotpose::print {

void write_text(const Sheet& sheet, const Progress& progress, base::OutputFile& file) {
    SymbolRows symbols(sheet);
    std::string line;
    for (int j = 0; j < sheet.rows; ++j) {
        line.clear();
        for (const Symbol symbol : symbols.row(j))
            line += letter(symbol);
        line += '\n';
        file.write(line);
        file.require_good();
        report(progress, j + 1, sheet.rows);
    }
}

}  // namespace dotpose::print
