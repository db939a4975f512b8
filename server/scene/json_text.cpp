// A SAX handler that builds the document and knows, at every moment, the JSON pointer it is at.
#include "server/scene/json_text.h"

#include "server/scene/scene_error.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace farlight {

namespace {

using Json = nlohmann::json;

// Deeper than any scene; keeps what walks the document recursively off the end of the stack.
constexpr std::size_t kDeepest = 100;

class DocumentBuilder final : public nlohmann::json_sax<Json> {
public:
    DocumentBuilder(std::string_view text, std::string name) : text_(text), name_(std::move(name))
    {
    }

    Json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t& /*text*/) override
    {
        return add(value);
    }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t& /*value*/) override { return false; }  // not in JSON text
    bool start_object(std::size_t /*size*/) override { return open(Json::object()); }
    bool start_array(std::size_t /*size*/) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override
    {
        levels_.back().key = name;
        if (levels_.back().node->contains(name))
            refuse(here(), "the key " + in_quotes(name) + " a second time", "each key once");
        return true;
    }

    bool parse_error(std::size_t position, const std::string& last_token,
        const nlohmann::detail::exception& error) override;

private:
    struct Level {
        Json* node;
        std::string key;  // of the value being read; empty in an array
    };

    bool add(Json value)
    {
        insert(std::move(value));
        return true;
    }

    bool open(Json value)
    {
        if (levels_.size() == kDeepest)
            refuse(here(), "deeper nesting", "at most " + std::to_string(kDeepest) + " levels");
        levels_.push_back({insert(std::move(value)), {}});
        return true;
    }

    bool close()
    {
        levels_.pop_back();
        return true;
    }

    Json* insert(Json value)
    {
        if (levels_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Json& parent = *levels_.back().node;
        if (parent.is_array())
            return &parent.get_ref<Json::array_t&>().emplace_back(std::move(value));
        return &(parent[levels_.back().key] = std::move(value));
    }

    ScenePlace here() const
    {
        ScenePlace place{name_, {}};
        for (std::size_t i = 0; i < levels_.size(); ++i) {
            const Level& level = levels_[i];
            const bool innermost = i + 1 == levels_.size();
            if (level.node->is_array())  // the level within is an element already
                place = place / (level.node->size() - (innermost ? 0 : 1));
            else if (!level.key.empty())
                place = place / level.key;
        }
        return place;
    }

    std::string_view text_;
    std::string name_;
    Json root_;
    std::vector<Level> levels_;
};

// nlohmann says `[...] parse error at ...: syntax error while parsing X - Y; expected Z`.
bool DocumentBuilder::parse_error(
    std::size_t position, const std::string& last_token, const nlohmann::detail::exception& error)
{
    const std::string_view read = text_.substr(0, position);
    const auto line = 1 + std::count(read.begin(), read.end(), '\n');
    const std::size_t newline = read.rfind('\n');
    const std::size_t column =
        newline == std::string_view::npos ? read.size() : read.size() - newline - 1;
    ScenePlace place = here();
    place.pointer += (place.pointer.empty() ? "line " : " at line ") + std::to_string(line)
        + ", column " + std::to_string(column);

    constexpr int kNumberOverflow = 406;  // nlohmann: out_of_range.406
    if (error.id == kNumberOverflow)
        refuse(place, "the number " + last_token, "a finite number");

    const std::string_view what = error.what();
    const std::size_t reason = what.find("while parsing");
    const std::size_t wanted = what.find("; expected ");
    const std::string_view found = what.substr(reason == std::string_view::npos ? 0 : reason,
        wanted == std::string_view::npos ? std::string_view::npos : wanted - reason);
    refuse(place, "broken JSON " + std::string(found),
        wanted == std::string_view::npos ? "valid JSON"
                                         : what.substr(wanted + 11));  // "; expected "
}

}  // namespace

std::string read_file(const std::filesystem::path& file, std::string_view expected)
{
    const ScenePlace place{file.string(), {}};
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status))
        refuse(place, "no such file", "a file");
    if (std::filesystem::is_directory(status))
        refuse(place, "a folder", "a file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        refuse(place, "a file that cannot be opened", "a readable file");
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad())
        refuse(place, "a file that cannot be read", "a readable file");
    if (bytes.empty())
        refuse(place, "an empty file", expected);
    return bytes;
}

Json parse_json(std::string_view text, const std::string& name)
{
    DocumentBuilder builder(text, name);
    Json::sax_parse(text, &builder);
    return builder.take();
}

}  // namespace farlight
