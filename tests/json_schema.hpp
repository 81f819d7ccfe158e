/// Validates JSON against a JSON Schema (draft 2020-12). Supports only the keywords that are used
/// in docs/schema. Throws an exception for other keywords, because ignoring them would leave part
/// of the schema unchecked.
#pragma once

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace dotpose::test {

class JsonSchema {
  public:
    using Json = nlohmann::json;

    struct Verdict {
        std::vector<std::string> errors;  ///< empty if the value is valid
        /// Keys of the checked object (top level only) that the schema describes.
        std::set<std::string> described_keys;
    };

    explicit JsonSchema(Json schema) : root_(std::move(schema)) {}

    Verdict check(const Json& value) const { return check(root_, value, "line"); }

  private:
    static void add(Verdict& verdict, const Verdict& more) {
        verdict.errors.insert(verdict.errors.end(), more.errors.begin(), more.errors.end());
        verdict.described_keys.insert(more.described_keys.begin(), more.described_keys.end());
    }

    Verdict check(const Json& schema, const Json& value, const std::string& path) const {
        Verdict verdict;
        if (schema.is_boolean()) {
            if (!schema.get<bool>()) verdict.errors.push_back(path + " may not be there");
            return verdict;
        }
        for (const auto& [keyword, rule] : schema.items())
            check_keyword(schema, keyword, rule, value, path, verdict);
        return verdict;
    }

    void check_keyword(const Json& schema, const std::string& keyword, const Json& rule,
                       const Json& value, const std::string& path, Verdict& verdict) const {
        static const std::set<std::string> kNotes = {"$schema",     "$id",  "$defs", "title",
                                                     "description", "then", "else"};
        if (kNotes.contains(keyword)) return;
        if (keyword == "$ref") return add(verdict, check(target_of(rule), value, path));
        if (keyword == "oneOf") return add(verdict, check_one_of(rule, value, path));
        if (keyword == "if") {
            const char* branch = check(rule, value, path).errors.empty() ? "then" : "else";
            if (schema.contains(branch)) add(verdict, check(schema[branch], value, path));
            return;
        }
        if (keyword == "properties") return check_properties(rule, value, path, verdict);
        if (keyword == "items") {
            for (const Json& item : value)
                add(verdict, check(rule, item, path + "[]"));
            return;
        }
        if (!holds(keyword, rule, value)) {
            verdict.errors.push_back(path + ": " + keyword + " " + rule.dump() +
                                     " is not true of " + value.dump());
        }
    }

    const Json& target_of(const std::string& reference) const {
        return root_.at(Json::json_pointer(reference.substr(1)));  // without the leading #
    }

    Verdict check_one_of(const Json& schemas, const Json& value, const std::string& path) const {
        Verdict all;
        Verdict valid;
        int matches = 0;
        for (const Json& schema : schemas) {
            const Verdict verdict = check(schema, value, path);
            matches += verdict.errors.empty();
            add(verdict.errors.empty() ? valid : all, verdict);
        }
        if (matches == 1) return valid;
        all.errors.push_back(path + " matches " + std::to_string(matches) + " schemas of oneOf");
        return all;
    }

    void check_properties(const Json& rules, const Json& object, const std::string& path,
                          Verdict& verdict) const {
        for (const auto& [key, rule] : rules.items()) {
            if (!object.contains(key)) continue;
            add(verdict, {check(rule, object[key], path + "." + key).errors, {}});
            verdict.described_keys.insert(key);
        }
    }

    static bool holds(const std::string& keyword, const Json& rule, const Json& value) {
        if (keyword == "type") return has_type(rule, value);
        if (keyword == "const") return value == rule;
        if (keyword == "enum") return std::ranges::find(rule, value) != rule.end();
        // Bounds apply only to numbers. Values of other types satisfy them.
        const bool is_bound =
            keyword == "minimum" || keyword == "maximum" || keyword == "exclusiveMinimum";
        if (is_bound && !value.is_number()) return true;
        if (keyword == "minimum") return value.get<double>() >= rule.get<double>();
        if (keyword == "maximum") return value.get<double>() <= rule.get<double>();
        if (keyword == "exclusiveMinimum") return value.get<double>() > rule.get<double>();
        if (keyword == "minItems") return value.size() >= rule.get<std::size_t>();
        if (keyword == "maxItems") return value.size() <= rule.get<std::size_t>();
        if (keyword == "required") return has_all(value, rule);
        if (keyword == "dependentRequired") {
            for (const auto& [key, others] : rule.items()) {
                if (value.contains(key) && !has_all(value, others)) return false;
            }
            return true;
        }
        throw std::logic_error("tests/json_schema.hpp does not know the keyword " + keyword);
    }

    static bool has_all(const Json& object, const Json& keys) {
        return std::ranges::all_of(
            keys, [&](const Json& key) { return object.contains(key.get<std::string>()); });
    }

    /// `rule` is the name of a type, or an array of names.
    static bool has_type(const Json& rule, const Json& value) {
        if (rule.is_array()) {
            return std::ranges::any_of(rule,
                                       [&](const Json& type) { return has_type(type, value); });
        }
        const auto type = rule.get<std::string>();
        if (type == "null") return value.is_null();
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "boolean") return value.is_boolean();
        if (type == "number") return value.is_number();
        if (type == "integer") return value.is_number_integer();
        throw std::logic_error("tests/json_schema.hpp does not know the type " + type);
    }

    Json root_;
};

}  // namespace dotpose::test
