// Tests the metadata of the exported folder, which package managers read.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

namespace {

namespace fs = std::filesystem;
using ::testing::Contains;

const fs::path kFolder = DOTPOSE_DEVICE_FOLDER;

std::string text_of(const fs::path& file) {
    std::ifstream in(kFolder / file);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::map<std::string, std::string> properties() {
    std::map<std::string, std::string> found;
    std::istringstream in(text_of("library.properties"));
    for (std::string line; std::getline(in, line);) {
        const auto at = line.find('=');
        if (at != std::string::npos) found[line.substr(0, at)] = line.substr(at + 1);
    }
    return found;
}

std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(kFolder / folder))
        names.insert(entry.path().filename().string());
    return names;
}

// Properties required by https://arduino.github.io/arduino-cli/latest/library-specification.
TEST(Metadata, ArduinoHasAllThatItsSpecificationWants) {
    const auto found = properties();
    for (const char* key : {"name", "version", "author", "maintainer", "sentence", "paragraph",
                            "category", "url", "architectures", "includes"})
        EXPECT_TRUE(found.contains(key)) << key;
    EXPECT_EQ(found.at("name"), "dotpose");
    EXPECT_EQ(found.at("version"), DOTPOSE_VERSION);
    EXPECT_EQ(found.at("category"), "Sensors");
    std::istringstream includes(found.at("includes"));
    for (std::string header; std::getline(includes, header, ',');)
        EXPECT_TRUE(fs::exists(kFolder / "src" / header)) << header;
}

TEST(Metadata, AnArduinoExampleIsAFolderWithASketchOfItsName) {
    const auto examples = names_in("examples");
    EXPECT_GE(examples.size(), 2U);
    for (const std::string& example : examples)
        EXPECT_TRUE(fs::exists(kFolder / "examples" / example / (example + ".ino"))) << example;
}

TEST(Metadata, PlatformIoGetsTheLanguageAndFilesThatExist) {
    const auto library = nlohmann::json::parse(text_of("library.json"));
    EXPECT_EQ(library.at("name"), "dotpose");
    EXPECT_EQ(library.at("version"), DOTPOSE_VERSION);
    EXPECT_EQ(library.at("license"), "MIT");
    const auto& build = library.at("build");
    EXPECT_THAT(build.at("flags"), Contains("-std=gnu++20"));
    EXPECT_THAT(build.at("unflags"), Contains("-std=gnu++17"));
    EXPECT_TRUE(fs::is_directory(kFolder / build.at("srcDir").get<std::string>()));
    for (const auto& header : library.at("headers"))
        EXPECT_TRUE(fs::exists(kFolder / "src" / header.get<std::string>())) << header;
    std::set<std::string> examples;
    for (const auto& example : library.at("examples")) {
        const std::string base = example.at("base");
        std::set<std::string> files;
        for (const auto& file : example.at("files"))
            files.insert(file.get<std::string>());
        EXPECT_EQ(files, names_in(base)) << base;
        examples.insert(example.at("name"));
    }
    EXPECT_EQ(examples, names_in("examples"));
}

TEST(Metadata, EspIdfGetsVersionAndCompilerThatIsNewEnough) {
    const YAML::Node component = YAML::Load(text_of("idf_component.yml"));
    EXPECT_EQ(component["version"].as<std::string>(), DOTPOSE_VERSION);
    EXPECT_FALSE(component["description"].as<std::string>().empty());
    // ESP-IDF 5.1 is the first version that includes GCC 12.
    EXPECT_EQ(component["dependencies"]["idf"].as<std::string>(), ">=5.1");
}

TEST(Metadata, ZephyrFindsItsFiles) {
    const YAML::Node module = YAML::Load(text_of("zephyr/module.yml"));
    EXPECT_EQ(module["name"].as<std::string>(), "dotpose");
    EXPECT_TRUE(
        fs::exists(kFolder / module["build"]["cmake"].as<std::string>() / "CMakeLists.txt"));
    EXPECT_TRUE(fs::exists(kFolder / module["build"]["kconfig"].as<std::string>()));
    EXPECT_THAT(text_of("zephyr/Kconfig"), ::testing::HasSubstr("\nconfig DOTPOSE\n\tbool "));
}

}  // namespace
