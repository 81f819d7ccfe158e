#include "small_pdf.hpp"

#include <fstream>

#include <fmt/core.h>

namespace dotpose::roundtrip {

void write_pdf(const std::filesystem::path& path, const std::vector<std::string>& objects) {
    std::string text = "%PDF-1.4\n";
    std::string places = "0000000000 65535 f \n";
    for (std::size_t i = 0; i < objects.size(); ++i) {
        places += fmt::format("{:010} 00000 n \n", text.size());
        text += fmt::format("{} 0 obj\n{}\nendobj\n", i + 1, objects[i]);
    }
    const std::size_t table = text.size();
    text +=
        fmt::format("xref\n0 {0}\n{1}trailer << /Size {0} /Root 1 0 R >>\nstartxref\n{2}\n%%EOF\n",
                    objects.size() + 1, places, table);
    std::ofstream(path, std::ios::binary) << text;
}

std::string stream(const std::string& data) {
    return fmt::format("<< /Length {} >>\nstream\n{}\nendstream", data.size(), data);
}

}  // namespace dotpose::roundtrip
