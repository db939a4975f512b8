// valijson decides whether and where a document breaks its schema; the wording is ours, because
// valijson's messages name its own internals.
#include "server/scene/json_schema.h"

#include <map>
#include <mutex>
#include <optional>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace farlight {

namespace {

using Json = nlohmann::json;

const Json& resolve(const Json& root, const Json& part)
{
    const auto reference = part.find("$ref");
    if (reference == part.end())
        return part;
    const auto& target = reference->get_ref<const std::string&>();
    return root.at(Json::json_pointer(target.substr(1)));  // after '#'
}

/// The schema's part for `token` of a value under `part`; null if the schema says nothing.
const Json* step(const Json& root, const Json& part, const std::string& token)
{
    const auto properties = part.find("properties");
    if (properties != part.end() && properties->contains(token))
        return &resolve(root, properties->at(token));
    for (const char* const rest : {"items", "additionalProperties"})
        if (part.contains(rest) && part.at(rest).is_object())
            return &resolve(root, part.at(rest));
    return nullptr;
}

/// valijson's context is `<root>`, `["key"]`, `[0]`, ...
std::vector<std::string> tokens_of(const std::vector<std::string>& context)
{
    std::vector<std::string> tokens;
    for (std::size_t i = 1; i < context.size(); ++i) {
        const std::size_t bracket = context[i].starts_with("[\"") ? 2 : 1;
        tokens.push_back(context[i].substr(bracket, context[i].size() - 2 * bracket));
    }
    return tokens;
}

std::string listed(const Json& names)
{
    std::string list;
    for (const auto& name : names)
        list += (list.empty() ? "" : ", ") + name.get<std::string>();
    return list;
}

/// Refuses an object for a key too many or too few, if that is what is wrong with it.
void refuse_keys(const Json& value, const Json& part, const ScenePlace& place)
{
    if (part.value("additionalProperties", Json()) == Json(false))
        for (const auto& [key, unused] : value.items())
            if (!part.at("properties").contains(key)) {
                Json known = Json::array();
                for (const auto& [name, also_unused] : part.at("properties").items())
                    known.push_back(name);
                refuse(place / key, "the unknown key " + in_quotes(key), "one of " + listed(known));
            }
    for (const auto& name : part.value("required", Json::array()))
        if (!value.contains(name.get<std::string>()))
            refuse(place, "no key " + name.dump(),
                part.at("description").get_ref<const std::string&>());
}

[[noreturn]] void refuse_at(const std::vector<std::string>& tokens, const Json& document,
    const Json& schema, const std::string& file)
{
    const Json* value = &document;
    const Json* part = &schema;
    ScenePlace place{file, {}};
    ScenePlace described = place;  // the innermost value whose schema has a description
    const Json* described_value = value;
    const Json* described_part = part;
    for (const std::string& token : tokens) {
        part = step(schema, *part, token);
        if (part == nullptr)
            break;
        value = value->is_array() ? &value->at(std::stoul(token)) : &value->at(token);
        place = place / token;
        if (part->contains("description")) {
            described = place;
            described_value = value;
            described_part = part;
        }
    }
    if (described_value->is_object())
        refuse_keys(*described_value, *described_part, described);
    refuse(described, describe(*described_value),
        described_part->at("description").get_ref<const std::string&>());
}

/// Read once a text, as that takes as long as many a scene.
struct ParsedSchema {
    explicit ParsedSchema(std::string_view text) : document(Json::parse(text))
    {
        valijson::SchemaParser(valijson::SchemaParser::kDraft7)
            .populateSchema(valijson::adapters::NlohmannJsonAdapter(document), schema);
    }

    Json document;
    valijson::Schema schema;
};

/// Texts are embedded ones: a text's place stands for it.
const ParsedSchema& parsed(std::string_view text)
{
    static std::mutex mutex;
    static std::map<const char*, ParsedSchema> known;
    const std::lock_guard lock(mutex);
    return known.try_emplace(text.data(), text).first->second;
}

}  // namespace

void check_schema(const Json& document, std::string_view schema_text, const std::string& file)
{
    const ParsedSchema& schema = parsed(schema_text);
    valijson::ValidationResults results;
    valijson::Validator validator;
    const valijson::adapters::NlohmannJsonAdapter target(document);
    if (validator.validate(schema.schema, target, &results))
        return;
    std::optional<std::vector<std::string>> innermost;
    for (const auto& error : results)
        if (!innermost || error.context.size() > innermost->size())
            innermost = error.context;
    refuse_at(
        tokens_of(innermost.value_or(std::vector<std::string>{})), document, schema.document, file);
}

}  // namespace farlight
